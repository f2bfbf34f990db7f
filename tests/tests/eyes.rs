//! Noise, delays, stacks and views of declared observations, end to end.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::environment::{Environment, Scratch};
use setpiece::scenario::Action;
use setpiece_tests::environment;

/// A scenario of two agents on each side, with these lines to observe.
fn scenario(lines: &str) -> String {
    format!(
        "scenario eyes extends academy {{
            param lag: duration = 0.2s in 0s..1s
            agents {{ left: all  right: all }}
            ball at (0.3, 0.05)
            team left {{ CF at (0.28, 0.05)  CM at (0.2, 0.1) }}
            team right {{ CB at (0.4, 0)  CM at (0.5, 0.1) }}
            observe vector {{ {lines} }}
            end limit 60 steps
        }}"
    )
}

fn seen(environment: &mut Environment, agent: usize) -> Vec<f32> {
    let mut out = vec![f32::NAN; environment.observed_names().len()];
    environment.observe_vector(agent, &mut out).unwrap();
    out
}

/// Every observation of an episode: step by step, agent by agent.
fn watched(environment: &mut Environment, index: u64) -> Vec<Vec<Vec<f32>>> {
    let mut scratch = Scratch::default();
    environment.reset(Some(7), Some(index)).unwrap();
    let mut all = Vec::new();
    loop {
        all.push((0..4).map(|agent| seen(environment, agent)).collect());
        if !environment.is_running() {
            return all;
        }
        environment.step(&[Action::BuiltinAi; 4], &mut scratch).unwrap();
    }
}

#[test]
fn noise_has_its_distribution_and_changes_nothing_else() {
    let mut plain = environment(&scenario("ball.metres as \"ball\""));
    let noisy = "ball.metres as \"ball\"  ball.metres noise normal(0, 0.3m) as \"noisy\"
        me.speed + uniform(-1m/s, 1m/s) as \"speed\"  ball noise normal(0, 0.3m) as \"place\"";
    let mut noisy = environment(&scenario(noisy));
    let (mut errors, mut last) = (Vec::new(), 0.0_f32);
    for index in 0..8 {
        let (exact, blurred) = (watched(&mut plain, index), watched(&mut noisy, index));
        assert_eq!(plain.digest(), noisy.digest(), "noise changes no match");
        for (exact, blurred) in exact.iter().flatten().zip(blurred.iter().flatten()) {
            assert_eq!(exact[..2], blurred[..2]);
            errors.extend([blurred[2] - blurred[0], blurred[3] - blurred[1]]);
            // The same noise in metres stands behind normalised places.
            let place = (blurred[5] * 54.4 - blurred[0]).abs();
            assert!(place < 2.0 && place != last, "{place}");
            last = place;
        }
        assert_eq!(watched(&mut noisy, index), blurred, "an episode is seen the same again");
    }
    let n = errors.len() as f32;
    let mean = errors.iter().sum::<f32>() / n;
    let sd = (errors.iter().map(|error| error * error).sum::<f32>() / n).sqrt();
    assert!(n > 1000.0 && mean.abs() < 0.03 && (sd - 0.3).abs() < 0.03, "{mean} {sd} {n}");
}

#[test]
fn noise_differs_between_agents_numbers_and_steps_but_not_between_looks() {
    let mut environment = environment(&scenario("ball.metres noise normal(0, 1m)"));
    environment.reset(Some(1), None).unwrap();
    let first: Vec<Vec<f32>> = (0..4).map(|agent| seen(&mut environment, agent)).collect();
    assert_eq!(first[0], seen(&mut environment, 0), "a second look shows the same");
    let mut errors: Vec<u32> = Vec::new();
    let ball = environment.state().ball.pos;
    for (agent, seen) in first.iter().enumerate() {
        let side = if agent < 2 { 1.0 } else { -1.0 };
        errors.extend([(seen[0] - side * ball.x).to_bits(), (seen[1] - side * ball.y).to_bits()]);
    }
    environment.step(&[Action::Idle; 4], &mut Scratch::default()).unwrap();
    let next = seen(&mut environment, 0);
    errors.push((next[0] - environment.state().ball.pos.x).to_bits());
    errors.sort_unstable();
    errors.dedup();
    assert_eq!(errors.len(), 9, "every number has noise of its own");
}

#[test]
fn delays_and_stacks_show_what_was_seen() {
    let lines = "ball.metres noise normal(0, 0.1m) as \"now\"
        ball.metres.x delayed 0.3s as \"exact late\"  ball.metres.x as \"exact\"
        ball.metres.x delayed lag as \"by parameter\"
        elapsed stack 4 as \"time\"
        elapsed delayed 0.5s stack 2 as \"late time\"";
    let mut environment = environment(&scenario(lines));
    let names = environment.observed_names();
    assert_eq!(
        names[5..],
        [
            "time, 3 steps ago",
            "time, 2 steps ago",
            "time, 1 step ago",
            "time",
            "late time, 1 step ago",
            "late time"
        ]
    );
    let all = watched(&mut environment, 0);
    for (step, agents) in all.iter().enumerate() {
        for (agent, seen) in agents.iter().enumerate() {
            let before = |steps: usize| &all[step.saturating_sub(steps)][agent];
            assert_eq!(seen[2], before(3)[3], "late by three steps");
            assert_eq!(seen[4], before(2)[3], "late by the parameter");
            let time = |steps: usize| step.saturating_sub(steps) as f32 / 10.0;
            assert_eq!(seen[5..9], [time(3), time(2), time(1), time(0)]);
            assert_eq!(seen[9..], [time(6), time(5)]);
        }
    }
}

#[test]
fn a_stack_keeps_the_noise_of_its_steps() {
    let mut environment =
        environment(&scenario("ball.metres.x noise normal(0, 1m) stack 3 as \"x\""));
    let all = watched(&mut environment, 2);
    for (step, agents) in all.iter().enumerate() {
        for (agent, seen) in agents.iter().enumerate() {
            assert_eq!(seen[1], all[step.saturating_sub(1)][agent][2]);
            assert_eq!(seen[0], all[step.saturating_sub(2)][agent][2]);
        }
    }
}

#[test]
fn what_is_behind_is_not_seen() {
    let lines = "sees(me, ball, within: 90deg) as \"sees\"
        angle(me, ball) / 1rad as \"towards\"  me.heading / 1rad as \"facing\"
        ball - me when sees(me, ball, within: 90deg) as \"ball\"  ball - me as \"exact\"";
    let mut environment = environment(&scenario(lines));
    let (mut yes, mut no) = (0, 0);
    for seen in watched(&mut environment, 1).iter().flatten() {
        let turn = (seen[1] - seen[2] + 3.0 * std::f32::consts::PI)
            .rem_euclid(std::f32::consts::TAU)
            - std::f32::consts::PI;
        // On the edge of the view rounding decides.
        if (turn.abs() - std::f32::consts::FRAC_PI_4).abs() > 1e-4 {
            assert_eq!(seen[0] == 1.0, turn.abs() < std::f32::consts::FRAC_PI_4, "{seen:?}");
        }
        let shown = if seen[0] == 1.0 { [seen[5], seen[6]] } else { [0.0, 0.0] };
        assert_eq!(seen[3..5], shown);
        *(if seen[0] == 1.0 { &mut yes } else { &mut no }) += 1;
    }
    assert!(yes > 10 && no > 10, "{yes} seen, {no} not");
}

#[test]
fn a_snapshot_keeps_what_was_seen() {
    let lines = "ball noise normal(0, 0.3m) delayed uniform(0s, 0.4s) stack 3
        1 / (elapsed / 1s - 0.5) as \"fails once\"";
    let mut environment = environment(&scenario(lines));
    let mut scratch = Scratch::default();
    environment.reset(Some(7), Some(3)).unwrap();
    for _ in 0..10 {
        environment.step(&[Action::BuiltinAi; 4], &mut scratch).unwrap();
    }
    let bytes = environment.snapshot().unwrap();
    let mut other = self::environment(&scenario(lines));
    other.restore(&bytes).unwrap();
    let faults = |environment: &Environment| -> Vec<(String, u32)> {
        environment.observed_faults().map(|(name, times)| (name.to_owned(), times)).collect()
    };
    assert_eq!(faults(&environment), [("fails once".to_owned(), 4)]);
    for _ in 0..10 {
        for agent in 0..4 {
            assert_eq!(seen(&mut environment, agent), seen(&mut other, agent));
        }
        assert_eq!(faults(&environment), faults(&other));
        environment.step(&[Action::BuiltinAi; 4], &mut scratch).unwrap();
        other.step(&[Action::BuiltinAi; 4], &mut scratch).unwrap();
    }
}

#[test]
fn what_cannot_be_computed_is_counted_by_name() {
    let mut environment =
        environment(&scenario("1 / (elapsed / 1s - 0.1) as \"early\"  ball.x  sqrt(-1 - ball.x)"));
    environment.reset(Some(1), None).unwrap();
    for step in 0..5 {
        for agent in [0, 0, 2] {
            let out = seen(&mut environment, agent);
            assert!(out.iter().all(|number| number.is_finite()));
            assert_eq!(out[0] == 0.0, step == 1, "shown as 0 while it can't be computed");
        }
        environment.step(&[Action::Idle; 4], &mut Scratch::default()).unwrap();
    }
    let faults: Vec<(&str, u32)> = environment.observed_faults().collect();
    assert_eq!(faults, [("early", 2), ("sqrt(-1 - ball.x)", 10)]);
    environment.reset(None, None).unwrap();
    assert_eq!(environment.observed_faults().count(), 0);
}
