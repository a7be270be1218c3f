//! A layer under SQLite that knows what a power cut leaves of a database.
//!
//! A [`Disk`] watches over a folder. SQLite works on the files in there as ever, and the disk takes note of every
//! write, truncation, deletion and sync. At a power cut ([`Disk::cut_after`]) only what was synced is sure to be
//! there; of the rest each write may have got through or not, or in part, in whatever order, and a name that came or
//! went since its folder was last synced may be there or not. [`Disk::survivors`] writes what is left into another
//! folder. The same seed leaves the same.
//!
//! The disk can also be full, read-only, or unable to sync ([`Fault`]), or lie about its syncs.

mod disk;
mod image;
mod vfs;

pub use disk::{Disk, Fault};
