//! Files that are there wholly or not at all, also after a power cut: written under another name, synced,
//! renamed, and the folder synced.

use std::fs::File;
use std::io;
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

/// The bytes of another file in such a one, and nothing else of it: neither its mode nor its owner.
pub(super) fn copied(from: &Path, file: &Path) -> Result<NamedTempFile, StoreError> {
    let part = beside(file)?;
    let mut source = File::open(from).map_err(|source| StoreError::file(from, source))?;
    let copied = io::copy(&mut source, &mut part.as_file());
    copied.map_err(|source| StoreError::file(from, source))?;
    Ok(part)
}

/// Makes what is in a file last.
pub(super) fn sync(part: &NamedTempFile, file: &Path) -> Result<(), StoreError> {
    // By its name: the database wrote it through a handle of its own.
    let synced = File::open(part.path()).and_then(|part| part.sync_all());
    synced.map_err(|source| StoreError::file(file, source))
}

/// Puts a synced file in its place; over another one only if `replace` says so.
pub(super) fn put(part: NamedTempFile, file: &Path, replace: bool) -> Result<(), StoreError> {
    let put = if replace { part.persist(file) } else { part.persist_noclobber(file) };
    match put {
        Ok(_) => Ok(()),
        Err(error) if error.error.kind() == io::ErrorKind::AlreadyExists => {
            Err(StoreError::Exists(file.to_owned()))
        }
        Err(error) => Err(StoreError::file(file, error.error)),
    }
}

/// Makes the names in a file's folder last.
pub(super) fn sync_folder(file: &Path) -> Result<(), StoreError> {
    let synced = File::open(folder(file)).and_then(|folder| folder.sync_all());
    synced.map_err(|source| StoreError::file(file, source))
}
