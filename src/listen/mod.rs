//! Listening: with TLS or without, and no more connections at once than allowed; further ones wait in
//! the system's queue. A client that does not take what is sent to it, or does not begin to speak, loses its
//! connection.

mod connection;
mod counted;
mod opening;

pub use connection::Connection;
pub use counted::{Counted, incoming};

#[cfg(test)]
mod tests;
