//! What `pitch { … }` sets, and the measures of a pitch that follow from it.

use super::words;
use crate::pitch;

words! {
    /// A figure of the pitch that a scenario may set, metres.
    PitchFigure {
        Length = "length", "from goal line to goal line";
        Width = "width", "from side line to side line";
        Goal = "goal", "from post to post";
        GoalHeight = "goal_height", "from the ground to the crossbar";
        Box = "box", "how far the penalty box reaches into the pitch";
        BoxWidth = "box_width", "how wide the penalty box is";
    }
}

impl PitchFigure {
    /// The value on Google Research Football's pitch, metres.
    #[inline]
    pub const fn usual(self) -> f64 {
        match self {
            PitchFigure::Length => 2.0 * pitch::HALF_LENGTH_M,
            PitchFigure::Width => 2.0 * pitch::HALF_WIDTH_M,
            PitchFigure::Goal => 2.0 * pitch::GOAL_HALF_WIDTH_M,
            PitchFigure::GoalHeight => pitch::GOAL_HEIGHT_M,
            PitchFigure::Box => pitch::BOX_DEPTH_M,
            PitchFigure::BoxWidth => 2.0 * pitch::BOX_HALF_WIDTH_M,
        }
    }

    /// The least and greatest value, metres.
    pub const fn range(self) -> (f64, f64) {
        match self {
            PitchFigure::Length => (20.0, 120.0),
            PitchFigure::Width => (15.0, 90.0),
            PitchFigure::Goal => (1.0, 10.0),
            PitchFigure::GoalHeight => (1.0, 3.0),
            PitchFigure::Box => (2.0, 40.0),
            PitchFigure::BoxWidth => (4.0, 90.0),
        }
    }

    /// The figure that this one is in proportion to where only that is set; the penalty box grows
    /// and shrinks with the pitch.
    pub const fn follows(self) -> Option<PitchFigure> {
        match self {
            PitchFigure::Box => Some(PitchFigure::Length),
            PitchFigure::BoxWidth => Some(PitchFigure::Width),
            _ => None,
        }
    }

    /// The figure that this one is at most as large as a share of, and that share.
    pub const fn within(self) -> Option<(PitchFigure, f64)> {
        match self {
            PitchFigure::Box => Some((PitchFigure::Length, 0.5)),
            PitchFigure::BoxWidth => Some((PitchFigure::Width, 1.0)),
            _ => None,
        }
    }
}

/// A length on the pitch that landmarks, regions and laws of the game are made of. Each is in
/// proportion to one figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PitchMeasure {
    /// From the centre spot to a goal line.
    HalfLength,
    /// From the centre spot to a side line.
    HalfWidth,
    /// The length of a third of the pitch.
    Third,
    /// From the centre spot to the next third.
    HalfMiddle,
    /// From the middle of a goal to a post.
    GoalHalfWidth,
    /// The height of the crossbar's centre.
    GoalHeight,
    /// The depth of the penalty box.
    BoxDepth,
    /// Half the width of the penalty box.
    BoxHalfWidth,
    /// The depth of the goal area.
    SixYardDepth,
    /// Half the width of the goal area.
    SixYardHalfWidth,
    /// From the goal line to the penalty spot.
    PenaltySpot,
    /// From the goal line to the spot of a goal kick.
    GoalKickSpot,
    /// The radius of the centre circle and of the D, which opponents keep at a free kick.
    Circle,
}

impl PitchMeasure {
    /// All measures, by [`PitchMeasure::index`].
    pub const ALL: [PitchMeasure; 13] = [
        PitchMeasure::HalfLength,
        PitchMeasure::HalfWidth,
        PitchMeasure::Third,
        PitchMeasure::HalfMiddle,
        PitchMeasure::GoalHalfWidth,
        PitchMeasure::GoalHeight,
        PitchMeasure::BoxDepth,
        PitchMeasure::BoxHalfWidth,
        PitchMeasure::SixYardDepth,
        PitchMeasure::SixYardHalfWidth,
        PitchMeasure::PenaltySpot,
        PitchMeasure::GoalKickSpot,
        PitchMeasure::Circle,
    ];

    /// Its index in [`PitchMeasure::ALL`].
    #[inline]
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Its length on Google Research Football's pitch, metres.
    pub const fn usual(self) -> f64 {
        match self {
            PitchMeasure::HalfLength => pitch::HALF_LENGTH_M,
            PitchMeasure::HalfWidth => pitch::HALF_WIDTH_M,
            PitchMeasure::Third => 2.0 * pitch::HALF_LENGTH_M / 3.0,
            PitchMeasure::HalfMiddle => pitch::HALF_LENGTH_M / 3.0,
            PitchMeasure::GoalHalfWidth => pitch::GOAL_HALF_WIDTH_M,
            PitchMeasure::GoalHeight => pitch::GOAL_HEIGHT_M,
            PitchMeasure::BoxDepth => pitch::BOX_DEPTH_M,
            PitchMeasure::BoxHalfWidth => pitch::BOX_HALF_WIDTH_M,
            PitchMeasure::SixYardDepth => pitch::SIX_YARD_DEPTH_M,
            PitchMeasure::SixYardHalfWidth => pitch::SIX_YARD_HALF_WIDTH_M,
            PitchMeasure::PenaltySpot => pitch::PENALTY_SPOT_M,
            PitchMeasure::GoalKickSpot => pitch::GOAL_KICK_SPOT_M,
            PitchMeasure::Circle => pitch::CIRCLE_RADIUS_M,
        }
    }

    /// The figure that it is in proportion to.
    pub const fn follows(self) -> PitchFigure {
        match self {
            PitchMeasure::HalfLength | PitchMeasure::Third | PitchMeasure::HalfMiddle => {
                PitchFigure::Length
            }
            PitchMeasure::HalfWidth | PitchMeasure::Circle => PitchFigure::Width,
            PitchMeasure::GoalHalfWidth => PitchFigure::Goal,
            PitchMeasure::GoalHeight => PitchFigure::GoalHeight,
            PitchMeasure::BoxDepth
            | PitchMeasure::SixYardDepth
            | PitchMeasure::PenaltySpot
            | PitchMeasure::GoalKickSpot => PitchFigure::Box,
            PitchMeasure::BoxHalfWidth | PitchMeasure::SixYardHalfWidth => PitchFigure::BoxWidth,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::PitchMeasure;

    #[test]
    fn all_measures_stand_at_their_index() {
        let indices = PitchMeasure::ALL.map(PitchMeasure::index);
        assert!(indices.into_iter().eq(0..PitchMeasure::ALL.len()));
    }
}
