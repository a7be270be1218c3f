//! The fuzz targets for a moment each, from the seeds in `fuzz/seeds`, with changes that are drawn in the same way every
//! time. `VOLTOUR_FUZZ_S` says for how many seconds to go on with further ones; `fuzz/README.md` how to do better.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)]
#![allow(clippy::disallowed_methods, missing_docs)]

mod change;
mod targets;

use std::env;
use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

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

/// Every seed is taken, but those that are named `bad-`; then so many cases of changed ones, again and again with other
/// changes as long as there is time.
fn run(target: &str, cases: u32, function: fn(&[u8]) -> bool) {
    let seeds = seeds(target);
    for (name, seed) in &seeds {
        assert_eq!(function(seed), !name.starts_with("bad-"), "{target}: the seed {name}");
    }
    let seconds = env::var("VOLTOUR_FUZZ_S").ok();
    let seconds = seconds.map_or(0, |text| text.parse().expect("a whole number"));
    let end = Instant::now() + Duration::from_secs(seconds);
    for round in 0_u64.. {
        draw(target, cases, round, &seeds, function);
        if Instant::now() >= end {
            println!("{target}: {} cases", (round + 1) * u64::from(cases));
            return;
        }
    }
}

fn draw(
    target: &str,
    cases: u32,
    round: u64,
    seeds: &[(String, Vec<u8>)],
    function: fn(&[u8]) -> bool,
) {
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    let mut start = [0; 32];
    start[..8].copy_from_slice(&round.to_le_bytes());
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &start);
    let mut runner = TestRunner::new_with_rng(config, rng);
    let drawn = (0..seeds.len(), vec(change(), 1..8));
    let tried = runner.run(&drawn, |(seed, changes)| {
        function(&applied(&seeds[seed].1, &changes));
        Ok(())
    });
    if let Err(TestError::Fail(why, (seed, changes))) = tried {
        let (name, seed) = &seeds[seed];
        let input = applied(seed, &changes);
        panic!("{target}: {why}; round {round}, from {name}: {}", input.escape_ascii());
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
#[should_panic(expected = "the last byte; round 0, from ")]
fn a_target_that_breaks_is_noticed_with_its_input() {
    run("cursor", 500, |data| {
        assert!(!data.ends_with(b"\xff"), "the last byte");
        targets::cursor(data)
    });
}
