//! The voltour service.
