//! The lock file beside the database: one process at a time. The system lets go of it when the process
//! ends, however it ends.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use super::StoreError;

/// Held as long as it lives.
#[derive(Debug)]
pub(super) struct Lock {
    database: PathBuf,
    _file: File,
}

impl Lock {
    /// Takes the lock of a database.
    pub fn take(database: &Path) -> Result<Self, StoreError> {
        let lock = |database: &Path| -> PathBuf {
            let mut path = database.as_os_str().to_owned();
            path.push(".lock");
            path.into()
        };
        let failed = |path: &Path, source| StoreError::Lock { path: lock(path), source };
        let real = real(database).map_err(|source| failed(database, source))?;
        let options = File::options().create(true).truncate(false).write(true).open(lock(&real));
        let file = options.map_err(|source| failed(&real, source))?;
        match file.try_lock() {
            Ok(()) => Ok(Self { database: real, _file: file }),
            Err(TryLockError::WouldBlock) => Err(StoreError::InUse(database.to_owned())),
            Err(TryLockError::Error(source)) => Err(failed(&real, source)),
        }
    }

    /// The database by its own name, which no symbolic link is part of.
    pub fn database(&self) -> &Path {
        &self.database
    }
}

/// The name of a file, there or not, without symbolic links: a database has one lock, by whatever name it is called.
fn real(file: &Path) -> io::Result<PathBuf> {
    let missing = match file.canonicalize() {
        Err(error) if error.kind() == io::ErrorKind::NotFound => error,
        found => return found,
    };
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = folder.unwrap_or(Path::new("."));
    // A link to what is not there yet. A circle of them is another error.
    if let Ok(target) = fs::read_link(file) {
        return real(&folder.join(target));
    }
    let name = file.file_name().ok_or(missing)?;
    Ok(folder.canonicalize()?.join(name))
}
