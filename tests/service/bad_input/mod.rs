//! Bad input of every kind and call: INVALID_ARGUMENT with a google.rpc.BadRequest violation that names
//! the field by its path, and nothing is stored.

mod departure;
mod list;
mod network;
mod request;
mod tour;

use tonic::{Code, Status};
use tonic_types::StatusExt;

/// The fields that a refusal names.
#[track_caller]
pub fn violations(status: &Status) -> Vec<String> {
    assert_eq!(status.code(), Code::InvalidArgument, "{status}");
    let details = status.get_details_bad_request().expect("a BadRequest in the details");
    for violation in &details.field_violations {
        assert!(!violation.description.is_empty(), "{}: no rule is given", violation.field);
    }
    details.field_violations.into_iter().map(|violation| violation.field).collect()
}

/// The call was refused for this one field.
#[track_caller]
fn refused<T>(answer: Result<T, Status>, field: &str) {
    match answer {
        Ok(_) => panic!("a bad {field} was accepted"),
        Err(status) => assert_eq!(violations(&status), [field], "{status}"),
    }
}

/// Numbers that are none.
const NO_NUMBERS: [f64; 3] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

/// Ids that break the rule of those that clients make.
fn bad_ids() -> Vec<String> {
    let bad = ["", "with space", "slash/ed", "umlaut-ä", "tab\t", "semi;colon", "\u{0}"];
    bad.into_iter().map(String::from).chain(["x".repeat(65)]).collect()
}
