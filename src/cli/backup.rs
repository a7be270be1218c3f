//! `voltour backup` and `voltour restore`: a database copied beside a running service, and put back.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::serve::block_on;
use super::{Database, Failure, say};
use crate::clock::{Clock, SystemClock};
use crate::store::{self, StoreError, Verified};

/// Arguments of `backup`.
#[derive(Debug, clap::Args)]
#[command(after_long_help = BACKUP)]
pub struct Backup {
    /// Where to
    pub file: PathBuf,
    /// Replace the file if it is there
    #[arg(long)]
    pub force: bool,
    #[command(flatten)]
    database: Database,
}

const BACKUP: &str = "\
The service goes on meanwhile. What it acknowledged before the command began is in the copy. The copy is written under
another name beside FILE, checked (every page, every reference, the schema), synced, and only then called FILE: where
there is a FILE, it is whole. It holds the hashes of tokens and every request, and is readable by its owner alone.

Examples:
  voltour backup /backup/voltour-$(date +%F).db --database /var/lib/voltour/voltour.db
  voltour backup /backup/latest.db --force --config /etc/voltour/voltour.toml

Exit codes: 0 the backup is there, 1 it could not be made, 2 the arguments are wrong or FILE is there already.";

/// Arguments of `restore`.
#[derive(Debug, clap::Args)]
#[command(after_long_help = RESTORE)]
pub struct Restore {
    /// A file that `voltour backup` made
    pub file: PathBuf,
    /// Also where there is a database: it is kept beside, under a name that ends in .before-restore- and the time
    #[arg(long)]
    pub force: bool,
    #[command(flatten)]
    database: Database,
}

const RESTORE: &str = "\
Stop the service first. The backup is copied and checked before anything else is touched. What was acknowledged after the
backup was made is not in the database then; base stations and chargers that repeat their calls store it again.

Examples:
  systemctl stop voltour
  voltour restore /backup/voltour-2026-01-31.db --force --database /var/lib/voltour/voltour.db
  systemctl start voltour

Run it as the service's user, who must be able to write the database.

Exit codes: 0 the database is the backup, 1 it could not be restored or a service runs on it, 2 the arguments are wrong,
the backup is damaged, or there is a database already.";

/// Makes a backup.
pub fn backup(args: Backup) -> Result<ExitCode, Failure> {
    let database = args.database.path()?;
    block_on(async {
        let made = store::backup(&database, &args.file, args.force).await;
        let made = made.map_err(|error| failed(&database, error))?;
        say(line(&args.file, made));
        Ok(())
    })
}

/// Puts a backup back.
pub fn restore(args: Restore) -> Result<ExitCode, Failure> {
    let database = args.database.path()?;
    block_on(async {
        let now = SystemClock.now();
        let restored = store::restore(&args.file, &database, args.force, now).await;
        let restored = restored.map_err(|error| failed(&args.file, error))?;
        say(line(&database, restored.verified));
        if let Some(aside) = restored.aside {
            say(format!("the database from before is kept as {}", aside.display()));
        }
        Ok(())
    })
}

fn line(file: &Path, found: Verified) -> String {
    let Verified { bytes, schema, requests, plans } = found;
    let file = file.display();
    format!("{file}: {bytes} bytes, schema {schema}, {requests} requests, {plans} plans; checked")
}

fn failed(file: &Path, error: StoreError) -> Failure {
    let named = match error {
        StoreError::Foreign | StoreError::Newer { .. } | StoreError::Database(_) => {
            format!("{}: {error}", file.display())
        }
        _ => error.to_string(),
    };
    match error {
        StoreError::Missing(_)
        | StoreError::Exists(_)
        | StoreError::Itself(_)
        | StoreError::Logged(_)
        | StoreError::Damaged { .. }
        | StoreError::Foreign
        | StoreError::Newer { .. } => Failure::input(named),
        _ => Failure::other(named),
    }
}
