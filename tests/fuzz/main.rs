//! The fuzz targets for a moment each, from the seeds in `fuzz/seeds`, with changes that are drawn in the same way every
//! time. `VOLTOUR_FUZZ_CASES` says how many; `fuzz/README.md` how to go on for longer.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]
#![allow(clippy::disallowed_methods, missing_docs)]

mod change;
mod targets;

use std::env;
use std::fs;
use std::path::Path;

use proptest::collection::vec;
use proptest::test_runner::{Config, RngAlgorithm, TestError, TestRng, TestRunner};

use change::{applied, change};

/// The seeds of a target, by name.
fn seeds(target: &str) -> Vec<(String, Vec<u8>)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("fuzz/seeds").join(target);
    let files = fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let read = |file: fs::DirEntry| {
        (file.file_name().into_string().unwrap(), fs::read(file.path()).unwrap())
    };
    let mut seeds: Vec<_> = files.map(|file| read(file.unwrap())).collect();
    seeds.sort();
    seeds
}

/// Every seed is taken, but those that are named `bad-`; then so many cases of changed ones.
fn run(target: &str, cases: u32, function: fn(&[u8]) -> bool) {
    let seeds = seeds(target);
    for (name, seed) in &seeds {
        assert_eq!(function(seed), !name.starts_with("bad-"), "{target}: the seed {name}");
    }
    let set = env::var("VOLTOUR_FUZZ_CASES").ok();
    let cases = set.map_or(cases, |text| text.parse().expect("a whole number"));
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    let rng = TestRng::deterministic_rng(RngAlgorithm::ChaCha);
    let mut runner = TestRunner::new_with_rng(config, rng);
    let cases = (0..seeds.len(), vec(change(), 1..8));
    let tried = runner.run(&cases, |(seed, changes)| {
        function(&applied(&seeds[seed].1, &changes));
        Ok(())
    });
    if let Err(TestError::Fail(why, (seed, changes))) = tried {
        let (name, seed) = &seeds[seed];
        let input = applied(seed, &changes);
        panic!("{target}: {why}; from {name}: {}", input.escape_ascii());
    }
}

#[test]
fn scenario_documents() {
    run("scenario", 3_000, targets::scenario);
}

#[test]
fn grpc_messages() {
    run("message", 2_000, targets::message);
}

#[test]
fn rest_queries() {
    run("query", 2_000, targets::query);
}

#[test]
fn cursors() {
    run("cursor", 500, targets::cursor);
}

#[test]
fn policy_files() {
    run("policy", 300, targets::policy);
}

#[test]
#[should_panic(expected = "the last byte; from ")]
fn a_target_that_breaks_is_noticed_with_its_input() {
    run("cursor", 500, |data| {
        assert!(!data.ends_with(b"\xff"), "the last byte");
        targets::cursor(data)
    });
}
