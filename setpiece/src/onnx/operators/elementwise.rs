//! Operators that compute each number from those in the same place.

use crate::onnx::node::NodeInputs;
use crate::onnx::tensor::{ElementType, Numbers, Tensor, common, stretch};

/// Applies a function to every float.
pub(super) fn map(given: &NodeInputs<'_>, f: impl Fn(f32) -> f32) -> Result<Tensor, String> {
    let tensor = given.input(0)?;
    let floats = tensor.as_floats()?.iter().map(|&x| f(x)).collect();
    Ok(Tensor::floats(tensor.shape.clone(), floats))
}

/// Combines all inputs, one after the other.
pub(super) fn zip(
    given: &NodeInputs<'_>,
    floats: impl Fn(f32, f32) -> f32 + Copy,
    integers: impl Fn(i64, i64) -> i64 + Copy,
) -> Result<Tensor, String> {
    let mut found = given.input(0)?.clone();
    for at in 1..given.inputs.len() {
        let (first, second) = (&found, given.input(at)?);
        let shape = common(&first.shape, &second.shape)?;
        let numbers = match (&first.numbers, &second.numbers) {
            (Numbers::Floats(a), Numbers::Floats(b)) => {
                Numbers::Floats(zipped((&first.shape, a), (&second.shape, b), &shape, floats)?)
            }
            (Numbers::Integers(a), Numbers::Integers(b)) => {
                Numbers::Integers(zipped((&first.shape, a), (&second.shape, b), &shape, integers)?)
            }
            _ => return Err("it mixes floats and whole numbers".to_owned()),
        };
        found = Tensor { shape, numbers };
    }
    Ok(found)
}

/// Compares two inputs.
pub(super) fn compare(
    given: &NodeInputs<'_>,
    floats: impl Fn(f32, f32) -> bool,
    integers: impl Fn(i64, i64) -> bool,
) -> Result<Tensor, String> {
    let (first, second) = (given.input(0)?, given.input(1)?);
    let shape = common(&first.shape, &second.shape)?;
    let held = match (&first.numbers, &second.numbers) {
        (Numbers::Floats(a), Numbers::Floats(b)) => {
            zipped((&first.shape, a), (&second.shape, b), &shape, |a, b| floats(a, b).into())?
        }
        (Numbers::Integers(a), Numbers::Integers(b)) => {
            zipped((&first.shape, a), (&second.shape, b), &shape, |a, b| integers(a, b).into())?
        }
        _ => return Err("it mixes floats and whole numbers".to_owned()),
    };
    Ok(Tensor::integers(shape, held))
}

/// Combines two inputs of true and false.
pub(super) fn logic(
    given: &NodeInputs<'_>,
    f: impl Fn(bool, bool) -> bool,
) -> Result<Tensor, String> {
    let (first, second) = (given.input(0)?, given.input(1)?);
    let shape = common(&first.shape, &second.shape)?;
    let (a, b) = (first.as_integers()?, second.as_integers()?);
    let both = |a, b| i64::from(f(a != 0, b != 0));
    Ok(Tensor::integers(
        shape.clone(),
        zipped((&first.shape, a), (&second.shape, b), &shape, both)?,
    ))
}

fn zipped<T: Copy, U>(
    (first_shape, first): (&[usize], &[T]),
    (second_shape, second): (&[usize], &[T]),
    shape: &[usize],
    f: impl Fn(T, T) -> U,
) -> Result<Vec<U>, String> {
    let first = stretch(first, first_shape, shape)?;
    let second = stretch(second, second_shape, shape)?;
    Ok(first.iter().zip(second.iter()).map(|(&a, &b)| f(a, b)).collect())
}

pub(super) fn div(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let by = given.input(1)?;
    if by.as_integers().is_ok_and(|by| by.contains(&0)) {
        return Err("it divides a whole number by 0".to_owned());
    }
    zip(given, |a, b| a / b, i64::wrapping_div)
}

pub(super) fn pow(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    // The exponent is often a whole number.
    let exponent = given.input(1)?;
    let floats = match &exponent.numbers {
        Numbers::Floats(floats) => floats.clone(),
        Numbers::Integers(integers) => integers.iter().map(|&it| it as f32).collect(),
    };
    let exponent = Tensor::floats(exponent.shape.clone(), floats);
    let inputs = vec![given.optional(0), Some(&exponent)];
    zip(&NodeInputs { inputs, attributes: given.attributes }, libm::powf, |a, _| a)
}

/// Keeps floats between two bounds, each of which may be left out.
pub(super) fn clip(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let bound = |at: usize, free: f32| match given.optional(at) {
        Some(bound) => bound.as_floats()?.first().copied().ok_or("a bound is empty".to_owned()),
        None => Ok(free),
    };
    let (low, high) = (bound(1, f32::NEG_INFINITY)?, bound(2, f32::INFINITY)?);
    map(given, |x| {
        let raised = if x < low { low } else { x };
        if raised > high { high } else { raised }
    })
}

pub(super) fn elu(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let alpha = given.attributes.float("alpha", 1.0);
    map(given, |x| if x < 0.0 { alpha * libm::expm1f(x) } else { x })
}

pub(super) fn selu(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    // The defaults of the operator.
    let alpha = given.attributes.float("alpha", 1.673_263_2);
    let gamma = given.attributes.float("gamma", 1.050_701);
    map(given, |x| gamma * if x <= 0.0 { alpha * libm::expm1f(x) } else { x })
}

pub(super) fn gelu(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    use std::f32::consts::{FRAC_1_SQRT_2, FRAC_2_SQRT_PI};
    let is_rough = given.attributes.text("approximate") == "tanh";
    map(given, |x| {
        let inner = FRAC_2_SQRT_PI * FRAC_1_SQRT_2 * (x + 0.044_715 * x * x * x);
        let share = if is_rough { libm::tanhf(inner) } else { libm::erff(x * FRAC_1_SQRT_2) };
        0.5 * x * (1.0 + share)
    })
}

pub(super) fn leaky_relu(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let alpha = given.attributes.float("alpha", 0.01);
    map(given, |x| if x < 0.0 { alpha * x } else { x })
}

pub(super) fn not(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let tensor = given.input(0)?;
    let integers = tensor.as_integers()?.iter().map(|&it| i64::from(it == 0)).collect();
    Ok(Tensor::integers(tensor.shape.clone(), integers))
}

/// Changes the type of the numbers.
pub(super) fn cast(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let (tensor, to) = (given.input(0)?, given.attributes.integer("to", 0));
    let to = i32::try_from(to).ok().and_then(ElementType::of);
    let to = to.ok_or("it wants a type of numbers that no policy needs")?;
    let numbers = match (&tensor.numbers, to) {
        (Numbers::Floats(floats), ElementType::Bool) => {
            Numbers::Integers(floats.iter().map(|&it| i64::from(it != 0.0)).collect())
        }
        (Numbers::Integers(integers), ElementType::Bool) => {
            Numbers::Integers(integers.iter().map(|&it| i64::from(it != 0)).collect())
        }
        (Numbers::Integers(integers), to) if to.is_float() => {
            Numbers::Floats(integers.iter().map(|&it| it as f32).collect())
        }
        (Numbers::Floats(floats), to) if !to.is_float() => {
            Numbers::Integers(floats.iter().map(|&it| it as i64).collect())
        }
        (same, _) => same.clone(),
    };
    Ok(Tensor { shape: tensor.shape.clone(), numbers })
}

/// Takes each number from the second or third input, as the first says.
pub(super) fn choose(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let (which, yes, no) = (given.input(0)?, given.input(1)?, given.input(2)?);
    let shape = common(&common(&which.shape, &yes.shape)?, &no.shape)?;
    let held = stretch(which.as_integers()?, &which.shape, &shape)?;
    let numbers = match (&yes.numbers, &no.numbers) {
        (Numbers::Floats(a), Numbers::Floats(b)) => {
            Numbers::Floats(chosen(&held, (&yes.shape, a), (&no.shape, b), &shape)?)
        }
        (Numbers::Integers(a), Numbers::Integers(b)) => {
            Numbers::Integers(chosen(&held, (&yes.shape, a), (&no.shape, b), &shape)?)
        }
        _ => return Err("it mixes floats and whole numbers".to_owned()),
    };
    Ok(Tensor { shape, numbers })
}

fn chosen<T: Copy>(
    held: &[i64],
    (yes_shape, yes): (&[usize], &[T]),
    (no_shape, no): (&[usize], &[T]),
    shape: &[usize],
) -> Result<Vec<T>, String> {
    let (yes, no) = (stretch(yes, yes_shape, shape)?, stretch(no, no_shape, shape)?);
    let both = held.iter().zip(yes.iter().zip(no.iter()));
    Ok(both.map(|(&held, (&yes, &no))| if held != 0 { yes } else { no }).collect())
}
