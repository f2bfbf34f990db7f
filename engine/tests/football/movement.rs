//! Movement against the curves measured on the original, 100 ms per step.

use crate::Bench;
use crate::layouts::Layout;
use setpiece_scenario::vocabulary::Action;

/// Speeds at each step, m/s, from the distance covered in it.
fn speeds(layout: Layout, keys: &[Action], steps: usize) -> Vec<f32> {
    let mut bench = Bench::new(layout, 0);
    // A player who has stood for a step sets off at once.
    bench.step(Action::Idle);
    let id = bench.game.agents[0].player.unwrap();
    let mut before = bench.game.player(id).pos;
    (0..steps)
        .map(|step| {
            bench.step(keys.get(step).copied().unwrap_or(Action::Idle));
            let now = bench.game.player(id).pos;
            let speed = now.distance(before) * 10.0;
            before = now;
            speed
        })
        .collect()
}

#[test]
fn a_sprint_from_standstill_follows_the_measured_curve() {
    let measured = [
        0.36, 2.19, 3.11, 3.93, 4.69, 5.07, 5.34, 5.86, 6.31, 6.69, 6.97, 7.19, 7.36, 7.48, 7.57,
        7.64, 7.69, 7.73, 7.75, 7.77,
    ];
    // The first step presses only the direction, so both gaits start alike.
    let run = speeds(Layout::Alone, &[Action::Right, Action::Sprint], 24);
    for (step, (is, should)) in run.iter().zip(measured).enumerate() {
        let tolerance = (0.1f32 * should).max(0.4);
        assert!((is - should).abs() <= tolerance, "step {step}: {is:.2} m/s, measured {should:.2}");
    }
}

#[test]
fn the_gaits_top_out_where_they_should() {
    let top = |layout, keys: &[Action]| *speeds(layout, keys, 60).last().unwrap();
    let near = |is: f32, should: f32| {
        assert!((is - should).abs() <= 0.05 * should, "{is} against {should}");
    };
    near(top(Layout::Alone, &[Action::Right]), 5.0);
    near(top(Layout::Alone, &[Action::Right, Action::Dribble]), 3.5);
    near(top(Layout::Alone, &[Action::Right, Action::Sprint]), 7.82);
}

#[test]
fn with_the_ball_a_sprint_is_slower_but_keeps_the_ball() {
    let mut bench = Bench::new(Layout::AloneWithBall, 0);
    let id = bench.game.agents[0].player.unwrap();
    bench.step(Action::Right);
    bench.step(Action::Sprint);
    let mut owned = 0;
    for _ in 0..60 {
        bench.step(Action::Idle);
        owned += usize::from(bench.game.owner == Some(id));
    }
    let from = bench.game.player(id).pos;
    for _ in 0..20 {
        bench.step(Action::Idle);
    }
    let mean = bench.game.player(id).pos.distance(from) / 2.0;
    assert!((6.7..7.6).contains(&mean), "{mean} m/s");
    assert!(owned >= 30, "owned in {owned} of 60 steps");
    assert!(bench.game.player(id).pos.distance(bench.game.ball.pos.truncate()) < 3.0);
}

#[test]
fn stops_are_as_long_as_measured() {
    for (sprint, way_m, steps) in [(false, 1.1, 5), (true, 2.4, 7)] {
        let mut bench = Bench::new(Layout::Alone, 0);
        let id = bench.game.agents[0].player.unwrap();
        bench.step(Action::Right);
        bench.step(if sprint { Action::Sprint } else { Action::Idle });
        for _ in 0..28 {
            bench.step(Action::Idle);
        }
        let from = bench.game.player(id).pos;
        bench.step(Action::ReleaseDirection);
        let mut taken = 1;
        while bench.game.player(id).vel.length() > 0.1 {
            bench.step(Action::Idle);
            taken += 1;
        }
        let way = bench.game.player(id).pos.distance(from);
        assert!((way - way_m).abs() < 0.35 * way_m, "{way} m against {way_m}");
        assert!(taken <= steps, "{taken} steps");
    }
}

#[test]
fn turns_take_as_long_as_measured() {
    // Steps until the velocity is within 12 degrees of the new direction, and until 90 % of the
    // speed is back.
    let cases = [
        (false, Action::BottomRight, 2..=5, 2..=6),
        (false, Action::Bottom, 3..=6, 4..=9),
        (true, Action::BottomRight, 2..=6, 2..=9),
        (true, Action::Bottom, 4..=8, 9..=15),
    ];
    for (sprint, turn, direction_steps, speed_steps) in cases {
        let mut bench = Bench::new(Layout::Alone, 0);
        let id = bench.game.agents[0].player.unwrap();
        bench.step(Action::Right);
        bench.step(if sprint { Action::Sprint } else { Action::Idle });
        for _ in 0..28 {
            bench.step(Action::Idle);
        }
        let old = bench.game.player(id).vel.length();
        let (x, y) = turn.direction().unwrap();
        let aim = glam::Vec2::new(x as f32, y as f32);
        let (mut turned, mut fast) = (None, None);
        for step in 1..=30 {
            bench.step(if step == 1 { turn } else { Action::Idle });
            let vel = bench.game.player(id).vel;
            let straight = vel.normalize_or_zero().dot(aim) > 0.978;
            turned = turned.or(straight.then_some(step));
            fast = fast.or((straight && vel.length() >= 0.9 * old).then_some(step));
        }
        let (turned, fast) = (turned.unwrap(), fast.unwrap());
        assert!(direction_steps.contains(&turned), "sprint {sprint} {turn}: turned after {turned}");
        assert!(speed_steps.contains(&fast), "sprint {sprint} {turn}: fast again after {fast}");
    }
}

#[test]
fn running_tires_and_standing_does_not() {
    let mut bench = Bench::new(Layout::Alone, 0);
    let id = bench.game.agents[0].player.unwrap();
    let mut way = Action::Right;
    bench.step(way);
    bench.step(Action::Sprint);
    for step in 0..498 {
        // Up and down the pitch.
        way = if step % 100 == 50 {
            Action::Left
        } else if step % 100 == 0 {
            Action::Right
        } else {
            Action::Idle
        };
        bench.step(way);
    }
    let tired = bench.game.player(id).fatigue;
    assert!((0.2..0.3).contains(&tired), "{tired} after 500 steps of sprint");
    assert_eq!(bench.game.players[0].fatigue, 0.0);
}
