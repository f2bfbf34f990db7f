//! Where a free ball will be, for those who run to meet it. Posts, nets and bodies are left out.

use super::flight;
use crate::state::Ball;
use glam::Vec3;

/// The ball's centre after `stride_ticks`, `2 * stride_ticks`, … ticks, in world metres, without an end.
pub fn forecast(ball: &Ball, stride_ticks: u32) -> impl Iterator<Item = Vec3> + use<> {
    let mut ahead = *ball;
    std::iter::repeat_with(move || {
        for _ in 0..stride_ticks {
            flight::fly(&mut ahead);
        }
        ahead.pos
    })
}
