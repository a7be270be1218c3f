//! The smallest pieces of an ONNX file.

use tract_onnx::pb::attribute_proto::AttributeType;
use tract_onnx::pb::tensor_proto::DataType;
use tract_onnx::pb::tensor_shape_proto::{Dimension, dimension};
use tract_onnx::pb::{
    AttributeProto, StringStringEntryProto, TensorProto, TensorShapeProto, TypeProto,
    ValueInfoProto, type_proto,
};

/// A size that is known, or a symbol.
pub enum Size {
    /// Known.
    Fixed(usize),
    /// Known when the model runs.
    Symbol(&'static str),
}

/// An input or output of float32.
pub fn value(name: &str, sizes: &[Size]) -> ValueInfoProto {
    let dimension = |size: &Size| {
        let value = match size {
            Size::Fixed(size) => dimension::Value::DimValue(*size as i64),
            Size::Symbol(name) => dimension::Value::DimParam((*name).to_owned()),
        };
        Dimension { value: Some(value), ..Dimension::default() }
    };
    let shape = TensorShapeProto { dim: sizes.iter().map(dimension).collect() };
    let tensor = type_proto::Tensor { elem_type: DataType::Float as i32, shape: Some(shape) };
    let kind =
        TypeProto { value: Some(type_proto::Value::TensorType(tensor)), ..TypeProto::default() };
    ValueInfoProto { name: name.to_owned(), r#type: Some(kind), ..ValueInfoProto::default() }
}

/// A constant tensor of float32.
pub fn floats(name: &str, dims: &[usize], values: &[f32]) -> TensorProto {
    let raw_data = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    constant(name, dims, DataType::Float, raw_data)
}

/// A constant vector of integers: axes and sizes.
pub fn integers(name: &str, values: &[i64]) -> TensorProto {
    let raw_data = values.iter().flat_map(|v| v.to_le_bytes()).collect();
    constant(name, &[values.len()], DataType::Int64, raw_data)
}

fn constant(name: &str, dims: &[usize], kind: DataType, raw_data: Vec<u8>) -> TensorProto {
    let dims = dims.iter().map(|d| *d as i64).collect();
    TensorProto {
        name: name.to_owned(),
        dims,
        data_type: kind as i32,
        raw_data,
        ..TensorProto::default()
    }
}

/// An integer attribute of a node.
pub fn integer(name: &str, value: i64) -> AttributeProto {
    let kind = AttributeType::Int as i32;
    AttributeProto { name: name.to_owned(), r#type: kind, i: value, ..AttributeProto::default() }
}

/// An attribute of a node that lists integers.
pub fn list(name: &str, values: &[i64]) -> AttributeProto {
    let kind = AttributeType::Ints as i32;
    AttributeProto {
        name: name.to_owned(),
        r#type: kind,
        ints: values.to_vec(),
        ..AttributeProto::default()
    }
}

/// An entry of the metadata.
pub fn entry(key: &str, value: impl ToString) -> StringStringEntryProto {
    StringStringEntryProto { key: key.to_owned(), value: value.to_string() }
}
