//! API tokens: what whoever holds one may do, and where.

use std::collections::BTreeSet;
use std::fmt;
use std::str::FromStr;

use jiff::Timestamp;
use serde::{Deserialize, Serialize};

use super::{ChargerId, NetworkId, TokenId, TokenName};

/// Networks of one token at most.
const MOST_NETWORKS: usize = 100;

/// What a caller is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Role {
    /// Announces sensors, posts requests, hears of departures.
    BaseStation,
    /// Announces its own departures, fetches and reports its own tours.
    Charger,
    /// Does with networks what the command line does, reads history and metrics.
    Operator,
    /// Everything.
    Admin,
}

impl Role {
    /// Every role.
    pub const ALL: [Self; 4] = [Self::BaseStation, Self::Charger, Self::Operator, Self::Admin];

    /// As it is written everywhere.
    pub const fn name(self) -> &'static str {
        match self {
            Self::BaseStation => "base_station",
            Self::Charger => "charger",
            Self::Operator => "operator",
            Self::Admin => "admin",
        }
    }
}

impl fmt::Display for Role {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Role {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let named = Self::ALL.into_iter().find(|role| role.name() == text);
        named.ok_or_else(|| {
            let names = Self::ALL.map(Self::name).join(", ");
            format!("{text:?} must be one of {names}")
        })
    }
}

/// The networks that a caller knows of; for it there are no others.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum NetworkScope {
    /// Every one, also those to come.
    #[default]
    All,
    /// These.
    Only(BTreeSet<NetworkId>),
}

impl NetworkScope {
    /// Whether a network is one of them.
    pub fn holds(&self, id: &NetworkId) -> bool {
        match self {
            Self::All => true,
            Self::Only(ids) => ids.contains(id),
        }
    }
}

/// What a token gives its holder: a charger's names its charger, and no other does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Grant {
    role: Role,
    networks: NetworkScope,
    charger: Option<ChargerId>,
}

impl Grant {
    /// Everything, everywhere.
    pub const ADMIN: Self = Self { role: Role::Admin, networks: NetworkScope::All, charger: None };

    /// A role in these networks.
    ///
    /// # Errors
    /// A charger's grant without its charger, another's with one, or no network or too many.
    pub fn new(
        role: Role,
        networks: NetworkScope,
        charger: Option<ChargerId>,
    ) -> Result<Self, String> {
        match (&charger, role) {
            (None, Role::Charger) => {
                return Err("charger: a token of the role charger must name its charger".to_owned());
            }
            (Some(id), role) if role != Role::Charger => {
                return Err(format!("charger: {id} goes with the role charger, not with {role}"));
            }
            _ => {}
        }
        if let NetworkScope::Only(ids) = &networks
            && !(1..=MOST_NETWORKS).contains(&ids.len())
        {
            let rule = format!("must be from 1 to {MOST_NETWORKS}");
            return Err(format!("networks: {} {rule}", ids.len()));
        }
        Ok(Self { role, networks, charger })
    }

    /// What the holder is.
    pub fn role(&self) -> Role {
        self.role
    }

    /// Where.
    pub fn networks(&self) -> &NetworkScope {
        &self.networks
    }

    /// The charger that it is, if it is one.
    pub fn charger(&self) -> Option<&ChargerId> {
        self.charger.as_ref()
    }
}

/// SHA-256 of a token.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct TokenHash(pub [u8; 32]);

impl fmt::Debug for TokenHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("TokenHash")
    }
}

/// A token as it is stored: all but the token itself.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Token {
    /// Made by the service.
    pub id: TokenId,
    /// What its makers call it; unique among those that are not revoked.
    pub name: TokenName,
    /// What it gives.
    pub grant: Grant,
    /// When it was made.
    pub created_at: Timestamp,
    /// Since when it is worth nothing.
    pub revoked_at: Option<Timestamp>,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn only(ids: impl IntoIterator<Item = String>) -> NetworkScope {
        NetworkScope::Only(ids.into_iter().map(|id| id.parse().unwrap()).collect())
    }

    #[test]
    fn a_charger_and_only_a_charger_names_its_charger() {
        let truck = || Some("truck-1".parse().unwrap());
        assert!(Grant::new(Role::Charger, NetworkScope::All, truck()).is_ok());
        for (role, charger) in [(Role::Charger, None), (Role::Admin, truck())] {
            let refused = Grant::new(role, NetworkScope::All, charger).unwrap_err();
            assert!(refused.starts_with("charger: "), "{refused}");
        }
    }

    #[test]
    fn a_scope_has_networks_and_not_too_many() {
        for count in [0, 101] {
            let networks = only((0..count).map(|n| format!("n{n}")));
            let refused = Grant::new(Role::Operator, networks, None).unwrap_err();
            assert_eq!(refused, format!("networks: {count} must be from 1 to 100"));
        }
        let scope = only(["north".to_owned()]);
        let holds = |id: &str| scope.holds(&id.parse().unwrap());
        assert!(holds("north") && !holds("south") && !holds("North"));
    }

    #[test]
    fn roles_are_read_as_they_are_written() {
        for role in Role::ALL {
            assert_eq!(role.name().parse(), Ok(role));
        }
        assert!(
            "root".parse::<Role>().unwrap_err().contains("\"root\" must be one of base_station")
        );
    }
}
