//! What clients of the last release rely on, which `tests/proto/released` holds, is still there: every service, method,
//! message, field and enumeration, under its name and number, of its type. A release replaces that folder
//! (`just released`); between two nothing is taken back.

use std::collections::BTreeSet;

use prost_types::{DescriptorProto, FileDescriptorSet};
use protox::prost_reflect::{DescriptorPool, FieldDescriptor, MessageDescriptor, MethodDescriptor};

use super::{compiled, is_ours, pool};

/// A line for each thing of the released contract, with all that a client relies on.
fn promises(pool: &DescriptorPool) -> BTreeSet<String> {
    let mut promises = BTreeSet::new();
    for service in pool.services().filter(|service| is_ours(service.full_name())) {
        promises.extend(service.methods().map(|method| of_method(&method)));
    }
    for message in pool.all_messages().filter(|message| is_ours(message.full_name())) {
        promises.insert(format!("message {}", message.full_name()));
        promises.extend(message.fields().map(|field| of_field(&message, &field)));
    }
    for kind in pool.all_enums().filter(|kind| is_ours(kind.full_name())) {
        let of = |name: &str, number| format!("enum {}: {name} = {number}", kind.full_name());
        promises.extend(kind.values().map(|value| of(value.name(), value.number())));
    }
    promises
}

fn of_method(method: &MethodDescriptor) -> String {
    let stream = |is: bool| if is { "stream " } else { "" };
    let (asks, answers) =
        (stream(method.is_client_streaming()), stream(method.is_server_streaming()));
    let (input, output) = (method.input(), method.output());
    let (input, output) = (input.full_name(), output.full_name());
    format!("rpc {}({asks}{input}) returns ({answers}{output})", method.full_name())
}

fn of_field(message: &MessageDescriptor, field: &FieldDescriptor) -> String {
    let presence = if field.supports_presence() { " with presence" } else { "" };
    let (number, name, json) = (field.number(), field.name(), field.json_name());
    let oneof = field.containing_oneof();
    let oneof = oneof.filter(|oneof| !oneof.is_synthetic());
    let oneof = oneof.map(|oneof| format!(" in {}", oneof.name())).unwrap_or_default();
    format!(
        "field {}: {number} {name} ({json}) {:?} {:?}{presence}{oneof}",
        message.full_name(),
        field.cardinality(),
        field.kind()
    )
}

fn broken(released: &DescriptorPool, present: &DescriptorPool) -> Vec<String> {
    promises(released).difference(&promises(present)).cloned().collect()
}

#[test]
fn nothing_released_is_taken_back() {
    let broken = broken(&pool(compiled("tests/proto/released")), &pool(compiled("proto")));
    assert!(broken.is_empty(), "taken back since the last release:\n{}", broken.join("\n"));
}

/// The message `SubmitRequest` of a set.
fn submit(files: &mut FileDescriptorSet) -> &mut DescriptorProto {
    let mut messages = files.file.iter_mut().flat_map(|file| &mut file.message_type);
    messages.find(|message| message.name() == "SubmitRequest").unwrap()
}

type Change = fn(&mut FileDescriptorSet);

#[test]
fn whatever_is_taken_back_is_found() {
    let changes: [(&str, Change); 8] = [
        ("field voltour.v1.SubmitRequest: ", |files| {
            submit(files).field.retain(|field| field.name() != "sensor_id");
        }),
        ("field voltour.v1.SubmitRequest: ", |files| {
            submit(files).field[0].name = Some("other".to_owned());
        }),
        ("field voltour.v1.SubmitRequest: ", |files| submit(files).field[0].number = Some(99)),
        ("field voltour.v1.SubmitRequest: ", |files| submit(files).field[0].set_type(BYTES)),
        ("field voltour.v1.SubmitRequest: ", |files| submit(files).field[0].set_label(REPEATED)),
        ("enum voltour.v1.", |files| {
            let mut kinds = files.file.iter_mut().flat_map(|file| &mut file.enum_type);
            kinds.next().unwrap().value.pop();
        }),
        ("rpc voltour.v1.", |files| {
            let mut services = files.file.iter_mut().flat_map(|file| &mut file.service);
            services.next().unwrap().method.remove(0);
        }),
        ("rpc voltour.v1.", |files| {
            let mut services = files.file.iter_mut().flat_map(|file| &mut file.service);
            services.next().unwrap().method[0].server_streaming = Some(true);
        }),
    ];
    let released = pool(compiled("proto"));
    for (i, (start, change)) in changes.into_iter().enumerate() {
        let mut files = compiled("proto");
        change(&mut files);
        let broken = broken(&released, &pool(files));
        assert_eq!(broken.len(), 1, "change {i}: {broken:?}");
        assert!(broken[0].starts_with(start), "change {i}: {broken:?}");
    }
}

#[test]
fn what_is_added_breaks_nothing() {
    let mut files = compiled("proto");
    let field = submit(&mut files).field[0].clone();
    let added = prost_types::FieldDescriptorProto {
        name: Some("added".to_owned()),
        json_name: Some("added".to_owned()),
        number: Some(99),
        ..field
    };
    submit(&mut files).field.push(added);
    assert_eq!(broken(&pool(compiled("proto")), &pool(files)), [""; 0]);
}

const BYTES: prost_types::field_descriptor_proto::Type =
    prost_types::field_descriptor_proto::Type::Bytes;
const REPEATED: prost_types::field_descriptor_proto::Label =
    prost_types::field_descriptor_proto::Label::Repeated;
