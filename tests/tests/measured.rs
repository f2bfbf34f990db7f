//! Records, declared observations, mirrors and shuffles, end to end: they show what happened.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::control::agents::Agent;
use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece::engine::judge::Recorded;
use setpiece::run::{RunOptions, run};
use setpiece::scenario::{Action, EventKind, Qualifier, Team};
use setpiece_tests::environment;

fn number(environment: &Environment, name: &str) -> f64 {
    let (_, value) = environment.records().find(|(known, _)| *known == name).unwrap();
    value.number().unwrap_or_else(|| panic!("{name}: {value:?}"))
}

const MEASURED: &str = "scenario measured extends academy_3_vs_1_with_keeper {
    record completed = count of pass completed by left
    record attempted = count of pass by left
    record completion = (count of pass completed by left) / max(count of pass by left, 1)
    record in_box = count of (ball in right.box)
    record top_speed = max of me.speed
    record lowest = min of ball.height
    record mean_x = mean of ball.x
    record begun = first of ball.x
    record ended = last of ball.x
    record path = series of ball
    end limit 120 steps
}";

#[test]
fn records_say_what_happened() {
    let mut environment = environment(MEASURED);
    let mut scratch = Scratch::default();
    let mut passes = 0.0;
    for index in 0..5 {
        environment.reset(Some(1), Some(index)).unwrap();
        let (mut completed, mut attempted, mut in_box, mut top, mut xs) =
            (0.0, 0.0, 0.0, 0.0_f64, Vec::new());
        while environment.is_running() {
            environment.step(&[Action::BuiltinAi], &mut scratch).unwrap();
            for event in environment.events() {
                let ours = event.kind == EventKind::Pass && event.team == Some(Team::Left);
                completed +=
                    f64::from(u8::from(ours && event.qualifier == Some(Qualifier::Completed)));
                attempted +=
                    f64::from(u8::from(ours && event.qualifier == Some(Qualifier::Attempted)));
            }
            // The episode's last step may have been followed by a restart, which records don't see.
            if environment.is_running() {
                let game = environment.state();
                let ball = game.ball.pos;
                in_box +=
                    f64::from(u8::from((38.5..=55.0).contains(&ball.x) && ball.y.abs() <= 20.15));
                xs.push(f64::from(ball.x) / 54.4);
                let me = game.agents[0].player.unwrap();
                top = top.max(f64::from(game.players[me.index()].vel.length()));
            }
        }
        assert_eq!(number(&environment, "completed"), completed);
        assert_eq!(number(&environment, "attempted"), attempted);
        assert_eq!(number(&environment, "completion"), completed / attempted.max(1.0));
        assert!((0.0..=1.0).contains(&(number(&environment, "in_box") - in_box)));
        assert!(number(&environment, "top_speed") >= top - 1e-6);
        assert!(number(&environment, "lowest") >= 0.1);
        assert!((number(&environment, "begun") - xs[0]).abs() < 1e-6);
        let (_, path) = environment.records().find(|(name, _)| *name == "path").unwrap();
        let Recorded::Places(path) = path else { panic!("{path:?}") };
        assert_eq!(path.len(), environment.steps() as usize);
        assert!(path.iter().zip(&xs).all(|(at, x)| (at[0] - x).abs() < 1e-6));
        let mean = path.iter().map(|at| at[0]).sum::<f64>() / path.len() as f64;
        assert!((number(&environment, "mean_x") - mean).abs() < 1e-9);
        assert_eq!(number(&environment, "ended"), path.last().unwrap()[0]);
        passes += attempted;
    }
    assert!(passes > 0.0, "nothing was measured");
}

const EFFORT: &str = "scenario effort extends academy {
    ball at (0, 0)
    team left { CM at (-0.02, 0) }
    team right { GK at (-1, 0)  CB at (-0.5, 0) }
    record shots = count of (me.action == shot)
    record switches = count of (me.action changes)
    record sprints = count of me.sprinting
    record close = count of me.dribbling
    record theirs = count of any(p.action != idle for p in right)
    reward cost {
        give 1 when me.action == shot as \"shot\"
        give 1 when prev(me.action) == shot as \"shot before\"
    }
    end limit 8 steps
}";

#[test]
fn actions_are_read_as_they_were_pressed() {
    let mut environment = environment(EFFORT);
    let mut scratch = Scratch::default();
    environment.reset(Some(1), Some(0)).unwrap();
    let pressed = [
        Action::Idle,
        Action::Sprint,
        Action::Left,
        Action::Left,
        Action::ReleaseSprint,
        Action::Dribble,
        Action::Shot,
        Action::Idle,
    ];
    for action in pressed {
        environment.step(&[action], &mut scratch).unwrap();
    }
    assert!(!environment.is_running());
    assert_eq!(number(&environment, "shots"), 1.0);
    // Nobody has acted before the first step, which counts as idle.
    assert_eq!(number(&environment, "switches"), 6.0);
    assert_eq!(number(&environment, "sprints"), 3.0);
    assert_eq!(number(&environment, "close"), 3.0);
    assert!(number(&environment, "theirs") > 0.0, "the bots press nothing");
    assert_eq!(environment.term_sums(0)[environment.term_names().len() - 2..], [1.0, 1.0]);
}

const RONDO: &str = "scenario rondo extends academy {
    param enough: int = 3
    agents { left: 1 }
    ball at (0, 0)
    team left { CM at (-0.02, 0)  CM at (0.1, 0.2)  CM at (0.1, -0.2)  CM at (0.2, 0) }
    team right { CB at (0.1, 0) { ai: chase } }
    record passes = count of pass completed by left
    record tries = count of pass by left
    record completion = passes / max(tries, 1)
    record quickest = max of ball.speed
    record late = prev(passes)
    record slower = prev(quickest)
    reward chain { state n = 0  on pass completed by us { n = n + 1 } }
    reward kept {
        give delta(passes) as \"each\"
        give passes as \"so far\"
        give delta(quickest) / 1m/s as \"quicker\"
        on pass completed by us { give count of pass completed by us as \"numbered\" }
    }
    remove end possession
    end success kept when passes >= enough and passes == chain.n
    end limit 400 steps
}";

#[test]
fn records_are_read_by_endings_rewards_and_other_records() {
    let text = format!("behavior chase {{ repeat {{ do move_to(ball) for 1s }} }}\n{RONDO}");
    let mut environment = environment(&text);
    let mut scratch = Scratch::default();
    let mut kept = 0;
    for index in 0..240 {
        environment.reset(Some(3), Some(index)).unwrap();
        let (mut passes, mut so_far, mut numbered) = (0.0, 0.0, 0.0);
        while environment.is_running() {
            let before = passes;
            let result = environment.step(&[Action::BuiltinAi], &mut scratch).unwrap();
            let completed = environment.events().iter().filter(|event| {
                event.kind == EventKind::Pass
                    && event.team == Some(Team::Left)
                    && event.qualifier == Some(Qualifier::Completed)
            });
            passes += completed.count() as f64;
            numbered += passes * (passes - before);
            so_far += passes;
            assert_eq!(number(&environment, "passes"), passes);
            assert_eq!(number(&environment, "late"), before);
            assert!(result.terminated || passes < 3.0, "passes: {passes}");
        }
        let tries = number(&environment, "tries");
        assert_eq!(number(&environment, "completion"), passes / tries.max(1.0));
        assert!(number(&environment, "slower") <= number(&environment, "quickest"));
        let paid = |term: &str| {
            let at = environment.term_names().iter().position(|known| known == term).unwrap();
            environment.term_sums(0)[at]
        };
        assert_eq!(paid("kept/each"), passes);
        assert_eq!(paid("kept/so far"), so_far);
        assert_eq!(paid("kept/numbered"), numbered);
        let quickest = number(&environment, "quickest");
        assert!((paid("kept/quicker") - quickest).abs() < 1e-6, "the ball lay still at first");
        let outcome = environment.outcome().unwrap();
        assert!((&*outcome.label == "kept") == (passes >= 3.0), "{outcome:?}");
        kept += u32::from(passes >= 3.0);
    }
    assert!(kept > 0, "nobody kept the ball");
}

#[test]
fn a_run_averages_records_over_its_episodes() {
    let loaded = setpiece::compile_text(MEASURED, "<test>").unwrap();
    let options = RunOptions {
        episodes: 0..8,
        seed: 2,
        agent: Agent::Bot.into(),
        threads: 2,
        environment: EnvironmentOptions::default(),
    };
    let summary = run(&loaded.scenario, &options, |_| {}).unwrap();
    let mean =
        |name: &str| summary.records.iter().find(|it| it.name == name).map(|record| record.mean);
    let attempted: f64 = summary
        .episodes
        .iter()
        .flatten()
        .map(|episode| {
            episode
                .records
                .iter()
                .find(|(name, _)| name == "attempted")
                .unwrap()
                .1
                .number()
                .unwrap()
        })
        .sum();
    assert_eq!(mean("attempted"), Some(attempted / 8.0));
    assert_eq!(mean("path"), None, "a series has no mean");
}

#[test]
fn what_depends_on_the_agent_is_recorded_for_each() {
    let mut environment = environment(
        "scenario s extends academy {
            agents { left: [one, two] }
            rules { assist: off }
            ball at (0, 0.3)
            team left { one: CM at (0, 0)  two: CM at (0.2, 0.1) }
            record way = sum of closing(me, right.goal)
            end limit 30 steps
        }",
    );
    let mut scratch = Scratch::default();
    environment.reset(Some(1), None).unwrap();
    while environment.is_running() {
        environment.step(&[Action::Right, Action::Left], &mut scratch).unwrap();
    }
    let (_, way) = environment.records().next().unwrap();
    let Recorded::PerAgent(ways) = way else { panic!("{way:?}") };
    let ways: Vec<f64> = ways.iter().map(|way| way.number().unwrap()).collect();
    assert!(ways[0] > 3.0 && ways[1] < -3.0, "{ways:?}");
}

#[test]
fn a_declared_observation_shows_the_state_in_the_own_frame() {
    let mut environment = environment(
        "scenario s extends academy {
            agents { left: [one], right: [other] }
            let far = uniform(0.1, 0.2)
            ball at (0.5, far)
            team left { one: CM at (0, 0) }
            team right { other: CB at (0.7, 0.1) }
            observe vector {
                ball.x, ball.y
                me as \"me\"
                distance(me, ball) / 10m as \"gap\"
                far
                delta(ball.x) as \"dx\"
            }
        }",
    );
    assert_eq!(
        environment.observed_names(),
        ["ball.x", "ball.y", "me.x", "me.y", "gap", "far", "dx"]
    );
    environment.reset(Some(1), None).unwrap();
    let far = environment.state().ball.pos.y / 83.6;
    let (mut left, mut right) = ([0.0; 7], [0.0; 7]);
    let near = |found: &[f32; 7], expected: [f32; 7]| {
        found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-4)
    };
    environment.observe_vector(0, &mut left).unwrap();
    environment.observe_vector(1, &mut right).unwrap();
    let gap = |x: f32, y: f32| ((x - 0.5) * 54.4).hypot((y - far) * 83.6) / 10.0;
    assert!(near(&left, [0.5, far, 0.0, 0.0, gap(0.0, 0.0), far, 0.0]), "{left:?}");
    assert!(near(&right, [-0.5, -far, -0.7, -0.1, gap(0.7, 0.1), far, 0.0]), "{right:?}");
    let mut scratch = Scratch::default();
    let mut moved = 0.0_f32;
    while environment.is_running() && moved < 0.1 {
        let before = environment.state().ball.pos.x;
        environment.step(&[Action::BuiltinAi, Action::BuiltinAi], &mut scratch).unwrap();
        environment.observe_vector(0, &mut left).unwrap();
        let dx = (environment.state().ball.pos.x - before) / 54.4;
        assert!((left[6] - dx).abs() < 1e-5, "{left:?}, {dx}");
        moved += dx.abs();
    }
    assert!(moved > 0.01, "the ball never moved");
    assert!(environment.observe_vector(0, &mut [0.0; 3]).is_err());
    assert!(environment.observe_vector(7, &mut left).is_err());
}

const PLAIN: &str = "scenario s extends academy {
    agents { left: [striker] }
    region goalside = rect((0.9, -0.3), (1, 0))
    ball right of striker by 2m { velocity: (3m/s, 4m/s, 0m/s) }
    team left {
        striker: CF at (0.5, -0.1) facing 30deg
        LB at left.corner.top
        CB in half_space.top
    }
    team right { CB ahead of striker by 5m  RM at own (0.1, 0.2) }
    end success inside when ball in goalside
}";

#[test]
fn a_mirror_shows_the_same_start_the_other_way_round() {
    let starts = |mirror: &str| {
        let mut environment =
            environment(&PLAIN.replace("agents {", &format!("{mirror} agents {{")));
        environment.reset(Some(1), Some(0)).unwrap();
        environment
    };
    let (plain, flanks, ends) = (starts(""), starts("mirror: flanks"), starts("mirror: ends"));
    let near = |a: glam::Vec2, x: f32, y: f32| (a.x - x).abs() < 1e-3 && (a.y - y).abs() < 1e-3;
    for id in [0, 1, 11, 12] {
        let here = plain.state().players[id].pos;
        assert!(near(flanks.state().players[id].pos, here.x, -here.y), "{id}");
        assert!(near(ends.state().players[(id + 11) % 22].pos, -here.x, -here.y), "{id}");
    }
    let ball = plain.state().ball;
    assert!(near(flanks.state().ball.pos.truncate(), ball.pos.x, -ball.pos.y));
    assert!(near(ends.state().ball.pos.truncate(), -ball.pos.x, -ball.pos.y));
    assert!(
        near(flanks.state().ball.vel.truncate(), 3.0, -4.0)
            && near(ends.state().ball.vel.truncate(), -3.0, -4.0)
    );
    let heading =
        |environment: &Environment, id: usize| environment.state().players[id].heading_rad;
    assert!((heading(&flanks, 0) + heading(&plain, 0)).abs() < 1e-4);
    // A player at the left flank's top is at its bottom: a drawn place follows its region.
    assert!(plain.state().players[2].pos.y < -9.1 && flanks.state().players[2].pos.y > 9.1);
    assert_eq!(ends.agents()[0].team, Team::Right);
    let role = |environment: &Environment, id: usize| environment.state().players[id].role.name();
    assert_eq!((role(&plain, 1), role(&flanks, 1), role(&ends, 12)), ("LB", "RB", "LB"));
    assert_eq!((role(&plain, 12), role(&flanks, 12), role(&ends, 1)), ("RM", "LM", "RM"));
}

#[test]
fn every_order_of_a_shuffle_is_as_likely() {
    let mut environment = environment(
        "scenario s extends academy {
            let (a, b, c) = shuffle(-0.2, 0, 0.2)
            ball at (0.5, 0)
            team left { CM at (0, a)  CM at (0.1, b)  CM at (0.2, c) }
        }",
    );
    let mut counts = std::collections::BTreeMap::new();
    for index in 0..1200 {
        environment.reset(Some(4), Some(index)).unwrap();
        let players = &environment.state().players;
        let order: Vec<i32> = (0..3).map(|id| (players[id].pos.y / 10.0).round() as i32).collect();
        *counts.entry(order).or_insert(0) += 1;
    }
    assert_eq!(counts.len(), 6, "{counts:?}");
    assert!(counts.values().all(|&count| (150..250).contains(&count)), "{counts:?}");
}

const METRES: &str = "scenario metres extends academy {
    agents { left: 1  right: 1 }
    ball at (27.2m, -8m)
    team left { CM at (20m, 3m) }
    team right { CM at (30m, 5m) }
    observe vector {
        ball.metres.x / 1m as \"x\"
        ball.metres.y / 1m as \"y\"
        me.metres as \"me\"
        (30m, 5m).metres as \"same\"
        ball.x as \"normalised\"
    }
    end limit 5 steps
}";

#[test]
fn a_place_in_metres_is_read_in_the_own_frame() {
    let mut environment = environment(METRES);
    environment.reset(Some(1), None).unwrap();
    let mut seen = [0.0; 7];
    environment.observe_vector(0, &mut seen).unwrap();
    assert_eq!(seen, [27.2, -8.0, 20.0, 3.0, 30.0, 5.0, 0.5]);
    // The right team's x and y are turned, and so are its literals.
    environment.observe_vector(1, &mut seen).unwrap();
    assert_eq!(seen, [-27.2, 8.0, -30.0, -5.0, 30.0, 5.0, -0.5]);
}
