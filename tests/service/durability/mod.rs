//! What befalls a database and the disk that it lies on.

mod backup;
mod faults;
mod released;
