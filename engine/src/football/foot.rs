//! Which foot leads: it decides which swing comes first, of those that start with either foot.
//!
//! The feet change with every stride and with every motion of an odd number of steps. (GRF's.)

use crate::state::Player;

/// How long a stride lasts, ticks. (GRF's.)
pub(super) const STRIDE_TICKS: i32 = 24;
/// After this many ticks of a stride or motion the other foot leads.
const CHANGES_TICKS: i32 = 12;

/// Whether a player's left foot leads now.
pub(super) fn left_leads(player: &Player, now: i32) -> bool {
    let body = &player.body;
    match body.lunge {
        Some(lunge) if now - lunge.from() <= CHANGES_TICKS => body.left_leads != lunge.changes_feet,
        Some(_) => body.left_leads,
        None => body.left_leads != (strides(now - body.ready_at.max(0)) % 2 != 0),
    }
}

/// How often the feet have changed some ticks after a motion.
fn strides(ticks: i32) -> i32 {
    ((ticks + STRIDE_TICKS - CHANGES_TICKS - 1) / STRIDE_TICKS).max(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_feet_change_in_the_middle_of_every_stride() {
        assert_eq!([-30, 0, 12, 13, 24, 36, 37, 60, 61].map(strides), [0, 0, 0, 1, 1, 1, 2, 2, 3]);
    }
}
