//! Putting a backup in the place of a database on which no service runs.

use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use jiff::Timestamp;
use tempfile::NamedTempFile;

use super::durable;
use super::verify::{Verified, verify};
use crate::store::lock::Lock;
use crate::store::{StoreError, open};

/// What came of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Restored {
    /// The database as it is now.
    pub verified: Verified,
    /// Where the one before lies now.
    pub aside: Option<PathBuf>,
}

/// Makes a backup the database. The copy is checked before anything is touched; a database that is there
/// is kept aside, under a name with the time `now`, if `replace` allows it.
///
/// # Errors
/// The backup is not there, is damaged, is not voltour's or of a later version than this program knows; a
/// service has the database open; there is one and it is not to be replaced; or files cannot be written.
pub async fn restore(
    backup: &Path,
    database: &Path,
    replace: bool,
    now: Timestamp,
) -> Result<Restored, StoreError> {
    if !backup.exists() {
        return Err(StoreError::Missing(backup.to_owned()));
    }
    // The copy of a database without its log would look whole, and lack what was acknowledged last.
    let log = with(backup, "-wal");
    if fs::metadata(&log).is_ok_and(|log| log.len() > 0) {
        return Err(StoreError::Logged(log));
    }
    let lock = Lock::take(database)?;
    let database = lock.database();
    if database.exists() && !replace {
        return Err(StoreError::Exists(database.to_owned()));
    }
    let part = durable::copied(backup, database)?;
    let verified = verify(part.path()).await.map_err(|error| of(backup, error))?;
    durable::sync(&part, database)?;
    fold(database).await;
    let aside = keep_aside(database, now)?;
    match put(part, database, replace, aside.as_deref()) {
        Ok(()) => Ok(Restored { verified, aside }),
        Err(cause) => Err(match aside {
            Some(aside) => StoreError::SetAside { aside, cause: Box::new(cause) },
            None => cause,
        }),
    }
}

/// Writes the log that a crash has left into its database, which is whole without it then. Where that cannot be done,
/// the database is no good to any service: both are kept aside as they are.
async fn fold(database: &Path) {
    if fs::metadata(with(database, "-wal")).is_ok_and(|log| log.len() > 0)
        && let Ok(conn) = open::connect(database, false).await
        && let Err(error) = open::close(conn).await
    {
        tracing::debug!(%error, "the log stays beside the database");
    }
}

/// Gives a database another name, which it keeps, with its log; also a log that was left alone.
pub(super) fn keep_aside(database: &Path, now: Timestamp) -> Result<Option<PathBuf>, StoreError> {
    let aside = with(database, &format!(".before-restore-{}", now.strftime("%Y%m%dT%H%M%SZ")));
    let mut kept = false;
    for end in ["", "-wal"] {
        kept |= did(fs::hard_link(with(database, end), with(&aside, end)), &aside)?;
    }
    durable::sync_folder(database)?;
    Ok(kept.then_some(aside))
}

/// Puts the copy over the database: there is always one, whatever cuts this short. The log goes before, for it would
/// be taken for the copy's.
fn put(
    part: NamedTempFile,
    database: &Path,
    replace: bool,
    aside: Option<&Path>,
) -> Result<(), StoreError> {
    let replaced = ["-wal", "-shm"]
        .into_iter()
        .try_for_each(|end| did(fs::remove_file(with(database, end)), database).map(drop));
    let replaced = replaced.and_then(|()| durable::sync_folder(database));
    if let Err(error) = replaced.and_then(|()| durable::put(part, database, replace)) {
        // The database from before is still there, and gets its log back; where it cannot, the error says where both lie.
        if let Some(aside) = aside {
            let _ = fs::hard_link(with(aside, "-wal"), with(database, "-wal"));
        }
        return Err(error);
    }
    durable::sync_folder(database)
}

/// Whether there was anything to do it with.
fn did(done: std::io::Result<()>, file: &Path) -> Result<bool, StoreError> {
    match done {
        Ok(()) => Ok(true),
        Err(error) if error.kind() == ErrorKind::NotFound => Ok(false),
        Err(error) => Err(StoreError::file(file, error)),
    }
}

/// Names the file that was given, not the copy of it that was looked at.
fn of(backup: &Path, error: StoreError) -> StoreError {
    match error {
        StoreError::Damaged { reason, .. } => StoreError::damaged(backup, reason),
        StoreError::Database(error) => StoreError::damaged(backup, error),
        error => error,
    }
}

fn with(file: &Path, end: &str) -> PathBuf {
    let mut name = file.as_os_str().to_owned();
    name.push(end);
    name.into()
}
