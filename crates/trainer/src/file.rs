//! Files that are whole at any moment.

use std::io::Write;
use std::path::Path;

use crate::error::{Error, Result};

/// Writes a file beside its final place and moves it there.
///
/// # Errors
/// The directory cannot be written.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<()> {
    let directory = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let write = || {
        std::fs::create_dir_all(directory)?;
        let mut file =
            tempfile::Builder::new().prefix(".").suffix(".part").tempfile_in(directory)?;
        file.write_all(bytes)?;
        file.as_file().sync_all()?;
        file.persist(path).map_err(|e| e.error)?;
        Ok(())
    };
    write().map_err(Error::file(path))
}
