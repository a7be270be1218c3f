//! The gRPC edge: the four services of the contract on the scheduler's handle, with health and
//! reflection. Wire types are parsed here into the domain's, once, and never pass this module (the
//! command line, a client, uses the conversions too).

mod count;
mod deadline;
mod departure;
mod edge;
mod guard;
mod network;
mod page_token;
mod request;
mod server;
mod status;
mod submit_stream;
mod tour;
mod watch;
pub mod wire;

pub use edge::{Edge, Limits};
pub use server::{Server, ServerError};
pub use status::violations;

#[cfg(test)]
mod tests;
