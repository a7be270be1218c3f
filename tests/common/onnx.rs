//! Models for tests: the smallest ONNX graph that keeps the contract, and ways to break it.
//!
//! `q = factor * mask * (h + edges h / 20)` with `h = nodes w`: it depends on every input, and rows of padding change
//! nothing.
#![allow(dead_code, reason = "not every test that includes it uses all of it")]

use prost::Message;
use tract_onnx::pb::tensor_proto::DataType;
use tract_onnx::pb::tensor_shape_proto::{Dimension, dimension::Value};
use tract_onnx::pb::{
    GraphProto, ModelProto, NodeProto, OperatorSetIdProto, StringStringEntryProto, TensorProto,
    TensorShapeProto, TypeProto, ValueInfoProto, type_proto,
};
use voltour_solver::policy::{FEATURE_VERSION, FEATURES};

/// What a test says of its model.
pub struct Onnx {
    /// `voltour.problem`.
    pub problem: &'static str,
    /// `voltour.feature_version`.
    pub version: String,
    /// Features that `nodes` has.
    pub features: usize,
    /// What every value is multiplied by.
    pub factor: f32,
}

impl Onnx {
    /// A model that keeps the contract.
    pub fn of(problem: &'static str) -> Self {
        Self { problem, version: FEATURE_VERSION.to_string(), features: FEATURES, factor: 1.0 }
    }

    /// The bytes of its file.
    pub fn bytes(&self) -> Vec<u8> {
        self.model().encode_to_vec()
    }

    /// The model, to be broken in another way.
    pub fn model(&self) -> ModelProto {
        let entry = |key: &str, value: &str| StringStringEntryProto {
            key: format!("voltour.{key}"),
            value: value.to_owned(),
        };
        ModelProto {
            ir_version: 8,
            opset_import: vec![OperatorSetIdProto { domain: String::new(), version: 17 }],
            graph: Some(self.graph()),
            metadata_props: vec![
                entry("feature_version", &self.version),
                entry("problem", self.problem),
                entry("training", r#"{"steps": 0}"#),
                entry("evaluation", r#"{"gap": null}"#),
            ],
            ..ModelProto::default()
        }
    }

    fn graph(&self) -> GraphProto {
        let weights: Vec<f32> = (0..self.features).map(|i| 1.0 / (1.0 + i as f32)).collect();
        let axis = TensorProto {
            name: "axis".to_owned(),
            dims: vec![1],
            data_type: DataType::Int64 as i32,
            int64_data: vec![2],
            ..TensorProto::default()
        };
        let features = i64::try_from(self.features).unwrap();
        GraphProto {
            name: "policy".to_owned(),
            node: vec![
                node("MatMul", ["nodes", "w"], "h"),
                node("MatMul", ["edges", "h"], "m"),
                node("Mul", ["m", "share"], "n"),
                node("Add", ["h", "n"], "s"),
                node("Squeeze", ["s", "axis"], "r"),
                node("Mul", ["r", "mask"], "v"),
                node("Mul", ["v", "factor"], "q"),
            ],
            initializer: vec![
                floats("w", &[features, 1], &weights),
                floats("share", &[1], &[0.05]),
                floats("factor", &[1], &[self.factor]),
                axis,
            ],
            input: vec![
                value("nodes", &[None, None, Some(features)]),
                value("edges", &[None, None, None]),
                value("mask", &[None, None]),
            ],
            output: vec![value("q", &[None, None])],
            ..GraphProto::default()
        }
    }
}

/// A tensor of float32 with these sizes; the first open one is B, the others are N.
pub fn value(name: &str, sizes: &[Option<i64>]) -> ValueInfoProto {
    let dimension = |(i, size): (usize, &Option<i64>)| {
        let symbol = || Value::DimParam(if i == 0 { "B" } else { "N" }.to_owned());
        Dimension { value: Some(size.map_or_else(symbol, Value::DimValue)), ..Dimension::default() }
    };
    let shape = TensorShapeProto { dim: sizes.iter().enumerate().map(dimension).collect() };
    let tensor = type_proto::Tensor { elem_type: DataType::Float as i32, shape: Some(shape) };
    let kind = Some(type_proto::Value::TensorType(tensor));
    let r#type = Some(TypeProto { value: kind, ..TypeProto::default() });
    ValueInfoProto { name: name.to_owned(), r#type, ..ValueInfoProto::default() }
}

fn node(operator: &str, inputs: [&str; 2], output: &str) -> NodeProto {
    NodeProto {
        name: output.to_owned(),
        op_type: operator.to_owned(),
        input: inputs.map(str::to_owned).to_vec(),
        output: vec![output.to_owned()],
        ..NodeProto::default()
    }
}

fn floats(name: &str, dims: &[i64], values: &[f32]) -> TensorProto {
    TensorProto {
        name: name.to_owned(),
        dims: dims.to_vec(),
        data_type: DataType::Float as i32,
        float_data: values.to_vec(),
        ..TensorProto::default()
    }
}
