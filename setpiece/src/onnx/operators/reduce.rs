//! Operators that look at all numbers along an axis.

use crate::onnx::node::NodeInputs;
use crate::onnx::tensor::{Tensor, axis_of, size_of, strides, walk};

/// Calls `f` with every row along an axis, as the places of its numbers.
fn rows(shape: &[usize], axis: usize, mut f: impl FnMut(&[usize])) -> Result<(), String> {
    let own = strides(shape);
    let others: Vec<usize> = (0..shape.len()).filter(|&it| it != axis).collect();
    let lengths: Vec<usize> = others.iter().map(|&it| shape[it]).collect();
    let steps: Vec<usize> = others.iter().map(|&it| own[it]).collect();
    for start in walk(&lengths, &steps, size_of(&lengths)?) {
        let places: Vec<usize> = (0..shape[axis]).map(|at| start + at * own[axis]).collect();
        f(&places);
    }
    Ok(())
}

/// The shares of exponentials along an axis, or their logarithms.
pub(super) fn softmax(given: &NodeInputs<'_>, logarithms: bool) -> Result<Tensor, String> {
    let tensor = given.input(0)?;
    let axis = axis_of(given.attributes.integer("axis", -1), tensor.shape.len())?;
    let mut floats = tensor.as_floats()?.to_vec();
    rows(&tensor.shape, axis, |places| {
        let most = places.iter().fold(f32::NEG_INFINITY, |most, &at| most.max(floats[at]));
        let sum: f32 = places.iter().map(|&at| libm::expf(floats[at] - most)).sum();
        for &at in places {
            let less = floats[at] - most;
            floats[at] = if logarithms { less - libm::logf(sum) } else { libm::expf(less) / sum };
        }
    })?;
    Ok(Tensor::floats(tensor.shape.clone(), floats))
}

/// Folds the numbers along some axes; all of them if none is named.
pub(super) fn reduce(
    given: &NodeInputs<'_>,
    begin: f32,
    add: impl Fn(f32, f32) -> f32,
    end: impl Fn(f32, usize) -> f32,
) -> Result<Tensor, String> {
    let tensor = given.input(0)?;
    let (rank, keeps) = (tensor.shape.len(), given.attributes.integer("keepdims", 1) != 0);
    let named = given.integers(1)?.or_else(|| given.attributes.integers("axes")).unwrap_or(&[]);
    let named = named.iter().map(|&axis| axis_of(axis, rank)).collect::<Result<Vec<_>, _>>()?;
    if named.is_empty() && given.attributes.integer("noop_with_empty_axes", 0) != 0 {
        return Ok(tensor.clone());
    }
    let is_folded = |axis: usize| named.is_empty() || named.contains(&axis);
    let kept: Vec<usize> =
        (0..rank).map(|it| if is_folded(it) { 1 } else { tensor.shape[it] }).collect();
    let own = strides(&kept);
    let steps: Vec<usize> = (0..rank).map(|it| if is_folded(it) { 0 } else { own[it] }).collect();
    let size = size_of(&kept)?;
    let mut sums = vec![begin; size];
    let places = walk(&tensor.shape, &steps, tensor.len());
    for (place, &number) in places.into_iter().zip(tensor.as_floats()?) {
        sums[place] = add(sums[place], number);
    }
    let n = tensor.len() / size.max(1);
    let shape = if keeps {
        kept
    } else {
        (0..rank).filter(|&axis| !is_folded(axis)).map(|axis| tensor.shape[axis]).collect()
    };
    Ok(Tensor::floats(shape, sums.into_iter().map(|sum| end(sum, n)).collect()))
}

/// Standardises the numbers of the last axes.
pub(super) fn layer_normalization(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let (tensor, scale) = (given.input(0)?, given.input(1)?.as_floats()?);
    let axis = axis_of(given.attributes.integer("axis", -1), tensor.shape.len())?;
    let n: usize = tensor.shape[axis..].iter().product();
    let bias = given.optional(2).map(Tensor::as_floats).transpose()?;
    if n == 0 || scale.len() != n || bias.is_some_and(|bias| bias.len() != n) {
        return Err(format!(
            "{:?} standardised by {} numbers don't fit",
            tensor.shape,
            scale.len()
        ));
    }
    let epsilon = given.attributes.float("epsilon", 1e-5);
    let mut floats = tensor.as_floats()?.to_vec();
    for row in floats.chunks_exact_mut(n) {
        let mean = row.iter().sum::<f32>() / n as f32;
        let variance = row.iter().map(|it| (it - mean) * (it - mean)).sum::<f32>() / n as f32;
        let deviation = libm::sqrtf(variance + epsilon);
        for (at, it) in row.iter_mut().enumerate() {
            *it = (*it - mean) / deviation * scale[at] + bias.map_or(0.0, |bias| bias[at]);
        }
    }
    Ok(Tensor::floats(tensor.shape.clone(), floats))
}

/// Standardises every channel by the mean and variance of the training.
pub(super) fn batch_normalization(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let tensor = given.input(0)?;
    let channels = *tensor.shape.get(1).ok_or("it has no channels")?;
    let mut parts: Vec<&[f32]> = Vec::new();
    for at in 1..5 {
        parts.push(given.input(at)?.as_floats()?);
    }
    if parts.iter().any(|part| part.len() != channels) {
        return Err(format!("{:?} has {channels} channels", tensor.shape));
    }
    let (epsilon, each) =
        (given.attributes.float("epsilon", 1e-5), tensor.shape[2..].iter().product::<usize>());
    let floats = tensor.as_floats()?.iter().enumerate().map(|(at, it)| {
        let channel = at / each.max(1) % channels.max(1);
        let [scale, bias, mean, variance] = [0, 1, 2, 3].map(|part: usize| parts[part][channel]);
        (it - mean) / libm::sqrtf(variance + epsilon) * scale + bias
    });
    Ok(Tensor::floats(tensor.shape.clone(), floats.collect()))
}
