//! What a node of a network is given.

use super::message::AttributeMessage;
use super::tensor::Tensor;
use std::collections::BTreeMap;

/// What a node is given.
pub(in crate::onnx) struct NodeInputs<'a> {
    /// Its inputs; none where one is left out.
    pub(in crate::onnx) inputs: Vec<Option<&'a Tensor>>,
    /// Its constants.
    pub(in crate::onnx) attributes: &'a Attributes,
}

/// The constants of a node, by name.
#[derive(Clone, Debug, Default)]
pub(in crate::onnx) struct Attributes(pub(in crate::onnx) BTreeMap<String, AttributeMessage>);

impl<'a> NodeInputs<'a> {
    /// An input that has to be there.
    pub(in crate::onnx) fn input(&self, at: usize) -> Result<&'a Tensor, String> {
        self.optional(at).ok_or_else(|| format!("it lacks its input {at}"))
    }

    /// An input, if it isn't left out.
    pub(in crate::onnx) fn optional(&self, at: usize) -> Option<&'a Tensor> {
        self.inputs.get(at).copied().flatten()
    }

    /// The whole numbers of an input, if it isn't left out.
    pub(in crate::onnx) fn integers(&self, at: usize) -> Result<Option<&'a [i64]>, String> {
        self.optional(at).map(Tensor::as_integers).transpose()
    }
}

impl Attributes {
    pub(in crate::onnx) fn integer(&self, name: &str, default: i64) -> i64 {
        self.0.get(name).map_or(default, |it| it.integer)
    }

    pub(in crate::onnx) fn float(&self, name: &str, default: f32) -> f32 {
        self.0.get(name).map_or(default, |it| it.float)
    }

    pub(in crate::onnx) fn integers(&self, name: &str) -> Option<&[i64]> {
        self.0.get(name).map(|it| it.integers.as_slice())
    }

    pub(in crate::onnx) fn text(&self, name: &str) -> &str {
        self.0.get(name).and_then(|it| std::str::from_utf8(&it.text).ok()).unwrap_or_default()
    }
}
