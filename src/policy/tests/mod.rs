//! Models that pass and models that do not; values, padding, time; and the exchange of policies.

mod exchange;
mod faults;
mod limited;
#[path = "../../../tests/common/onnx.rs"]
pub(crate) mod onnx;
mod support;
mod values;

pub(crate) use support::{policy, zeros};
