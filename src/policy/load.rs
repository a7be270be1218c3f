//! From the bytes of a file to a policy that passed every check.

use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

use sha2::{Digest, Sha256};
use voltour_solver::policy::{FEATURE_VERSION, Problem};

use super::graph::{Graph, RunError};
use super::network::Network;
use super::pad::padded;
use super::probe::probes;
use super::{About, Fault, ModelError, Policy};

/// The policy of an ONNX file, for this problem, or for that which it says itself.
///
/// # Errors
/// Which check it does not pass: format, inputs and output, feature version, problem, finite values for
/// the states that every model is tried on.
pub fn load(file: &str, bytes: &[u8], problem: Option<Problem>) -> Result<Policy, ModelError> {
    checked(file, bytes, problem).map_err(|fault| ModelError { file: file.to_owned(), fault })
}

fn checked(file: &str, bytes: &[u8], required: Option<Problem>) -> Result<Policy, Fault> {
    let (graph, mut metadata) = Graph::parse(bytes)?;
    let found = metadata.remove("voltour.feature_version").unwrap_or_else(|| "none".to_owned());
    if found.parse() != Ok(FEATURE_VERSION) {
        return Err(Fault::WrongVersion { found });
    }
    let found = metadata.remove("voltour.problem").unwrap_or_else(|| "none".to_owned());
    let problem = found.parse::<Problem>().ok();
    let Some(problem) = problem.filter(|found| required.is_none_or(|required| required == *found))
    else {
        let any = || Problem::ALL.map(Problem::name).join(" or ");
        let required = required.map_or_else(any, |required| required.name().to_owned());
        return Err(Fault::WrongProblem { found, required });
    };
    probed(&graph)?;
    let name =
        Path::new(file).file_stem().map_or_else(String::new, |name| name.display().to_string());
    let about = About {
        name,
        source: file.to_owned(),
        digest: digest(bytes),
        problem,
        feature_version: FEATURE_VERSION,
        training: metadata.remove("voltour.training").unwrap_or_default(),
        evaluation: metadata.remove("voltour.evaluation").unwrap_or_default(),
    };
    Ok(Policy { about: Arc::new(about), function: Arc::new(Network(graph)) })
}

/// Whether the graph has finite values for states that it must have values for.
fn probed(graph: &Graph) -> Result<(), Fault> {
    for probe in probes() {
        let batch = padded(&probe, 0, probe.states);
        let values = graph.run(&batch).map_err(|error| match error {
            RunError::Failed(reason) => Fault::Damaged(reason),
            RunError::Shape(found) => Fault::WrongShape {
                tensor: "q",
                found: format!("{found:?} for {} states of {} rows", batch.states, batch.rows),
                required: format!("[{}, {}]", batch.states, batch.rows),
            },
        })?;
        let wrong =
            values.iter().zip(&batch.mask).find(|(q, mask)| **mask != 0.0 && !q.is_finite());
        if let Some((value, _)) = wrong {
            return Err(Fault::NotFinite(value.to_string()));
        }
    }
    Ok(())
}

/// SHA-256, in hexadecimal.
fn digest(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(64);
    for byte in Sha256::digest(bytes) {
        // A string takes every write.
        let _ = write!(text, "{byte:02x}");
    }
    text
}
