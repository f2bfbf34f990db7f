//! The operators of networks.
//!
//! A network computes the same bits on every machine: sums have one order, and functions are those
//! of `libm`.

mod elementwise;
mod filter;
mod linear;
mod reduce;
mod shape;

pub(super) use linear::transposed as turned;

use super::node::NodeInputs;
use super::tensor::Tensor;

/// Computes the first output of a node; the error says in a clause why it can't.
pub(super) type Operator = fn(&NodeInputs<'_>) -> Result<Tensor, String>;

/// Finds an operator of ONNX by its name.
pub(super) fn operator(name: &str) -> Option<Operator> {
    let found = OPERATORS.binary_search_by_key(&name, |(known, _)| *known);
    found.ok().and_then(|at| OPERATORS.get(at)).map(|(_, operator)| *operator)
}

/// Every operator, sorted by name.
const OPERATORS: &[(&str, Operator)] = &[
    ("Abs", |given| elementwise::map(given, libm::fabsf)),
    ("Add", |given| elementwise::zip(given, |a, b| a + b, i64::wrapping_add)),
    ("And", |given| elementwise::logic(given, |a, b| a & b)),
    ("BatchNormalization", reduce::batch_normalization),
    ("Cast", elementwise::cast),
    ("Clip", elementwise::clip),
    ("Concat", shape::concat),
    ("Constant", constant),
    ("ConstantOfShape", shape::constant_of_shape),
    ("Conv", filter::conv),
    ("Div", elementwise::div),
    ("Dropout", |given| Ok(given.input(0)?.clone())),
    ("Elu", elementwise::elu),
    ("Equal", |given| elementwise::compare(given, |a, b| a == b, |a, b| a == b)),
    ("Erf", |given| elementwise::map(given, libm::erff)),
    ("Exp", |given| elementwise::map(given, libm::expf)),
    ("Expand", shape::expand),
    ("Flatten", shape::flatten),
    ("Gather", shape::gather),
    ("Gelu", elementwise::gelu),
    ("Gemm", linear::gemm),
    ("Greater", |given| elementwise::compare(given, |a, b| a > b, |a, b| a > b)),
    ("GreaterOrEqual", |given| elementwise::compare(given, |a, b| a >= b, |a, b| a >= b)),
    ("Identity", |given| Ok(given.input(0)?.clone())),
    ("LayerNormalization", reduce::layer_normalization),
    ("LeakyRelu", elementwise::leaky_relu),
    ("Less", |given| elementwise::compare(given, |a, b| a < b, |a, b| a < b)),
    ("LessOrEqual", |given| elementwise::compare(given, |a, b| a <= b, |a, b| a <= b)),
    ("Log", |given| elementwise::map(given, libm::logf)),
    ("LogSoftmax", |given| reduce::softmax(given, true)),
    ("MatMul", linear::matmul),
    ("Max", |given| elementwise::zip(given, f32::max, i64::max)),
    ("MaxPool", filter::max_pool),
    ("Min", |given| elementwise::zip(given, f32::min, i64::min)),
    ("Mul", |given| elementwise::zip(given, |a, b| a * b, i64::wrapping_mul)),
    ("Neg", |given| elementwise::map(given, |x| -x)),
    ("Not", elementwise::not),
    ("Or", |given| elementwise::logic(given, |a, b| a | b)),
    ("Pow", elementwise::pow),
    ("Reciprocal", |given| elementwise::map(given, |x| 1.0 / x)),
    ("ReduceL2", |given| reduce::reduce(given, 0.0, |a, b| a + b * b, |sum, _| libm::sqrtf(sum))),
    ("ReduceMax", |given| reduce::reduce(given, f32::NEG_INFINITY, f32::max, |found, _| found)),
    ("ReduceMean", |given| reduce::reduce(given, 0.0, |a, b| a + b, |sum, n| sum / n as f32)),
    ("ReduceMin", |given| reduce::reduce(given, f32::INFINITY, f32::min, |found, _| found)),
    ("ReduceSum", |given| reduce::reduce(given, 0.0, |a, b| a + b, |sum, _| sum)),
    ("Relu", |given| elementwise::map(given, |x| if x < 0.0 { 0.0 } else { x })),
    ("Reshape", shape::reshape),
    ("Selu", elementwise::selu),
    ("Shape", shape::shape),
    ("Sigmoid", |given| elementwise::map(given, sigmoid)),
    ("Slice", shape::slice),
    ("Softmax", |given| reduce::softmax(given, false)),
    ("Softplus", |given| elementwise::map(given, |x| libm::log1pf(libm::expf(x)))),
    ("Sqrt", |given| elementwise::map(given, libm::sqrtf)),
    ("Squeeze", shape::squeeze),
    ("Sub", |given| elementwise::zip(given, |a, b| a - b, i64::wrapping_sub)),
    ("Tanh", |given| elementwise::map(given, libm::tanhf)),
    ("Transpose", shape::transpose),
    ("Unsqueeze", shape::unsqueeze),
    ("Where", elementwise::choose),
];

fn sigmoid(x: f32) -> f32 {
    1.0 / (1.0 + libm::expf(-x))
}

/// The array that a node holds.
fn constant(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let held = &given.attributes.0;
    if let Some(tensor) = held.get("value").and_then(|it| it.tensor.as_ref()) {
        return Tensor::read(tensor);
    }
    let named = |name: &str| held.get(name);
    match (named("value_float"), named("value_int"), named("value_floats"), named("value_ints")) {
        (Some(it), ..) => Ok(Tensor::floats([], vec![it.float])),
        (_, Some(it), ..) => Ok(Tensor::integers([], vec![it.integer])),
        (_, _, Some(it), _) => Ok(Tensor::floats([it.floats.len()], it.floats.clone())),
        (.., Some(it)) => Ok(Tensor::integers([it.integers.len()], it.integers.clone())),
        _ => Err("it holds neither floats nor whole numbers".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_sorted() {
        assert!(OPERATORS.is_sorted_by_key(|(name, _)| *name));
    }
}
