use super::message::{
    AttributeMessage, AxisMessage, EntryMessage, GraphMessage, ModelMessage, NodeMessage,
    OpsetMessage, ShapeMessage, TensorMessage, TensorTypeMessage, TypeMessage, ValueMessage,
};
use super::*;

fn constant(name: &str, shape: &[i64], floats: &[f32]) -> TensorMessage {
    let (name, shape, floats) = (name.to_owned(), shape.to_vec(), floats.to_vec());
    TensorMessage { shape, element: 1, floats, name, ..TensorMessage::default() }
}

fn value(name: &str, element: i32, shape: &[i64]) -> ValueMessage {
    let axes = shape.iter().map(|&length| AxisMessage { length }).collect();
    let tensor = TensorTypeMessage { element, shape: Some(ShapeMessage { axes }) };
    ValueMessage { name: name.to_owned(), kind: Some(TypeMessage { tensor: Some(tensor) }) }
}

fn node(operator: &str, inputs: &[&str], output: &str) -> NodeMessage {
    NodeMessage {
        inputs: inputs.iter().map(|&name| name.to_owned()).collect(),
        outputs: vec![output.to_owned()],
        operator: operator.to_owned(),
        ..NodeMessage::default()
    }
}

fn with(mut node: NodeMessage, name: &str, attribute: AttributeMessage) -> NodeMessage {
    node.attributes.push(AttributeMessage { name: name.to_owned(), ..attribute });
    node
}

fn integer(integer: i64) -> AttributeMessage {
    AttributeMessage { integer, ..AttributeMessage::default() }
}

fn integers(integers: &[i64]) -> AttributeMessage {
    AttributeMessage { integers: integers.to_vec(), ..AttributeMessage::default() }
}

fn model(
    nodes: Vec<NodeMessage>,
    constants: Vec<TensorMessage>,
    inputs: Vec<ValueMessage>,
) -> ModelMessage {
    let outputs = vec![value("out", 1, &[])];
    let graph = GraphMessage { nodes, initializers: constants, inputs, outputs };
    let opsets = vec![OpsetMessage { domain: String::new(), version: 17 }];
    let metadata = vec![EntryMessage { key: "repeat".to_owned(), value: "4".to_owned() }];
    ModelMessage { ir_version: 9, graph: Some(graph), opsets, metadata }
}

/// Two layers with a mask, as `baselines/ppo.py` writes them.
fn two_layers() -> ModelMessage {
    let turned = |node| with(node, "transB", integer(1));
    model(
        vec![
            node("Sub", &["seen", "mean"], "centred"),
            turned(node("Gemm", &["centred", "first", "bias"], "inner")),
            node("Tanh", &["inner"], "squashed"),
            turned(node("Gemm", &["squashed", "second"], "rated")),
            node("Not", &["mask"], "closed"),
            node("Where", &["closed", "never", "rated"], "masked"),
            node("LogSoftmax", &["masked"], "out"),
        ],
        vec![
            constant("mean", &[2], &[1.0, -1.0]),
            constant("first", &[3, 2], &[1.0, 0.0, 0.0, 1.0, 1.0, 1.0]),
            constant("bias", &[3], &[0.0, 0.5, 0.0]),
            constant("second", &[2, 3], &[1.0, 0.0, 0.0, 0.0, 1.0, 1.0]),
            constant("never", &[], &[-1e9]),
        ],
        vec![value("seen", 1, &[0, 2]), value("mask", 9, &[0, 2])],
    )
}

fn computed(model: &ModelMessage, given: Vec<Tensor>) -> Tensor {
    Network::from_bytes(&model.encode_to_vec()).unwrap().run(given).unwrap()
}

fn floats(tensor: &Tensor) -> &[f32] {
    tensor.as_floats().unwrap()
}

#[test]
fn two_layers_are_computed_for_every_row() {
    let seen = Tensor::floats([2, 2], vec![1.0, -1.0, 2.0, 0.0]);
    let mask = Tensor::integers([2, 2], vec![1, 1, 1, 0]);
    let out = computed(&two_layers(), vec![seen, mask]);
    assert_eq!(out.shape, [2, 2]);
    // The first row sees nothing: only the bias is left, tanh(0.5).
    let odds = 1.0 + libm::expf(libm::tanhf(0.5));
    let expected = [1.0 / odds, 1.0 - 1.0 / odds];
    for (found, expected) in floats(&out)[..2].iter().zip(expected) {
        assert!((libm::expf(*found) - expected).abs() < 1e-6, "{out:?}");
    }
    // In the second one action is left.
    assert_eq!(floats(&out)[2], 0.0);
    assert!(floats(&out)[3] < -1e8);
}

#[test]
fn a_network_says_what_it_takes() {
    let network = Network::from_bytes(&two_layers().encode_to_vec()).unwrap();
    let said: Vec<_> = network
        .inputs()
        .iter()
        .map(|it| (it.name.as_str(), it.element, it.shape.clone()))
        .collect();
    assert_eq!(
        said,
        [
            ("seen", ElementType::Float, vec![None, Some(2)]),
            ("mask", ElementType::Bool, vec![None, Some(2)])
        ]
    );
    assert_eq!((network.metadata("repeat"), network.metadata("author")), (Some("4"), None));
}

/// A filter that adds up 2 × 2 pixels, over pictures with the channels behind.
#[test]
fn pictures_are_turned_and_filtered() {
    let nodes = vec![
        with(node("Transpose", &["seen"], "turned"), "perm", integers(&[0, 3, 1, 2])),
        with(node("Cast", &["turned"], "cast"), "to", integer(1)),
        with(node("Conv", &["cast", "filter", "bias"], "filtered"), "strides", integers(&[1, 2])),
        node("Relu", &["filtered"], "positive"),
        node("Flatten", &["positive"], "out"),
    ];
    let filter = constant("filter", &[2, 1, 2, 2], &[1.0, 1.0, 1.0, 1.0, -1.0, -1.0, -1.0, -1.0]);
    let constants = vec![filter, constant("bias", &[2], &[0.5, 11.0])];
    let model = model(nodes, constants, vec![value("seen", 2, &[0, 3, 4, 1])]);
    let seen = Tensor::integers([1, 3, 4, 1], (0..12).collect());
    let out = computed(&model, vec![seen]);
    assert_eq!(out.shape, [1, 8]);
    assert_eq!(floats(&out), [10.5, 18.5, 26.5, 34.5, 1.0, 0.0, 0.0, 0.0]);
}

#[test]
fn a_filter_sees_nothing_beyond_the_edges() {
    let conv = with(node("Conv", &["seen", "filter"], "out"), "pads", integers(&[1, 1, 1, 1]));
    let filter = constant("filter", &[1, 1, 3, 3], &[1.0; 9]);
    let model = model(vec![conv], vec![filter], vec![value("seen", 1, &[0, 1, 2, 2])]);
    let seen = Tensor::floats([1, 1, 2, 2], vec![1.0, 2.0, 3.0, 4.0]);
    assert_eq!(floats(&computed(&model, vec![seen])), [10.0; 4]);
}

#[test]
fn shapes_are_computed_with() {
    let list = |name: &str, list: &[i64]| {
        let (name, shape) = (name.to_owned(), vec![list.len() as i64]);
        TensorMessage {
            name,
            shape,
            element: 7,
            integers: list.to_vec(),
            ..TensorMessage::default()
        }
    };
    let nodes = vec![
        node("Shape", &["seen"], "shape"),
        node("Slice", &["shape", "zero", "one"], "batch"),
        with(node("Concat", &["batch", "rest"], "wanted"), "axis", integer(0)),
        node("Reshape", &["seen", "wanted"], "flat"),
        with(node("Gather", &["flat", "places"], "picked"), "axis", integer(1)),
        node("ReduceSum", &["picked", "one"], "out"),
    ];
    let constants =
        vec![list("zero", &[0]), list("one", &[1]), list("rest", &[-1]), list("places", &[3, -4])];
    let model = model(nodes, constants, vec![value("seen", 1, &[0, 2, 2])]);
    let seen = Tensor::floats([2, 2, 2], (0..8).map(|it| it as f32).collect());
    let out = computed(&model, vec![seen]);
    assert_eq!((out.shape.as_slice(), floats(&out)), (&[2, 1][..], &[3.0, 11.0][..]));
}

#[test]
fn what_cannot_be_computed_is_named() {
    let read = |model: &ModelMessage| Network::from_bytes(&model.encode_to_vec());
    let alone = |operator| {
        let mut node = node(operator, &["seen"], "out");
        node.name = "last".to_owned();
        model(vec![node], Vec::new(), vec![value("seen", 1, &[0, 2])])
    };
    let fault = read(&alone("LSTM")).unwrap_err();
    assert_eq!(
        fault.to_string(),
        "its node `last` needs the operator `LSTM`, which isn't supported"
    );
    let mut old = two_layers();
    old.opsets[0].version = 9;
    assert_eq!(read(&old).unwrap_err(), NetworkFault::Opset(9));
    let loose = model(vec![node("Relu", &["gone"], "out")], Vec::new(), Vec::new());
    let fault = read(&loose).unwrap_err();
    assert_eq!(fault.to_string(), "its `gone` can't be used: nothing computes it");
    let network = read(&alone("MatMul")).unwrap();
    let fault = network.run(vec![Tensor::floats([1, 2], vec![0.0; 2])]).unwrap_err();
    assert_eq!(
        fault.to_string(),
        "its node `last` (MatMul) can't be computed: it lacks its input 1"
    );
    let mut short = two_layers();
    short.graph.as_mut().unwrap().initializers[2] = constant("bias", &[2], &[0.0, 0.5]);
    let given = vec![Tensor::floats([1, 2], vec![0.0; 2]), Tensor::integers([1, 2], vec![1, 1])];
    let fault = read(&short).unwrap().run(given).unwrap_err();
    assert_eq!(
        fault.to_string(),
        "its node `inner` (Gemm) can't be computed: [2] doesn't fit [1, 3]"
    );
    let mut vast = two_layers();
    vast.graph.as_mut().unwrap().initializers[0].shape = vec![1 << 40, 1 << 40];
    assert!(matches!(read(&vast).unwrap_err(), NetworkFault::Value { .. }));
}

/// No file makes it panic: every beginning of one, and many with a wrong byte.
#[test]
fn damaged_files_are_refused_or_computed() {
    let whole = two_layers().encode_to_vec();
    let try_out = |bytes: &[u8]| {
        let Ok(network) = Network::from_bytes(bytes) else { return };
        let seen = Tensor::floats([1, 2], vec![0.0; 2]);
        let _ = network.run(vec![seen, Tensor::integers([1, 2], vec![1, 1])]);
    };
    for length in 0..whole.len() {
        try_out(&whole[..length]);
    }
    for at in 0..whole.len() {
        for change in [0x01, 0x02, 0x08, 0x40, 0x80, 0xff] {
            let mut damaged = whole.clone();
            damaged[at] ^= change;
            try_out(&damaged);
        }
    }
    assert_eq!(Network::from_bytes(b"scenario").unwrap_err(), NetworkFault::NotOnnx);
    assert_eq!(Network::from_bytes(b"").unwrap_err(), NetworkFault::NotOnnx);
}
