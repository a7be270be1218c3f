//! A length of time as the configuration and the command line spell it: `2s`, `10m`, `1h 30m`.

use std::fmt;
use std::str::FromStr;
use std::time::Duration;

use jiff::{SignedDuration, SpanRelativeTo};
use serde::{Deserialize, Serialize, Serializer};

/// A length of time, at least 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(try_from = "String")]
pub struct Span(pub Duration);

impl Span {
    /// So many seconds.
    pub const fn seconds(seconds: u64) -> Self {
        Self(Duration::from_secs(seconds))
    }
}

impl FromStr for Span {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        // A day has 24 hours wherever one is.
        let span: Option<jiff::Span> = text.parse().ok();
        let parsed: Option<SignedDuration> =
            span.and_then(|span| span.to_duration(SpanRelativeTo::days_are_24_hours()).ok());
        let duration = parsed.and_then(|span| Duration::try_from(span).ok());
        duration.map(Self).ok_or_else(|| {
            format!("{text:?} must be a length of time such as 500ms, 2s, 10m, 1h 30m or 90d")
        })
    }
}

impl TryFrom<String> for Span {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl Serialize for Span {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl fmt::Display for Span {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match SignedDuration::try_from(self.0) {
            Ok(span) => write!(f, "{span:#}"),
            Err(_) => write!(f, "{} s", self.0.as_secs()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_what_people_write() {
        let expected = [("2s", 2_000), ("10m", 600_000), ("1h 30m", 5_400_000), ("500ms", 500)];
        for (text, millis) in expected {
            assert_eq!(text.parse(), Ok(Span(Duration::from_millis(millis))), "{text}");
        }
        assert_eq!("90d".parse(), Ok(Span::seconds(90 * 86_400)));
        for text in ["", "5", "-2s", "soon", "2 fortnights"] {
            assert!(text.parse::<Span>().is_err(), "{text}");
        }
        assert_eq!(Span::seconds(90).to_string(), "1m 30s");
    }
}
