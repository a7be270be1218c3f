//! The gate: who a call comes from, and whether that caller may make it.
//!
//! The tokens are held in mind and compared with the database twice a second, so that no call waits for
//! the database; one that is not known here is looked up there, so that a new token holds at once. As
//! long as there never was one, and none is configured, nobody needs one; from the first on everybody
//! does, also after the last was revoked.

use std::future::Future;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use axum::http::HeaderMap;
use axum::http::header::AUTHORIZATION;
use tokio::sync::watch;
use tokio_util::sync::CancellationToken;

use super::table::Who;
use super::{Caller, Secret, bearer};
use crate::domain::{Grant, NetworkScope, Refusal, TokenHash};
use crate::store::{Keys, Reads, StoreError};

/// A token that is revoked is worth nothing after so long.
const LOOK: Duration = Duration::from_millis(500);

const NONE: &str = "a token is needed, as `authorization: Bearer TOKEN`; \
                    `voltour token create` makes one on the service's machine";
const UNKNOWN: &str = "the token is not known here, or was revoked";

/// Lets callers in; cheap to clone.
#[derive(Clone, Debug)]
pub struct Gate {
    reads: Reads,
    keys: watch::Sender<Arc<Keys>>,
    /// There was a token. A database that somebody else has emptied opens nothing.
    closed: Arc<AtomicBool>,
    bootstrap: Option<TokenHash>,
}

impl Gate {
    /// Reads the tokens. That one which is configured is an admin's for all networks.
    ///
    /// # Errors
    /// The database cannot be read.
    pub async fn open(reads: Reads, bootstrap: Option<&Secret>) -> Result<Self, StoreError> {
        let keys = watch::Sender::new(Arc::new(reads.keys().await?));
        let closed = AtomicBool::new(bootstrap.is_some() || keys.borrow().count.made > 0);
        let bootstrap = bootstrap.map(Secret::hash);
        Ok(Self { reads, keys, closed: Arc::new(closed), bootstrap })
    }

    /// Whether calls need a token.
    pub fn is_closed(&self) -> bool {
        self.closed.load(Ordering::Relaxed)
    }

    /// The caller of a call; none where anybody may make it.
    ///
    /// # Errors
    /// There is no token, or no good one, or its holder may not make this call.
    pub async fn admit(&self, who: Who, headers: &HeaderMap) -> Result<Option<Caller>, Refusal> {
        if who == Who::Anybody {
            return Ok(None);
        }
        if !self.is_closed() {
            return Ok(Some(Caller::new(Arc::new(Grant::ADMIN), None)));
        }
        let refused = |why: &str| Refusal::Unauthenticated(why.to_owned());
        let none = if headers.contains_key(AUTHORIZATION) { UNKNOWN } else { NONE };
        let hash = bearer::token(headers).ok_or_else(|| refused(none))?.hash();
        let grant = self.grant(hash).await?.ok_or_else(|| refused(UNKNOWN))?;
        allowed(who, &grant)?;
        Ok(Some(Caller::new(grant, Some(hash))))
    }

    /// Ends once the caller would not be let in any more: a stream that it holds open ends then.
    pub fn revoked(&self, caller: &Caller) -> impl Future<Output = ()> + Send + use<> {
        let (key, bootstrap) = (caller.key, self.bootstrap);
        let mut keys = self.keys.subscribe();
        async move {
            let gone = |keys: &Arc<Keys>| match key {
                Some(key) => bootstrap != Some(key) && !keys.grants.contains_key(&key),
                None => keys.count.made > 0,
            };
            if keys.wait_for(gone).await.is_err() {
                // The service ends, which streams hear of by another way.
                std::future::pending::<()>().await;
            }
        }
    }

    /// Follows the database until it is stopped.
    pub async fn follow(self, stop: CancellationToken) {
        let mut fails = false;
        loop {
            tokio::select! {
                () = stop.cancelled() => return,
                () = tokio::time::sleep(LOOK) => {}
            }
            match self.look().await {
                Ok(()) => fails = false,
                Err(error) if !fails => {
                    tracing::warn!(%error, "the tokens cannot be read; those known go on holding");
                    fails = true;
                }
                Err(_) => {}
            }
        }
    }

    async fn look(&self) -> Result<(), StoreError> {
        let count = self.reads.token_count().await?;
        if count != self.keys.borrow().count {
            let keys = self.reads.keys().await?;
            if keys.count.made > 0 {
                self.closed.store(true, Ordering::Relaxed);
            }
            tracing::info!(tokens = keys.grants.len(), "the tokens have changed");
            self.keys.send_replace(Arc::new(keys));
        }
        Ok(())
    }

    async fn grant(&self, hash: TokenHash) -> Result<Option<Arc<Grant>>, Refusal> {
        if self.bootstrap == Some(hash) {
            return Ok(Some(Arc::new(Grant::ADMIN)));
        }
        if let Some(grant) = self.keys.borrow().grants.get(&hash) {
            return Ok(Some(grant.clone()));
        }
        let failed = |error: StoreError| {
            tracing::warn!(%error, "a token cannot be looked up");
            Refusal::Unavailable("the tokens cannot be read now; try again".to_owned())
        };
        let Some(grant) = self.reads.key(hash).await.map_err(failed)? else { return Ok(None) };
        // What streams go by must know it too.
        self.look().await.map_err(failed)?;
        Ok(Some(Arc::new(grant)))
    }
}

fn allowed(who: Who, grant: &Grant) -> Result<(), Refusal> {
    let (roles, everywhere) = match who {
        Who::Anybody | Who::Holders => return Ok(()),
        Who::Roles(roles) => (roles, false),
        Who::Everywhere(roles) => (roles, true),
    };
    let role = grant.role();
    if !roles.contains(&role) {
        let names: Vec<_> = roles.iter().map(|role| role.name()).collect();
        let names = names.join(", ");
        let text = format!("the token's role is {role}; this is for {names}");
        return Err(Refusal::PermissionDenied(text));
    }
    if everywhere && *grant.networks() != NetworkScope::All {
        let text = "this tells of all networks, and the token is not for all".to_owned();
        return Err(Refusal::PermissionDenied(text));
    }
    Ok(())
}
