//! Where a free ball will be, for those who run to meet it. Posts, nets and bodies are left out.

use super::flight;
use crate::state::Ball;
use glam::Vec3;

/// Fills `out` with the ball's centre after `stride_ticks`, `2 * stride_ticks`, … ticks, in world metres.
///
/// Costs one tick of free flight each (about 10 ns), and nothing for a ball that lies still.
pub fn forecast(ball: &Ball, out: &mut [Vec3], stride_ticks: u32) {
    let mut ahead = *ball;
    for place in out {
        for _ in 0..stride_ticks {
            flight::fly(&mut ahead);
        }
        *place = ahead.pos;
    }
}
