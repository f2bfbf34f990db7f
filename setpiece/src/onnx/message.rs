//! The parts of an ONNX file that a network needs, with the field numbers of the format.

/// A file: a graph, the version of its operators, and what its author says of it.
#[derive(Clone, PartialEq, prost::Message)]
pub(crate) struct ModelMessage {
    #[prost(int64, tag = "1")]
    pub(crate) ir_version: i64,
    #[prost(message, optional, tag = "7")]
    pub(crate) graph: Option<GraphMessage>,
    #[prost(message, repeated, tag = "8")]
    pub(crate) opsets: Vec<OpsetMessage>,
    #[prost(message, repeated, tag = "14")]
    pub(crate) metadata: Vec<EntryMessage>,
}

/// A set of operators and its version; the standard one has an empty name.
#[derive(Clone, PartialEq, prost::Message)]
pub(crate) struct OpsetMessage {
    #[prost(string, tag = "1")]
    pub(crate) domain: String,
    #[prost(int64, tag = "2")]
    pub(crate) version: i64,
}

/// A line of the metadata.
#[derive(Clone, PartialEq, prost::Message)]
pub(crate) struct EntryMessage {
    #[prost(string, tag = "1")]
    pub(crate) key: String,
    #[prost(string, tag = "2")]
    pub(crate) value: String,
}

/// Nodes in the order in which they are computed, and the constants that they use.
#[derive(Clone, PartialEq, prost::Message)]
pub(crate) struct GraphMessage {
    #[prost(message, repeated, tag = "1")]
    pub(crate) nodes: Vec<NodeMessage>,
    #[prost(message, repeated, tag = "5")]
    pub(crate) initializers: Vec<TensorMessage>,
    #[prost(message, repeated, tag = "11")]
    pub(crate) inputs: Vec<ValueMessage>,
    #[prost(message, repeated, tag = "12")]
    pub(crate) outputs: Vec<ValueMessage>,
}

/// An operator with the names of what it takes and computes. An empty name: left out.
#[derive(Clone, PartialEq, prost::Message)]
pub(crate) struct NodeMessage {
    #[prost(string, repeated, tag = "1")]
    pub(crate) inputs: Vec<String>,
    #[prost(string, repeated, tag = "2")]
    pub(crate) outputs: Vec<String>,
    #[prost(string, tag = "3")]
    pub(crate) name: String,
    #[prost(string, tag = "4")]
    pub(crate) operator: String,
    #[prost(message, repeated, tag = "5")]
    pub(crate) attributes: Vec<AttributeMessage>,
    #[prost(string, tag = "7")]
    pub(crate) domain: String,
}

/// A constant of a node.
#[derive(Clone, PartialEq, prost::Message)]
pub(crate) struct AttributeMessage {
    #[prost(string, tag = "1")]
    pub(crate) name: String,
    #[prost(float, tag = "2")]
    pub(crate) float: f32,
    #[prost(int64, tag = "3")]
    pub(crate) integer: i64,
    #[prost(bytes = "vec", tag = "4")]
    pub(crate) text: Vec<u8>,
    #[prost(message, optional, tag = "5")]
    pub(crate) tensor: Option<TensorMessage>,
    #[prost(float, repeated, tag = "7")]
    pub(crate) floats: Vec<f32>,
    #[prost(int64, repeated, tag = "8")]
    pub(crate) integers: Vec<i64>,
}

/// A constant array. Its numbers stand in `raw`, else in the list of their type.
#[derive(Clone, PartialEq, prost::Message)]
pub(crate) struct TensorMessage {
    #[prost(int64, repeated, tag = "1")]
    pub(crate) shape: Vec<i64>,
    #[prost(int32, tag = "2")]
    pub(crate) element: i32,
    #[prost(float, repeated, tag = "4")]
    pub(crate) floats: Vec<f32>,
    #[prost(int32, repeated, tag = "5")]
    pub(crate) words: Vec<i32>,
    #[prost(int64, repeated, tag = "7")]
    pub(crate) integers: Vec<i64>,
    #[prost(string, tag = "8")]
    pub(crate) name: String,
    #[prost(bytes = "vec", tag = "9")]
    pub(crate) raw: Vec<u8>,
    #[prost(double, repeated, tag = "10")]
    pub(crate) doubles: Vec<f64>,
    /// Not 0: the numbers are in another file.
    #[prost(int32, tag = "14")]
    pub(crate) location: i32,
}

/// An input or output of a graph.
#[derive(Clone, PartialEq, prost::Message)]
pub(crate) struct ValueMessage {
    #[prost(string, tag = "1")]
    pub(crate) name: String,
    #[prost(message, optional, tag = "2")]
    pub(crate) kind: Option<TypeMessage>,
}

/// The type of a value; other types than arrays are left out.
#[derive(Clone, PartialEq, prost::Message)]
pub(crate) struct TypeMessage {
    #[prost(message, optional, tag = "1")]
    pub(crate) tensor: Option<TensorTypeMessage>,
}

/// The type of an array.
#[derive(Clone, PartialEq, prost::Message)]
pub(crate) struct TensorTypeMessage {
    #[prost(int32, tag = "1")]
    pub(crate) element: i32,
    #[prost(message, optional, tag = "2")]
    pub(crate) shape: Option<ShapeMessage>,
}

/// The lengths of an array's axes.
#[derive(Clone, PartialEq, prost::Message)]
pub(crate) struct ShapeMessage {
    #[prost(message, repeated, tag = "1")]
    pub(crate) axes: Vec<AxisMessage>,
}

/// The length of an axis; 0 where it is free.
#[derive(Clone, PartialEq, prost::Message)]
pub(crate) struct AxisMessage {
    #[prost(int64, tag = "1")]
    pub(crate) length: i64,
}
