//! The exchange of policies while they are in use.

use std::fs;
use std::path::Path;

use voltour_solver::policy::Problem;

use super::onnx::Onnx;
use super::support::batch;
use crate::policy::{Fault, Policies, Reloaded, Shelf};

fn put(folder: &Path, problem: &str, bytes: &[u8]) {
    fs::write(folder.join(format!("{problem}.onnx")), bytes).unwrap();
}

fn digest(policies: &Policies, problem: Problem) -> Option<String> {
    policies.of(problem).ok().map(|policy| policy.about.digest.clone())
}

#[test]
fn policies_are_exchanged_where_the_new_ones_are_good() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    put(folder, "reward", &Onnx::of("reward").bytes());
    put(folder, "mobile", b"damaged");
    let shelf = Shelf::open(Some(folder));
    let first = shelf.current();
    let of = |shelf: &Shelf, problem| digest(&shelf.current(), problem);
    assert!(of(&shelf, Problem::Reward).is_some() && of(&shelf, Problem::Mobile).is_none());
    let became = |problem: Problem| {
        let became = shelf.reload();
        became.into_iter().find(|(other, _)| *other == problem).unwrap().1
    };
    assert_eq!(became(Problem::Reward), Reloaded::Same);
    // A bad one: that from before stays.
    put(folder, "reward", &Onnx { factor: f32::NAN, ..Onnx::of("reward") }.bytes());
    assert!(
        matches!(became(Problem::Reward), Reloaded::Refused(error) if matches!(error.fault, Fault::NotFinite(_)))
    );
    assert_eq!(of(&shelf, Problem::Reward), digest(&first, Problem::Reward));
    // Another good one, and one where there was none.
    put(folder, "reward", &Onnx { factor: 2.0, ..Onnx::of("reward") }.bytes());
    put(folder, "mobile", &Onnx::of("mobile").bytes());
    let became = shelf.reload();
    assert_eq!(became.iter().filter(|(_, became)| *became == Reloaded::Taken).count(), 2);
    assert_ne!(of(&shelf, Problem::Reward), digest(&first, Problem::Reward));
    assert!(of(&shelf, Problem::Mobile).is_some());
    // Whoever began with the first ones still has them.
    assert!(first.of(Problem::Reward).unwrap().function.values(&batch(1, 2)).is_ok());
}

#[test]
fn a_folder_that_is_not_there_has_no_policy() {
    let policies = Policies::load(Some(Path::new("no/such/folder")));
    for (_, policy) in policies.iter() {
        let error = policy.unwrap_err();
        assert!(error.fault == Fault::Missing && error.file.contains("no/such/folder"), "{error}");
    }
}
