//! A fingerprint of a match: two states with the same digest look the same in every way.
//!
//! FNV-1a over 64 bits. Every number enters as its little-endian bytes, floats by their bits with
//! -0.0 folded to 0.0. The order is that of [`of_match`]: clock, score, ball, players by id,
//! possession, mode, agents, the world and the pitch where they aren't the usual ones. Random
//! streams enter by their next numbers, so runs that only happen to look alike differ.

use crate::physics::Conditions;
use crate::state::{Match, PlayerId};
use setpiece_scenario::PitchSize;

/// A digest being computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Digest(u64);

impl Default for Digest {
    fn default() -> Digest {
        Digest(0xcbf2_9ce4_8422_2325)
    }
}

impl Digest {
    /// Adds whole numbers.
    #[must_use]
    pub fn whole(self, value: u64) -> Digest {
        let step =
            |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
        Digest(value.to_le_bytes().into_iter().fold(self.0, step))
    }

    /// Adds a float by its bits; both zeros are the same.
    #[must_use]
    pub fn float(self, value: f32) -> Digest {
        self.whole(u64::from((value + 0.0).to_bits()))
    }

    /// Adds floats in order.
    #[must_use]
    pub fn floats(self, values: impl IntoIterator<Item = f32>) -> Digest {
        values.into_iter().fold(self, Digest::float)
    }

    /// The digest.
    pub fn value(self) -> u64 {
        self.0
    }
}

/// The digest of a match's current state.
pub fn of_match(game: &Match) -> u64 {
    let id = |player: Option<PlayerId>| player.map_or(u64::MAX, |player| u64::from(player.0));
    let mut digest = Digest::default()
        .whole(game.tick.into())
        .whole(game.step.into())
        .whole(game.score[0].into())
        .whole(game.score[1].into())
        .floats(game.ball.pos.to_array())
        .floats(game.ball.vel.to_array())
        .floats(game.ball.spin.to_array());
    for player in game.squad.ids().map(|id| game.player(id)) {
        digest = digest
            .whole(player.active.into())
            .floats(player.pos.to_array())
            .floats(player.vel.to_array())
            .float(player.heading_rad)
            .float(player.fatigue)
            .whole(player.yellow_cards.into());
    }
    digest = digest
        .whole(id(game.owner))
        .whole(game.possession.map_or(u64::MAX, |team| team.index() as u64))
        .whole(id(game.last_touch))
        .whole(game.mode.index() as u64)
        .whole(game.dead.into());
    for agent in &game.agents {
        digest = digest.whole(id(agent.player)).whole(agent.sticky.into());
        if let Some(steer) = agent.steer {
            digest = digest.floats(steer.way.to_array()).float(steer.power);
        }
    }
    if game.conditions != Conditions::USUAL {
        digest = digest.floats(game.conditions.figures());
    }
    if game.pitch != PitchSize::USUAL {
        digest = digest.floats(<[f64; _]>::from(game.pitch).map(|share| share as f32));
    }
    digest
        .whole(game.play_random.clone().bits().into())
        .whole(game.bot_random.clone().bits().into())
        .value()
}

/// One digest of many, in order.
pub fn of_all(digests: impl IntoIterator<Item = u64>) -> u64 {
    digests.into_iter().fold(Digest::default(), Digest::whole).value()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_zeros_are_one_and_order_counts() {
        assert_eq!(Digest::default().float(0.0), Digest::default().float(-0.0));
        assert_ne!(Digest::default().float(0.0), Digest::default().float(f32::MIN_POSITIVE));
        assert_ne!(of_all([1, 2]), of_all([2, 1]));
    }
}
