//! Ids. Those that clients make are 1 to 64 of `A-Z a-z 0-9 . _ : -`; a sensor's is free text; those
//! that the service makes are UUIDv7, so that their order is that of their making.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use uuid::Uuid;

/// Why a text is no id.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{value:?} {rule}")]
pub struct IdError {
    value: String,
    rule: &'static str,
}

impl IdError {
    fn new(value: &str, rule: &'static str) -> Self {
        Self { value: value.chars().take(80).collect(), rule }
    }
}

macro_rules! text_id {
    ($(#[$doc:meta])* $name:ident, $valid:expr, $rule:literal) => {
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
        #[serde(try_from = "String", into = "String")]
        pub struct $name(String);

        impl $name {
            /// The text.
            pub fn as_str(&self) -> &str {
                &self.0
            }
        }

        impl FromStr for $name {
            type Err = IdError;

            fn from_str(text: &str) -> Result<Self, IdError> {
                let valid: fn(&str) -> bool = $valid;
                if valid(text) { Ok(Self(text.to_owned())) } else { Err(IdError::new(text, $rule)) }
            }
        }

        impl TryFrom<String> for $name {
            type Error = IdError;

            fn try_from(text: String) -> Result<Self, IdError> {
                text.parse()
            }
        }

        impl From<$name> for String {
            fn from(id: $name) -> Self {
                id.0
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(&self.0)
            }
        }
    };
}

fn plain(text: &str) -> bool {
    let allowed = |byte: u8| byte.is_ascii_alphanumeric() || b"._:-".contains(&byte);
    (1..=64).contains(&text.len()) && text.bytes().all(allowed)
}

fn free(text: &str) -> bool {
    (1..=128).contains(&text.len())
}

text_id! {
    /// A network.
    NetworkId, plain, "must be 1 to 64 of A-Z a-z 0-9 . _ : -"
}
text_id! {
    /// A charger.
    ChargerId, plain, "must be 1 to 64 of A-Z a-z 0-9 . _ : -"
}
text_id! {
    /// What a client calls one of its calls.
    ClientId, plain, "must be 1 to 64 of A-Z a-z 0-9 . _ : -"
}
text_id! {
    /// What an API token is called.
    TokenName, plain, "must be 1 to 64 of A-Z a-z 0-9 . _ : -"
}
text_id! {
    /// A sensor: free text, to be escaped wherever it is shown.
    SensorId, free, "must have 1 to 128 bytes"
}

macro_rules! uuid_id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(
            Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
        )]
        #[serde(transparent)]
        pub struct $name(pub Uuid);

        impl FromStr for $name {
            type Err = IdError;

            fn from_str(text: &str) -> Result<Self, IdError> {
                // Only the hyphenated form, so that an id has one spelling.
                match Uuid::try_parse(text) {
                    Ok(id) if text.len() == 36 => Ok(Self(id)),
                    _ => Err(IdError::new(text, "must be a UUID")),
                }
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                self.0.fmt(f)
            }
        }
    };
}

uuid_id! {
    /// A charging request.
    RequestId
}
uuid_id! {
    /// A departure.
    DepartureId
}
uuid_id! {
    /// A plan.
    PlanId
}
uuid_id! {
    /// A tour.
    TourId
}
uuid_id! {
    /// A visit report.
    VisitId
}
uuid_id! {
    /// An API token.
    TokenId
}
