//! Ready-made agents on the Academy's layouts.

use crate::Bench;
use crate::layouts::Layout;
use setpiece_engine::control::agents::Agent;
use setpiece_engine::random::{Purpose, Stream};
use setpiece_scenario::vocabulary::EventKind;

/// Plays an Academy episode; whether left scored, and its length in steps.
fn episode(layout: Layout, agent: Agent, seed: u64) -> (bool, u32) {
    let mut bench = Bench::new(layout, seed);
    let mut stream = Stream::new(seed, 0, Purpose::Agent);
    let mut held = None;
    for step in 1..=400 {
        let action = agent.act(&bench.game, 0, &mut stream);
        bench.step(action);
        let owner = bench.game.owner.map(setpiece_engine::state::PlayerId::team);
        let lost = owner.is_some() && held.is_some() && owner != held;
        held = owner.or(held);
        if bench.game.score != [0, 0] {
            return (bench.game.score[0] > 0, step);
        }
        if lost || bench.game.dead || bench.seen(EventKind::OutOfPlay).is_some() {
            return (false, step);
        }
    }
    (false, 400)
}

fn rate(layout: Layout, agent: Agent, episodes: u64) -> (f64, f64) {
    let (mut won, mut steps) = (0u32, 0u32);
    for seed in 0..episodes {
        let (goal, length) = episode(layout, agent, seed);
        won += u32::from(goal);
        steps += length;
    }
    (f64::from(won) / episodes as f64, f64::from(steps) / episodes as f64)
}

#[test]
fn the_scripted_agent_scores_where_nothing_stops_it() {
    for (layout, least, lengths) in [
        (Layout::EmptyGoalClose, 0.97, 9.0..20.0),
        (Layout::EmptyGoal, 0.95, 55.0..85.0),
        (Layout::RunToScore, 0.85, 55.0..85.0),
    ] {
        let (success, length) = rate(layout, Agent::RunAndShoot, 40);
        assert!(success >= least, "{layout:?}: {success}");
        assert!(lengths.contains(&length), "{layout:?}: {length} steps");
    }
}

#[test]
fn a_keeper_makes_it_harder() {
    let (alone, _) = rate(Layout::RunToScore, Agent::RunAndShoot, 40);
    let (kept, _) = rate(Layout::RunToScoreKeeper, Agent::RunAndShoot, 40);
    assert!(kept < alone - 0.1, "{kept} against {alone}");
}

#[test]
fn an_idle_agent_never_scores() {
    for layout in [Layout::EmptyGoalClose, Layout::EmptyGoal, Layout::RunToScore] {
        assert_eq!(rate(layout, Agent::Idle, 30).0, 0.0, "{layout:?}");
    }
}

#[test]
fn a_random_agent_scores_now_and_then() {
    let (success, _) = rate(Layout::ThreeVersusOne, Agent::Random, 300);
    assert!(success > 0.0 && success < 0.3, "{success}");
}
