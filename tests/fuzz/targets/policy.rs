//! A policy file: loaded, or refused with the check that it does not pass.

use voltour::policy::load;

pub fn policy(data: &[u8]) -> bool {
    match load("fuzz.onnx", data, None) {
        Ok(_) => true,
        Err(error) => {
            assert!(!error.to_string().is_empty());
            false
        }
    }
}
