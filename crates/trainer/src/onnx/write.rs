//! A policy as an ONNX model: the formula of [`crate::network`], node by node.
//!
//! Only operators that every runtime has had for years; no shape is asked for at run time.

use tract_onnx::pb::{ModelProto, OperatorSetIdProto};
use voltour_solver::policy::{FEATURE_VERSION, FEATURES, IN_TOUR, REWARD};

use super::Model;
use super::encode::{Size, entry, integer, list, value};
use super::graph::Graph;

const IR_VERSION: i64 = 8;
const OPSET: i64 = 17;

pub fn model(model: &Model) -> ModelProto {
    let shape = serde_json::to_string(model.weights.shape()).unwrap_or_default();
    let metadata = &model.metadata;
    ModelProto {
        ir_version: IR_VERSION,
        opset_import: vec![OperatorSetIdProto { domain: String::new(), version: OPSET }],
        producer_name: env!("CARGO_PKG_NAME").to_owned(),
        producer_version: env!("CARGO_PKG_VERSION").to_owned(),
        graph: Some(graph(model).proto),
        metadata_props: vec![
            entry("voltour.feature_version", FEATURE_VERSION),
            entry("voltour.problem", &metadata.problem),
            entry("voltour.network", shape),
            entry("voltour.training", &metadata.training),
            entry("voltour.evaluation", &metadata.evaluation),
        ],
        ..ModelProto::default()
    }
}

fn graph(model: &Model) -> Graph {
    use Size::{Fixed, Symbol};
    let mut g = Graph::default();
    g.proto.name = "q".to_owned();
    g.proto.input = vec![
        value("nodes", &[Symbol("B"), Symbol("N"), Fixed(FEATURES)]),
        value("edges", &[Symbol("B"), Symbol("N"), Symbol("N")]),
        value("mask", &[Symbol("B"), Symbol("N")]),
    ];
    g.proto.output = vec![value("q", &[Symbol("B"), Symbol("N")])];
    let weights = &model.weights;
    for (i, part) in weights.parts().iter().enumerate() {
        g.floats(&part.name, &[part.rows, part.columns], weights.part(i));
    }
    g.integers("axis.1", &[1]);
    g.integers("axis.2", &[2]);
    let columns = g.op("Unsqueeze", &["mask", "axis.1"]);
    let kernels = kernels(&mut g, &weights.shape().kernels, &columns);
    let h = embedding(&mut g, weights.shape().rounds, &kernels);
    let state = state(&mut g, &h, &columns, weights.shape().width);
    let own = g.op("MatMul", &[&h, "head.node"]);
    let head = g.op("Add", &[&own, &state]);
    let head = g.op("Relu", &[&head]);
    let after = g.op("MatMul", &[&head, "output.weight"]);
    let after = g.op("Add", &[&after, "output.bias"]);
    let reward = feature(&mut g, "reward", REWARD);
    let q = g.op("Add", &[&after, &reward]);
    let q = g.op("Squeeze", &[&q, "axis.2"]);
    g.op("Mul", &[&q, "mask"]);
    g.finish("q");
    g
}

/// The names of the normalised kernels, `[B, N, N]` each.
fn kernels(g: &mut Graph, scales: &[f32], columns: &str) -> Vec<String> {
    g.floats("tiny", &[], &[1e-30]);
    let mut names = Vec::new();
    for (k, scale) in scales.iter().enumerate() {
        let factor = g.floats(&format!("kernel{k}.factor"), &[], &[-1.0 / scale]);
        let exponent = g.op("Mul", &["edges", &factor]);
        let kernel = g.op("Exp", &[&exponent]);
        let kernel = g.op("Mul", &[&kernel, columns]);
        let sum = g.sum(&kernel, "axis.2");
        let sum = g.op("Max", &[&sum, "tiny"]);
        names.push(g.op("Div", &[&kernel, &sum]));
    }
    names
}

/// `h [B, N, p]` after all rounds.
fn embedding(g: &mut Graph, rounds: usize, kernels: &[String]) -> String {
    let x = g.op("MatMul", &["nodes", "input.weight"]);
    let x = g.op("Add", &[&x, "input.bias"]);
    let mut h = g.op("Relu", &[&x]);
    for _ in 0..rounds {
        let own = g.op("MatMul", &[&h, "message.own"]);
        let mut z = g.op("Add", &[&x, &own]);
        for (k, kernel) in kernels.iter().enumerate() {
            let message = g.op("MatMul", &[&h, &format!("message.kernel{k}")]);
            let message = g.op("MatMul", &[kernel, &message]);
            z = g.op("Add", &[&z, &message]);
        }
        h = g.op("Relu", &[&z]);
    }
    h
}

/// What the head knows of the whole state, `[B, 1, p]`.
fn state(g: &mut Graph, h: &str, columns: &str, width: usize) -> String {
    g.floats("one", &[], &[1.0]);
    let tour = feature(g, "tour", IN_TOUR);
    let tour = g.node("Transpose", &[&tour], vec![list("perm", &[0, 2, 1])]);
    let tour = g.op("Mul", &[&tour, columns]);
    let mut mean = |members: &str| {
        let count = g.sum(members, "axis.2");
        let count = g.op("Max", &[&count, "one"]);
        g.op("Div", &[members, &count])
    };
    let (all, tour) = (mean(columns), mean(&tour));
    let pool = g.node("Concat", &[&all, &tour], vec![integer("axis", 1)]);
    let means = g.op("MatMul", &[&pool, h]);
    g.integers("state.shape", &[0, 1, 2 * width as i64]);
    let means = g.op("Reshape", &[&means, "state.shape"]);
    let state = g.op("MatMul", &[&means, "head.state"]);
    g.op("Add", &[&state, "head.bias"])
}

/// One column of the features, `[B, N, 1]`.
fn feature(g: &mut Graph, name: &str, column: usize) -> String {
    let from = g.integers(&format!("{name}.from"), &[column as i64]);
    let to = g.integers(&format!("{name}.to"), &[column as i64 + 1]);
    g.op("Slice", &["nodes", &from, &to, "axis.2"])
}
