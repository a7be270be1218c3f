//! The independent checker: right plans hold, and each rule broken by itself is reported where it
//! is broken.

mod coverage;
mod example;
mod mutations;
mod presets;
mod support;
