#![no_main]

use std::sync::Once;

#[allow(dead_code, unused_imports, reason = "the targets of the others")]
#[path = "../../tests/fuzz/targets/mod.rs"]
mod targets;

/// The library that reads models panics over some, and `load` catches it; libFuzzer's hook would end the process before that.
/// A panic that is not caught ends it all the same.
static QUIET: Once = Once::new();

libfuzzer_sys::fuzz_target!(|data: &[u8]| {
    QUIET.call_once(|| std::panic::set_hook(Box::new(|_| {})));
    targets::policy(data);
});
