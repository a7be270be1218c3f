//! Files that are there wholly or not at all, also after a power cut: written under another name, synced,
//! renamed, and the folder synced.

use std::fs::File;
use std::path::Path;

use tempfile::NamedTempFile;

use crate::store::StoreError;

/// The folder that a file lies in.
pub(super) fn folder(file: &Path) -> &Path {
    let parent = file.parent().filter(|parent| !parent.as_os_str().is_empty());
    parent.unwrap_or(Path::new("."))
}

/// An empty file beside another one, which only its owner reads: tokens' hashes and all requests stand in a
/// database. It goes when it is dropped.
pub(super) fn beside(file: &Path) -> Result<NamedTempFile, StoreError> {
    let made =
        tempfile::Builder::new().prefix(".voltour-").suffix(".part").tempfile_in(folder(file));
    made.map_err(|source| StoreError::file(file, source))
}

/// Puts a file in its place, for good; over another one only if `replace` says so.
pub(super) fn keep(part: NamedTempFile, file: &Path, replace: bool) -> Result<(), StoreError> {
    let failed = |source| StoreError::file(file, source);
    // By its name: the database wrote it through a handle of its own.
    File::open(part.path()).and_then(|part| part.sync_all()).map_err(failed)?;
    let kept = if replace { part.persist(file) } else { part.persist_noclobber(file) };
    match kept {
        Ok(_) => sync_folder(file),
        Err(error) if error.error.kind() == std::io::ErrorKind::AlreadyExists => {
            Err(StoreError::Exists(file.to_owned()))
        }
        Err(error) => Err(failed(error.error)),
    }
}

/// Makes the names in a file's folder last.
pub(super) fn sync_folder(file: &Path) -> Result<(), StoreError> {
    let synced = File::open(folder(file)).and_then(|folder| folder.sync_all());
    synced.map_err(|source| StoreError::file(file, source))
}
