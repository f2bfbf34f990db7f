//! `pitch { }`: what a scenario draws is the ground its episodes are played on, and travels with
//! them.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use glam::Vec3;
use setpiece::engine::environment::{Environment, Scratch};
use setpiece::engine::state::Match;
use setpiece::replay::{Recorder, Replay};
use setpiece::scenario::pitch::{GOAL_KICK_SPOT_M, PENALTY_SPOT_M};
use setpiece::scenario::vocabulary::{EventKind, PitchFigure as Figure};
use setpiece::scenario::{Action, PitchSize};
use setpiece_tests::environment;

/// A ball that moves over a pitch without anybody near it.
fn rolling(pitch: &str, ball: &str) -> String {
    format!(
        "scenario s {{ {pitch}
            ball {ball}
            team left {{ GK at left.goal + (1m, 0m) {{ ai: hold }} }}
            team right {{ GK at right.corner.top - (1m, 0m) {{ ai: hold }} }}
            agents {{ left: 0 }}
            end limit 100 steps }}"
    )
}

/// Four against four, bots all.
fn four_a_side(pitch: &str) -> String {
    format!(
        "scenario s {{ {pitch}
            ball at centre
            agents {{ left: 0 }}
            rules {{ offside: off, stochastic: on }}
            team left {{ GK at left.goal + (1m, 0m)  CB at (-6m, 0m)  2 CM in left.half - left.box }}
            team right {{ GK at right.goal - (1m, 0m)  CB at (6m, 0m)  2 CM in right.half - right.box }}
            record goals = count of goal
            end limit 1200 steps }}"
    )
}

/// An environment at the start of an episode.
fn at_start(text: &str, index: u64) -> Environment {
    let mut environment = environment(text);
    environment.reset(Some(4), Some(index)).unwrap();
    environment
}

/// Plays some steps; calls `see` after each with the events.
fn play(environment: &mut Environment, steps: u32, mut see: impl FnMut(&Match, &[EventKind])) {
    let mut scratch = Scratch::default();
    for _ in 0..steps {
        environment.step(&[], &mut scratch).unwrap();
        let events: Vec<EventKind> = environment.events().iter().map(|event| event.kind).collect();
        see(environment.state(), &events);
    }
}

/// What the referee calls first, and where the ball is in the step after.
fn first_call(pitch: &str, ball: &str) -> Option<(EventKind, Vec3)> {
    const CALLS: [EventKind; 4] =
        [EventKind::Goal, EventKind::ThrowIn, EventKind::Corner, EventKind::GoalKick];
    let mut environment = at_start(&rolling(pitch, ball), 0);
    let mut called = None;
    play(&mut environment, 60, |game, events| {
        let now = events.iter().find(|kind| CALLS.contains(kind));
        called = called.or(now.map(|kind| (*kind, game.ball.pos)));
    });
    called
}

const SMALL: &str = "pitch { length: 40m, width: 30m, goal: 4m, goal_height: 2m }";
const DRAWN: &str = "pitch {
    length: uniform(40m, 60m), width: uniform(30m, 40m), goal: uniform(3m, 5m)
}";

#[test]
fn the_lines_and_goals_are_where_the_scenario_puts_them() {
    let call = |ball: &str| first_call(SMALL, ball).map(|(kind, _)| kind);
    let flat = "at (17m, 0m) { velocity: (12m/s, 0m/s) }";
    assert_eq!(call(flat), Some(EventKind::Goal));
    assert_eq!(first_call("", flat), None, "the usual goal is far away");
    // Beside a goal of 4 m and over one of 2 m, where the usual one would have been hit.
    let beside = "at (17m, 2.6m) { velocity: (12m/s, 0m/s) }";
    let over = "at (17m, 0m) { velocity: (20m/s, 0m/s, 1m/s)  height: 2.2m }";
    for ball in [beside, over] {
        assert!(matches!(call(ball), Some(EventKind::Corner | EventKind::GoalKick)), "{ball}");
        assert_eq!(
            first_call("pitch { length: 40m, width: 30m }", ball).map(|(kind, _)| kind),
            Some(EventKind::Goal),
            "{ball}"
        );
    }
    let (kind, at) = first_call(SMALL, "at (5m, 13m) { velocity: (0m/s, 12m/s) }").unwrap();
    assert_eq!(kind, EventKind::ThrowIn);
    assert!((at.y - 15.0).abs() < 0.2, "{at}");
}

#[test]
fn set_pieces_are_taken_from_this_pitchs_spots() {
    let ball = |start: &str| {
        let text = format!(
            "scenario s {{ {SMALL} start {start}
                team left {{ CM at (10m, 0m) }} team right {{ GK at right.goal }}
                end limit 50 steps }}"
        );
        at_start(&text, 0).state().ball.pos.truncate()
    };
    // The box is in proportion: 40 m of 110 m.
    let share = 40.0 / 110.0;
    assert!((ball("penalty for left").x - (20.0 - PENALTY_SPOT_M as f32 * share)).abs() < 0.01);
    assert!(
        (ball("goal_kick for right").x - (20.0 - GOAL_KICK_SPOT_M as f32 * share)).abs() < 0.01
    );
    let corner = ball("corner for left").abs();
    assert!((corner.x - 20.0).abs() < 0.6 && (corner.y - 15.0).abs() < 0.6, "{corner}");
}

#[test]
fn what_is_usual_changes_no_bit() {
    let written = "pitch { length: 110m, width: 72m, goal: 7.4m, goal_height: 2.5m, box: 16.5m,
        box_width: 40.3m }";
    let end = |pitch: &str| {
        let mut environment = at_start(&four_a_side(pitch), 0);
        play(&mut environment, 600, |_, _| ());
        (environment.state().clone(), environment.digest())
    };
    assert_eq!(end(written), end(""));
    assert_eq!(end(written).0.pitch, PitchSize::USUAL);
}

#[test]
fn each_episode_draws_its_own_pitch() {
    let pitches: Vec<PitchSize> =
        (0..200).map(|index| at_start(&four_a_side(DRAWN), index).state().pitch).collect();
    assert_eq!(pitches[7], at_start(&four_a_side(DRAWN), 7).state().pitch, "the same episode");
    for (figure, low, high) in
        [(Figure::Length, 40.0, 60.0), (Figure::Width, 30.0, 40.0), (Figure::Goal, 3.0, 5.0)]
    {
        let all = || pitches.iter().map(|pitch| pitch.figure(figure));
        let (least, most) = (all().fold(99.0, f64::min), all().fold(0.0, f64::max));
        let tenth = 0.1 * (high - low);
        assert!(least >= low && least < low + tenth, "{figure}: {least}");
        assert!(most <= high && most > high - tenth, "{figure}: {most}");
    }
    for pitch in &pitches {
        let share = pitch.figure(Figure::Length) / Figure::Length.usual();
        assert!((pitch.figure(Figure::Box) - 16.5 * share).abs() < 1e-9, "{pitch:?}");
        assert_eq!(pitch.figure(Figure::GoalHeight), 2.5, "what isn't set is usual");
    }
}

#[test]
fn a_parameter_sets_the_pitch() {
    let text =
        four_a_side("param size: length = 60m in 30m..100m  pitch { length: size, width: 30m }");
    let mut environment = environment(&text);
    let mut bindings = environment.bindings().clone();
    bindings.set_text(&environment.scenario().params, "size", "48m").unwrap();
    environment.set_bindings(&bindings).unwrap();
    environment.reset(Some(0), Some(0)).unwrap();
    assert_eq!(environment.state().pitch.half_length(), 24.0);
}

#[test]
fn rewards_endings_and_observations_read_the_pitch_of_the_episode() {
    let text = "scenario s {
        pitch { length: uniform(40m, 80m), width: 40m }
        ball at centre
        team left { m: CM at right.goal - (3m, 4m) { ai: hold } }
        reward far { give distance(ball, right.goal) / 1m }
        observe vector { right.corner.bottom - me }
        end success inside when ball in circle(centre, 1m) and m in right.box
        end limit 3 steps
    }";
    for index in 0..10 {
        let mut environment = at_start(text, index);
        let half = environment.state().half();
        let mut seen = vec![0.0; environment.observed_names().len()];
        environment.observe_vector(0, &mut seen).unwrap();
        assert!((seen[0] - 3.0).abs() < 1e-3 && (seen[1] - 24.0).abs() < 1e-3, "{seen:?}");
        environment.step(&[Action::Idle], &mut Scratch::default()).unwrap();
        let paid = environment.rewards()[0];
        assert!((paid - half.x).abs() < 1e-3, "{paid} of {half}");
        assert_eq!(&*environment.outcome().unwrap().label, "inside");
    }
}

#[test]
fn formations_are_stretched_over_the_pitch() {
    let places = |pitch: &str| -> Vec<glam::Vec2> {
        let text = format!("scenario s extends 11_vs_11_stochastic {{ {pitch} }}");
        at_start(&text, 0).state().players.iter().map(|player| player.pos).collect()
    };
    let (usual, small) = (places(""), places("pitch { length: 55m, width: 36m }"));
    for (usual, small) in usual.iter().zip(&small) {
        assert!((usual.x - 2.0 * small.x).abs() < 1e-3, "{usual} {small}");
        // Whoever kicks off stands at the ball, wherever that is.
        assert!((usual.y - 2.0 * small.y).abs() < 1e-3 || usual.x.abs() < 2.0, "{usual} {small}");
    }
    assert_eq!(places("pitch { length: 110m, width: 72m }"), usual);
}

#[test]
fn checkpoints_are_in_proportion_to_the_length() {
    let paid = |pitch: &str, ball: &str| {
        let text = format!(
            "scenario s {{ {pitch} ball at {ball} {{ owner: m }}
                team left {{ m: CM at {ball} {{ ai: hold }} }}
                reward checkpoints
                end limit 3 steps }}"
        );
        let mut environment = at_start(&text, 0);
        environment.step(&[Action::Idle], &mut Scratch::default()).unwrap();
        environment.rewards()[0]
    };
    // Halfway to their goal half of the regions are behind, on every pitch.
    let usual = paid("", "(27m, 0m)");
    assert!(usual > 0.3, "{usual}");
    assert_eq!(paid("pitch { length: 55m, width: 36m }", "(13.5m, 0m)"), usual);
}

#[test]
fn a_mirrored_pitch_is_the_same_pitch() {
    let ball = |mirror: &str| {
        let text = format!("mirror: {mirror} {SMALL}");
        let mut environment =
            at_start(&rolling(&text, "at (12m, 6m) { velocity: (9m/s, 2m/s) }"), 0);
        play(&mut environment, 5, |_, _| ());
        environment.state().ball.pos.truncate()
    };
    let usual = ball("none");
    assert_eq!(ball("ends"), -usual);
    assert_eq!(ball("flanks"), glam::Vec2::new(usual.x, -usual.y));
}

#[test]
fn bots_play_football_on_pitches_of_every_size() {
    for pitch in [
        SMALL,
        DRAWN,
        "pitch { length: 20m, width: 15m, goal: 1m, goal_height: 1m }",
        "pitch { length: 120m, width: 90m, goal: 10m, goal_height: 3m }",
    ] {
        let (mut goals, mut touches) = (0, 0);
        for index in 0..14 {
            let mut environment = at_start(&four_a_side(pitch), index);
            let rim = environment.state().rim();
            play(&mut environment, 1199, |game, events| {
                for player in game.players.iter().filter(|player| player.active) {
                    let out = (player.pos.abs() - rim).max_element();
                    assert!(out <= 1e-3, "{} of {rim}", player.pos);
                }
                assert!(game.ball.pos.is_finite());
                goals += events.iter().filter(|kind| **kind == EventKind::Goal).count();
                touches += events.iter().filter(|kind| **kind == EventKind::Touch).count();
            });
        }
        assert!(touches > 460, "{pitch}: {touches}");
        assert!(goals > 0 || pitch.contains("1m,"), "{pitch}: no goal in 28 minutes");
    }
}

#[test]
fn snapshots_and_replays_carry_the_pitch() {
    let mut environment = at_start(&four_a_side(DRAWN), 2);
    let mut recorder = Recorder::default();
    recorder.begin(None);
    let pitch = environment.state().pitch;
    play(&mut environment, 10, |_, _| ());
    let snapshot = environment.snapshot().unwrap();
    play(&mut environment, 200, |_, _| ());
    let (end, digest) = (environment.state().clone(), environment.digest());
    let replay = Replay::of(&environment, &recorder).unwrap();
    let replay = Replay::from_bytes(&replay.to_bytes().unwrap()).unwrap();
    assert_eq!(replay.play(|_, _| ()).unwrap().digest(), digest);

    environment.reset(Some(4), Some(5)).unwrap();
    let other = environment.state().pitch;
    assert_ne!(other, pitch, "another pitch");
    environment.restore(&snapshot).unwrap();
    assert_eq!(environment.state().pitch, pitch);
    play(&mut environment, 200, |_, _| ());
    assert_eq!(*environment.state(), end);
    environment.reset_from(&snapshot, Some(4), Some(5)).unwrap();
    assert_eq!(environment.state().pitch, other, "a new episode draws its own");
}
