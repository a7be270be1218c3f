//! [`Graph`]: a graph that grows node by node.

use tract_onnx::pb::{AttributeProto, GraphProto, NodeProto};

use super::encode;

/// A graph under construction. Values are called by their names.
#[derive(Default)]
pub struct Graph {
    pub proto: GraphProto,
}

impl Graph {
    /// Adds a node with one output and gives the name of it.
    pub fn node(&mut self, op: &str, inputs: &[&str], attributes: Vec<AttributeProto>) -> String {
        let name = format!("{}_{}", op.to_lowercase(), self.proto.node.len());
        self.proto.node.push(NodeProto {
            name: name.clone(),
            op_type: op.to_owned(),
            input: inputs.iter().map(|i| (*i).to_owned()).collect(),
            output: vec![name.clone()],
            attribute: attributes,
            ..NodeProto::default()
        });
        name
    }

    /// A node without attributes.
    pub fn op(&mut self, op: &str, inputs: &[&str]) -> String {
        self.node(op, inputs, Vec::new())
    }

    /// A constant of float32; one number has no dimensions.
    pub fn floats(&mut self, name: &str, dims: &[usize], values: &[f32]) -> String {
        self.proto.initializer.push(encode::floats(name, dims, values));
        name.to_owned()
    }

    /// A constant vector of integers.
    pub fn integers(&mut self, name: &str, values: &[i64]) -> String {
        self.proto.initializer.push(encode::integers(name, values));
        name.to_owned()
    }

    /// Sums over an axis, which stays with size 1.
    pub fn sum(&mut self, of: &str, axis: &str) -> String {
        self.node("ReduceSum", &[of, axis], vec![encode::integer("keepdims", 1)])
    }

    /// Renames the last node's output: the graph's own.
    pub fn finish(&mut self, name: &str) {
        if let Some(last) = self.proto.node.last_mut() {
            last.output = vec![name.to_owned()];
        }
    }
}
