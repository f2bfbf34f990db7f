//! Named points and regions of the pitch.

use super::words;
use crate::pitch::{
    BOX_DEPTH_M, BOX_HALF_WIDTH_M, HALF_LENGTH_M, HALF_WIDTH_M, PENALTY_SPOT_M, SIX_YARD_DEPTH_M, SIX_YARD_HALF_WIDTH_M,
};

words! {
    /// A named point of a team's end: `left.goal`, `them.penalty_spot`.
    Landmark {
        Goal = "goal", "the middle of the goal mouth";
        PenaltySpot = "penalty_spot", "the penalty spot";
        CornerTop = "corner.top", "the corner at the top of the picture";
        CornerBottom = "corner.bottom", "the corner at the bottom of the picture";
        PostTop = "top_post", "the post nearer the top of the picture";
        PostBottom = "bottom_post", "the post nearer the bottom of the picture";
    }
}

impl Landmark {
    /// The place in metres at the left team's end; the right team's is rotated by 180° but for top and bottom.
    pub fn left_m(self) -> (f64, f64) {
        match self {
            Landmark::Goal => (-HALF_LENGTH_M, 0.0),
            Landmark::PenaltySpot => (PENALTY_SPOT_M - HALF_LENGTH_M, 0.0),
            Landmark::CornerTop => (-HALF_LENGTH_M, -HALF_WIDTH_M),
            Landmark::CornerBottom => (-HALF_LENGTH_M, HALF_WIDTH_M),
            Landmark::PostTop => (-HALF_LENGTH_M, -crate::pitch::GOAL_HALF_WIDTH_M),
            Landmark::PostBottom => (-HALF_LENGTH_M, crate::pitch::GOAL_HALF_WIDTH_M),
        }
    }
}

words! {
    /// A named region of a team's end: `left.box`, `them.third`.
    RegionName {
        Box = "box", "the penalty box";
        SixYard = "six_yard", "the goal area";
        Half = "half", "the half of the pitch";
        Third = "third", "the third of the pitch";
    }
}

impl RegionName {
    /// The rectangle `(x0, y0, x1, y1)` in metres at the left team's end.
    pub fn left_rect_m(self) -> (f64, f64, f64, f64) {
        let (depth, half_width) = match self {
            RegionName::Box => (BOX_DEPTH_M, BOX_HALF_WIDTH_M),
            RegionName::SixYard => (SIX_YARD_DEPTH_M, SIX_YARD_HALF_WIDTH_M),
            RegionName::Half => (HALF_LENGTH_M, HALF_WIDTH_M),
            RegionName::Third => (2.0 * HALF_LENGTH_M / 3.0, HALF_WIDTH_M),
        };
        (-HALF_LENGTH_M, -half_width, depth - HALF_LENGTH_M, half_width)
    }
}
