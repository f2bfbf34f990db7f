//! Named points and regions of the pitch.

use super::pitch::PitchMeasure::{
    self, BoxDepth, BoxHalfWidth, Circle, GoalHalfWidth, HalfLength, HalfMiddle, HalfWidth,
    PenaltySpot, SixYardDepth, SixYardHalfWidth, Third,
};
use super::words;

/// A coordinate of a point of the pitch: one measure less another, 0 where there is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Along {
    /// What is added to the centre spot's coordinate.
    pub plus: Option<PitchMeasure>,
    /// What is taken from it.
    pub minus: Option<PitchMeasure>,
}

impl Along {
    /// At the centre spot.
    const ZERO: Along = Along { plus: None, minus: None };

    /// Its value; `length` gives that of a measure.
    pub fn value(self, length: impl Fn(PitchMeasure) -> f64) -> f64 {
        self.plus.map_or(0.0, &length) - self.minus.map_or(0.0, &length)
    }
}

/// Towards +.
const fn up(to: PitchMeasure) -> Along {
    Along { plus: Some(to), minus: None }
}

/// Towards -.
const fn down(to: PitchMeasure) -> Along {
    Along { plus: None, minus: Some(to) }
}

/// So far in front of the left team's goal line.
const fn ahead(by: PitchMeasure) -> Along {
    Along { plus: Some(by), minus: Some(HalfLength) }
}

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
    /// The place at the left team's end. The right team's is rotated by 180°, except top and
    /// bottom.
    pub const fn left(self) -> (Along, Along) {
        match self {
            Landmark::Goal => (down(HalfLength), Along::ZERO),
            Landmark::PenaltySpot => (ahead(PenaltySpot), Along::ZERO),
            Landmark::CornerTop => (down(HalfLength), down(HalfWidth)),
            Landmark::CornerBottom => (down(HalfLength), up(HalfWidth)),
            Landmark::PostTop => (down(HalfLength), down(GoalHalfWidth)),
            Landmark::PostBottom => (down(HalfLength), up(GoalHalfWidth)),
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

/// A rectangle of the pitch, from one corner to the other: x and y of each.
pub type PitchRect = [(Along, Along); 2];

/// The shape of a named region, at the left team's end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum RegionShape {
    /// A rectangle.
    Rect(PitchRect),
    /// A disc, by its centre and radius, less a rectangle.
    DiscWithout((Along, Along), PitchMeasure, PitchRect),
}

impl RegionName {
    /// The shape at the left team's end; the right team's is rotated by 180°.
    pub const fn left_shape(self) -> RegionShape {
        RegionShape::Rect(match self {
            RegionName::Box => end(BoxDepth, BoxHalfWidth),
            RegionName::SixYard => end(SixYardDepth, SixYardHalfWidth),
            RegionName::Half => end(HalfLength, HalfWidth),
            RegionName::Third => end(Third, HalfWidth),
            RegionName::GoalMouth => line(GoalHalfWidth),
            RegionName::Byline => line(HalfWidth),
            RegionName::D => {
                let spot = (ahead(PenaltySpot), Along::ZERO);
                return RegionShape::DiscWithout(spot, Circle, end(BoxDepth, BoxHalfWidth));
            }
        })
    }
}

/// What lies in front of the goal line, so deep and so wide to either side.
const fn end(depth: PitchMeasure, half_width: PitchMeasure) -> PitchRect {
    [(down(HalfLength), down(half_width)), (ahead(depth), up(half_width))]
}

/// A part of the goal line, so wide to either side.
const fn line(half_width: PitchMeasure) -> PitchRect {
    [(down(HalfLength), down(half_width)), (down(HalfLength), up(half_width))]
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
    /// The rectangle; `None` for the centre circle, a disc.
    pub const fn rect(self) -> Option<PitchRect> {
        let (from, to) = match self {
            PitchRegion::CentreCircle => return None,
            PitchRegion::MiddleThird => {
                let (from, to) = (down(HalfMiddle), up(HalfMiddle));
                return Some([(from, down(HalfWidth)), (to, up(HalfWidth))]);
            }
            PitchRegion::Pitch => (down(HalfWidth), up(HalfWidth)),
            PitchRegion::FlankTop => (down(HalfWidth), down(BoxHalfWidth)),
            PitchRegion::FlankBottom => (up(BoxHalfWidth), up(HalfWidth)),
            PitchRegion::HalfSpaceTop => (down(BoxHalfWidth), down(SixYardHalfWidth)),
            PitchRegion::HalfSpaceBottom => (up(SixYardHalfWidth), up(BoxHalfWidth)),
            PitchRegion::MiddleLane => (down(SixYardHalfWidth), up(SixYardHalfWidth)),
        };
        // A lane from end to end.
        Some([(down(HalfLength), from), (up(HalfLength), to)])
    }
}
