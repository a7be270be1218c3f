//! The commands `solve`, `check`, `explain` and `generate` of the real binary: exit codes, what goes where,
//! standard input, bad documents.
#![allow(clippy::unwrap_used, reason = "a test fails by it")]

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

use self::onnx::Onnx;

#[path = "common/onnx.rs"]
mod onnx;

const SMALL: &str = r#"{
  "format": "voltour/scenario/1", "name": "small", "objective": "min_distance",
  "charger": {"start_m": [250, 250], "end_m": [250, 250], "speed_mps": 5, "travel_jpm": 600,
              "transfer_w": 20, "capacity_j": null, "timespan_s": null},
  "charge_level": 1.0,
  "coverage": {"k": 1, "field_m": [[0,0],[300,0],[300,300],[0,300]]},
  "sensors": [{"id": "s1", "position_m": [150, 150], "range_m": 250, "battery_j": 10800}],
  "requests": [{"sensor": "s1", "ready_s": 0, "deadline_s": 5400, "residual_j": 1620,
                "drain_w": 0.3, "reward": 9180, "required": false}]
}"#;

/// Runs the binary with what stands on its standard input.
fn voltour(arguments: &[&str], input: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_voltour"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A command that refuses its arguments does not read its input.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

fn code(output: &Output) -> i32 {
    output.status.code().unwrap()
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).unwrap()
}

/// Exit code 2, nothing on standard output, one line on standard error; the line.
fn refused(output: &Output) -> String {
    assert_eq!(code(output), 2, "{}", text(&output.stderr));
    assert!(output.stdout.is_empty());
    let line = text(&output.stderr).strip_suffix('\n').unwrap();
    assert!(!line.is_empty() && !line.contains('\n'), "{line:?}");
    line.to_owned()
}

fn file(folder: &Path, name: &str, content: &str) -> String {
    let path: PathBuf = folder.join(name);
    fs::write(&path, content).unwrap();
    path.to_str().unwrap().to_owned()
}

fn json(bytes: &[u8]) -> Value {
    serde_json::from_slice(bytes).unwrap()
}

#[test]
fn a_scenario_is_solved_and_its_plan_holds() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = file(folder.path(), "scenario.json", SMALL);
    let output = voltour(&["solve", &scenario, "--time-limit", "100ms"], "");
    assert_eq!(code(&output), 0, "{}", text(&output.stderr));
    assert!(output.stderr.is_empty());
    let plan = json(&output.stdout);
    assert_eq!(plan["format"], "voltour/plan/1");
    assert!((plan["objective"].as_f64().unwrap() - 282.842_712).abs() < 1e-3);
    assert!(plan["elapsed_s"].as_f64().unwrap() > 0.0);

    let output = voltour(&["check", &scenario, "-"], text(&output.stdout));
    assert_eq!(code(&output), 0, "{}", text(&output.stdout));
    assert!(output.stdout.is_empty() && output.stderr.is_empty());
}

#[test]
fn a_broken_plan_is_told_line_by_line() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = file(folder.path(), "scenario.json", SMALL);
    let solved = voltour(&["solve", &scenario, "--iterations", "10"], "");
    let mut plan = json(&solved.stdout);
    plan["distance_m"] = 5.into();
    plan["stops"][0]["arrive_s"] = 1.into();
    let plan = file(folder.path(), "plan.json", &plan.to_string());
    let output = voltour(&["check", &scenario, &plan], "");
    assert_eq!(code(&output), 1);
    let lines: Vec<_> = text(&output.stdout).lines().collect();
    assert!(lines.iter().any(|line| line.starts_with("distance_m: ")), "{lines:?}");
    assert!(lines.iter().any(|line| line.starts_with("stops[0].arrive_s: ")), "{lines:?}");
}

#[test]
fn the_same_seed_and_iterations_give_the_same_plan() {
    let drawn = voltour(&["generate", "reward", "--sensors", "60", "--seed", "5"], "");
    let scenario = text(&drawn.stdout);
    let solve = || {
        let output = voltour(&["solve", "-", "--iterations", "200", "--seed", "3"], scenario);
        let mut plan = json(&output.stdout);
        assert!(plan.as_object_mut().unwrap().remove("elapsed_s").is_some());
        plan
    };
    assert_eq!(solve(), solve());
}

#[test]
fn no_feasible_tour_is_exit_code_one_with_a_plan() {
    let late = SMALL.replace("5400", "1").replace("\"required\": false", "\"required\": true");
    let output = voltour(&["solve", "-", "--iterations", "10"], &late);
    assert_eq!(code(&output), 1);
    let plan = json(&output.stdout);
    assert!(["best_effort", "infeasible"].contains(&plan["status"].as_str().unwrap()));
    assert_eq!(plan["violations"][0]["kind"], "required");
}

#[test]
fn an_infeasible_scenario_is_explained() {
    let late = SMALL.replace("5400", "10");
    let output = voltour(&["explain", "-", "--iterations", "1000"], &late);
    assert_eq!(code(&output), 1, "{}", text(&output.stderr));
    let told = text(&output.stdout);
    assert!(told.starts_with("infeasible: no tour keeps every constraint.\n"), "{told}");
    assert!(told.contains("needs s1 before 10 s; the charger cannot reach it in time"), "{told}");
    assert!(output.stderr.is_empty());

    let json_of = |seed: &str| {
        let arguments =
            ["explain", "-", "--iterations", "1000", "--format", "json", "--seed", seed];
        json(&voltour(&arguments, &late).stdout)
    };
    let explanation = json_of("1");
    assert_eq!(explanation["format"], "voltour/explanation/1");
    assert_eq!(explanation["conflict"]["irreducible"], true);
    assert_eq!(explanation["next"][0]["change"]["kind"], "deadline");
    assert_eq!(explanation, json_of("1"));
}

#[test]
fn a_plan_is_explained_if_it_holds() {
    let folder = tempfile::tempdir().unwrap();
    let scenario = file(folder.path(), "scenario.json", SMALL);
    let solved = voltour(&["solve", &scenario, "--solver", "greedy"], "");
    let output = voltour(&["explain", &scenario, "-", "--time-limit", "1s"], text(&solved.stdout));
    assert_eq!(code(&output), 0, "{}", text(&output.stderr));
    let told = text(&output.stdout);
    assert!(
        told.starts_with("feasible: ") && told.contains("\n  s1: without it -282.84 m"),
        "{told}"
    );

    let target = folder.path().join("explanation.json");
    let target = target.to_str().unwrap();
    let plan = file(folder.path(), "plan.json", text(&solved.stdout));
    let output = voltour(&["explain", &scenario, &plan, "--format", "json", "-o", target], "");
    assert_eq!((code(&output), output.stdout.len()), (0, 0), "{}", text(&output.stderr));
    assert_eq!(json(&fs::read(target).unwrap())["served"][0]["sensor"], "s1");

    let mut wrong = json(&solved.stdout);
    wrong["distance_m"] = 5.into();
    let output = voltour(&["explain", &scenario, "-"], &wrong.to_string());
    assert_eq!(code(&output), 1);
    assert!(output.stdout.is_empty());
    let lines = text(&output.stderr);
    assert!(lines.contains("is not explained\n") && lines.contains("distance_m: "), "{lines}");
}

#[test]
fn bad_documents_are_one_line() {
    let cases = [
        (SMALL.replace("\"drain_w\": 0.3", "\"drain_w\": -1"), "requests[0].drain_w"),
        (SMALL.replace("\"charge_level\"", "\"charge\\nlevel\""), "unknown field"),
        (SMALL.replace("\"name\"", "\"format\""), "format"),
        (SMALL.replace("10800}", "1e999}"), "line"),
        ("{".to_owned(), "line 1"),
        (String::new(), "line 1"),
        ("[".repeat(100_000), "line 1"),
        ("\u{feff}{}".to_owned(), "line 1"),
    ];
    for (document, expected) in cases {
        for command in ["solve", "check", "explain"] {
            let mut arguments = vec![command, "-"];
            if command == "check" {
                arguments.push("/nowhere/plan.json");
            }
            let line = refused(&voltour(&arguments, &document));
            assert!(line.contains(expected), "{line}");
        }
    }
    let folder = tempfile::tempdir().unwrap();
    let scenario = file(folder.path(), "scenario.json", SMALL);
    let line = refused(&voltour(&["check", &scenario, "-"], "{\"format\": \"voltour/plan/2\"}"));
    assert!(line.contains("standard input: "), "{line}");
}

#[test]
fn a_policy_that_is_named_must_be_good() {
    let folder = tempfile::tempdir().unwrap();
    let bytes = Onnx::of("k_coverage").bytes();
    let nan = Onnx { factor: f32::NAN, ..Onnx::of("k_coverage") }.bytes();
    let old = Onnx { version: "0".into(), ..Onnx::of("k_coverage") }.bytes();
    let wide = Onnx { features: 7, ..Onnx::of("k_coverage") }.bytes();
    let cases: [(&[u8], &str); 5] = [
        (&bytes[..bytes.len() / 3], "is no ONNX model"),
        (&nan, "must be finite"),
        (&old, "features of version 0"),
        (&wide, "[?, ?, 7]"),
        (&Onnx::of("mobile").bytes(), "is trained for mobile"),
    ];
    let model = folder.path().join("k_coverage.onnx");
    let (model, folder) = (model.to_str().unwrap(), folder.path().to_str().unwrap());
    for (bytes, says) in cases {
        fs::write(model, bytes).unwrap();
        for arguments in [["--model", model], ["--policy-folder", folder]] {
            for solver in ["auto", "dqn"] {
                let solve = ["solve", "-", "--solver", solver, arguments[0], arguments[1]];
                let line = refused(&voltour(&solve, SMALL));
                assert!(line.contains(says) && line.contains(model), "{line}");
                assert!(line.contains(arguments[0]), "{line}");
            }
        }
    }
    let line = refused(&voltour(&["solve", "-", "--model", "/no/policy.onnx"], SMALL));
    assert!(line.contains("/no/policy.onnx: there is no model"), "{line}");
    let line = refused(&voltour(&["solve", "-", "--policy-folder", "/no/folder"], SMALL));
    assert!(line.contains("/no/folder"), "{line}");
    let greedy = ["solve", "-", "--solver", "greedy", "--model", model];
    assert!(refused(&voltour(&greedy, SMALL)).contains("only the solvers auto and dqn"));
    fs::write(model, &bytes).unwrap();
    let output = voltour(&["solve", "-", "--iterations", "50", "--model", model], SMALL);
    assert_eq!(code(&output), 0, "{}", text(&output.stderr));
    let again = voltour(&["solve", "-", "--iterations", "50", "--policy-folder", folder], SMALL);
    assert_eq!(json(&again.stdout)["stops"], json(&output.stdout)["stops"]);
}

#[test]
fn a_policy_alone_plans_the_same_tour_twice() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("policy.onnx");
    fs::write(&model, Onnx::of("k_coverage").bytes()).unwrap();
    let solve = ["solve", "-", "--solver", "dqn", "--iterations", "32", "--model"];
    let solve = [&solve[..], &[model.to_str().unwrap()]].concat();
    let plans = [(); 2].map(|()| {
        let output = voltour(&solve, SMALL);
        assert_eq!(code(&output), 0, "{}", text(&output.stderr));
        json(&output.stdout)
    });
    assert_eq!((&plans[0]["solver"], &plans[0]["stops"]), (&"dqn".into(), &plans[1]["stops"]));
}

#[test]
fn policies_are_listed() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("mobile.onnx"), Onnx::of("mobile").bytes()).unwrap();
    fs::write(folder.path().join("reward.onnx"), b"damaged").unwrap();
    let path = folder.path().to_str().unwrap();
    let output = voltour(&["policy", "list", "--policy-folder", path], "");
    assert_eq!(code(&output), 1, "not every problem has its policy");
    let listed = text(&output.stdout);
    for said in
        ["k_coverage\n", "mobile.onnx\n  sha256 ", "{\"steps\": 0}", "none: ", "reward.onnx: is no"]
    {
        assert!(listed.contains(said), "{said} is not in\n{listed}");
    }
}

#[test]
fn bad_arguments_are_one_line() {
    let line = refused(&voltour(&["solve", "-", "--solver", "magic"], SMALL));
    assert!(line.contains("unknown solver \"magic\"") && line.contains("baseline"), "{line}");
    assert!(refused(&voltour(&["solve", "/nowhere.json"], "")).contains("/nowhere.json"));
    for command in ["check", "explain"] {
        assert!(refused(&voltour(&[command, "-", "-"], SMALL)).contains("standard input"));
    }
    let line = refused(&voltour(&["explain", "-", "--solver", "magic"], SMALL));
    assert!(line.contains("unknown solver \"magic\""), "{line}");
    let line = refused(&voltour(&["generate", "reward", "--seed", "1", "--side-m", "-1"], ""));
    assert!(line.contains("--side-m: -1"), "{line}");
    for arguments in [
        &["solve"][..],
        &["solve", "-", "--time-limit", "-1s"],
        &["solve", "-", "--iterations", "x"],
        &["explain", "-", "--format", "xml"],
        &["explain", "-", "/nowhere/plan.json", "--solver", "greedy"],
        &["generate", "reward"],
        &["generate", "nothing", "--seed", "1"],
    ] {
        let output = voltour(arguments, SMALL);
        assert_eq!(code(&output), 2, "{arguments:?}");
        assert!(output.stdout.is_empty() && !output.stderr.is_empty());
    }
}

#[test]
fn options_of_comparison_algorithms_are_held_to_their_rules() {
    for (option, value, rule) in [
        ("--dp-step", "0", "above 0"),
        ("--dp-step", "NaN", "above 0"),
        ("--app-step", "inf", "above 0"),
        ("--app-epsilon", "1", "below 1"),
        ("--app-level", "13", "1..=12"),
        ("--memory-limit", "0", "1.."),
        ("--walks", "0", "1.."),
        ("--acs-ants", "0", "1.."),
        ("--acs-q0", "1.1", "[0, 1]"),
        ("--acs-beta", "-1", "0 or more"),
    ] {
        let output = voltour(&["solve", "-", "--solver", "dp", option, value], SMALL);
        let said = text(&output.stderr);
        assert_eq!(code(&output), 2, "{option} {value}");
        assert!([option, value, rule].iter().all(|part| said.contains(part)), "{said}");
    }
    let line = refused(&voltour(&["solve", "-", "--solver", "mst"], SMALL));
    assert!(line.contains("\"mst\" is not for this problem: it needs"), "{line}");
}

#[test]
fn an_ant_colony_is_as_large_as_its_options_say() {
    let scenario = text(&voltour(&["generate", "k_coverage", "--seed", "3"], "").stdout).to_owned();
    let ants = |options: &[&str]| {
        let given = [&["solve", "-", "--solver", "acs"], options].concat();
        let output = voltour(&given, &scenario);
        assert_eq!(code(&output), 0, "{}", text(&output.stderr));
        json(&output.stdout)
    };
    let few = ants(&["--acs-runs", "1", "--acs-iterations", "1", "--acs-ants", "2"]);
    let many = ants(&["--acs-runs", "2", "--acs-iterations", "20"]);
    assert!(few["objective"].as_f64() > many["objective"].as_f64(), "{few} {many}");
}

#[test]
fn every_preset_is_drawn_solved_checked_and_pictured() {
    let folder = tempfile::tempdir().unwrap();
    for preset in ["k_coverage", "reward", "mobile"] {
        let path = |end: &str| folder.path().join(format!("{preset}.{end}"));
        let [scenario, plan, svg] =
            ["json", "plan", "svg"].map(|end| path(end).to_str().unwrap().to_owned());
        let output = voltour(&["generate", preset, "--seed", "1", "-o", &scenario], "");
        assert_eq!((code(&output), output.stdout.len()), (0, 0), "{}", text(&output.stderr));
        let solve = ["solve", &scenario, "--iterations", "50", "-o", &plan, "--svg", &svg];
        let output = voltour(&solve, "");
        assert!(code(&output) <= 1 && output.stdout.is_empty(), "{}", text(&output.stderr));
        let output = voltour(&["check", &scenario, &plan], "");
        assert_eq!(code(&output), 0, "{preset}: {}", text(&output.stdout));
        assert!(fs::read_to_string(&svg).unwrap().starts_with("<svg"));
    }
}

#[test]
fn a_drawing_repeats() {
    let draw = |seed: &str| voltour(&["generate", "mobile", "--seed", seed], "").stdout;
    assert_eq!(draw("7"), draw("7"));
    assert_ne!(draw("7"), draw("8"));
}

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_voltour"))
        .args(["generate", "reward", "--sensors", "5000", "--seed", "1"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(code(&output), 0);
    assert!(output.stderr.is_empty(), "{}", text(&output.stderr));
}

#[test]
fn what_cannot_be_written_is_said() {
    let output = voltour(&["solve", "-", "--iterations", "1", "-o", "/nowhere/plan.json"], SMALL);
    assert!(refused(&output).contains("/nowhere/plan.json"));
}

#[test]
fn the_papers_tables_are_drawn_anew() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out").to_str().unwrap().to_owned();
    let document = file(
        folder.path(),
        "d.md",
        "# D\n<!-- bench reward-capacity -->\n<!-- bench end -->\nend\n",
    );
    let bench = |more: &[&str]| {
        let given = ["bench", "paper", "--scenarios", "1", "--iterations", "20", "--out", &out];
        voltour(&[&given[..], more].concat(), "")
    };
    let line = refused(&bench(&["network-size", "--document", &document]));
    assert!(line.contains("must have <!-- bench network-size -->"), "{line}");
    let output = bench(&["reward-capacity", "--document", &document]);
    assert_eq!(code(&output), 0, "{}", text(&output.stderr));
    let tables = text(&output.stdout);
    assert!(tables.contains("| 350 | mst |") && tables.contains("| 1 of 1 |"), "{tables}");
    let renewed = fs::read_to_string(&document).unwrap();
    assert!(renewed.contains("| 350 | mst |") && renewed.ends_with("<!-- bench end -->\nend\n"));
    for name in
        ["out/tables.md", "out/runs.csv", "out/reward-capacity.csv", "d/reward-capacity.svg"]
    {
        assert!(folder.path().join(name).is_file(), "{name}");
    }
    // Given again, it has nothing left to run and says the same.
    assert_eq!(text(&bench(&["reward-capacity"]).stdout), tables);
    let line = refused(&bench(&["reward-capacity", "--seed", "1"]));
    assert!(line.contains("seed is 0 for the runs in this folder, not 1"), "{line}");
    let output = bench(&["size"]);
    assert_eq!(code(&output), 2);
    assert!(text(&output.stderr).contains("must be one of mobile-network-size,"));
}

#[test]
fn public_instances_are_measured_against_their_best_values() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out").to_str().unwrap().to_owned();
    let instances = folder.path().to_str().unwrap();
    let bench =
        || voltour(&["bench", "public", instances, "--solvers", "greedy,exact", "--out", &out], "");
    assert!(refused(&bench()).contains("best.csv"));
    file(folder.path(), "small.json", SMALL);
    file(
        folder.path(),
        "best.csv",
        "file,objective,best_known,proven,source\nsmall.json,min_distance,100,no,own\n",
    );
    let output = bench();
    assert_eq!(code(&output), 0, "{}", text(&output.stderr));
    assert!(
        text(&output.stdout).contains("| exact | 1 of 1 | 0 | 182.84 % |"),
        "{}",
        text(&output.stdout)
    );
}
