//! A policy back from its ONNX model: the parameters by name, the rest from the metadata.

use tract_onnx::pb::ModelProto;
use voltour_solver::policy::FEATURE_VERSION;

use crate::network::{Part, Shape, Weights};

use super::{Metadata, Model};

type Read<T> = Result<T, String>;

pub fn model(proto: &ModelProto) -> Read<Model> {
    let of = |key: &str| {
        let entry = proto.metadata_props.iter().find(|e| e.key == key);
        entry.map(|e| e.value.clone()).ok_or_else(|| format!("the metadata lacks {key}"))
    };
    let version = of("voltour.feature_version")?;
    if version != FEATURE_VERSION.to_string() {
        return Err(format!(
            "made for version {version} of the features; this is version {FEATURE_VERSION}"
        ));
    }
    let shape: Shape = serde_json::from_str(&of("voltour.network")?)
        .map_err(|e| format!("voltour.network: {e}"))?;
    let shape = shape.checked().map_err(|e| e.to_string())?;
    let mut values = Vec::with_capacity(shape.parameters());
    for part in shape.parts() {
        values.extend(numbers(proto, &part)?);
    }
    if let Some(value) = values.iter().find(|v| !v.is_finite()) {
        return Err(format!("a parameter is {value}"));
    }
    let metadata = Metadata {
        problem: of("voltour.problem")?,
        training: of("voltour.training")?,
        evaluation: of("voltour.evaluation")?,
    };
    let weights = Weights::from_values(shape, values).ok_or("the number of parameters is wrong")?;
    Ok(Model { weights, metadata })
}

fn numbers(proto: &ModelProto, part: &Part) -> Read<Vec<f32>> {
    let graph = proto.graph.as_ref().ok_or("no graph")?;
    let name = &part.name;
    let tensor = graph.initializer.iter().find(|t| t.name == *name);
    let tensor = tensor.ok_or_else(|| format!("no parameters {name}"))?;
    let (chunks, rest) = tensor.raw_data.as_chunks::<4>();
    if tensor.dims != [part.rows as i64, part.columns as i64]
        || chunks.len() != part.len()
        || !rest.is_empty()
    {
        return Err(format!("{name} has the dimensions {:?}", tensor.dims));
    }
    Ok(chunks.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect())
}
