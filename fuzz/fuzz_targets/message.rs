#![no_main]

#[allow(dead_code, unused_imports, reason = "the targets of the others")]
#[path = "../../tests/fuzz/targets/mod.rs"]
mod targets;

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    targets::message(data);
});
