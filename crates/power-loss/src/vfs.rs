//! SQLite's view of the layer: a file system that passes every call on to the machine's, and tells the disk of
//! those that change something. It becomes SQLite's default; files that lie on no disk pass untouched.

use std::ffi::{CStr, OsStr, c_char, c_int, c_void};
use std::os::unix::ffi::OsStrExt;
use std::path::{Path, PathBuf};
use std::sync::{Arc, OnceLock};

use libsqlite3_sys::{
    SQLITE_IOERR, SQLITE_OK, SQLITE_OPEN_MAIN_DB, SQLITE_OPEN_MAIN_JOURNAL, SQLITE_OPEN_WAL,
    sqlite3_file, sqlite3_io_methods, sqlite3_vfs, sqlite3_vfs_find, sqlite3_vfs_register,
};

use crate::disk::Shared;
use crate::image::Change;

/// A file as SQLite holds it. The machine's own follows right behind it in the memory that SQLite gives.
#[repr(C)]
struct File {
    methods: *const sqlite3_io_methods,
    /// None for a file that lies on no disk.
    on_disk: *mut OnDisk,
}

struct OnDisk {
    disk: Arc<Shared>,
    path: PathBuf,
    /// A log or journal that was just made: SQLite syncs its folder with its first sync.
    is_new: bool,
}

/// The machine's file system.
struct Machine(*mut sqlite3_vfs);

// SAFETY: SQLite's own file systems may be called from every thread, and are never taken away.
unsafe impl Send for Machine {}
// SAFETY: as above.
unsafe impl Sync for Machine {}

static MACHINE: OnceLock<Machine> = OnceLock::new();

/// Makes the layer SQLite's default, once a process.
pub(crate) fn install() {
    MACHINE.get_or_init(|| {
        // SAFETY: finding initialises SQLite; the default is a valid file system for the whole process, and
        // what is registered is never freed.
        unsafe {
            let machine = sqlite3_vfs_find(std::ptr::null());
            assert!(!machine.is_null(), "SQLite has a file system");
            let mut layer = Box::new(*machine);
            layer.szOsFile += size_of::<File>() as c_int;
            layer.pNext = std::ptr::null_mut();
            layer.zName = c"power-loss".as_ptr();
            layer.xOpen = Some(open);
            layer.xDelete = Some(delete);
            // It opens the machine's files before `MACHINE` is set only if another thread is faster; that one
            // waits for it in `machine`.
            let registered = sqlite3_vfs_register(Box::into_raw(layer), 1);
            assert_eq!(registered, SQLITE_OK, "SQLite takes the layer");
            Machine(machine)
        }
    });
}

fn machine() -> *mut sqlite3_vfs {
    MACHINE.wait().0
}

/// The machine's file behind one of ours.
unsafe fn real(file: *mut sqlite3_file) -> *mut sqlite3_file {
    // SAFETY: `szOsFile` has made room for both.
    unsafe { file.cast::<u8>().add(size_of::<File>()).cast() }
}

unsafe fn on_disk<'a>(file: *mut sqlite3_file) -> Option<&'a mut OnDisk> {
    // SAFETY: what `open` has put there lives until `close`, and SQLite uses a file from one thread at a time.
    unsafe { (*file.cast::<File>()).on_disk.as_mut() }
}

/// Calls a method of the machine's file; one that it lacks is an error.
macro_rules! pass {
    ($file:expr, $method:ident $(, $argument:expr)*) => {{
        // SAFETY: the machine's file was opened by the machine, and has its methods.
        unsafe {
            let real = real($file);
            match (*(*real).pMethods).$method {
                Some(method) => method(real $(, $argument)*),
                None => SQLITE_IOERR,
            }
        }
    }};
}

unsafe extern "C" fn open(
    _: *mut sqlite3_vfs,
    name: *const c_char,
    file: *mut sqlite3_file,
    flags: c_int,
    out: *mut c_int,
) -> c_int {
    const WATCHED: c_int = SQLITE_OPEN_MAIN_DB | SQLITE_OPEN_WAL | SQLITE_OPEN_MAIN_JOURNAL;
    // SAFETY: `name` is null or a text, `file` has room for both files, as SQLite promises.
    unsafe {
        let ours = file.cast::<File>();
        ours.write(File { methods: std::ptr::null(), on_disk: std::ptr::null_mut() });
        let path = (!name.is_null() && flags & WATCHED != 0).then(|| path(name).to_owned());
        let disk = path.and_then(|path| Some((Shared::of(&path)?, path)));
        if let Some((disk, path)) = disk {
            let Some(is_new) = disk.opening(&path) else { return SQLITE_IOERR };
            let is_new = is_new && flags & SQLITE_OPEN_MAIN_DB == 0;
            (*ours).on_disk = Box::into_raw(Box::new(OnDisk { disk, path, is_new }));
        }
        let opened = match (*machine()).xOpen {
            Some(really) => really(machine(), name, real(file), flags, out),
            None => SQLITE_IOERR,
        };
        if opened == SQLITE_OK {
            (*ours).methods = &METHODS;
        } else {
            forget(ours);
        }
        opened
    }
}

/// Lets go of the disk.
unsafe fn forget(ours: *mut File) {
    // SAFETY: `open` has made the box, and whoever calls this is the last to have the file.
    unsafe {
        if !(*ours).on_disk.is_null() {
            drop(Box::from_raw((*ours).on_disk));
            (*ours).on_disk = std::ptr::null_mut();
        }
    }
}

unsafe extern "C" fn delete(_: *mut sqlite3_vfs, name: *const c_char, folder: c_int) -> c_int {
    // SAFETY: `name` is a text, and the machine's file system is the machine's own argument.
    let really = || unsafe {
        match (*machine()).xDelete {
            Some(really) => really(machine(), name, folder),
            None => SQLITE_IOERR,
        }
    };
    // SAFETY: `name` is a text.
    let path = unsafe { path(name) };
    match Shared::of(path) {
        Some(disk) => disk.delete(path, folder != 0, really),
        None => really(),
    }
}

unsafe extern "C" fn close(file: *mut sqlite3_file) -> c_int {
    // SAFETY: nobody uses the file after this.
    unsafe { forget(file.cast()) };
    pass!(file, xClose)
}

unsafe extern "C" fn write(
    file: *mut sqlite3_file,
    from: *const c_void,
    n: c_int,
    at: i64,
) -> c_int {
    let really = || pass!(file, xWrite, from, n, at);
    // SAFETY: the file is open.
    let Some(watched) = (unsafe { on_disk(file) }) else { return really() };
    // SAFETY: SQLite gives `n` bytes at `from`.
    let bytes = unsafe { std::slice::from_raw_parts(from.cast::<u8>(), n as usize) };
    let change = Change::Write { at: at as u64, bytes: bytes.to_vec() };
    watched.disk.change(&watched.path, change, really)
}

unsafe extern "C" fn truncate(file: *mut sqlite3_file, length: i64) -> c_int {
    let really = || pass!(file, xTruncate, length);
    // SAFETY: the file is open.
    match unsafe { on_disk(file) } {
        Some(w) => w.disk.change(&w.path, Change::Truncate(length as u64), really),
        None => really(),
    }
}

/// On a disk nothing is really synced, which would only take time: what a test finds after the cut is what
/// the disk has noted.
unsafe extern "C" fn sync(file: *mut sqlite3_file, flags: c_int) -> c_int {
    // SAFETY: the file is open.
    match unsafe { on_disk(file) } {
        Some(w) => {
            let done = w.disk.sync(&w.path, w.is_new);
            w.is_new &= done != SQLITE_OK;
            done
        }
        None => pass!(file, xSync, flags),
    }
}

unsafe fn path<'a>(name: *const c_char) -> &'a Path {
    // SAFETY: the caller has a text that ends with a zero.
    Path::new(OsStr::from_bytes(unsafe { CStr::from_ptr(name) }.to_bytes()))
}

/// Methods that do nothing but pass the call on.
macro_rules! passed {
    ($($name:ident => $method:ident($($argument:ident: $type:ty),*);)*) => {$(
        unsafe extern "C" fn $name(file: *mut sqlite3_file $(, $argument: $type)*) -> c_int {
            pass!(file, $method $(, $argument)*)
        }
    )*};
}

passed! {
    read => xRead(to: *mut c_void, n: c_int, at: i64);
    file_size => xFileSize(size: *mut i64);
    lock => xLock(level: c_int);
    unlock => xUnlock(level: c_int);
    check_reserved_lock => xCheckReservedLock(out: *mut c_int);
    file_control => xFileControl(operation: c_int, argument: *mut c_void);
    sector_size => xSectorSize();
    device_characteristics => xDeviceCharacteristics();
    shm_map => xShmMap(page: c_int, size: c_int, extend: c_int, to: *mut *mut c_void);
    shm_lock => xShmLock(offset: c_int, n: c_int, flags: c_int);
    shm_unmap => xShmUnmap(delete: c_int);
}

unsafe extern "C" fn shm_barrier(file: *mut sqlite3_file) {
    // SAFETY: the machine's file was opened by the machine, and has its methods.
    unsafe {
        let real = real(file);
        if let Some(method) = (*(*real).pMethods).xShmBarrier {
            method(real);
        }
    }
}

/// Version 2: with the shared memory that a log needs, without memory maps, past which nothing would be seen.
static METHODS: sqlite3_io_methods = sqlite3_io_methods {
    iVersion: 2,
    xClose: Some(close),
    xRead: Some(read),
    xWrite: Some(write),
    xTruncate: Some(truncate),
    xSync: Some(sync),
    xFileSize: Some(file_size),
    xLock: Some(lock),
    xUnlock: Some(unlock),
    xCheckReservedLock: Some(check_reserved_lock),
    xFileControl: Some(file_control),
    xSectorSize: Some(sector_size),
    xDeviceCharacteristics: Some(device_characteristics),
    xShmMap: Some(shm_map),
    xShmLock: Some(shm_lock),
    xShmBarrier: Some(shm_barrier),
    xShmUnmap: Some(shm_unmap),
    xFetch: None,
    xUnfetch: None,
};
