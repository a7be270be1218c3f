//! The disk: its files, its folder's entries, and what is wrong with it.

use std::collections::BTreeMap;
use std::ffi::c_int;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use libsqlite3_sys::{SQLITE_FULL, SQLITE_IOERR, SQLITE_IOERR_FSYNC, SQLITE_OK, SQLITE_READONLY};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::image::{Change, Image};
use crate::vfs;

static DISKS: Mutex<Vec<Arc<Shared>>> = Mutex::new(Vec::new());

/// Watches over a folder until it is dropped.
#[derive(Debug)]
pub struct Disk(Arc<Shared>);

#[derive(Debug)]
pub(crate) struct Shared {
    root: PathBuf,
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    files: BTreeMap<PathBuf, Named>,
    operations: u64,
    cut_after: Option<u64>,
    /// What was there when the power went.
    cut: Option<BTreeMap<PathBuf, Named>>,
    fault: Option<Fault>,
    lying: bool,
}

/// What is wrong with a disk that has power.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// There is no room for anything.
    Full,
    /// Nothing may be written.
    ReadOnly,
    /// What was written cannot be synced, and nobody knows what of it is there.
    Unsynced,
}

impl Fault {
    fn code(self) -> c_int {
        match self {
            Self::Full => SQLITE_FULL,
            Self::ReadOnly => SQLITE_READONLY,
            Self::Unsynced => SQLITE_IOERR_FSYNC,
        }
    }
}

/// What goes by a name: now, and after a power cut for sure.
#[derive(Clone, Debug, Default)]
struct Named {
    now: Option<Image>,
    /// Whether the folder was synced since `now` got the name.
    is_kept: bool,
    /// What had the name when the folder was last synced, if that is not `now`.
    before: Option<Image>,
}

impl Disk {
    /// Watches over a folder. It must exist, and be named before SQLite opens anything in it.
    ///
    /// # Errors
    /// There is no such folder.
    ///
    /// # Panics
    /// SQLite refuses the layer.
    pub fn over(folder: &Path) -> io::Result<Self> {
        vfs::install();
        let shared = Shared { root: folder.canonicalize()?, state: Mutex::default() };
        let shared = Arc::new(shared);
        lock(&DISKS).push(shared.clone());
        Ok(Self(shared))
    }

    /// Cuts the power when so many more operations have been done: everything fails from then on.
    pub fn cut_after(&self, operations: u64) {
        let mut state = self.0.state();
        state.cut_after = Some(state.operations + operations);
    }

    /// Cuts the power now.
    pub fn cut(&self) {
        self.0.state().cut();
    }

    /// Whether the power is gone. What was acknowledged while it was not, must be there.
    pub fn is_cut(&self) -> bool {
        self.0.state().cut.is_some()
    }

    /// How many operations there were: writes, truncations, deletions, syncs.
    pub fn operations(&self) -> u64 {
        self.0.state().operations
    }

    /// Says from now on that everything is synced, and syncs nothing.
    pub fn lie(&self) {
        self.0.state().lying = true;
    }

    /// Has a fault from now on; none heals it.
    pub fn fail(&self, fault: Option<Fault>) {
        self.0.state().fault = fault;
    }

    /// Writes what the power cut has left into another folder. Without a seed that is what was synced and
    /// nothing more.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn survivors(&self, into: &Path, seed: Option<u64>) -> io::Result<()> {
        let state = self.0.state();
        let mut dice = seed.map(Pcg64Mcg::seed_from_u64);
        for (path, named) in state.cut.iter().flatten() {
            let name = path.strip_prefix(&self.0.root).unwrap_or(path);
            if let Some(image) = named.after_cut(dice.as_mut()) {
                fs::write(into.join(name), image.survivor(dice.as_mut()))?;
            }
        }
        Ok(())
    }
}

impl Drop for Disk {
    fn drop(&mut self) {
        lock(&DISKS).retain(|disk| !Arc::ptr_eq(disk, &self.0));
    }
}

impl Named {
    fn after_cut(&self, dice: Option<&mut Pcg64Mcg>) -> Option<&Image> {
        let kept = if self.is_kept { &self.now } else { &self.before };
        let luck = dice.is_some_and(|dice| dice.random());
        if luck { self.now.as_ref() } else { kept.as_ref() }
    }

    /// Something else, or nothing, gets the name.
    fn replace(&mut self, now: Option<Image>) {
        let before = std::mem::replace(&mut self.now, now);
        if self.is_kept {
            self.before = before;
        }
        self.is_kept = false;
    }
}

impl State {
    /// One more operation; false where the power is gone.
    fn powered(&mut self) -> bool {
        self.operations += 1;
        if self.cut_after.is_some_and(|last| self.operations > last) {
            self.cut();
        }
        self.cut.is_none()
    }

    fn cut(&mut self) {
        if self.cut.is_none() {
            self.cut = Some(self.files.clone());
        }
    }

    fn sync_folder(&mut self) {
        for named in self.files.values_mut() {
            (named.is_kept, named.before) = (true, None);
        }
    }
}

impl Shared {
    /// The disk that a file lies on.
    pub fn of(file: &Path) -> Option<Arc<Self>> {
        lock(&DISKS).iter().find(|disk| file.starts_with(&disk.root)).cloned()
    }

    /// A file is about to be opened: it is known, or found, or new. Whether it is new; none where the power is
    /// gone.
    pub fn opening(&self, file: &Path) -> Option<bool> {
        let mut state = self.state();
        if state.cut.is_some() {
            return None;
        }
        let named = state.files.entry(file.to_owned()).or_default();
        // A file that is known is not read: closing it again would drop the locks that SQLite has on it.
        if named.now.is_some() {
            return Some(false);
        }
        let found = fs::read(file).ok();
        let is_new = found.is_none();
        match found {
            Some(content) => (named.now, named.is_kept) = (Some(Image::found(content)), true),
            None => named.replace(Some(Image::default())),
        }
        Some(is_new)
    }

    /// A file's content changes.
    pub fn change(&self, file: &Path, change: Change, really: impl FnOnce() -> c_int) -> c_int {
        let mut state = self.state();
        let was_cut = state.cut.is_some();
        if !state.powered() {
            // What was being written when the power went may be there too.
            if let Some(image) =
                state.cut.as_mut().filter(|_| !was_cut).and_then(|cut| now(cut, file))
            {
                image.change(change);
            }
            return SQLITE_IOERR;
        }
        if let Some(fault) = state.fault.filter(|fault| *fault != Fault::Unsynced) {
            return fault.code();
        }
        let Some(image) = now(&mut state.files, file) else { return SQLITE_IOERR };
        let done = really();
        if done == SQLITE_OK {
            image.change(change);
        }
        done
    }

    /// A file is synced, and its folder too where that is said.
    pub fn sync(&self, file: &Path, folder: bool) -> c_int {
        let mut state = self.state();
        if !state.powered() {
            return SQLITE_IOERR;
        }
        if state.fault == Some(Fault::Unsynced) {
            return Fault::Unsynced.code();
        }
        if state.lying {
            return SQLITE_OK;
        }
        if let Some(image) = now(&mut state.files, file) {
            image.sync();
        }
        if folder {
            state.sync_folder();
        }
        SQLITE_OK
    }

    /// A file is deleted.
    pub fn delete(&self, file: &Path, folder: bool, really: impl FnOnce() -> c_int) -> c_int {
        let mut state = self.state();
        if !state.powered() {
            return SQLITE_IOERR;
        }
        let done = really();
        if done == SQLITE_OK
            && let Some(named) = state.files.get_mut(file)
        {
            named.replace(None);
        }
        if folder && !state.lying {
            state.sync_folder();
        }
        done
    }

    fn state(&self) -> MutexGuard<'_, State> {
        lock(&self.state)
    }
}

fn now<'a>(files: &'a mut BTreeMap<PathBuf, Named>, file: &Path) -> Option<&'a mut Image> {
    files.get_mut(file)?.now.as_mut()
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
