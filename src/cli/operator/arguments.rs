//! Arguments that several commands take.

use std::str::FromStr;

use jiff::Timestamp;

use super::remote::Remote;
use crate::cli::Failure;
use crate::clock::{Clock, Ids, SystemClock, plus};
use crate::config::Span;
use crate::domain::ClientId;

/// Where the service is, and how to answer.
#[derive(Clone, Debug, clap::Args)]
pub struct Common {
    #[command(flatten)]
    pub remote: Remote,
    /// Print JSON: one object a line
    #[arg(long)]
    pub json: bool,
}

/// The caller's id for a call.
#[derive(Clone, Debug, clap::Args)]
pub struct Caller {
    /// Id of this call, so that it can be repeated safely; a fresh one if left out
    #[arg(long, value_name = "ID")]
    pub client_id: Option<ClientId>,
}

impl Caller {
    /// As given, or a fresh one.
    pub fn id(&self) -> Result<ClientId, Failure> {
        match &self.client_id {
            Some(id) => Ok(id.clone()),
            None => fresh_id(),
        }
    }
}

/// A client id that nobody has used before.
pub fn fresh_id() -> Result<ClientId, Failure> {
    let id = Ids::default().next(SystemClock.now()).to_string();
    id.parse().map_err(|error| Failure::other(format!("client id: {error}")))
}

/// So long from now.
pub fn from_now(span: Span) -> Timestamp {
    plus(SystemClock.now(), span.0)
}

/// A place in the plane, as `X,Y`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point(pub [f64; 2]);

impl FromStr for Point {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |text: &str| text.trim().parse().ok().filter(|value: &f64| value.is_finite());
        let parts = text.split_once(',').and_then(|(x, y)| number(x).zip(number(y)));
        parts
            .map(|(x, y)| Self([x, y]))
            .ok_or_else(|| format!("{text:?} must be two numbers in metres, such as 12.5,40"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_is_two_numbers() {
        assert_eq!("12.5, -40".parse(), Ok(Point([12.5, -40.0])));
        for text in ["", "1", "1,2,3", "a,b", "1,inf", "NaN,0"] {
            assert!(text.parse::<Point>().is_err(), "{text}");
        }
    }
}
