//! How large the pitch of an episode is.

use crate::vocabulary::{PitchFigure, PitchMeasure};
use serde::{Deserialize, Serialize};

/// The size of a pitch, metres.
///
/// Each figure is within its range, so that a file can't hold an impossible pitch. The measures are
/// computed once, because a match asks for them hundreds of times in a step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "[f64; PitchFigure::ALL.len()]", into = "[f64; PitchFigure::ALL.len()]")]
pub struct PitchSize {
    figures: [f64; PitchFigure::ALL.len()],
    measures: [f64; PitchMeasure::ALL.len()],
}

impl PitchSize {
    /// Google Research Football's pitch: 110 m long, 72 m wide.
    pub const USUAL: PitchSize = {
        let mut figures = [0.0; PitchFigure::ALL.len()];
        let mut index = 0;
        while index < figures.len() {
            figures[index] = PitchFigure::ALL[index].usual();
            index += 1;
        }
        PitchSize::of(figures)
    };

    /// A pitch with these figures.
    const fn of(figures: [f64; PitchFigure::ALL.len()]) -> PitchSize {
        let mut size = PitchSize { figures, measures: [0.0; PitchMeasure::ALL.len()] };
        let mut index = 0;
        while index < size.measures.len() {
            let measure = PitchMeasure::ALL[index];
            size.measures[index] = size.in_proportion(measure.usual(), measure.follows());
            index += 1;
        }
        size
    }

    /// The usual pitch with some figures changed, metres. A figure that follows another one does so
    /// unless it is changed, too. A value out of its range becomes the nearest in it, one that is
    /// no number the usual one.
    pub fn with(changes: impl IntoIterator<Item = (PitchFigure, f64)>) -> PitchSize {
        let mut given = [None; PitchFigure::ALL.len()];
        for (figure, value) in changes {
            given[figure.index()] = Some(value);
        }
        let mut size = PitchSize::USUAL;
        for &figure in PitchFigure::ALL {
            let followed = figure.follows().map(|of| size.in_proportion(figure.usual(), of));
            if let Some(value) = given[figure.index()].or(followed) {
                size.figures[figure.index()] = value;
            }
        }
        size.bounded()
    }

    /// Every figure in its range.
    fn bounded(mut self) -> PitchSize {
        for &figure in PitchFigure::ALL {
            let (low, high) = figure.range();
            let most =
                figure.within().map_or(high, |(of, share)| high.min(share * self.figure(of)));
            let value = self.figure(figure);
            self.figures[figure.index()] =
                if value.is_nan() { figure.usual() } else { value.clamp(low, most) };
        }
        PitchSize::of(self.figures)
    }

    /// A figure, metres.
    #[inline]
    pub const fn figure(&self, figure: PitchFigure) -> f64 {
        self.figures[figure.index()]
    }

    /// A measure, metres.
    #[inline]
    pub const fn measure(&self, measure: PitchMeasure) -> f64 {
        self.measures[measure.index()]
    }

    /// A distance of the usual pitch in proportion to a figure. In this order, it is to the bit
    /// what it was where the figure is the usual one.
    #[inline]
    const fn in_proportion(&self, usual_m: f64, to: PitchFigure) -> f64 {
        self.figure(to) * usual_m / to.usual()
    }

    /// The goal lines are at x = ± this, metres.
    #[inline]
    pub const fn half_length(&self) -> f64 {
        self.measure(PitchMeasure::HalfLength)
    }

    /// The side lines are at y = ± this, metres.
    #[inline]
    pub const fn half_width(&self) -> f64 {
        self.measure(PitchMeasure::HalfWidth)
    }

    /// How far players may go, in x and y, metres: some way beyond the lines.
    #[inline]
    pub const fn rim(&self) -> (f64, f64) {
        (self.half_length() + RIM_BEYOND_M.0, self.half_width() + RIM_BEYOND_M.1)
    }

    /// Half the distance between the posts' centres, metres.
    #[inline]
    pub const fn goal_half_width(&self) -> f64 {
        self.measure(PitchMeasure::GoalHalfWidth)
    }

    /// A distance along the usual pitch's length, in proportion on this one, metres.
    #[inline]
    pub const fn along(&self, usual_m: f64) -> f64 {
        self.in_proportion(usual_m, PitchFigure::Length)
    }

    /// A distance across the usual pitch, in proportion on this one, metres.
    #[inline]
    pub const fn across(&self, usual_m: f64) -> f64 {
        self.in_proportion(usual_m, PitchFigure::Width)
    }

    /// How much longer distances between players are than on the usual pitch: the root of how much
    /// larger it is.
    #[inline]
    pub fn scale(&self) -> f64 {
        libm::sqrt(self.along(1.0) * self.across(1.0))
    }

    /// A distance from the middle of the usual goal, in proportion in this one, metres.
    #[inline]
    pub const fn in_goal(&self, usual_m: f64) -> f64 {
        self.in_proportion(usual_m, PitchFigure::Goal)
    }

    /// The height of the crossbar's centre, metres.
    #[inline]
    pub const fn goal_height(&self) -> f64 {
        self.measure(PitchMeasure::GoalHeight)
    }
}

/// How far the rim lies beyond the goal lines and the side lines, metres.
pub const RIM_BEYOND_M: (f64, f64) = (5.0, 4.0);

impl Default for PitchSize {
    fn default() -> PitchSize {
        PitchSize::USUAL
    }
}

impl From<[f64; PitchFigure::ALL.len()]> for PitchSize {
    fn from(figures: [f64; PitchFigure::ALL.len()]) -> PitchSize {
        PitchSize::of(figures).bounded()
    }
}

impl From<PitchSize> for [f64; PitchFigure::ALL.len()] {
    fn from(size: PitchSize) -> Self {
        size.figures
    }
}
