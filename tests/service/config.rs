//! The configuration on the command line: checked, printed, and which of its sources goes before the others.

use std::process::{Command, Output};

use tempfile::TempDir;

struct Place {
    dir: TempDir,
}

impl Place {
    fn with(toml: &str) -> Self {
        let dir = tempfile::tempdir().unwrap();
        std::fs::write(dir.path().join("voltour.toml"), toml).unwrap();
        Self { dir }
    }

    fn config(&self, arguments: &[&str], environment: &[(&str, &str)]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_voltour"));
        command.current_dir(self.dir.path()).arg("config").args(arguments);
        command.args(["--config", "voltour.toml"]).envs(environment.iter().copied());
        command.output().unwrap()
    }
}

fn said(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn flags_go_before_the_environment_before_the_file_before_the_defaults() {
    let place = Place::with("[planning]\nbudget = \"1s\"\nthreads = 2\nseed = 3\n");
    let environment = [("VOLTOUR_PLANNING__THREADS", "3"), ("VOLTOUR_PLANNING__SEED", "4")];
    let printed = place.config(&["print", "--set", "planning.seed=5"], &environment);
    let text = said(&printed.stdout);
    assert!(printed.status.success(), "{}", said(&printed.stderr));
    for line in [
        "budget = \"1s\"",
        "threads = 3",
        "seed = 5",
        "max_late = \"10m\"",
        "lead = \"2s\"",
        "[store]",
        "path = \"voltour.db\"",
    ] {
        assert!(text.lines().any(|printed| printed == line), "{line} in\n{text}");
    }
    // What is printed is a configuration, of the same meaning.
    let again = Place::with(&text).config(&["print"], &[]);
    assert_eq!(said(&again.stdout), text);
}

#[test]
fn what_is_good_passes_silently_and_leaves_nothing_behind() {
    let place = Place::with("[store]\npath = \"new.db\"\n");
    let checked = place.config(&["check", "--set", "grpc.listen=127.0.0.1:0"], &[]);
    assert!(checked.status.success(), "{}", said(&checked.stderr));
    assert_eq!((said(&checked.stdout), said(&checked.stderr)), (String::new(), String::new()));
    assert!(!place.dir.path().join("new.db").exists());
}

#[test]
fn every_fault_is_named_with_its_key() {
    for (toml, arguments, environment, named) in [
        ("[planning]\nbugdet = \"1s\"", &[][..], &[][..], "bugdet"),
        ("", &["--set", "planning.budget=soon"], &[], "planning.budget"),
        ("", &["--set", "planning.bugdet=1s"], &[], "bugdet"),
        ("", &["--set", "budget=1s"], &[], "SECTION.KEY=VALUE"),
        ("", &["--set", "log.filter=voltour=loud"], &[], "log.filter"),
        ("", &[], &[("VOLTOUR_LOG__FORMAT", "xml")], "log.format"),
        ("", &[], &[("VOLTOUR_LOG__FROMAT", "text")], "fromat"),
    ] {
        for command in ["check", "print"] {
            let mut arguments = arguments.to_vec();
            arguments.insert(0, command);
            let refused = Place::with(toml).config(&arguments, environment);
            let text = said(&refused.stderr);
            assert_eq!(refused.status.code(), Some(2), "{toml} {arguments:?}: {text}");
            assert!(text.contains(named), "{named} in {text}");
            assert!(refused.stdout.is_empty());
        }
    }
}

#[test]
fn what_may_be_a_token_is_never_shown() {
    let key = "VOLTOUR_ACCESS__BOOTSTRAP_TOKEN";
    for (toml, environment) in [
        ("", &[(key, "70457045")][..]),
        ("", &[(key, "70457045-too-short")]),
        ("", &[(key, "[70457045]")]),
        ("[access]\nbootstrap_token = 70457045", &[]),
        ("[access]\nbootstrap_token = \"70457045-too-short\"", &[]),
        ("[access]\nbootstrap_token = \"70457045", &[]),
        ("[access]\nbootstrap_token = 70457045-and-more", &[]),
    ] {
        for command in ["check", "print"] {
            let refused = Place::with(toml).config(&[command], environment);
            let text = said(&refused.stderr);
            assert_eq!(refused.status.code(), Some(2), "{toml} {environment:?}: {text}");
            let names = text.contains("access.bootstrap_token") || text.contains("line 2");
            assert!(names && !text.contains("7045"), "{toml} {environment:?}: {text}");
        }
    }
    let token = "a-token-that-somebody-has-made-0123456789";
    let printed = Place::with("").config(&["print"], &[(key, token)]);
    let text = said(&printed.stdout);
    assert!(text.contains("bootstrap_token = \"***\"") && !text.contains("made"), "{text}");
}

#[test]
fn a_check_reads_the_files_that_are_named() {
    let place = Place::with("");
    std::fs::write(place.dir.path().join("token"), "hush-too-short").unwrap();
    for (settings, key) in [
        (&["access.bootstrap_token_file=token"][..], "access.bootstrap_token_file: token"),
        (&["tls.certificate_file=no.crt", "tls.key_file=no.key"], "tls.certificate_file: no.crt"),
    ] {
        let settings = settings.iter().flat_map(|setting| ["--set", setting]);
        let arguments: Vec<_> = ["check"].into_iter().chain(settings).collect();
        let refused = place.config(&arguments, &[]);
        let text = said(&refused.stderr);
        assert_eq!(refused.status.code(), Some(2), "{text}");
        assert!(text.contains(key) && !text.contains("hush"), "{text}");
    }
}

#[test]
fn a_set_flag_configures_the_service_too() {
    let place = Place::with("");
    let mut serve = Command::new(env!("CARGO_BIN_EXE_voltour"));
    serve.current_dir(place.dir.path()).args(["serve", "--set", "planning.threads=0"]);
    let refused = serve.output().unwrap();
    assert_eq!(refused.status.code(), Some(2));
    assert!(said(&refused.stderr).contains("planning.threads: 0"), "{}", said(&refused.stderr));
}

#[test]
fn the_installed_sample_is_good() {
    let sample = concat!(env!("CARGO_MANIFEST_DIR"), "/deploy/voltour.toml");
    let checked = Command::new(env!("CARGO_BIN_EXE_voltour"))
        .args(["config", "check", "--config", sample])
        .output()
        .unwrap();
    assert!(checked.status.success(), "{}", said(&checked.stderr));
}

#[test]
fn completions_and_man_pages_come_from_the_commands() {
    for shell in ["bash", "zsh", "fish"] {
        let made =
            Command::new(env!("CARGO_BIN_EXE_voltour")).args(["completions", shell]).output();
        let text = said(&made.unwrap().stdout);
        for word in ["voltour", "solve", "memory-limit", "completions"] {
            assert!(text.contains(word), "{word} for {shell}");
        }
    }
    let dir = tempfile::tempdir().unwrap();
    let pages = dir.path().join("share/man1");
    let made = Command::new(env!("CARGO_BIN_EXE_voltour")).arg("man").arg(&pages).output().unwrap();
    assert!(made.status.success(), "{}", said(&made.stderr));
    for name in ["voltour.1", "voltour-serve.1", "voltour-solve.1", "voltour-config-print.1"] {
        let text =
            std::fs::read_to_string(pages.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(text.contains(".TH ") && text.contains(".SH SYNOPSIS"), "{name}: {text}");
    }
    let file = dir.path().join("file");
    std::fs::write(&file, "").unwrap();
    let refused =
        Command::new(env!("CARGO_BIN_EXE_voltour")).arg("man").arg(&file).output().unwrap();
    assert_eq!(refused.status.code(), Some(1));
    assert!(said(&refused.stderr).contains("file"));
}
