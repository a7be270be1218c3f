//! Where models come from: the binary, and files.

use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

use voltour_solver::policy::Problem;

use super::{Fault, ModelError, Policy, load};

include!(concat!(env!("OUT_DIR"), "/models.rs"));

/// No model is larger: 64 MiB.
const LARGEST: u64 = 64 << 20;

/// The policy of a problem that is part of the binary.
///
/// # Errors
/// There is none, or it does not pass a check.
pub fn embedded(problem: Problem) -> Result<Policy, ModelError> {
    let file = format!("{problem}.onnx");
    let source = format!("{file} (part of the binary)");
    match MODELS.iter().find(|(name, _)| *name == file) {
        Some((_, bytes)) => load(&source, bytes, Some(problem)),
        None => Err(ModelError { file: source, fault: Fault::Missing }),
    }
}

/// The policy of a file, for this problem, or for that which it says itself.
///
/// # Errors
/// It is not there, cannot be read, is too large, or does not pass a check.
pub fn file(path: &Path, problem: Option<Problem>) -> Result<Policy, ModelError> {
    let file = path.display().to_string();
    let fault = |fault| ModelError { file: file.clone(), fault };
    let mut bytes = Vec::new();
    let read = File::open(path).and_then(|file| file.take(LARGEST + 1).read_to_end(&mut bytes));
    match read {
        Err(error) if error.kind() == ErrorKind::NotFound => Err(fault(Fault::Missing)),
        Err(error) => Err(fault(Fault::Unreadable(error.to_string()))),
        Ok(_) if bytes.len() as u64 > LARGEST => {
            Err(fault(Fault::Unreadable("it is larger than 64 MiB".to_owned())))
        }
        Ok(_) => load(&file, &bytes, problem),
    }
}

/// The policy of a problem from a folder: its file there, and that of the binary where there is none. A folder
/// that is not there has none, and nothing else stands in its place: whoever names it, means it.
///
/// # Errors
/// As for [`file`] and [`embedded`].
pub(super) fn folder(folder: &Path, problem: Problem) -> Result<Policy, ModelError> {
    if !folder.is_dir() {
        let file = format!("{} (no folder)", folder.display());
        return Err(ModelError { file, fault: Fault::Missing });
    }
    match file(&folder.join(format!("{problem}.onnx")), Some(problem)) {
        Err(ModelError { fault: Fault::Missing, .. }) => embedded(problem),
        found => found,
    }
}
