//! The command line's way to make tokens and to revoke them.
//!
//! The command line may change this one table beside a running service: nothing that the service keeps
//! in mind for its commands is in it, and SQLite lets one transaction write after the other.

use std::path::Path;

use jiff::Timestamp;
use sqlx::sqlite::SqliteRow;
use sqlx::{Connection, SqliteConnection};

use super::cells::{Cells, text};
use super::lock::Lock;
use super::tokens::{MOST, grant};
use super::words::Word;
use super::{StoreError, open, schema};
use crate::domain::{NetworkScope, Token, TokenHash, TokenName};

/// The tokens of a database, for the command line.
#[derive(Debug)]
pub struct TokenFile {
    conn: SqliteConnection,
    /// Held where no service has the database open, so that none starts in the middle.
    lock: Option<Lock>,
}

impl TokenFile {
    /// Opens the database beside a running service, or by itself. Where there is none it is made if
    /// `make` says so.
    ///
    /// # Errors
    /// There is none and none is to be made, it cannot be opened or brought up to date, or a service of
    /// an earlier version runs on it.
    pub async fn open(path: &Path, make: bool) -> Result<Self, StoreError> {
        if !make && !path.exists() {
            return Err(StoreError::Missing(path.to_owned()));
        }
        let lock = match Lock::take(path) {
            Ok(lock) => Some(lock),
            Err(StoreError::InUse(_)) => None,
            Err(error) => return Err(error),
        };
        let mut conn = open::connect(path, lock.is_some()).await?;
        if lock.is_some() {
            schema::bring_up(&mut conn).await?;
        } else {
            // The schema of a running service is the service's to change.
            let found =
                "SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name = 'tokens'";
            let found: i64 = sqlx::query_scalar(found).fetch_one(&mut conn).await?;
            if found == 0 {
                return Err(StoreError::Older(path.to_owned()));
            }
        }
        Ok(Self { conn, lock })
    }

    /// Whether a service has the database open.
    pub fn is_served(&self) -> bool {
        self.lock.is_none()
    }

    /// Stores a new token; false where another one has its name.
    ///
    /// # Errors
    /// The database cannot be written, or holds as many tokens as there may be.
    pub async fn add(&mut self, token: &Token, hash: TokenHash) -> Result<bool, StoreError> {
        let mut tx = self.conn.begin_with("BEGIN IMMEDIATE").await?;
        let active = "SELECT count(*) FROM tokens WHERE revoked_us IS NULL";
        let active: i64 = sqlx::query_scalar(active).fetch_one(&mut *tx).await?;
        if active >= MOST {
            return Err(StoreError::Full { what: "tokens that are not revoked", most: MOST });
        }
        let Token { id, name, grant, created_at, .. } = token;
        let networks = match grant.networks() {
            NetworkScope::All => None,
            NetworkScope::Only(ids) => Some(text(ids)),
        };
        let added = sqlx::query(
            "INSERT INTO tokens (id, name, hash, role, networks, charger_id, created_us) \
             VALUES (?, ?, ?, ?, ?, ?, ?) ON CONFLICT (name) WHERE revoked_us IS NULL DO NOTHING",
        )
        .bind(id.to_string())
        .bind(name.as_str())
        .bind(&hash.0[..])
        .bind(grant.role().word())
        .bind(networks)
        .bind(grant.charger().map(|id| id.as_str()))
        .bind(created_at.as_microsecond())
        .execute(&mut *tx)
        .await?;
        tx.commit().await?;
        Ok(added.rows_affected() == 1)
    }

    /// Revokes a token; false where none that is not revoked has this name.
    ///
    /// # Errors
    /// The database cannot be written.
    pub async fn revoke(&mut self, name: &TokenName, now: Timestamp) -> Result<bool, StoreError> {
        let update = "UPDATE tokens SET revoked_us = ? WHERE name = ? AND revoked_us IS NULL";
        let update = sqlx::query(update).bind(now.as_microsecond()).bind(name.as_str());
        Ok(update.execute(&mut self.conn).await?.rows_affected() > 0)
    }

    /// The tokens, oldest first; the newest thousand of the revoked ones too if they are asked for.
    ///
    /// # Errors
    /// The database cannot be read.
    pub async fn list(&mut self, revoked: bool) -> Result<Vec<Token>, StoreError> {
        let rows = sqlx::query(
            "SELECT * FROM tokens WHERE revoked_us IS NULL UNION ALL SELECT * FROM \
             (SELECT * FROM tokens WHERE revoked_us IS NOT NULL AND ? ORDER BY id DESC LIMIT ?) \
             ORDER BY id",
        );
        let rows = rows.bind(revoked).bind(MOST).fetch_all(&mut self.conn).await?;
        rows.iter().map(token).collect()
    }

    /// Closes the database.
    ///
    /// # Errors
    /// What was written last could not be.
    pub async fn close(self) -> Result<(), StoreError> {
        Ok(self.conn.close().await?)
    }
}

fn token(row: &SqliteRow) -> Result<Token, StoreError> {
    let cells = Cells::new("tokens", row);
    Ok(Token {
        id: cells.parsed("id")?,
        name: cells.parsed("name")?,
        grant: grant(row)?,
        created_at: cells.time("created_us")?,
        revoked_at: cells.time_or_none("revoked_us")?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clock::{Clock, Ids, SystemClock};
    use crate::domain::{Grant, Role, TokenId};
    use crate::store::TokenCount;
    use crate::store::fixture::Bench;

    fn named(name: &str, role: Role, networks: &[&str], charger: Option<&str>) -> Token {
        let ids = networks.iter().map(|id| id.parse().unwrap());
        let charger = charger.map(|id| id.parse().unwrap());
        let now = SystemClock.now();
        Token {
            id: TokenId(Ids::default().next(now)),
            name: name.parse().unwrap(),
            grant: Grant::new(role, NetworkScope::Only(ids.collect()), charger).unwrap(),
            created_at: now,
            revoked_at: None,
        }
    }

    #[tokio::test]
    async fn a_token_is_made_beside_a_running_service_and_revoked_for_good() {
        let bench = Bench::new().await;
        let reads = &bench.store.reads;
        assert_eq!(reads.token_count().await.unwrap(), TokenCount::default());
        let mut file = TokenFile::open(&bench.path(), false).await.unwrap();
        assert!(file.is_served());
        let (truck, hash) = (named("t", Role::Charger, &["n", "m"], Some("c")), TokenHash([7; 32]));
        assert!(file.add(&truck, hash).await.unwrap());
        assert!(!file.add(&truck, TokenHash([8; 32])).await.unwrap(), "the name is taken");
        assert_eq!(file.list(false).await.unwrap(), std::slice::from_ref(&truck));
        assert_eq!(reads.key(hash).await.unwrap(), Some(truck.grant.clone()));
        assert_eq!(*reads.keys().await.unwrap().grants[&hash], truck.grant);
        assert_eq!(reads.key(TokenHash([8; 32])).await.unwrap(), None);
        assert!(file.revoke(&truck.name, SystemClock.now()).await.unwrap());
        assert!(!file.revoke(&truck.name, SystemClock.now()).await.unwrap(), "it is already");
        assert_eq!(reads.key(hash).await.unwrap(), None);
        assert!(reads.keys().await.unwrap().grants.is_empty());
        assert_eq!(reads.token_count().await.unwrap(), TokenCount { made: 1, revoked: 1 });
        assert!(file.list(false).await.unwrap().is_empty());
        assert!(file.list(true).await.unwrap()[0].revoked_at.is_some());
        // Its name is free again.
        let next = named("t", Role::Admin, &["n"], None);
        assert!(file.add(&next, TokenHash([9; 32])).await.unwrap());
    }

    #[tokio::test]
    async fn a_database_is_made_for_its_first_token_and_for_nothing_else() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("new.db");
        assert!(matches!(TokenFile::open(&path, false).await, Err(StoreError::Missing(_))));
        assert!(!path.exists());
        let file = TokenFile::open(&path, true).await.unwrap();
        assert!(!file.is_served());
        file.close().await.unwrap();
        assert!(TokenFile::open(&path, false).await.is_ok());
    }
}
