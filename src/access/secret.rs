//! Tokens as their holders have them: made here, shown once, kept nowhere.

use std::fmt;

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;
use serde::{Deserialize, Serialize, Serializer};
use sha2::{Digest, Sha256};

use crate::domain::TokenHash;

/// So that one that got lost in a log or a repository is recognised.
const PREFIX: &str = "voltour_";
/// Random bytes of one that is made here.
const BYTES: usize = 32;
/// Characters of one that somebody else has made: enough that it cannot be guessed if it is random.
const LEAST: usize = 32;
/// No header is longer than that for a token's sake.
const MOST: usize = 256;

const MASK: &str = "********";

/// A token. It is never printed by accident: its debug form is a mask, and so is what serde makes of it.
#[derive(Clone, PartialEq, Eq, Deserialize)]
#[serde(try_from = "String")]
pub struct Secret(String);

impl Secret {
    /// A new one of 256 random bits.
    ///
    /// # Errors
    /// The system has no randomness to give.
    pub fn random() -> Result<Self, getrandom::Error> {
        let mut bytes = [0; BYTES];
        getrandom::fill(&mut bytes)?;
        Ok(Self(format!("{PREFIX}{}", URL_SAFE_NO_PAD.encode(bytes))))
    }

    /// What is stored of it. It is random, so that no salt and no slow hash is needed; and to look it up by
    /// its hash tells whoever measures the time nothing about it, for nobody can choose a hash.
    pub fn hash(&self) -> TokenHash {
        TokenHash(Sha256::digest(self.0.as_bytes()).into())
    }

    /// The token itself, for its one showing and for the header.
    pub fn reveal(&self) -> &str {
        &self.0
    }
}

impl TryFrom<String> for Secret {
    type Error = String;

    /// The characters are those that may follow `Bearer` (RFC 6750, 2.1).
    fn try_from(text: String) -> Result<Self, String> {
        let allowed = |byte: u8| byte.is_ascii_alphanumeric() || b"-._~+/=".contains(&byte);
        // What it is instead is not said: it may be a token with one character too many.
        if (LEAST..=MOST).contains(&text.len()) && text.bytes().all(allowed) {
            Ok(Self(text))
        } else {
            Err(format!("a token must have {LEAST} to {MOST} of A-Z a-z 0-9 - . _ ~ + / ="))
        }
    }
}

impl std::str::FromStr for Secret {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        text.to_owned().try_into()
    }
}

impl fmt::Debug for Secret {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(MASK, f)
    }
}

impl Serialize for Secret {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(MASK)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_are_never_the_same_and_neither_is_printed() {
        let (one, other) = (Secret::random().unwrap(), Secret::random().unwrap());
        assert_ne!(one.hash(), other.hash());
        assert_eq!(one.reveal().len(), PREFIX.len() + 43);
        assert_eq!(one.reveal().parse(), Ok(one.clone()));
        assert_eq!(format!("{one:?}"), "\"********\"");
        assert_eq!(serde_json::to_string(&one).unwrap(), "\"********\"");
    }

    #[test]
    fn a_bad_one_is_refused_without_being_shown() {
        for text in
            ["", "short", &"x".repeat(257), &format!("{} {}", "x".repeat(20), "y".repeat(20))]
        {
            let refused = text.parse::<Secret>().unwrap_err();
            assert!(refused.contains("32 to 256") && !refused.contains("xx"), "{refused}");
        }
    }
}
