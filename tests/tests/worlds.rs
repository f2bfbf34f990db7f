//! `world { }`: what a scenario draws is what its episodes play under, and travels with them.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::environment::{Environment, Scratch};
use setpiece::engine::physics::{Conditions, Forecast};
use setpiece::engine::state::Match;
use setpiece::replay::{Recorder, Replay};
use setpiece::scenario::PitchSize;
use setpiece::scenario::vocabulary::WorldFigure as Figure;
use setpiece_tests::environment;

/// A lofted ball over an empty pitch, under a world.
fn lofted(world: &str) -> String {
    format!(
        "scenario s {{ {world}
            ball at centre {{ velocity: (15m/s, 0m/s, 12m/s) }}
            team left {{ GK at (-50m, -30m) {{ ai: hold }} }}
            agents {{ left: 0 }}
            end limit 100 steps }}"
    )
}

/// The match of an episode after some steps.
fn after(text: &str, index: u64, steps: u32) -> Match {
    let mut environment = environment(text);
    environment.reset(Some(4), Some(index)).unwrap();
    play(&mut environment, steps);
    environment.state().clone()
}

fn play(environment: &mut Environment, steps: u32) {
    let mut scratch = Scratch::default();
    for _ in 0..steps {
        environment.step(&[], &mut scratch).unwrap();
    }
}

const DRAWN: &str = "world {
    wind: polar(uniform(0m/s, 8m/s), uniform(0deg, 360deg))
    gravity: uniform(8, 11), friction: uniform(0.5, 2), bounce: uniform(0.4, 0.8)
}";

#[test]
fn a_scenarios_world_moves_its_ball() {
    let ball = |world: &str| after(&lofted(world), 0, 20).ball.pos;
    let usual = ball("");
    let blown = ball("world { wind: (0m/s, 8m/s) }");
    assert!(usual.y == 0.0 && blown.y > 1.0, "{usual}, {blown}");
    assert!(ball("world { gravity: 5 }").z > usual.z + 2.0);
    let across = |mirror: &str| {
        let text = lofted(&format!("mirror: {mirror} world {{ wind: (0m/s, 8m/s) }}"));
        after(&text, 0, 20).ball.pos.y
    };
    assert_eq!(across("flanks"), -blown.y);
    assert_eq!(across("ends"), -blown.y);
}

#[test]
fn what_is_usual_changes_no_bit() {
    let written = "world { gravity: 9.81, wind: (0m/s, 0m/s), drag: 1, swerve: 1, spin_decay: 0.07,
        bounce: 0.62, friction: 1 }";
    let end = |world: &str| after(&lofted(world), 0, 60);
    assert_eq!(end(written), end(""));
    assert_eq!(end(written).conditions, Conditions::USUAL);
}

#[test]
fn each_episode_draws_its_own_world() {
    let worlds: Vec<_> = (0..200).map(|i| after(&lofted(DRAWN), i, 0).conditions).collect();
    assert_eq!(worlds[7], after(&lofted(DRAWN), 7, 0).conditions, "the same episode, the same day");
    let all = |figure: Figure| worlds.iter().map(move |world| world.figures()[figure.index()]);
    for (figure, low, high) in
        [(Figure::Gravity, 8.0, 11.0), (Figure::Friction, 0.5, 2.0), (Figure::Bounce, 0.4, 0.8)]
    {
        let (least, most) = (all(figure).fold(99.0, f32::min), all(figure).fold(0.0, f32::max));
        let tenth = 0.1 * (high - low);
        assert!(least >= low && least < low + tenth, "{figure}: {least}");
        assert!(most <= high && most > high - tenth, "{figure}: {most}");
    }
    let winds = all(Figure::WindX).zip(all(Figure::WindY));
    assert!(winds.clone().all(|(x, y)| x.hypot(y) <= 8.0));
    let quarters =
        winds.map(|(x, y)| (x > 0.0, y > 0.0)).collect::<std::collections::BTreeSet<_>>();
    assert_eq!(quarters.len(), 4, "the wind blows from everywhere");
    let drag = all(Figure::Drag).all(|drag| drag == 1.0);
    assert!(drag, "what isn't set is usual");
}

#[test]
fn a_parameter_sets_the_world() {
    let text = lofted("param g: number = 9.81 in 2..20  world { gravity: g }");
    let mut environment = environment(&text);
    let mut bindings = environment.bindings().clone();
    bindings.set_text(&environment.scenario().params, "g", "4").unwrap();
    environment.set_bindings(&bindings).unwrap();
    environment.reset(Some(0), Some(0)).unwrap();
    assert_eq!(environment.state().conditions.figures()[Figure::Gravity.index()], 4.0);
}

#[test]
fn snapshots_and_replays_carry_the_world() {
    let text = lofted(DRAWN);
    let mut environment = environment(&text);
    environment.reset(Some(4), Some(2)).unwrap();
    let mut recorder = Recorder::default();
    recorder.begin(None);
    let world = environment.state().conditions;
    play(&mut environment, 10);
    let snapshot = environment.snapshot().unwrap();
    play(&mut environment, 30);
    let (end, digest) = (environment.state().clone(), environment.digest());
    let replay = Replay::of(&environment, &recorder).unwrap();
    let replay = Replay::from_bytes(&replay.to_bytes().unwrap()).unwrap();
    assert_eq!(replay.play(|_, _| ()).unwrap().digest(), digest);

    environment.reset(Some(4), Some(5)).unwrap();
    let other = environment.state().conditions;
    assert_ne!(other, world, "another day");
    environment.restore(&snapshot).unwrap();
    assert_eq!(environment.state().conditions, world);
    play(&mut environment, 30);
    assert_eq!(*environment.state(), end);
    // A new episode that begins in the snapshot has its own day, and nobody expects the ball on
    // its old way.
    environment.reset_from(&snapshot, Some(4), Some(5)).unwrap();
    let now = environment.state();
    assert_eq!(now.conditions, other);
    assert_eq!(now.play.forecast, Forecast::of(&now.ball, &PitchSize::USUAL, &other, now.tick));
}
