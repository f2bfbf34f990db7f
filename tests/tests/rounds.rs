//! Several rounds in one episode, and players who are replaced.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::environment::{Environment, Scratch};
use setpiece::scenario::Action;
use setpiece::scenario::pitch::X_SCALE_M;

const ROUNDS: &str = "
behavior forward { do run(0deg) }
scenario s {
    agents { left: 1 }
    let place = uniform(-0.5, 0.5)
    let side = if mod(round, 2) == 1 then -1 else 1
    start open { score: [2, 0] }
    ball at (place, side * 0.3)
    team left {
        GK at (-1, 0) { controllable: off, ai: hold }
        CM at (-0.8, 0) when round < 3
        CF at (-0.8, 0.1) when round == 3
    }
    team right { CB at (-0.9, 0.4) { ai: forward } }
    rounds 3 when round_elapsed >= 2s
    reward all {
        give round as \"rounds\"
        give place as \"let\"
        give potential(ball.x, gamma: 1) as \"potential\"
    }
    record seen = last of round
    record elapsed = max of round_elapsed
    record began = first of place
    record ends = last of place
    end limit 30s
}
";

fn environment() -> Environment {
    setpiece_tests::environment(ROUNDS)
}

/// What a step shows: the ball, the players, the terms.
fn shown(environment: &Environment) -> (Vec<f32>, Vec<f64>) {
    let game = environment.state();
    let mut places = vec![game.ball.pos.x, game.ball.pos.y];
    places.extend(game.players.iter().flat_map(|player| player.pos.to_array()));
    (places, environment.terms(0).to_vec())
}

/// Plays an episode to its end and gives what every step shows.
fn played(environment: &mut Environment, action: Action) -> Vec<(Vec<f32>, Vec<f64>)> {
    let mut scratch = Scratch::default();
    let mut all = Vec::new();
    while environment.is_running() {
        environment.step(&[action], &mut scratch).unwrap();
        all.push(shown(environment));
    }
    all
}

#[test]
fn a_start_is_drawn_for_every_round_and_the_rest_goes_on() {
    let mut environment = environment();
    environment.reset(Some(3), Some(0)).unwrap();
    let mut scratch = Scratch::default();
    let (mut places, mut lets) = (vec![environment.state().ball.pos], Vec::new());
    while environment.is_running() {
        let result = environment.step(&[Action::Idle], &mut scratch).unwrap();
        let game = environment.state();
        let of_let = environment.terms(0)[1];
        match game.step {
            20 | 40 => {
                assert_eq!(environment.round(), game.step / 20 + 1);
                places.push(game.ball.pos);
                lets.push(of_let);
                assert!(environment.is_running() && !result.terminated);
                assert_eq!(game.score, [2, 0]);
                assert!(game.player(setpiece::engine::state::PlayerId(11)).pos.x < -48.0);
            }
            60 => {
                lets.push(of_let);
                assert!(result.terminated && !result.truncated);
            }
            _ => assert!(!result.terminated && !result.truncated),
        }
    }
    assert_eq!(environment.outcome().unwrap().label.as_ref(), "rounds");
    assert!(places[0].y < 0.0 && places[1].y > 0.0 && places[2].y < 0.0, "{places:?}");
    assert!(lets[0] != lets[1] && lets[1] != lets[2], "{lets:?}");
    let records: Vec<_> =
        environment.records().map(|(name, value)| format!("{name} {value:?}")).collect();
    assert!(records[0].contains("3.0") && records[1].contains("2.0"), "{records:?}");
    assert_ne!(records[2].split(' ').next_back(), records[3].split(' ').next_back());
    let sums = environment.term_sums(0);
    assert_eq!(sums[0], 20.0 + 40.0 + 60.0);
    // The ball's moves between the rounds count. At the end the potential is 0.
    let first = f64::from(places[0].x) / X_SCALE_M;
    assert!((sums[2] + first).abs() < 1e-6, "{sums:?} {first}");
}

#[test]
fn rounds_are_the_same_again_and_after_a_snapshot() {
    let mut one = environment();
    one.reset(Some(3), Some(4)).unwrap();
    let first = played(&mut one, Action::Right);
    one.reset(Some(3), Some(4)).unwrap();
    assert_eq!(played(&mut one, Action::Right), first);
    one.reset(Some(3), Some(5)).unwrap();
    assert_ne!(played(&mut one, Action::Right), first);

    one.reset(Some(3), Some(4)).unwrap();
    let mut scratch = Scratch::default();
    for _ in 0..33 {
        one.step(&[Action::Right], &mut scratch).unwrap();
    }
    let bytes = one.snapshot().unwrap();
    let mut other = environment();
    other.restore(&bytes).unwrap();
    assert_eq!(other.round(), 2);
    assert_eq!(played(&mut other, Action::Right), first[33..]);
}

#[test]
fn a_substitute_has_the_place_of_the_other_and_legs_of_their_own() {
    let text = "scenario s {
        agents { left: 1 }
        ball at (0, 0.4)
        team left { tired: CM at (-0.8, 0) { fatigue: 0.9, yellow_cards: 1, difficulty: 0.5 } }
        team right { CB at (0.9, 0) { ai: hold } }
        substitute tired when elapsed >= 1s and tired.fatigue > 50% {
            difficulty: 1
            stats: { speed: 1 - tired.fatigue / 2 }
        }
        end limit 40 steps
    }";
    let mut environment = setpiece_tests::environment(text);
    for index in 0..2 {
        environment.reset(Some(3), Some(index)).unwrap();
        let mut scratch = Scratch::default();
        for step in 1..=40 {
            let from = environment.state().players[0].pos;
            environment.step(&[Action::Right], &mut scratch).unwrap();
            let player = &environment.state().players[0];
            assert!(player.pos.distance(from) < 1.2);
            if step < 10 {
                assert!(player.fatigue > 0.85 && player.yellow_cards == 1);
                assert!((player.difficulty - 0.5).abs() < 1e-6);
            } else {
                assert!(player.fatigue < 0.05 && player.yellow_cards == 0);
                assert!((player.difficulty - 1.0).abs() < 1e-6);
            }
        }
        let bytes = environment.snapshot().unwrap();
        let mut other = environment.clone();
        other.restore(&bytes).unwrap();
        assert_eq!(other.digest(), environment.digest());
    }
}
