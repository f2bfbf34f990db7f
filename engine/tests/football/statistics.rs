//! Every statistic of a player has an effect.

use crate::Bench;
use crate::layouts::{Layout, drawn};
use setpiece_engine::digest;
use setpiece_scenario::vocabulary::{Action, Stat};

/// Plays a match of bots in which every player has a statistic at a value; returns the digest at
/// its end.
fn played(stat: Option<Stat>, value: f32, seed: u64) -> u64 {
    let mut start = drawn(Layout::Eleven, seed);
    for player in start.players.iter_mut().flatten() {
        player.stats.extend(stat.map(|stat| (stat, value)));
    }
    let mut bench = Bench::of(&start);
    for _ in 0..1500 {
        bench.step(Action::BuiltinAi);
        bench.restart();
    }
    // The statistics themselves must not affect the comparison.
    for player in &mut bench.game.players {
        player.body.stats = [0.0; Stat::ALL.len()];
    }
    digest::of_match(&bench.game)
}

#[test]
fn a_match_is_another_one_with_other_statistics() {
    for &stat in Stat::ALL {
        assert!(
            (0..160).any(|seed| played(Some(stat), 0.1, seed) != played(Some(stat), 1.0, seed)),
            "nothing depends on {stat}"
        );
    }
}
