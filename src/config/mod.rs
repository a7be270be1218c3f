//! The configuration: defaults, then a TOML file, then the environment (`VOLTOUR_SECTION__KEY`), then the command
//! line. Read and checked once at the start; every error names the key, its value and the rule.

mod access;
mod load;
mod print;
mod sections;
mod setting;
mod span;

pub use load::{ConfigError, load, load_with};
pub use print::print;
pub use sections::{
    Access, Config, Format, Grpc, Lifecycle, Limits, Log, Planning, Policy, Rest, Store, Telemetry,
    Tls,
};
pub use setting::Setting;
pub use span::Span;
