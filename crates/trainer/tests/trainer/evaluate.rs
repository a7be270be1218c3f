//! The command `evaluate`, on a model as shipped.

use std::process::{Command, Output};

fn evaluate(options: &[&str]) -> Output {
    let model = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/mobile.onnx");
    let mut command = Command::new(env!("CARGO_BIN_EXE_voltour-train"));
    command.args(["evaluate", model, "--cells", "mobile/10", "--count", "2"]).args(options);
    command.output().unwrap()
}

#[test]
fn every_seed_counts_and_methods_are_compared_with_the_last() {
    let last_seed = u64::MAX.to_string();
    let options = ["--seed", &last_seed, "--seeds", "3", "--paired"];
    let output = evaluate(&[&options[..], &["--methods", "control-greedy,greedy"]].concat());
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{text}");
    assert!(text.contains("| mobile/10 | greedy | 6 of 6 |"), "{text}");
    let row = text.lines().find(|line| line.contains("| control-greedy - greedy |")).unwrap();
    let counts = row.split(" | ").skip(4).map(|cell| cell.trim_end_matches(" |"));
    let runs: u32 = counts.map(|count| count.parse::<u32>().unwrap()).sum();
    assert_eq!(runs, 6, "{row}");
}

#[test]
fn one_method_alone_cannot_be_compared() {
    let output = evaluate(&["--methods", "greedy", "--paired"]);
    assert_eq!(output.status.code(), Some(2));
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(text.contains("methods = greedy must be two or more with --paired"), "{text}");
}
