//! Who calls, and which networks and chargers it may name. What it may not know of is refused in the very
//! words in which what is not there is refused.

use std::sync::Arc;

use crate::domain::{ChargerId, Grant, NetworkId, NetworkScope, Refusal, TokenHash};

/// A caller that was let in.
#[derive(Clone, Debug)]
pub struct Caller {
    grant: Arc<Grant>,
    /// None while nobody needs a token.
    pub(super) key: Option<TokenHash>,
}

impl Caller {
    pub(super) fn new(grant: Arc<Grant>, key: Option<TokenHash>) -> Self {
        Self { grant, key }
    }

    /// The networks that there are for it: what lists are filtered by.
    pub fn networks(&self) -> &NetworkScope {
        self.grant.networks()
    }

    /// Whether there is this network for it.
    pub fn sees(&self, network: &NetworkId) -> bool {
        self.networks().holds(network)
    }

    /// Whether there are things in some network that it may not touch.
    pub fn is_restricted(&self) -> bool {
        self.grant.charger().is_some() || *self.networks() != NetworkScope::All
    }

    /// For a call that names a network which must be there.
    ///
    /// # Errors
    /// For this caller there is no such network.
    pub fn network(&self, id: &NetworkId) -> Result<(), Refusal> {
        if self.sees(id) {
            return Ok(());
        }
        Err(Refusal::NotFound { what: "network", id: id.to_string() })
    }

    /// For a call that makes a network or changes it: whether it is there already makes no difference.
    ///
    /// # Errors
    /// The token is not for this network.
    pub fn put(&self, id: &NetworkId) -> Result<(), Refusal> {
        if self.sees(id) {
            return Ok(());
        }
        Err(Refusal::PermissionDenied(format!("network_id: the token is not for network {id}")))
    }

    /// For a call in the name of a charger.
    ///
    /// # Errors
    /// The caller is another charger.
    pub fn drives(&self, id: &ChargerId) -> Result<(), Refusal> {
        match self.grant.charger() {
            Some(own) if own != id => {
                let text = format!("charger_id: the token is charger {own}'s, not charger {id}'s");
                Err(Refusal::PermissionDenied(text))
            }
            _ => Ok(()),
        }
    }

    /// For a call that is about one charger or about all: a charger's own is all that there is for it.
    ///
    /// # Errors
    /// The caller is another charger.
    pub fn among(&self, asked: Option<ChargerId>) -> Result<Option<ChargerId>, Refusal> {
        asked.iter().try_for_each(|id| self.drives(id))?;
        Ok(asked.or_else(|| self.grant.charger().cloned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Role;

    fn caller(role: Role, networks: &[&str], charger: Option<&str>) -> Caller {
        let networks = NetworkScope::Only(networks.iter().map(|id| id.parse().unwrap()).collect());
        let charger = charger.map(|id| id.parse().unwrap());
        Caller::new(Arc::new(Grant::new(role, networks, charger).unwrap()), None)
    }

    #[test]
    fn another_network_is_refused_as_one_that_is_not_there() {
        let operator = caller(Role::Operator, &["north"], None);
        let (north, south) = ("north".parse().unwrap(), "south".parse().unwrap());
        assert_eq!(operator.network(&north), Ok(()));
        let missing = Refusal::NotFound { what: "network", id: "south".to_owned() };
        assert_eq!(operator.network(&south), Err(missing));
        assert!(matches!(operator.put(&south), Err(Refusal::PermissionDenied(_))));
        assert!(operator.is_restricted());
    }

    #[test]
    fn a_charger_stands_for_itself_alone() {
        let charger = caller(Role::Charger, &["north"], Some("A"));
        let (own, other): (ChargerId, ChargerId) = ("A".parse().unwrap(), "B".parse().unwrap());
        assert_eq!(charger.among(None), Ok(Some(own.clone())));
        assert_eq!(charger.among(Some(own.clone())), Ok(Some(own)));
        assert!(matches!(charger.among(Some(other)), Err(Refusal::PermissionDenied(_))));
        let operator = caller(Role::Operator, &["north"], None);
        assert_eq!(operator.among(None), Ok(None));
    }

    #[test]
    fn an_admin_of_everything_is_not_restricted() {
        let admin = Caller::new(Arc::new(Grant::ADMIN), None);
        assert!(!admin.is_restricted() && admin.sees(&"anything".parse().unwrap()));
    }
}
