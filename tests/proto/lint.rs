//! How the contract is written: names as the style guide of Protocol Buffers has them, and a comment on
//! every service, enumeration and value.

use prost_types::FileDescriptorProto;

use super::compiled;

/// What is wrong with a file, a line each.
fn faults(file: &FileDescriptorProto) -> Vec<String> {
    let mut lint = Lint { file, faults: Vec::new() };
    let folder = file.package().replace('.', "/");
    lint.check(
        file.name().starts_with(&format!("{folder}/")),
        file.name(),
        "not in its package's folder",
    );
    for (i, service) in (0..).zip(&file.service) {
        lint.named(service.name(), is_pascal(service.name()));
        lint.commented(&[6, i], service.name());
        lint.check(service.name().ends_with("Service"), service.name(), "must end in Service");
        for method in &service.method {
            lint.named(method.name(), is_pascal(method.name()));
            let input = method.input_type().ends_with("Request");
            lint.check(input, method.name(), "must take a message whose name ends in Request");
        }
    }
    for message in &file.message_type {
        lint.named(message.name(), is_pascal(message.name()));
        for field in &message.field {
            lint.named(field.name(), is_snake(field.name()));
        }
        let is_flat = message.enum_type.is_empty()
            && message
                .nested_type
                .iter()
                .all(|nested| nested.options.as_ref().is_some_and(|o| o.map_entry()));
        lint.check(is_flat, message.name(), "holds types of its own: they belong beside it");
    }
    for (i, kind) in (0..).zip(&file.enum_type) {
        lint.named(kind.name(), is_pascal(kind.name()));
        lint.commented(&[5, i], kind.name());
        let prefix = screaming(kind.name());
        for (j, value) in (0..).zip(&kind.value) {
            let name = value.name();
            // What is unspecified has nothing to say.
            let rest = name.strip_prefix(&format!("{prefix}_"));
            lint.check(
                rest.is_some_and(|_| name == name.to_uppercase()),
                name,
                "must begin with its enum's name, in capitals",
            );
            match value.number() {
                0 => lint.check(rest == Some("UNSPECIFIED"), name, "0 must be UNSPECIFIED"),
                _ => lint.commented(&[5, i, 2, j], name),
            }
        }
    }
    lint.faults
}

struct Lint<'a> {
    file: &'a FileDescriptorProto,
    faults: Vec<String>,
}

impl Lint<'_> {
    fn check(&mut self, holds: bool, name: &str, rule: &str) {
        if !holds {
            self.faults.push(format!("{}: {name}: {rule}", self.file.name()));
        }
    }

    fn named(&mut self, name: &str, is_well: bool) {
        self.check(is_well, name, "is not written as such names are");
    }

    fn commented(&mut self, path: &[i32], name: &str) {
        let locations = self.file.source_code_info.iter().flat_map(|info| &info.location);
        let mut here = locations.filter(|location| location.path == path);
        let said =
            here.any(|at| !(at.leading_comments().is_empty() && at.trailing_comments().is_empty()));
        self.check(said, name, "has no comment");
    }
}

fn is_pascal(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_uppercase())
        && name.chars().all(|c| c.is_ascii_alphanumeric())
}

fn is_snake(name: &str) -> bool {
    let legal = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    name.starts_with(|c: char| c.is_ascii_lowercase())
        && name.chars().all(legal)
        && !name.contains("__")
}

/// `RequestState` as `REQUEST_STATE`.
fn screaming(name: &str) -> String {
    let mut text = String::new();
    for (i, c) in name.chars().enumerate() {
        if i > 0 && c.is_ascii_uppercase() {
            text.push('_');
        }
        text.push(c.to_ascii_uppercase());
    }
    text
}

#[test]
fn the_contract_is_written_as_its_readers_expect() {
    let files = compiled("proto").file;
    let ours: Vec<_> = files.iter().filter(|file| file.name().starts_with("voltour/")).collect();
    assert!(ours.len() >= 5, "{}", ours.len());
    let faults: Vec<_> = ours.into_iter().flat_map(faults).collect();
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn what_is_written_otherwise_is_found() {
    let text = "syntax = \"proto3\"; package voltour.v1;\n\
                // Said.\nmessage bad_name { string badField = 1; }\n\
                // Said.\nenum Kind { KIND_NONE = 0; OTHER = 1; }\n\
                service Tours { rpc get(bad_name) returns (bad_name); }";
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("x.proto"), text).unwrap();
    let mut compiler = protox::Compiler::new([directory.path()]).unwrap();
    compiler.include_source_info(true).open_file("x.proto").unwrap();
    let found = faults(&compiler.file_descriptor_set().file[0]).join("\n");
    for part in [
        "x.proto: not in its",
        "bad_name: is not",
        "badField: is not",
        "KIND_NONE: 0 must",
        "OTHER: must begin",
        "OTHER: has no",
        "Tours: must end",
        "Tours: has no",
        "get: is not",
        "get: must take",
    ] {
        assert!(found.contains(part), "{part} in\n{found}");
    }
    assert!(!found.contains("Kind: has no"), "{found}");
}
