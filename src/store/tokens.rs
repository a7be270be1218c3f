//! Tokens: what the service reads of them.

use std::collections::HashMap;
use std::sync::Arc;

use sqlx::sqlite::SqliteRow;

use super::cells::Cells;
use super::{Reads, StoreError};
use crate::domain::{Grant, NetworkScope, TokenHash};

/// Tokens that are not revoked, at most.
pub(super) const MOST: i64 = 1_000;

/// How many tokens were ever made and revoked. Neither number falls, so that the same two mean the
/// same tokens.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TokenCount {
    /// Made.
    pub made: u64,
    /// Of these, revoked.
    pub revoked: u64,
}

/// The tokens that are not revoked.
#[derive(Clone, Debug, Default)]
pub struct Keys {
    /// What each gives.
    pub grants: HashMap<TokenHash, Arc<Grant>>,
    /// When they were read.
    pub count: TokenCount,
}

impl Reads {
    /// How many tokens there are.
    ///
    /// # Errors
    /// The database cannot be read.
    pub async fn token_count(&self) -> Result<TokenCount, StoreError> {
        let row = sqlx::query("SELECT count(*) AS made, count(revoked_us) AS revoked FROM tokens");
        count(&row.fetch_one(self.pool()).await?)
    }

    /// The tokens that are not revoked.
    ///
    /// # Errors
    /// The database cannot be read.
    pub async fn keys(&self) -> Result<Keys, StoreError> {
        let mut tx = self.pool().begin().await?;
        let counted = "SELECT count(*) AS made, count(revoked_us) AS revoked FROM tokens";
        let count = count(&sqlx::query(counted).fetch_one(&mut *tx).await?)?;
        let rows = sqlx::query("SELECT * FROM tokens WHERE revoked_us IS NULL LIMIT ?").bind(MOST);
        let mut grants = HashMap::new();
        for row in rows.fetch_all(&mut *tx).await? {
            grants.insert(hash(&row)?, Arc::new(grant(&row)?));
        }
        Ok(Keys { grants, count })
    }

    /// What one token gives, unless it is revoked.
    ///
    /// # Errors
    /// The database cannot be read.
    pub async fn key(&self, hash: TokenHash) -> Result<Option<Grant>, StoreError> {
        let row = sqlx::query("SELECT * FROM tokens WHERE hash = ? AND revoked_us IS NULL");
        let row = row.bind(&hash.0[..]).fetch_optional(self.pool()).await?;
        row.as_ref().map(grant).transpose()
    }
}

fn count(row: &SqliteRow) -> Result<TokenCount, StoreError> {
    let cells = Cells::new("tokens", row);
    Ok(TokenCount { made: cells.number("made")?, revoked: cells.number("revoked")? })
}

fn hash(row: &SqliteRow) -> Result<TokenHash, StoreError> {
    let bytes: &[u8] = Cells::new("tokens", row).get("hash")?;
    let bytes = bytes.try_into().map_err(|_| StoreError::row("tokens", "hash: not 32 bytes"))?;
    Ok(TokenHash(bytes))
}

/// What the token of a row gives.
pub(super) fn grant(row: &SqliteRow) -> Result<Grant, StoreError> {
    let cells = Cells::new("tokens", row);
    let networks = cells.json_or_none("networks")?.map_or(NetworkScope::All, NetworkScope::Only);
    let grant = Grant::new(cells.word("role")?, networks, cells.parsed_or_none("charger_id")?);
    grant.map_err(|reason| StoreError::row("tokens", reason))
}
