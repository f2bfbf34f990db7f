//! The layouts of array observations: one row per block. Spaces and documentation are generated
//! from them.

use setpiece_scenario::pitch::{STEPS_PER_S, TEAM_MAX, X_SCALE_M, Y_SCALE_M};
use setpiece_scenario::vocabulary::StickyAction;

/// Length of `simple115` and `simple115v2`.
pub const SIMPLE115: usize = 115;
/// Length of `simple115v2+sticky`.
pub const SIMPLE115_STICKY: usize = SIMPLE115 + StickyAction::DEFAULT_SET;
/// Number of values for one other player in `egocentric`.
pub const OTHER: usize = 7;
/// Where the other players begin in `egocentric`.
pub const OTHERS: usize = 46;

/// A block of an observation: related numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Index of its first number.
    pub start: usize,
    /// The number of values.
    pub len: usize,
    /// The meaning of the values.
    pub meaning: String,
    /// The unit of the values.
    pub unit: &'static str,
    /// Least values, repeated over the block.
    pub low: Vec<f32>,
    /// Greatest values, repeated over the block.
    pub high: Vec<f32>,
    /// How `scale` changes the block; `None` for no change.
    pub scale: Option<Scale>,
}

/// Another unit for the numbers of a block.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    /// The unit after scaling.
    pub unit: &'static str,
    /// The factors on the values, repeated over the block.
    pub factors: Vec<f32>,
}

/// The layout of an observation.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layout {
    /// The blocks, in order.
    pub blocks: Vec<Block>,
}

impl Layout {
    /// The number of values.
    pub fn len(&self) -> usize {
        self.blocks.last().map_or(0, |block| block.start + block.len)
    }

    /// Whether it has no numbers.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The bounds of every number; written values are clamped to them.
    pub fn bounds(&self) -> (Vec<f32>, Vec<f32>) {
        let over = |bounds: fn(&Block) -> &Vec<f32>| {
            self.blocks
                .iter()
                .flat_map(|block| bounds(block).iter().copied().cycle().take(block.len))
                .collect()
        };
        (over(|block| &block.low), over(|block| &block.high))
    }

    /// The same numbers in the units of `scale`.
    #[must_use]
    pub fn scaled(mut self) -> Layout {
        for block in &mut self.blocks {
            let Some(scale) = block.scale.take() else { continue };
            block.unit = scale.unit;
            block.low = times(&block.low, &scale.factors);
            block.high = times(&block.high, &scale.factors);
        }
        self
    }

    /// The factor of `scale` on every number: 1 for unchanged ones.
    pub fn factors(&self) -> Vec<f32> {
        let one = [1.0];
        let of = |block: &Block| {
            let factors = block.scale.as_ref().map_or(&one[..], |scale| &scale.factors);
            factors.iter().copied().cycle().take(block.len).collect::<Vec<_>>()
        };
        self.blocks.iter().flat_map(of).collect()
    }

    /// Sets how `scale` changes the last block.
    fn in_units(mut self, unit: &'static str, factors: &[f32]) -> Layout {
        if let Some(block) = self.blocks.last_mut() {
            block.scale = Some(Scale { unit, factors: factors.to_vec() });
        }
        self
    }

    /// Adds a block whose numbers lie within ± `bounds`, repeated.
    fn around(
        self,
        len: usize,
        meaning: impl Into<String>,
        unit: &'static str,
        bounds: &[f32],
    ) -> Layout {
        self.block(len, meaning, unit, bounds.iter().map(|bound| -bound).collect(), bounds.to_vec())
    }

    /// Adds a block of shares or flags, 0..1.
    fn shares(self, len: usize, meaning: impl Into<String>, unit: &'static str) -> Layout {
        self.block(len, meaning, unit, vec![0.0], vec![1.0])
    }

    fn block(
        mut self,
        len: usize,
        meaning: impl Into<String>,
        unit: &'static str,
        low: Vec<f32>,
        high: Vec<f32>,
    ) -> Layout {
        let start = self.len();
        self.blocks.push(Block {
            start,
            len,
            meaning: meaning.into(),
            unit,
            low,
            high,
            scale: None,
        });
        self
    }

    /// The end of `simple115` and `simple115v2`: the ball, its owner, the controlled player, the
    /// game mode.
    fn ball_and_modes(self) -> Layout {
        self.block(
            3,
            "ball x, y, z",
            "normalised; z in metres",
            vec![-2.0, -1.5, 0.0],
            vec![2.0, 1.5, 100.0],
        )
        .in_units("50 m; z in 10 m", &[SCALED_PLACE[0], SCALED_PLACE[1], 1.0 / SCALE_HEIGHT_M])
        .around(3, "ball direction", "normalised per step; z in metres", &[1.0, 1.0, 10.0])
        .in_units("10 m/s", &[SCALED_STRIDE[0], SCALED_STRIDE[1], STEPS_PER_S as f32 / SCALE_MPS])
        .shares(3, "who has the ball: nobody, we, they", "one-hot")
        .shares(11, "the controlled player", "one-hot")
        .shares(7, "game mode", "one-hot")
    }
}

/// Bounds of a normalised place: the rim of the pitch and what lies beyond.
const PLACE: [f32; 2] = [2.0, 1.5];
/// Bounds of a displacement in one step.
const STRIDE: [f32; 2] = [1.0, 1.0];

/// The unit of lengths under `scale`, metres: about half the pitch.
const SCALE_M: f32 = 50.0;
/// The unit of heights under `scale`, metres: that of `egocentric`.
const SCALE_HEIGHT_M: f32 = 10.0;
/// The unit of velocities under `scale`, m/s: that of `egocentric`.
const SCALE_MPS: f32 = 10.0;
/// Factor from a normalised place to a scaled one.
const SCALED_PLACE: [f32; 2] = [X_SCALE_M as f32 / SCALE_M, Y_SCALE_M as f32 / SCALE_M];
/// Factor from a displacement per step to a scaled velocity.
const SCALED_STRIDE: [f32; 2] =
    [(X_SCALE_M * STEPS_PER_S) as f32 / SCALE_MPS, (Y_SCALE_M * STEPS_PER_S) as f32 / SCALE_MPS];
/// Factor from a relative position in units of 54.4 m to a scaled one.
const SCALED_WAY: f32 = SCALED_PLACE[0];
/// Factor from a distance in units of 128 m to a scaled one.
const SCALED_DISTANCE: f32 = FAR_M / SCALE_M;
/// The unit of distances in `egocentric`: across the pitch and its rim, metres.
pub(super) const FAR_M: f32 = 128.0;

/// `simple115v2`; missing and sent-off players are -1 in all their numbers.
pub fn simple115v2() -> Layout {
    Layout::default()
        .around(22, "own players' x, y", "normalised", &PLACE)
        .in_units("50 m", &SCALED_PLACE)
        .around(22, "own players' direction", "normalised per step", &STRIDE)
        .in_units("10 m/s", &SCALED_STRIDE)
        .around(22, "opponents' x, y", "normalised", &PLACE)
        .in_units("50 m", &SCALED_PLACE)
        .around(22, "opponents' direction", "normalised per step", &STRIDE)
        .in_units("10 m/s", &SCALED_STRIDE)
        .ball_and_modes()
}

/// `simple115v2+sticky`: `simple115v2`, plus the keys that the agent holds.
pub fn simple115v2_sticky() -> Layout {
    simple115v2().shares(StickyAction::DEFAULT_SET, "held actions", "flags of `sticky_actions`")
}

/// `simple115`: like `simple115v2`, except that the four blocks of players follow each other
/// without gaps. If players are missing, later players move up, and the rest of the 88 numbers is
/// -1.
pub fn simple115() -> Layout {
    Layout::default()
        .around(
            4 * 2 * TEAM_MAX,
            "own places, own directions, opponents' places, opponents' directions; then -1",
            "normalised; directions per step",
            &[PLACE[0], PLACE[0]],
        )
        .ball_and_modes()
}

/// `egocentric`, for teams of up to `team` players: what the agent's player sees from their own
/// place, with teammates and opponents each sorted nearest first.
pub fn egocentric(team: usize) -> Layout {
    let layout = Layout::default()
        .around(2, "my x, y", "normalised", &PLACE)
        .in_units("50 m", &SCALED_PLACE)
        .around(2, "my velocity", "10 m/s", &[2.0])
        .around(2, "the way I face: cosine, sine", "", &[1.0])
        .shares(1, "my tiredness", "0 fresh to 1")
        .shares(10, "held actions", "flags of `sticky_actions`")
        .around(2, "from me to the ball", "54.4 m", &[4.0])
        .in_units("50 m", &[SCALED_WAY])
        .shares(1, "height of the ball", "10 m, at most 1")
        .shares(1, "distance of the ball", "128 m")
        .in_units("50 m", &[SCALED_DISTANCE])
        .around(3, "velocity of the ball", "10 m/s", &[6.0])
        .shares(
            5,
            "who has the ball: nobody, I, a mate, an opponent; whether it is in hands",
            "one-hot, flag",
        )
        .around(2, "from me to their goal", "54.4 m", &[4.0])
        .in_units("50 m", &[SCALED_WAY])
        .around(2, "from me to our goal", "54.4 m", &[4.0])
        .in_units("50 m", &[SCALED_WAY])
        .shares(7, "game mode", "one-hot")
        .shares(1, "whether the set piece is ours", "flag")
        .around(1, "goals ahead", "5 goals, at most 1", &[1.0])
        .shares(1, "what is left of the episode", "share; 0 without a limit")
        .around(1, "how far the line of offside is ahead of me", "54.4 m", &[4.0])
        .in_units("50 m", &[SCALED_WAY])
        .shares(2, "whether I am the keeper; whether I am there", "flags");
    let other = |layout: Layout, who: String| {
        layout
            .block(
                OTHER,
                format!("{who}: there; from me x, y; velocity from mine x, y; distance; keeper"),
                "flag; 54.4 m; 10 m/s; 128 m; flag",
                vec![0.0, -4.0, -4.0, -4.0, -4.0, 0.0, 0.0],
                vec![1.0, 4.0, 4.0, 4.0, 4.0, 1.0, 1.0],
            )
            .in_units(
                "flag; 50 m; 10 m/s; 50 m; flag",
                &[1.0, SCALED_WAY, SCALED_WAY, 1.0, 1.0, SCALED_DISTANCE, 1.0],
            )
    };
    let mates = (1..team).fold(layout, |layout, i| other(layout, format!("mate {i}")));
    (1..=team).fold(mates, |layout, i| other(layout, format!("opponent {i}")))
}

/// Each value times its factor; the shorter list repeats.
fn times(values: &[f32], factors: &[f32]) -> Vec<f32> {
    let n = values.len().max(factors.len());
    let pairs = values.iter().cycle().zip(factors.iter().cycle());
    pairs.take(n).map(|(value, factor)| value * factor).collect()
}

/// The largest absolute value in a scenario's own observation; larger values are clamped.
pub const DECLARED_MAX: f32 = 1.0e6;

/// A scenario's own observation, one block per number.
pub fn declared(names: &[String]) -> Layout {
    names.iter().fold(Layout::default(), |layout, name| {
        layout.around(1, name, "as declared", &[DECLARED_MAX])
    })
}
