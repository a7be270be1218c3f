//! A copy of a database as it is at one moment, whether or not a service is at work on it.

use std::path::Path;

use sqlx::Connection;

use super::durable;
use super::verify::{Verified, verify};
use crate::store::lock::Lock;
use crate::store::{StoreError, open, schema};

/// Copies a database into one file, which is there only once it is whole, checked and synced. A running
/// service goes on meanwhile; what it acknowledged before the call is in the copy.
///
/// # Errors
/// There is no database, or none that this program knows; the file exists and is not to be replaced, or
/// is the database itself; it cannot be written; or the copy does not pass its check.
pub async fn backup(database: &Path, file: &Path, replace: bool) -> Result<Verified, StoreError> {
    if !database.exists() {
        return Err(StoreError::Missing(database.to_owned()));
    }
    if file.exists() {
        if !replace {
            return Err(StoreError::Exists(file.to_owned()));
        }
        let real = |path: &Path| path.canonicalize().map_err(|e| StoreError::file(path, e));
        if real(file)? == real(database)? {
            return Err(StoreError::Itself(file.to_owned()));
        }
    }
    // Where no service runs, none may start and change the schema in the middle.
    let _lock = match Lock::take(database) {
        Ok(lock) => Some(lock),
        Err(StoreError::InUse(_)) => None,
        Err(error) => return Err(error),
    };
    let part = durable::beside(file)?;
    let mut conn = open::connect(database, false).await?;
    schema::version(&mut conn).await?;
    // One statement, and so one moment of the database.
    let into = sqlx::query("VACUUM INTO ?").bind(part.path().to_string_lossy().into_owned());
    into.execute(&mut conn).await?;
    conn.close().await?;
    let verified = verify(part.path()).await?;
    durable::sync(&part, file)?;
    durable::put(part, file, replace)?;
    durable::sync_folder(file)?;
    Ok(verified)
}
