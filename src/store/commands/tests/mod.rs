//! Every step in the life of a request and of a departure, on a real database.

mod again;
mod closing;
mod forget;
mod life;
mod visits;
