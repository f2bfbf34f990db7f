//! After warm-up a step allocates nothing: neither the game, nor the bots, nor judging, nor
//! observing.
//!
//! The exception is rapier itself, which allocates when it runs: if a free ball meets something
//! hard, or comes close to it. In a match of eleven a side that is less than one step in fifty.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test fails by panicking"
)]

use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece::engine::observe;
use setpiece::pixels::PixelEye;
use setpiece::render::Pixels;
use setpiece::scenario::{Action, Scenario};
use std::sync::Arc;

/// The observation that takes most steps to write.
const SCALED: observe::Floats = observe::Floats::Scaled(observe::Scaled::Simple115v2Sticky);

/// Some steps after the first episode.
#[derive(Debug, Default)]
struct Steps {
    played: u32,
    /// Steps in which rapier ran.
    rigid: u32,
    /// Steps that allocated although it didn't.
    allocated: u32,
}

fn steps(name: &str, episodes: u64) -> Steps {
    steps_of(setpiece::load(name).unwrap().scenario, episodes)
}

fn steps_of(scenario: Arc<Scenario>, episodes: u64) -> Steps {
    let mut environment = Environment::new(scenario, EnvironmentOptions::default()).unwrap();
    let mut scratch = Scratch::default();
    let mut floats = vec![0.0; observe::layout::SIMPLE115];
    let mut scaled = vec![0.0; observe::layout::SIMPLE115_STICKY];
    let mut map = vec![0; observe::smm_size(observe::SMM_WIDTH, observe::SMM_HEIGHT)];
    let mut steps = Steps::default();
    for index in 0..=episodes {
        environment.reset(Some(1), Some(index)).unwrap();
        while environment.is_running() {
            let asked = scratch.rigid();
            let counted = allocation_counter::measure(|| {
                environment.step(&[Action::BuiltinAi], &mut scratch).unwrap();
                observe::simple115(environment.state(), 0, &mut floats).unwrap();
                environment.observe(SCALED, 0, &mut scaled).unwrap();
                observe::smm(
                    environment.state(),
                    0,
                    observe::SMM_WIDTH,
                    observe::SMM_HEIGHT,
                    &mut map,
                )
                .unwrap();
            });
            // The first episode warms up. An ending may create the label of its outcome.
            if index > 0 && environment.is_running() {
                let rigid = scratch.rigid() > asked;
                steps.played += 1;
                steps.rigid += u32::from(rigid);
                steps.allocated += u32::from(counted.count_total > 0 && !rigid);
            }
        }
    }
    steps
}

#[test]
fn a_step_allocates_nothing_but_what_rapier_does() {
    let match_of_eleven = steps("11_vs_11_stochastic", 2);
    assert!(
        match_of_eleven.played == 2 * 2999 && match_of_eleven.allocated == 0,
        "{match_of_eleven:?}"
    );
    assert!(match_of_eleven.rigid * 50 < match_of_eleven.played, "{match_of_eleven:?}");
    for name in ["academy_empty_goal", "academy_3_vs_1_with_keeper", "academy_corner"] {
        let steps = steps(name, 20);
        assert!(steps.played > 200 && steps.allocated == 0, "{name}: {steps:?}");
    }
}

#[test]
fn a_pitch_of_another_size_in_every_episode_allocates_nothing() {
    let text = "scenario s {
        pitch { length: uniform(40m, 80m), width: uniform(30m, 50m), goal: uniform(3m, 5m) }
        ball at centre
        team left { GK at left.goal  3 CM in left.half }
        team right { GK at right.goal  3 CM in right.half }
        reward near { give 0.01 when ball in them.box }
        end limit 300 steps
    }";
    let scenario = setpiece::compile_text(text, "<test>").unwrap().scenario;
    let steps = steps_of(scenario, 10);
    assert!(steps.played > 2000 && steps.allocated == 0, "{steps:?}");
}

#[test]
fn pictures_allocate_nothing() {
    let scenario = setpiece::load("11_vs_11_stochastic").unwrap().scenario;
    let mut environment = Environment::new(scenario, EnvironmentOptions::default()).unwrap();
    let mut scratch = Scratch::default();
    for pixels in [Pixels::SMALL, Pixels::SMALL_GRAY] {
        let (mut eye, mut out) = (PixelEye::new(pixels).unwrap(), vec![0; pixels.len()]);
        environment.reset(Some(1), None).unwrap();
        for step in 0..600 {
            environment.step(&[Action::BuiltinAi], &mut scratch).unwrap();
            let counted = allocation_counter::measure(|| {
                eye.write(&environment, 0, &mut out).unwrap();
            });
            assert!(step < 100 || counted.count_total == 0, "{step}: {counted:?}");
        }
    }
}

/// A copy into an existing environment, which tree search makes at every node.
#[test]
fn a_copy_in_memory_allocates_nothing() {
    let scenario = setpiece::load("11_vs_11_stochastic").unwrap().scenario;
    let mut environment = Environment::new(scenario, EnvironmentOptions::default()).unwrap();
    environment.reset(Some(1), None).unwrap();
    let mut kept = environment.clone();
    let mut scratch = Scratch::default();
    for _ in 0..30 {
        environment.step(&[Action::BuiltinAi], &mut scratch).unwrap();
    }
    kept.clone_from(&environment);
    let counted = allocation_counter::measure(|| {
        environment.step(&[Action::Right], &mut scratch).unwrap();
        environment.clone_from(&kept);
        kept.clone_from(&environment);
    });
    assert_eq!(counted.count_total, 0);
}

#[test]
fn behaviors_allocate_nothing() {
    let text = "
        behavior busy(spot: point) {
            state n = 0
            repeat {
                let there = spot + (uniform(-5m, 5m), uniform(-5m, 5m))
                n = n + 1
                choose { 2: do move_to(there) for 2s 1: do mark(nearest(them, to: me)) for 1s }
            }
            interrupt when count(p in mates where distance(p, me) < 2m) > 0 { do run(90deg) for 0.3s }
        }
        scenario s {
            agents { left: [anna] }
            ball at (-0.9, -0.4)
            team left { anna: CM at (0, 0) { ai: busy((0, 0)) } CM at (0, 0.1) { ai: busy((0.1, 0.1)) } }
            team right { CB at (0.5, 0) { ai: busy((0.4, 0)) } }
            end limit 200 steps
        }";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("busy.pitch");
    std::fs::write(&path, text).unwrap();
    let loaded = setpiece::load(path.to_str().unwrap()).unwrap();
    assert_eq!(loaded.scenario.behaviors.len(), 3);
    let steps = steps_of(loaded.scenario, 3);
    assert!(steps.played > 500 && steps.allocated == 0, "{steps:?}");
}

/// The memory of a batch for each further match of eleven a side: the environment itself and
/// everything that only it owns.
#[test]
fn a_further_match_takes_at_most_32_kib() {
    let scenario = setpiece::load("11_vs_11_stochastic").unwrap().scenario;
    let mut first = Environment::new(scenario, EnvironmentOptions::default()).unwrap();
    first.reset(Some(1), None).unwrap();
    let mut scratch = Scratch::default();
    let mut another = None;
    let counted = allocation_counter::measure(|| {
        let mut environment = first.clone();
        environment.reset(Some(2), None).unwrap();
        for _ in 0..200 {
            environment.step(&[Action::BuiltinAi], &mut scratch).unwrap();
        }
        another = Some(environment);
    });
    let bytes = counted.bytes_current as usize + std::mem::size_of::<Environment>();
    assert!(another.is_some() && bytes <= 32 * 1024, "{bytes} bytes");
}

/// What looks back is kept in every step, in a memory that is there from the start.
#[test]
fn an_observation_with_a_memory_allocates_nothing() {
    let text = "scenario s extends academy_3_vs_1_with_keeper {
        observe vector {
            ball - me noise normal(0, 0.1m) delayed uniform(0s, 0.5s) stack 4
            nearest(them, to: me) when sees(me, nearest(them, to: me), within: 120deg)
        }
    }";
    let scenario = setpiece::compile_text(text, "<test>").unwrap().scenario;
    let mut environment = Environment::new(scenario, EnvironmentOptions::default()).unwrap();
    let (mut scratch, mut played) = (Scratch::default(), 0);
    let mut out = vec![0.0; environment.observed_names().len()];
    for index in 0..4 {
        environment.reset(Some(1), Some(index)).unwrap();
        while environment.is_running() {
            let asked = scratch.rigid();
            let counted = allocation_counter::measure(|| {
                environment.step(&[Action::BuiltinAi], &mut scratch).unwrap();
                environment.observe_vector(0, &mut out).unwrap();
            });
            // An ending may create the label of its outcome.
            let is_running = environment.is_running();
            let is_warm = index > 0 && is_running && scratch.rigid() == asked;
            assert!(!is_warm || counted.count_total == 0, "step {}", environment.steps());
            played += u32::from(is_warm);
        }
    }
    assert!(played > 20);
}
