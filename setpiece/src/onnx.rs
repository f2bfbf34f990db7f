//! Networks from ONNX files: reads one and computes its first output.
//!
//! It knows the operators of policies: layers, filters over maps, activations, masks. Runtimes for
//! any network are the greater part of a build (tract has 45 crates more and takes minutes), run
//! on threads of their own, and compute other bits on another processor. Here a policy plays the
//! same episode on every machine.

mod graph;
mod message;
mod node;
mod operators;
mod tensor;

pub use tensor::ElementType;
pub(crate) use tensor::{Numbers, Tensor};

use graph::{NetworkNode, prepare};
use message::{ModelMessage, ValueMessage};
use node::NodeInputs;
use prost::Message;
use std::collections::BTreeMap;

/// The oldest version of the operators that is read: later ones differ only in what they add.
const OPSET_MIN: i64 = 13;

/// A network that can be computed.
#[derive(Clone, Debug)]
pub struct Network {
    inputs: Vec<NetworkInput>,
    /// The shape of the first output as the file says it; empty if it doesn't.
    output_shape: Vec<Option<usize>>,
    metadata: BTreeMap<String, String>,
    nodes: Vec<NetworkNode>,
    /// The values that don't depend on the inputs, by their slots.
    constants: Vec<Option<Tensor>>,
    /// The slot of the first output.
    output: usize,
}

/// An input of a network.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NetworkInput {
    /// Its name.
    pub name: String,
    /// What its numbers are.
    pub element: ElementType,
    /// The lengths of its axes; none where one is free.
    pub shape: Vec<Option<usize>>,
    slot: usize,
}

/// Why a network can't be read or computed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NetworkFault {
    /// The bytes aren't those of an ONNX model.
    #[error("it is no ONNX model")]
    NotOnnx,
    /// Its operators are older than those that are known.
    #[error("it has the operators of version {0}; expected {OPSET_MIN} or later")]
    Opset(i64),
    /// It needs an operator that isn't known.
    #[error("its node `{node}` needs the operator `{operator}`, which isn't supported")]
    Operator {
        /// The node's name, else that of its output.
        node: String,
        /// The operator.
        operator: String,
    },
    /// A constant, an input or an output can't be used.
    #[error("its `{name}` can't be used: {why}")]
    Value {
        /// The name.
        name: String,
        /// A clause.
        why: String,
    },
    /// A node can't be computed.
    #[error("its node `{node}` ({operator}) can't be computed: {why}")]
    Node {
        /// The node's name, else that of its output.
        node: String,
        /// The operator.
        operator: String,
        /// A clause.
        why: String,
    },
}

impl Network {
    /// Reads an ONNX file.
    ///
    /// # Errors
    /// [`NetworkFault`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Network, NetworkFault> {
        let model = ModelMessage::decode(bytes).map_err(|_| NetworkFault::NotOnnx)?;
        let graph = model.graph.filter(|graph| !graph.outputs.is_empty());
        let graph = graph.ok_or(NetworkFault::NotOnnx)?;
        let version = |domain: &str| matches!(domain, "" | "ai.onnx");
        let opset =
            model.opsets.iter().find(|set| version(&set.domain)).map_or(1, |set| set.version);
        if opset < OPSET_MIN {
            return Err(NetworkFault::Opset(opset));
        }
        let metadata = model.metadata.into_iter().map(|entry| (entry.key, entry.value)).collect();
        prepare(&graph, metadata)
    }

    /// Its inputs.
    pub fn inputs(&self) -> &[NetworkInput] {
        &self.inputs
    }

    /// The shape of its first output as the file says it; empty if it doesn't.
    pub fn output_shape(&self) -> &[Option<usize>] {
        &self.output_shape
    }

    /// What its author says of it.
    pub fn metadata(&self, key: &str) -> Option<&str> {
        self.metadata.get(key).map(String::as_str)
    }

    /// Computes the first output from an array for each input.
    pub(crate) fn run(&self, given: Vec<Tensor>) -> Result<Tensor, NetworkFault> {
        let mut values: Vec<Option<Tensor>> = vec![None; self.constants.len()];
        for (input, tensor) in self.inputs.iter().zip(given) {
            if let Some(value) = values.get_mut(input.slot) {
                *value = Some(tensor);
            }
        }
        for node in &self.nodes {
            let computed = node.compute(&values, &self.constants)?;
            if let Some(value) = values.get_mut(node.output) {
                *value = Some(computed);
            }
        }
        let found = values.get_mut(self.output).and_then(Option::take);
        let constant = || self.constants.get(self.output).cloned().flatten();
        found.or_else(constant).ok_or(NetworkFault::NotOnnx)
    }
}

impl NetworkNode {
    /// Computes the output from the values so far.
    fn compute(
        &self,
        values: &[Option<Tensor>],
        constants: &[Option<Tensor>],
    ) -> Result<Tensor, NetworkFault> {
        let value = |slot: usize| {
            let computed = values.get(slot).and_then(Option::as_ref);
            computed.or_else(|| constants.get(slot).and_then(Option::as_ref))
        };
        let inputs = self.inputs.iter().map(|slot| slot.and_then(value)).collect();
        (self.operator)(&NodeInputs { inputs, attributes: &self.attributes }).map_err(|why| {
            NetworkFault::Node { node: self.name.clone(), operator: self.kind.clone(), why }
        })
    }
}

/// The element type and the shape that a file gives an input or an output.
fn type_of(message: &ValueMessage) -> Option<(ElementType, Vec<Option<usize>>)> {
    let tensor = message.kind.as_ref()?.tensor.as_ref()?;
    let axes = tensor.shape.as_ref().map(|shape| shape.axes.as_slice()).unwrap_or_default();
    let length = |length: i64| usize::try_from(length).ok().filter(|&length| length > 0);
    Some((ElementType::of(tensor.element)?, axes.iter().map(|axis| length(axis.length)).collect()))
}

#[cfg(test)]
mod tests;
