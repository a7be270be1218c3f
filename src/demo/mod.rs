//! The demonstration: a service of its own, and a base station and a charger that are played against
//! it over gRPC in fast motion.

use crate::cli::Failure;
use crate::config::Config;

/// Runs until Ctrl-C, or until so many departures are over.
///
/// # Errors
/// The service did not start, or refused what should have been right.
pub async fn run(_config: Option<Config>, _departures: Option<u32>) -> Result<(), Failure> {
    Err(Failure::other("the demonstration is not there yet"))
}
