//! The layout of vector observations: one row per block, from which spaces and documentation are made.

/// Length of `simple115v2`.
pub const SIMPLE115: usize = 115;

/// A block of a vector observation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// Index of its first number.
    pub start: usize,
    /// How many numbers.
    pub len: usize,
    /// What they mean.
    pub meaning: &'static str,
    /// Least values, repeated over the block.
    pub low: &'static [f32],
    /// Greatest values, repeated over the block.
    pub high: &'static [f32],
    /// Their unit.
    pub unit: &'static str,
}

/// Bounds of a normalised place: the rim of the pitch and what lies behind it.
const PLACE: [f32; 2] = [2.0, 1.5];
const PLACE_LOW: [f32; 2] = [-2.0, -1.5];
/// Bounds of a displacement in one step.
const STRIDE: [f32; 2] = [1.0, 1.0];
const STRIDE_LOW: [f32; 2] = [-1.0, -1.0];

const fn block(start: usize, len: usize, meaning: &'static str, unit: &'static str) -> Block {
    Block { start, len, meaning, low: &[0.0], high: &[1.0], unit }
}

/// The blocks of `simple115v2`; missing and sent-off players are -1 in all their numbers.
pub const SIMPLE115_BLOCKS: &[Block] = &[
    Block { low: &PLACE_LOW, high: &PLACE, ..block(0, 22, "own players' x, y", "normalised") },
    Block { low: &STRIDE_LOW, high: &STRIDE, ..block(22, 22, "own players' direction", "normalised per step") },
    Block { low: &PLACE_LOW, high: &PLACE, ..block(44, 22, "opponents' x, y", "normalised") },
    Block { low: &STRIDE_LOW, high: &STRIDE, ..block(66, 22, "opponents' direction", "normalised per step") },
    Block {
        low: &[-2.0, -1.5, 0.0],
        high: &[2.0, 1.5, 100.0],
        ..block(88, 3, "ball x, y, z", "normalised; z in metres")
    },
    Block {
        low: &[-1.0, -1.0, -10.0],
        high: &[1.0, 1.0, 10.0],
        ..block(91, 3, "ball direction", "normalised per step; z in metres")
    },
    block(94, 3, "who has the ball: nobody, we, they", "one-hot"),
    block(97, 11, "the controlled player", "one-hot"),
    block(108, 7, "game mode", "one-hot"),
];

/// Least and greatest value of every number of `simple115v2`; what is written is held between them.
pub fn simple115_bounds() -> ([f32; SIMPLE115], [f32; SIMPLE115]) {
    let (mut low, mut high) = ([0.0; SIMPLE115], [0.0; SIMPLE115]);
    for block in SIMPLE115_BLOCKS {
        let range = block.start..block.start + block.len;
        let bounds = block.low.iter().cycle().zip(block.high.iter().cycle());
        for ((low, high), (l, h)) in low[range.clone()].iter_mut().zip(&mut high[range]).zip(bounds) {
            (*low, *high) = (*l, *h);
        }
    }
    (low, high)
}
