//! Operators that move numbers without changing them.

use crate::onnx::node::NodeInputs;
use crate::onnx::tensor::{Numbers, Tensor, axis_of, common, size_of, stretched, strides, walk};

pub(super) fn shape(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let lengths: Vec<i64> = given.input(0)?.shape.iter().map(|&length| length as i64).collect();
    // Counts from the end, and is cut at the ends, like a slice.
    let n = lengths.len() as i64;
    let at = |name, default| {
        let at = given.attributes.integer(name, default);
        (if at < 0 { at + n } else { at }).clamp(0, n) as usize
    };
    let (start, end) = (at("start", 0), at("end", n));
    let part = lengths.get(start..end).unwrap_or_default().to_vec();
    Ok(Tensor::integers([part.len()], part))
}

/// The same numbers in another shape: -1 stands for what is left, 0 for the length that it has.
pub(super) fn reshape(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let tensor = given.input(0)?;
    let wanted = given.integers(1)?.ok_or("it lacks the shape")?;
    let keeps_zero = given.attributes.integer("allowzero", 0) != 0;
    let (mut shape, mut open) = (Vec::new(), None);
    for (axis, &length) in wanted.iter().enumerate() {
        shape.push(match length {
            -1 if open.is_none() => {
                open = Some(axis);
                1
            }
            0 if !keeps_zero => *tensor.shape.get(axis).ok_or("an axis is missing")?,
            length => usize::try_from(length).map_err(|_| format!("{wanted:?} is no shape"))?,
        });
    }
    if let Some(axis) = open {
        shape[axis] = tensor.len() / size_of(&shape)?.max(1);
    }
    tensor.reshaped(shape)
}

pub(super) fn flatten(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let tensor = given.input(0)?;
    let (rank, axis) = (tensor.shape.len(), given.attributes.integer("axis", 1));
    let axis = if axis == rank as i64 { rank } else { axis_of(axis, rank)? };
    let (rows, columns) = tensor.shape.split_at(axis);
    tensor.reshaped(vec![rows.iter().product(), columns.iter().product()])
}

pub(super) fn transpose(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let tensor = given.input(0)?;
    let rank = tensor.shape.len();
    let order = match given.attributes.integers("perm") {
        Some(order) => order.iter().map(|&it| axis_of(it, rank)).collect::<Result<Vec<_>, _>>()?,
        None => (0..rank).rev().collect(),
    };
    if !(0..rank).all(|axis| order.contains(&axis)) || order.len() != rank {
        return Err(format!("{order:?} isn't an order of {rank} axes"));
    }
    let own = strides(&tensor.shape);
    let shape: Vec<usize> = order.iter().map(|&axis| tensor.shape[axis]).collect();
    let steps: Vec<usize> = order.iter().map(|&axis| own[axis]).collect();
    let places = walk(&shape, &steps, tensor.len());
    tensor.picked(shape, &places)
}

pub(super) fn squeeze(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let tensor = given.input(0)?;
    let rank = tensor.shape.len();
    let axes = match given.integers(1)? {
        Some(axes) => axes.iter().map(|&it| axis_of(it, rank)).collect::<Result<Vec<_>, _>>()?,
        None => (0..rank).filter(|&axis| tensor.shape[axis] == 1).collect(),
    };
    let kept = (0..rank).filter(|axis| !axes.contains(axis)).map(|axis| tensor.shape[axis]);
    tensor.reshaped(kept.collect())
}

pub(super) fn unsqueeze(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let tensor = given.input(0)?;
    let axes = given.integers(1)?.ok_or("it lacks the axes")?;
    let rank = tensor.shape.len() + axes.len();
    let axes = axes.iter().map(|&it| axis_of(it, rank)).collect::<Result<Vec<_>, _>>()?;
    let mut rest = tensor.shape.iter();
    let shape = (0..rank)
        .map(|axis| if axes.contains(&axis) { 1 } else { rest.next().copied().unwrap_or(1) });
    tensor.reshaped(shape.collect())
}

pub(super) fn concat(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let parts: Vec<&Tensor> =
        (0..given.inputs.len()).map(|at| given.input(at)).collect::<Result<_, _>>()?;
    let first = parts.first().ok_or("it joins nothing")?;
    let axis = axis_of(given.attributes.integer("axis", 0), first.shape.len())?;
    let others = |shape: &[usize]| {
        shape
            .iter()
            .enumerate()
            .filter(|(at, _)| *at != axis)
            .map(|(_, it)| *it)
            .collect::<Vec<_>>()
    };
    if parts.iter().any(|part| {
        part.shape.len() != first.shape.len() || others(&part.shape) != others(&first.shape)
    }) {
        return Err("the parts don't fit".to_owned());
    }
    let mut shape = first.shape.clone();
    shape[axis] = parts.iter().map(|part| part.shape[axis]).sum();
    let size = size_of(&shape)?;
    let lead: usize = first.shape[..axis].iter().product();
    let numbers = match first.numbers {
        Numbers::Floats(_) => Numbers::Floats(joined(&parts, lead, size, Tensor::as_floats)?),
        Numbers::Integers(_) => Numbers::Integers(joined(&parts, lead, size, Tensor::as_integers)?),
    };
    Ok(Tensor { shape, numbers })
}

/// A row of each part, then the next row of each.
fn joined<T: Copy>(
    parts: &[&Tensor],
    lead: usize,
    size: usize,
    numbers: impl Fn(&Tensor) -> Result<&[T], String>,
) -> Result<Vec<T>, String> {
    let mut joined = Vec::with_capacity(size);
    for row in 0..lead {
        for part in parts {
            let numbers = numbers(part)?;
            let n = numbers.len() / lead.max(1);
            joined.extend_from_slice(&numbers[row * n..(row + 1) * n]);
        }
    }
    Ok(joined)
}

pub(super) fn slice(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let tensor = given.input(0)?;
    let lacks = || "it lacks where to begin and to end".to_owned();
    let (starts, ends) =
        (given.integers(1)?.ok_or_else(lacks)?, given.integers(2)?.ok_or_else(lacks)?);
    let (axes, steps) = (given.integers(3)?, given.integers(4)?);
    let rank = tensor.shape.len();
    let mut kept: Vec<Vec<usize>> =
        tensor.shape.iter().map(|&length| (0..length).collect()).collect();
    for (at, (&start, &end)) in starts.iter().zip(ends).enumerate() {
        let axis = match axes {
            Some(axes) => axis_of(*axes.get(at).ok_or("an axis is missing")?, rank)?,
            None => axis_of(at as i64, rank)?,
        };
        let step = steps.map_or(Some(1), |steps| steps.get(at).copied()).unwrap_or(0);
        let step =
            usize::try_from(step).ok().filter(|&step| step > 0).ok_or("a step isn't positive")?;
        let length = tensor.shape[axis] as i64;
        let within = |at: i64| {
            (if at < 0 { at.saturating_add(length) } else { at }).clamp(0, length) as usize
        };
        kept[axis] = (within(start)..within(end).max(within(start))).step_by(step).collect();
    }
    let shape: Vec<usize> = kept.iter().map(Vec::len).collect();
    let own = strides(&tensor.shape);
    let places = kept.iter().zip(own).fold(vec![0], |places, (kept, stride)| {
        let next = |place: usize| kept.iter().map(move |at| place + at * stride);
        places.into_iter().flat_map(next).collect()
    });
    tensor.picked(shape, &places)
}

pub(super) fn gather(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let (tensor, which) = (given.input(0)?, given.input(1)?);
    let axis = axis_of(given.attributes.integer("axis", 0), tensor.shape.len())?;
    let (lead, rest) = (&tensor.shape[..axis], &tensor.shape[axis + 1..]);
    let length = tensor.shape[axis];
    let which_places = which.as_integers()?.iter().map(|&at| axis_of(at, length));
    let which_places = which_places.collect::<Result<Vec<_>, _>>()?;
    let shape = [lead, &which.shape, rest].concat();
    let mut places = Vec::with_capacity(size_of(&shape)?);
    let inner: usize = rest.iter().product();
    for block in 0..lead.iter().product() {
        for at in &which_places {
            let from = (block * length + at) * inner;
            places.extend(from..from + inner);
        }
    }
    tensor.picked(shape, &places)
}

pub(super) fn expand(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let tensor = given.input(0)?;
    let wanted = given.integers(1)?.ok_or("it lacks the shape")?;
    let wanted: Option<Vec<usize>> = wanted.iter().map(|&it| usize::try_from(it).ok()).collect();
    let shape = common(&tensor.shape, &wanted.ok_or("the shape has a negative length")?)?;
    let places = stretched(&tensor.shape, &shape)?;
    tensor.picked(shape, &places)
}

pub(super) fn constant_of_shape(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let wanted = given.integers(0)?.ok_or("it lacks the shape")?;
    let shape: Option<Vec<usize>> = wanted.iter().map(|&it| usize::try_from(it).ok()).collect();
    let shape = shape.ok_or("the shape has a negative length")?;
    let held = given.attributes.0.get("value").and_then(|it| it.tensor.as_ref());
    let one = held.map_or(Ok(Tensor::floats([1], vec![0.0])), Tensor::read)?;
    let places = vec![0; size_of(&shape)?];
    one.picked(shape, &places)
}
