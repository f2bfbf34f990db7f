//! Prepares a graph: names become slots, and what doesn't depend on the inputs is computed once.

use super::message::{GraphMessage, NodeMessage};
use super::node::Attributes;
use super::operators::{Operator, operator, turned};
use super::tensor::Tensor;
use super::{Network, NetworkFault, NetworkInput, type_of};
use std::collections::BTreeMap;

/// An operator with the slots of what it takes and computes.
#[derive(Clone)]
pub(super) struct NetworkNode {
    /// The node's name, else that of its output.
    pub(super) name: String,
    /// The name of the operator.
    pub(super) kind: String,
    pub(super) operator: Operator,
    pub(super) attributes: Attributes,
    /// None where an input is left out.
    pub(super) inputs: Vec<Option<usize>>,
    pub(super) output: usize,
}

impl std::fmt::Debug for NetworkNode {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {:?} -> {}", self.kind, self.inputs, self.output)
    }
}

/// The slots of values, by name.
#[derive(Default)]
struct Slots<'a> {
    known: BTreeMap<&'a str, usize>,
    constants: Vec<Option<Tensor>>,
}

impl<'a> Slots<'a> {
    fn add(&mut self, name: &'a str, constant: Option<Tensor>) -> usize {
        let slot = self.constants.len();
        self.constants.push(constant);
        self.known.insert(name, slot);
        slot
    }

    fn find(&self, name: &str) -> Result<usize, NetworkFault> {
        let unknown =
            || NetworkFault::Value { name: name.to_owned(), why: "nothing computes it".to_owned() };
        self.known.get(name).copied().ok_or_else(unknown)
    }

    fn is_constant(&self, slot: usize) -> bool {
        self.constants.get(slot).is_some_and(Option::is_some)
    }
}

/// Makes a network of a graph.
pub(super) fn prepare(
    graph: &GraphMessage,
    metadata: BTreeMap<String, String>,
) -> Result<Network, NetworkFault> {
    let wrong =
        |name: &str, why: &str| NetworkFault::Value { name: name.to_owned(), why: why.to_owned() };
    let mut slots = Slots::default();
    for message in &graph.initializers {
        let tensor = Tensor::read(message).map_err(|why| wrong(&message.name, &why))?;
        slots.add(&message.name, Some(tensor));
    }
    let mut inputs = Vec::new();
    for message in &graph.inputs {
        // Old files list constants among the inputs too.
        if slots.known.contains_key(message.name.as_str()) {
            continue;
        }
        let (element, shape) =
            type_of(message).ok_or_else(|| wrong(&message.name, "it is no array of numbers"))?;
        let slot = slots.add(&message.name, None);
        inputs.push(NetworkInput { name: message.name.clone(), element, shape, slot });
    }
    let mut nodes = Vec::new();
    for message in &graph.nodes {
        let node = node(message, &mut slots)?;
        let is_fixed = node.inputs.iter().flatten().all(|&slot| slots.is_constant(slot));
        if is_fixed {
            let computed = node.compute(&[], &slots.constants)?;
            slots.constants[node.output] = Some(computed);
        } else {
            nodes.push(node);
        }
    }
    let first = graph.outputs.first().ok_or(NetworkFault::NotOnnx)?;
    let output = slots.find(&first.name)?;
    let output_shape = type_of(first).map(|(_, shape)| shape).unwrap_or_default();
    Ok(Network { inputs, output_shape, metadata, nodes, constants: slots.constants, output })
}

fn node<'a>(message: &'a NodeMessage, slots: &mut Slots<'a>) -> Result<NetworkNode, NetworkFault> {
    let first = message.outputs.first().map(String::as_str).unwrap_or_default();
    let name = if message.name.is_empty() { first } else { &message.name };
    let kind = &message.operator;
    let unknown = || NetworkFault::Operator { node: name.to_owned(), operator: kind.clone() };
    let is_standard = matches!(message.domain.as_str(), "" | "ai.onnx");
    let operator = operator(kind).filter(|_| is_standard).ok_or_else(unknown)?;
    let slot = |name: &String| if name.is_empty() { Ok(None) } else { slots.find(name).map(Some) };
    let inputs = message.inputs.iter().map(slot).collect::<Result<Vec<_>, _>>()?;
    let attributes = message.attributes.iter().map(|it| (it.name.clone(), it.clone())).collect();
    let output = slots.add(first, None);
    let mut node = NetworkNode {
        name: name.to_owned(),
        kind: kind.clone(),
        operator,
        attributes: Attributes(attributes),
        inputs,
        output,
    };
    turn_weights(&mut node, slots);
    Ok(node)
}

/// Transposes constant weights once instead of in every call.
fn turn_weights(node: &mut NetworkNode, slots: &mut Slots<'_>) {
    if node.kind != "Gemm" || node.attributes.0.get("transB").is_none_or(|it| it.integer == 0) {
        return;
    }
    let Some(Some(weights)) = node.inputs.get(1).copied() else { return };
    let Some(Ok(weights)) = slots.constants.get(weights).and_then(Option::as_ref).map(turned)
    else {
        return;
    };
    node.attributes.0.remove("transB");
    node.inputs[1] = Some(slots.constants.len());
    slots.constants.push(Some(weights));
}
