//! The configuration: defaults, then a TOML file, then the environment (`VOLTOUR_SECTION__KEY`). Read
//! and checked once at the start; every error names the key, its value and the rule.

mod access;
mod load;
mod sections;
mod span;

pub use load::{ConfigError, load};
pub use sections::{
    Access, Config, Format, Grpc, Lifecycle, Limits, Log, Planning, Policy, Rest, Store, Tls,
};
pub use span::Span;
