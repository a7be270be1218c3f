#![no_main]

// Alone, so that it is built without the service.
#[path = "../../tests/fuzz/targets/scenario.rs"]
mod scenario;

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    scenario::scenario(data);
});
