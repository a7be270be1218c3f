//! [`Graph`]: an ONNX file as it is run; the only file that knows tract.
//!
//! The graph is optimised anew for each size of its inputs, which makes it about twice as fast as one for any
//! size; what was made last is kept.

use std::collections::HashMap;
use std::num::NonZeroUsize;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Mutex, PoisonError};

use lru::LruCache;
use prost::Message;
use tract_onnx::pb::tensor_proto::DataType;
use tract_onnx::pb::tensor_shape_proto::dimension::Value as Size;
use tract_onnx::pb::{GraphProto, ModelProto, ValueInfoProto, type_proto};
use tract_onnx::prelude::*;
use voltour_solver::policy::{Batch, FEATURES};

use super::Fault;

/// Sizes of inputs for which an optimised graph is kept.
const KEPT: NonZeroUsize = NonZeroUsize::MIN.saturating_add(63);

/// A dimension of the contract: a size, or one that is known when the graph runs.
type Dimension = Option<usize>;

/// The inputs of the contract: their names, and their dimensions.
const INPUTS: [(&str, &[Dimension]); 3] =
    [("nodes", &[None, None, Some(FEATURES)]), ("edges", &[None; 3]), ("mask", &[None; 2])];

/// The output of the contract.
const OUTPUT: (&str, &[Dimension]) = ("q", &[None; 2]);

/// An ONNX graph with the inputs and the output of the contract.
#[derive(Debug)]
pub(super) struct Graph {
    model: InferenceModel,
    /// Of each of [`INPUTS`], which input of the graph it is.
    places: [usize; 3],
    optimised: Mutex<LruCache<(usize, usize), Arc<TypedRunnableModel>>>,
}

/// Why a graph has no values for a batch.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum RunError {
    /// It does not run.
    Failed(String),
    /// Its output is not `[B, N]`, but this.
    Shape(Vec<usize>),
}

impl Graph {
    /// The graph of an ONNX file, and the metadata in it. That it runs, is to be seen.
    pub fn parse(bytes: &[u8]) -> Result<(Self, HashMap<String, String>), Fault> {
        let model = ModelProto::decode(bytes).map_err(|error| damaged(&error))?;
        let graph = model.graph.as_ref().ok_or_else(|| damaged(&"it has no graph"))?;
        let places = contract(graph)?;
        let metadata =
            model.metadata_props.iter().map(|entry| (entry.key.clone(), entry.value.clone()));
        let metadata = metadata.collect();
        let parsed = guarded(|| tract_onnx::onnx().model_for_proto_model(&model));
        let model = parsed.map_err(Fault::Damaged)?;
        Ok((Self { model, places, optimised: Mutex::new(LruCache::new(KEPT)) }, metadata))
    }

    /// `q [B, N]`, row by row.
    pub fn run(&self, batch: &Batch) -> Result<Vec<f32>, RunError> {
        let (b, n) = (batch.states, batch.rows);
        let run = || {
            let graph = self.optimised(b, n)?;
            let tensors: [Tensor; 3] = [
                Tensor::from_shape(&[b, n, FEATURES], &batch.nodes)?,
                Tensor::from_shape(&[b, n, n], &batch.edges)?,
                Tensor::from_shape(&[b, n], &batch.mask)?,
            ];
            let mut inputs: Vec<(usize, TValue)> =
                self.places.into_iter().zip(tensors.map(Into::into)).collect();
            inputs.sort_by_key(|(place, _)| *place);
            let outputs = graph.run(inputs.into_iter().map(|(_, input)| input).collect())?;
            let q = outputs.first().ok_or_else(|| TractError::msg("no output"))?;
            Ok((q.shape().to_vec(), q.to_plain_array_view::<f32>()?.iter().copied().collect()))
        };
        let (shape, values) = guarded(run).map_err(RunError::Failed)?;
        if shape == [b, n] { Ok(values) } else { Err(RunError::Shape(shape)) }
    }

    fn optimised(&self, b: usize, n: usize) -> TractResult<Arc<TypedRunnableModel>> {
        let kept = || self.optimised.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(graph) = kept().get(&(b, n)) {
            return Ok(graph.clone());
        }
        // Not under the lock: where two solves need the same size at once, both make it.
        let mut model = self.model.clone();
        let shapes: [TVec<usize>; 3] = [tvec![b, n, FEATURES], tvec![b, n, n], tvec![b, n]];
        for (place, shape) in self.places.into_iter().zip(shapes) {
            model.set_input_fact(place, InferenceFact::dt_shape(f32::datum_type(), shape))?;
        }
        let graph = model.into_optimized()?.into_runnable()?;
        kept().put((b, n), graph.clone());
        Ok(graph)
    }
}

/// What tract does, a panic in it as an error.
fn guarded<T>(work: impl FnOnce() -> TractResult<T>) -> Result<T, String> {
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(done) => done.map_err(|error| one_line(&format!("{error:#}"))),
        Err(_) => Err("the library that runs it panicked".to_owned()),
    }
}

/// A message, as one line that is not too long.
fn one_line(text: &str) -> String {
    const LONGEST: usize = 300;
    text.split_whitespace().collect::<Vec<_>>().join(" ").chars().take(LONGEST).collect()
}

fn damaged(error: &dyn std::fmt::Display) -> Fault {
    Fault::Damaged(one_line(&error.to_string()))
}

/// Where the inputs of the contract are among those of a graph that has them and no others.
fn contract(graph: &GraphProto) -> Result<[usize; 3], Fault> {
    let is_given = |input: &&ValueInfoProto| {
        !graph.initializer.iter().any(|constant| constant.name == input.name)
    };
    let inputs: Vec<&ValueInfoProto> = graph.input.iter().filter(is_given).collect();
    if let Some(other) = inputs.iter().find(|input| INPUTS.iter().all(|(n, _)| *n != input.name)) {
        let found = format!("beside another input, {:?}", other.name);
        let required = "nothing but nodes, edges and mask".to_owned();
        return Err(Fault::WrongShape { tensor: "nodes", found, required });
    }
    let mut places = [0; 3];
    for (place, (name, dimensions)) in places.iter_mut().zip(INPUTS) {
        let found = inputs.iter().position(|input| input.name == name);
        *place = found.ok_or_else(|| wrong(name, "not an input".to_owned(), dimensions))?;
        matches(inputs[*place], name, dimensions, true)?;
    }
    let (name, dimensions) = OUTPUT;
    match graph.output.as_slice() {
        [output] if output.name == name => matches(output, name, dimensions, false)?,
        _ => return Err(wrong(name, "not the one output".to_owned(), dimensions)),
    }
    Ok(places)
}

/// Whether a tensor is declared as the contract says; an output may leave its sizes to what is computed.
fn matches(
    value: &ValueInfoProto,
    name: &'static str,
    dimensions: &[Dimension],
    whole: bool,
) -> Result<(), Fault> {
    let kind = value.r#type.as_ref().and_then(|kind| kind.value.as_ref());
    let Some(type_proto::Value::TensorType(tensor)) = kind else {
        return if whole { Err(wrong(name, "no tensor".to_owned(), dimensions)) } else { Ok(()) };
    };
    let sizes = tensor.shape.as_ref().map(|shape| {
        let size = |size: &Option<Size>| match size {
            Some(Size::DimValue(size)) => Some(*size),
            _ => None,
        };
        shape.dim.iter().map(|dimension| size(&dimension.value)).collect::<Vec<_>>()
    });
    let is_same = |sizes: &Vec<Option<i64>>| {
        let required = dimensions.iter().map(|size| size.and_then(|size| i64::try_from(size).ok()));
        sizes.iter().copied().eq(required)
    };
    let is_float = tensor.elem_type == DataType::Float as i32;
    match &sizes {
        None if is_float && !whole => Ok(()),
        Some(sizes) if is_float && is_same(sizes) => Ok(()),
        sizes => {
            let kind = DataType::try_from(tensor.elem_type).map_or("unknown", |k| k.as_str_name());
            let sizes = sizes.as_deref().unwrap_or_default();
            Err(wrong(name, format!("{} {}", kind.to_lowercase(), shown(sizes)), dimensions))
        }
    }
}

fn wrong(tensor: &'static str, found: String, dimensions: &[Dimension]) -> Fault {
    Fault::WrongShape { tensor, found, required: format!("float {}", shown(dimensions)) }
}

/// Such as `[?, ?, 32]`.
fn shown<T: ToString>(sizes: &[Option<T>]) -> String {
    let size = |size: &Option<T>| size.as_ref().map_or("?".to_owned(), ToString::to_string);
    format!("[{}]", sizes.iter().map(size).collect::<Vec<_>>().join(", "))
}
