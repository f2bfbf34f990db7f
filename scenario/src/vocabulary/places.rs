//! Named points and regions of the pitch.

use super::words;
use crate::pitch::{
    BOX_DEPTH_M, BOX_HALF_WIDTH_M, CIRCLE_RADIUS_M, GOAL_HALF_WIDTH_M, HALF_LENGTH_M, HALF_WIDTH_M,
    PENALTY_SPOT_M, SIX_YARD_DEPTH_M, SIX_YARD_HALF_WIDTH_M,
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
    /// The place in metres at the left team's end. The right team's is rotated by 180°, except top
    /// and bottom.
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
        D = "d", "the arc in front of the penalty box";
        GoalMouth = "goal.mouth", "the line between the posts";
        Byline = "byline", "the goal line from corner to corner";
    }
}

/// The shape of a named region, metres at the left team's end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RegionShape {
    /// A rectangle `(x0, y0, x1, y1)`.
    Rect(f64, f64, f64, f64),
    /// A disc `(x, y, radius)` less a rectangle.
    DiscWithout((f64, f64, f64), (f64, f64, f64, f64)),
}

impl RegionName {
    /// The shape at the left team's end; the right team's is rotated by 180°.
    pub fn left_shape_m(self) -> RegionShape {
        let end = |depth: f64, half_width: f64| {
            (-HALF_LENGTH_M, -half_width, depth - HALF_LENGTH_M, half_width)
        };
        let (x0, y0, x1, y1) = match self {
            RegionName::Box => end(BOX_DEPTH_M, BOX_HALF_WIDTH_M),
            RegionName::SixYard => end(SIX_YARD_DEPTH_M, SIX_YARD_HALF_WIDTH_M),
            RegionName::Half => end(HALF_LENGTH_M, HALF_WIDTH_M),
            RegionName::Third => end(2.0 * HALF_LENGTH_M / 3.0, HALF_WIDTH_M),
            RegionName::GoalMouth => end(0.0, GOAL_HALF_WIDTH_M),
            RegionName::Byline => end(0.0, HALF_WIDTH_M),
            RegionName::D => {
                let disc = (PENALTY_SPOT_M - HALF_LENGTH_M, 0.0, CIRCLE_RADIUS_M);
                return RegionShape::DiscWithout(disc, end(BOX_DEPTH_M, BOX_HALF_WIDTH_M));
            }
        };
        RegionShape::Rect(x0, y0, x1, y1)
    }
}

words! {
    /// A named region that belongs to no team: `pitch`, `flank.top`.
    PitchRegion {
        Pitch = "pitch", "the whole pitch";
        CentreCircle = "centre_circle", "the centre circle";
        MiddleThird = "middle.third", "the third between the teams' thirds";
        FlankTop = "flank.top", "beside the boxes, at the top of the picture";
        FlankBottom = "flank.bottom", "beside the boxes, at the bottom of the picture";
        HalfSpaceTop = "half_space.top", "between flank and goal area's width, at the top";
        HalfSpaceBottom = "half_space.bottom", "between flank and goal area's width, at the bottom";
        MiddleLane = "middle.lane", "as wide as the goal areas, from end to end";
    }
}

impl PitchRegion {
    /// The rectangle `(x0, y0, x1, y1)` in metres; `None` for the centre circle, a disc.
    pub fn rect_m(self) -> Option<(f64, f64, f64, f64)> {
        let lane = |y0: f64, y1: f64| Some((-HALF_LENGTH_M, y0, HALF_LENGTH_M, y1));
        match self {
            PitchRegion::Pitch => lane(-HALF_WIDTH_M, HALF_WIDTH_M),
            PitchRegion::CentreCircle => None,
            PitchRegion::MiddleThird => {
                Some((-HALF_LENGTH_M / 3.0, -HALF_WIDTH_M, HALF_LENGTH_M / 3.0, HALF_WIDTH_M))
            }
            PitchRegion::FlankTop => lane(-HALF_WIDTH_M, -BOX_HALF_WIDTH_M),
            PitchRegion::FlankBottom => lane(BOX_HALF_WIDTH_M, HALF_WIDTH_M),
            PitchRegion::HalfSpaceTop => lane(-BOX_HALF_WIDTH_M, -SIX_YARD_HALF_WIDTH_M),
            PitchRegion::HalfSpaceBottom => lane(SIX_YARD_HALF_WIDTH_M, BOX_HALF_WIDTH_M),
            PitchRegion::MiddleLane => lane(-SIX_YARD_HALF_WIDTH_M, SIX_YARD_HALF_WIDTH_M),
        }
    }
}
