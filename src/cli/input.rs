//! Files that commands read: whole, within bounds, and without fields that nobody knows.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use serde::de::DeserializeOwned;
use serde_json::Value;

use super::Failure;

/// The largest file.
const MOST: u64 = 64 * 1024 * 1024;

/// Reads a text file; `-` is standard input.
pub fn read(file: &Path) -> Result<String, Failure> {
    let failed = |error: io::Error| Failure::input(format!("{}: {error}", file.display()));
    let mut text = String::new();
    let read = if file == Path::new("-") {
        io::stdin().lock().take(MOST + 1).read_to_string(&mut text)
    } else {
        File::open(file).map_err(failed)?.take(MOST + 1).read_to_string(&mut text)
    };
    match read.map_err(failed)? as u64 {
        bytes if bytes <= MOST => Ok(text),
        _ => Err(Failure::input(format!("{}: has more than {MOST} bytes", file.display()))),
    }
}

/// A value of a type, every error with its path; unknown fields are refused.
pub fn strict<T: DeserializeOwned>(value: Value) -> Result<T, String> {
    let mut unknown = None;
    let mut note = |path: serde_ignored::Path<'_>| {
        unknown.get_or_insert_with(|| brackets(&path.to_string()));
    };
    let read = serde_path_to_error::deserialize(serde_ignored::Deserializer::new(value, &mut note));
    match (read, unknown) {
        (Ok(_), Some(path)) => Err(format!("{path}: is no field")),
        (Ok(read), None) => Ok(read),
        (Err(error), _) => match error.path().to_string() {
            path if path == "." => Err(error.into_inner().to_string()),
            path => Err(format!("{path}: {}", error.into_inner())),
        },
    }
}

/// `sensors.3.id` as `sensors[3].id`; `?` stands for what an optional field holds.
fn brackets(path: &str) -> String {
    let mut text = String::new();
    for step in path.split('.').filter(|step| *step != "?") {
        if step.bytes().all(|byte| byte.is_ascii_digit()) {
            text = format!("{text}[{step}]");
        } else if text.is_empty() {
            text = step.to_owned();
        } else {
            text = format!("{text}.{step}");
        }
    }
    text
}
