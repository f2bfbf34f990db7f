//! Arrays of numbers, as networks compute with them.

use super::message::TensorMessage;
use std::borrow::Cow;

/// Most numbers of an array. The largest of our networks, those that see maps, have a million.
const SIZE_MAX: usize = 1 << 24;

/// The type of an input's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElementType {
    /// 32 bits.
    Float,
    /// 64 bits, which are computed as 32.
    Double,
    /// Whole numbers of any width.
    Integer,
    /// Bytes.
    Byte,
    /// True or false.
    Bool,
}

impl ElementType {
    /// The type of a number of the format; none for those that no policy needs.
    pub(super) fn of(number: i32) -> Option<ElementType> {
        Some(match number {
            1 => ElementType::Float,
            2 => ElementType::Byte,
            6 | 7 => ElementType::Integer,
            9 => ElementType::Bool,
            11 => ElementType::Double,
            _ => return None,
        })
    }

    /// Whether its numbers are computed as floats.
    pub(crate) fn is_float(self) -> bool {
        matches!(self, ElementType::Float | ElementType::Double)
    }
}

/// The numbers of an array, row by row.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Numbers {
    /// Floats.
    Floats(Vec<f32>),
    /// Whole numbers and bytes; 0 and 1 for false and true.
    Integers(Vec<i64>),
}

/// An array.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Tensor {
    /// The lengths of its axes.
    pub(crate) shape: Vec<usize>,
    /// As many as the product of the lengths.
    pub(crate) numbers: Numbers,
}

impl Tensor {
    /// An array of floats.
    pub(crate) fn floats(shape: impl Into<Vec<usize>>, floats: Vec<f32>) -> Tensor {
        Tensor { shape: shape.into(), numbers: Numbers::Floats(floats) }
    }

    /// An array of whole numbers.
    pub(crate) fn integers(shape: impl Into<Vec<usize>>, integers: Vec<i64>) -> Tensor {
        Tensor { shape: shape.into(), numbers: Numbers::Integers(integers) }
    }

    /// Reads a constant of a file.
    pub(super) fn read(message: &TensorMessage) -> Result<Tensor, String> {
        if message.location != 0 {
            return Err("its numbers are in another file".to_owned());
        }
        let shape = message.shape.iter().map(|&length| {
            usize::try_from(length).map_err(|_| format!("an axis has the length {length}"))
        });
        let shape = shape.collect::<Result<Vec<_>, _>>()?;
        let size = size_of(&shape)?;
        let numbers = match (message.element, message.raw.is_empty()) {
            (1, false) => Numbers::Floats(raw(&message.raw, f32::from_le_bytes)),
            (1, true) => Numbers::Floats(message.floats.clone()),
            (11, false) => Numbers::Floats(raw(&message.raw, |it| f64::from_le_bytes(it) as f32)),
            (11, true) => Numbers::Floats(message.doubles.iter().map(|it| *it as f32).collect()),
            (2 | 9, false) => {
                Numbers::Integers(message.raw.iter().copied().map(i64::from).collect())
            }
            (6, false) => Numbers::Integers(raw(&message.raw, |it| i32::from_le_bytes(it).into())),
            (2 | 6 | 9, true) => {
                Numbers::Integers(message.words.iter().copied().map(i64::from).collect())
            }
            (7, false) => Numbers::Integers(raw(&message.raw, i64::from_le_bytes)),
            (7, true) => Numbers::Integers(message.integers.clone()),
            (other, _) => return Err(format!("its numbers have the type {other} of ONNX")),
        };
        let tensor = Tensor { shape, numbers };
        let found = tensor.len();
        if found == size { Ok(tensor) } else { Err(format!("it has {found} numbers for {size}")) }
    }

    /// How many numbers it has.
    pub(crate) fn len(&self) -> usize {
        match &self.numbers {
            Numbers::Floats(floats) => floats.len(),
            Numbers::Integers(integers) => integers.len(),
        }
    }

    /// Its floats.
    pub(super) fn as_floats(&self) -> Result<&[f32], String> {
        match &self.numbers {
            Numbers::Floats(floats) => Ok(floats),
            Numbers::Integers(_) => Err("expected floats, found whole numbers".to_owned()),
        }
    }

    /// Its whole numbers.
    pub(super) fn as_integers(&self) -> Result<&[i64], String> {
        match &self.numbers {
            Numbers::Integers(integers) => Ok(integers),
            Numbers::Floats(_) => Err("expected whole numbers, found floats".to_owned()),
        }
    }

    /// The same numbers in another shape.
    pub(super) fn reshaped(&self, shape: Vec<usize>) -> Result<Tensor, String> {
        if size_of(&shape)? != self.len() {
            return Err(format!("{:?} can't become {shape:?}", self.shape));
        }
        Ok(Tensor { shape, numbers: self.numbers.clone() })
    }

    /// The numbers at some places, in another shape.
    pub(super) fn picked(&self, shape: Vec<usize>, places: &[usize]) -> Result<Tensor, String> {
        fn pick<T: Copy>(of: &[T], places: &[usize]) -> Result<Vec<T>, String> {
            let one =
                |&place: &usize| of.get(place).copied().ok_or("a place is outside".to_owned());
            places.iter().map(one).collect()
        }
        let numbers = match &self.numbers {
            Numbers::Floats(floats) => Numbers::Floats(pick(floats, places)?),
            Numbers::Integers(integers) => Numbers::Integers(pick(integers, places)?),
        };
        Ok(Tensor { shape, numbers })
    }
}

fn raw<const N: usize, T>(bytes: &[u8], read: impl Fn([u8; N]) -> T) -> Vec<T> {
    bytes.chunks_exact(N).filter_map(|it| it.try_into().ok()).map(read).collect()
}

/// How many numbers an array of a shape has.
pub(super) fn size_of(shape: &[usize]) -> Result<usize, String> {
    let size = shape.iter().try_fold(1_usize, |size, &length| size.checked_mul(length));
    size.filter(|&size| size <= SIZE_MAX).ok_or_else(|| format!("{shape:?} is too large"))
}

/// How far apart neighbours on each axis are.
pub(super) fn strides(shape: &[usize]) -> Vec<usize> {
    let mut strides = vec![1; shape.len()];
    for axis in (1..shape.len()).rev() {
        strides[axis - 1] = strides[axis] * shape[axis];
    }
    strides
}

/// The axis of a number that may count from the end.
pub(super) fn axis_of(axis: i64, rank: usize) -> Result<usize, String> {
    let from_start = if axis < 0 { axis + rank as i64 } else { axis };
    let found = usize::try_from(from_start).ok().filter(|&axis| axis < rank);
    found.ok_or_else(|| format!("there is no axis {axis} of {rank}"))
}

/// The shape that arrays of two shapes are stretched to.
pub(super) fn common(first: &[usize], second: &[usize]) -> Result<Vec<usize>, String> {
    let rank = first.len().max(second.len());
    let length = |shape: &[usize], axis: usize| {
        (axis + shape.len()).checked_sub(rank).map_or(1, |axis| shape[axis])
    };
    let axes = (0..rank).map(|axis| match (length(first, axis), length(second, axis)) {
        (a, b) if a == b || b == 1 => Ok(a),
        (1, b) => Ok(b),
        _ => Err(format!("{first:?} and {second:?} don't fit")),
    });
    axes.collect()
}

/// The places in an array of the shape `from` of the numbers of one that it is stretched to.
pub(super) fn stretched(from: &[usize], to: &[usize]) -> Result<Vec<usize>, String> {
    let size = size_of(to)?;
    let misfit = || format!("{from:?} doesn't fit {to:?}");
    let lead = to.len().checked_sub(from.len()).ok_or_else(misfit)?;
    if from.iter().zip(&to[lead..]).any(|(&from, &to)| from != 1 && from != to) {
        return Err(misfit());
    }
    let own = strides(from);
    let step = |axis: usize| {
        axis.checked_sub(lead).filter(|&axis| from[axis] != 1).map_or(0, |axis| own[axis])
    };
    let steps: Vec<usize> = (0..to.len()).map(step).collect();
    Ok(walk(to, &steps, size))
}

/// The places that a walk over a shape comes by, row by row, with a step for each axis.
pub(super) fn walk(shape: &[usize], steps: &[usize], size: usize) -> Vec<usize> {
    let (mut at, mut place) = (vec![0; shape.len()], 0);
    let mut places = Vec::with_capacity(size);
    for _ in 0..size {
        places.push(place);
        for axis in (0..shape.len()).rev() {
            at[axis] += 1;
            place += steps[axis];
            if at[axis] < shape[axis] {
                break;
            }
            place -= steps[axis] * at[axis];
            at[axis] = 0;
        }
    }
    places
}

/// Numbers of the shape `from`, stretched to another.
pub(super) fn stretch<'a, T: Copy>(
    numbers: &'a [T],
    from: &[usize],
    to: &[usize],
) -> Result<Cow<'a, [T]>, String> {
    let size = size_of(to)?;
    if numbers.len() == size {
        return Ok(Cow::Borrowed(numbers));
    }
    if let [one] = numbers {
        return Ok(Cow::Owned(vec![*one; size]));
    }
    Ok(Cow::Owned(stretched(from, to)?.iter().map(|&place| numbers[place]).collect()))
}
