//! `voltour health`: whether a running service takes calls, for what watches over it without a shell at hand.

use tonic_health::pb::HealthCheckRequest;
use tonic_health::pb::health_check_response::ServingStatus;
use tonic_health::pb::health_client::HealthClient;

use super::client::{refused, waiting};
use super::remote::Remote;
use crate::cli::Failure;
use crate::config::Span;

/// Arguments of `health`.
#[derive(Debug, clap::Args)]
#[command(after_long_help = HELP)]
pub struct Args {
    /// How long to wait for the answer
    #[arg(long, value_name = "SPAN", default_value = "3s")]
    wait: Span,
    #[command(flatten)]
    remote: Remote,
}

const HELP: &str = "\
Needs no token. Prints nothing where all is well.

Exit codes:
  0  the service takes calls
  1  it does not, or nothing answers
  2  bad arguments";

/// Runs the command.
pub async fn run(args: Args) -> Result<(), Failure> {
    let mut health = HealthClient::new(args.remote.connect().await?);
    let answer = health.check(waiting(HealthCheckRequest::default(), args.wait.0)).await;
    match answer.map_err(refused)?.into_inner().status() {
        ServingStatus::Serving => Ok(()),
        _ => Err(Failure::other("the service takes no calls now".to_owned())),
    }
}
