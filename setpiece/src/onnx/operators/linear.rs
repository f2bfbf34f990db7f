//! Products of matrices.

use crate::onnx::node::NodeInputs;
use crate::onnx::tensor::{Tensor, stretch};

/// Adds the product of two matrices, `rows × inner` and `inner × columns`, to a third.
///
/// Goes through the second row by row: the sums of a row of the result grow side by side.
pub(super) fn add_product(
    out: &mut [f32],
    first: &[f32],
    second: &[f32],
    inner: usize,
    columns: usize,
) {
    if inner == 0 || columns == 0 {
        return;
    }
    for (out, first) in out.chunks_exact_mut(columns).zip(first.chunks_exact(inner)) {
        for (&factor, row) in first.iter().zip(second.chunks_exact(columns)) {
            for (sum, &number) in out.iter_mut().zip(row) {
                *sum += factor * number;
            }
        }
    }
}

/// A matrix with rows and columns exchanged.
pub(in crate::onnx) fn transposed(matrix: &Tensor) -> Result<Tensor, String> {
    let [rows, columns] = sides(matrix)?;
    let floats = matrix.as_floats()?;
    let turned =
        (0..columns).flat_map(|column| (0..rows).map(move |row| floats[row * columns + column]));
    Ok(Tensor::floats([columns, rows], turned.collect()))
}

fn sides(matrix: &Tensor) -> Result<[usize; 2], String> {
    let shape = &matrix.shape;
    shape[..].try_into().map_err(|_| format!("expected a matrix, found {shape:?}"))
}

/// `alpha A B + beta C`; A and B may be transposed.
pub(super) fn gemm(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let turn = |at: usize, name: &str| {
        let matrix = given.input(at)?;
        let is_turned = given.attributes.integer(name, 0) != 0;
        if is_turned {
            transposed(matrix).map(std::borrow::Cow::Owned)
        } else {
            Ok(std::borrow::Cow::Borrowed(matrix))
        }
    };
    let (first, second) = (turn(0, "transA")?, turn(1, "transB")?);
    let ([rows, inner], [height, columns]) = (sides(&first)?, sides(&second)?);
    if inner != height {
        return Err(format!("{:?} times {:?} don't fit", first.shape, second.shape));
    }
    let (alpha, beta) = (given.attributes.float("alpha", 1.0), given.attributes.float("beta", 1.0));
    let mut out = match given.optional(2) {
        Some(bias) => stretch(bias.as_floats()?, &bias.shape, &[rows, columns])?.into_owned(),
        None => vec![0.0; rows * columns],
    };
    if beta != 1.0 {
        for it in &mut out {
            *it *= beta;
        }
    }
    let scaled: Vec<f32> = first.as_floats()?.iter().map(|it| alpha * it).collect();
    add_product(&mut out, &scaled, second.as_floats()?, inner, columns);
    Ok(Tensor::floats([rows, columns], out))
}

/// A product with a matrix, of an array whose last axis is as long as the matrix is high.
pub(super) fn matmul(given: &NodeInputs<'_>) -> Result<Tensor, String> {
    let (first, second) = (given.input(0)?, given.input(1)?);
    let [height, columns] = sides(second)?;
    let Some((&inner, lead)) = first.shape.split_last().filter(|(inner, _)| **inner == height)
    else {
        return Err(format!("{:?} times {:?} don't fit", first.shape, second.shape));
    };
    let rows: usize = lead.iter().product();
    let mut out = vec![0.0; rows * columns];
    add_product(&mut out, first.as_floats()?, second.as_floats()?, inner, columns);
    Ok(Tensor::floats([lead, &[columns]].concat(), out))
}
