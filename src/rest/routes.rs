//! A router that knows its routes, so that a test can hold them against the access table.

use axum::Router;
use axum::routing::MethodRouter;

/// Routes, and what they are called.
pub(super) struct Routes<S> {
    router: Router<S>,
    paths: Vec<&'static str>,
}

impl<S: Clone + Send + Sync + 'static> Routes<S> {
    /// None yet.
    pub fn new() -> Self {
        Self { router: Router::new(), paths: Vec::new() }
    }

    /// One more.
    pub fn route(mut self, path: &'static str, methods: MethodRouter<S>) -> Self {
        self.paths.push(path);
        Self { router: self.router.route(path, methods), paths: self.paths }
    }

    /// The router of them, and all their paths.
    pub fn finish(self) -> (Router<S>, Vec<&'static str>) {
        (self.router, self.paths)
    }
}
