//! After warm-up a step allocates nothing: neither the game, nor the bots, nor judging, nor observing.
//!
//! The exception is rapier itself, whose solver allocates when it resolves a rigid contact of a free ball: in a match of
//! eleven a side less than one step in fifty.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

use setpiece::engine::environment::{Environment, EnvironmentOptions, Scratch};
use setpiece::engine::observe;
use setpiece::scenario::{Action, Scenario};
use std::sync::Arc;

/// Steps of some episodes after the first one, and how many of them allocated.
fn steps(name: &str, episodes: u64) -> (u32, u32) {
    steps_of(setpiece::load(name).unwrap().scenario, episodes)
}

fn steps_of(scenario: Arc<Scenario>, episodes: u64) -> (u32, u32) {
    let mut environment = Environment::new(scenario, EnvironmentOptions::default()).unwrap();
    let mut scratch = Scratch::default();
    let mut floats = vec![0.0; observe::layout::SIMPLE115];
    let (mut played, mut allocated) = (0, 0);
    for index in 0..=episodes {
        environment.reset(Some(1), Some(index)).unwrap();
        while environment.is_running() {
            let counted = allocation_counter::measure(|| {
                environment.step(&[Action::BuiltinAi], &mut scratch).unwrap();
                observe::simple115(environment.state(), 0, &mut floats).unwrap();
            });
            // The first episode warms up; an outcome's label may be made when one ends.
            if index > 0 && environment.is_running() {
                played += 1;
                allocated += u32::from(counted.count_total > 0);
            }
        }
    }
    (played, allocated)
}

#[test]
fn a_step_without_rigid_contact_allocates_nothing() {
    let (played, allocated) = steps("11_vs_11_stochastic", 1);
    assert!(played == 2999 && allocated * 50 < played, "{allocated} of {played}");
    // Nobody is near enough to the ball's way for a rigid contact.
    let (played, allocated) = steps("academy_empty_goal", 5);
    assert!(played > 200 && allocated * 50 < played, "{allocated} of {played}");
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
    let (played, allocated) = steps_of(loaded.scenario, 3);
    assert!(played > 500 && allocated * 50 < played, "{allocated} of {played}");
}

/// What a batch needs for each further match of eleven a side: the environment itself and all that it owns alone.
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
