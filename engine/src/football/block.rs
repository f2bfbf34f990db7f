//! A team's block: a formation stretched over a part of the pitch and drawn towards the action.
//! (GRF's.)
//!
//! All coordinates are in the team's own frame; the team attacks towards +x.

use crate::math;
use glam::Vec2;

/// Beyond this distance from a point of attraction, players don't feel it, metres.
const DRAW_M: f32 = 50.0;

/// A point that attracts players, and its strength from 0 to 1.
pub type Attraction = (f32, f32);

/// A team's block.
#[derive(Clone, Copy, Debug)]
pub struct TeamBlock {
    /// x of the rearmost and the foremost slot, metres.
    pub depth: [f32; 2],
    /// Half the block's width, metres.
    pub half_width: f32,
    /// y of the block's middle, metres.
    pub middle_y: f32,
    /// The x that attracts players near it.
    pub towards_x: Attraction,
    /// The y that attracts players near it.
    pub towards_y: Attraction,
    /// The point that attracts everybody near it.
    pub towards: (Vec2, f32),
    /// The slot x that attracts midfielders.
    pub midfield: Attraction,
}

impl TeamBlock {
    /// The place of a slot on a pitch; `half`: half the pitch along each axis, metres.
    pub fn place(&self, slot: Vec2, half: Vec2) -> Vec2 {
        let [back, front] = self.depth;
        let middle = (1.0 - 1.2 * slot.x.abs()).max(0.0);
        let moved = math::mix(slot.x, self.midfield.0, math::ease(middle) * self.midfield.1);
        let plain = Vec2::new(
            back + (0.5 * moved + 0.5) * (front - back),
            self.middle_y + slot.y * self.half_width,
        );
        let (x, keen) = self.towards_x;
        let place_x = if keen > 0.0 {
            let near = 1.0 - ((x - plain.x) / (front - back)).abs().min(1.0);
            math::mix(plain.x, x, math::eighths::<6>(math::ease(near)) * keen)
        } else {
            plain.x
        };
        let (y, keen) = self.towards_y;
        let near = 1.0 - ((y - plain.y) / (2.0 * self.half_width)).abs().min(1.0);
        let place_y = math::mix(plain.y, y, near * (0.2 + 0.8 * y.abs() / half.y) * keen);
        self.drawn(plain, Vec2::new(place_x, place_y))
    }

    /// Moves a place towards the point of attraction; nearer slots move more.
    fn drawn(&self, plain: Vec2, place: Vec2) -> Vec2 {
        let (point, keen) = self.towards;
        let far = ((point - plain) * Vec2::new(1.0, 0.8)).length() / DRAW_M;
        if keen <= 0.0 || far >= 1.0 {
            return place;
        }
        let near = 1.0 - far;
        let beside = 0.1 * (1.0 - ((far - 0.15).abs() / 0.25).min(1.0));
        let pull = (math::mix(near, math::ease(near), 0.3) + beside).clamp(0.0, 1.0) * keen;
        let to = Vec2::new(point.x, math::mix(point.y, place.y, 0.4));
        place + (to - place) * pull
    }
}
