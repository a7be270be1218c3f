//! What is wrong with the database or the disk below it: what lasts until somebody does something about it.

use std::fmt;
use std::io::ErrorKind;

use super::StoreError;
use crate::domain::Refusal;

/// What is wrong, for as long as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trouble {
    /// There is no room on its disk.
    Full,
    /// It may not be written.
    ReadOnly,
    /// Another process writes it, and does not stop.
    Locked,
    /// It does not hold what it held, or is no database any more.
    Damaged,
    /// Its disk fails otherwise.
    Failing,
}

impl Trouble {
    /// The trouble behind an error; none where the command or the row is to blame.
    pub fn of(error: &StoreError) -> Option<Self> {
        match error {
            StoreError::Database(sqlx::Error::Database(inner)) => {
                Self::of_code(inner.code()?.parse().ok()?)
            }
            StoreError::Database(sqlx::Error::Io(error))
            | StoreError::File { source: error, .. }
            | StoreError::Lock { source: error, .. } => Some(match error.kind() {
                ErrorKind::StorageFull | ErrorKind::QuotaExceeded => Self::Full,
                ErrorKind::ReadOnlyFilesystem | ErrorKind::PermissionDenied => Self::ReadOnly,
                _ => Self::Failing,
            }),
            StoreError::Database(sqlx::Error::WorkerCrashed) => Some(Self::Failing),
            StoreError::Troubled(trouble) => Some(*trouble),
            StoreError::Verification(_) | StoreError::Damaged { .. } | StoreError::Foreign => {
                Some(Self::Damaged)
            }
            _ => None,
        }
    }

    /// By SQLite's result code, of which the last byte says what kind it is.
    fn of_code(code: i32) -> Option<Self> {
        const BUSY: i32 = 5;
        const LOCKED: i32 = 6;
        const NO_MEMORY: i32 = 7;
        const READ_ONLY: i32 = 8;
        const IO: i32 = 10;
        const CORRUPT: i32 = 11;
        const FULL: i32 = 13;
        const CANNOT_OPEN: i32 = 14;
        const PROTOCOL: i32 = 15;
        const NOT_A_DATABASE: i32 = 26;
        match code & 0xff {
            FULL => Some(Self::Full),
            READ_ONLY => Some(Self::ReadOnly),
            BUSY | LOCKED | PROTOCOL => Some(Self::Locked),
            CORRUPT | NOT_A_DATABASE => Some(Self::Damaged),
            IO | CANNOT_OPEN | NO_MEMORY => Some(Self::Failing),
            _ => None,
        }
    }

    /// What the callers hear whose commands were not acknowledged.
    pub fn refusal(self) -> Refusal {
        let stored = match self {
            // A commit whose sync failed may have been kept all the same; its id finds it.
            Self::Failing => "perhaps nothing was stored: try again under the same id",
            _ => "nothing was stored: try again",
        };
        let reason = format!("{self}, {stored}");
        match self {
            Self::Full => Refusal::exhausted("the space on the disk", reason),
            _ => Refusal::Unavailable(reason),
        }
    }
}

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Full => "the disk of the database is full",
            Self::ReadOnly => "the database may not be written",
            Self::Locked => "another process holds the database locked",
            Self::Damaged => "the database is damaged",
            Self::Failing => "the disk of the database fails",
        })
    }
}
