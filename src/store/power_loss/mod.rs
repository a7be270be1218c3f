//! Power cuts and failing disks: under a layer that loses whatever was not synced, everything acknowledged is there
//! afterwards.

mod cut;
mod faults;
mod history;
