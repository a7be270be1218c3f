//! [`Shelf`]: the policies in use, which can be exchanged while tours are planned.

use std::path::{Path, PathBuf};
use std::sync::{Arc, PoisonError, RwLock};

use voltour_solver::policy::Problem;

use super::{Fault, ModelError, Policies, Policy};

/// The policies in use; clones share them.
#[derive(Clone, Debug)]
pub struct Shelf {
    current: Arc<RwLock<Arc<Policies>>>,
    folder: Option<PathBuf>,
}

/// What became of a problem's policy when the models were loaded again.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Reloaded {
    /// Another one is in use now.
    Taken,
    /// It is the same as before, or there is none as before.
    Same,
    /// The new one is not used; the one from before is, if there was one.
    Refused(ModelError),
}

impl Reloaded {
    /// The words for all of them.
    pub const NAMES: [&str; 3] = ["taken", "same", "refused"];

    /// The word for it.
    pub const fn name(&self) -> &'static str {
        let [taken, same, refused] = Self::NAMES;
        match self {
            Self::Taken => taken,
            Self::Same => same,
            Self::Refused(_) => refused,
        }
    }
}

impl Shelf {
    /// Loads the policies and logs what there is. A model that fails a check leaves its problem without one.
    pub fn open(folder: Option<&Path>) -> Self {
        let shelf = Self { folder: folder.map(Path::to_owned), ..Self::of(Policies::load(folder)) };
        for (problem, policy) in shelf.current().iter() {
            match policy {
                Ok(policy) => in_use(policy),
                // A binary without models, and nobody has named any.
                Err(error) if folder.is_none() && error.fault == Fault::Missing => {
                    tracing::info!(%problem, "no policy in this binary");
                }
                Err(error) => {
                    tracing::warn!(%problem, %error, "no policy: tours are planned without one");
                }
            }
        }
        shelf
    }

    /// Holds these policies.
    pub fn of(policies: Policies) -> Self {
        Self { current: Arc::new(RwLock::new(Arc::new(policies))), folder: None }
    }

    /// The policies in use.
    pub fn current(&self) -> Arc<Policies> {
        self.current.read().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Loads the models again, and exchanges all policies at once: for those that passed every check; a model that
    /// failed one leaves the policy from before in use. It reads files and computes: not for an async thread.
    pub fn reload(&self) -> Vec<(Problem, Reloaded)> {
        let (fresh, old) = (Policies::load(self.folder.as_deref()), self.current());
        let became = |(problem, new)| (problem, became(old.of(problem), new));
        let became: Vec<(Problem, Reloaded)> = fresh.iter().map(became).collect();
        let next = Policies::new(|problem| {
            let (new, old) = (fresh.of(problem), old.of(problem));
            let is_taken = became.contains(&(problem, Reloaded::Taken));
            // Without any that is good, the newest reason is the one to tell.
            let chosen = if is_taken || old.is_err() { new } else { old };
            chosen.cloned().map_err(Clone::clone)
        });
        *self.current.write().unwrap_or_else(PoisonError::into_inner) = Arc::new(next);
        for (problem, became) in &became {
            match (became, fresh.of(*problem)) {
                (Reloaded::Taken, Ok(policy)) => in_use(policy),
                (Reloaded::Refused(error), _) => {
                    let kept = old.of(*problem).map(|policy| policy.about.digest.as_str()).ok();
                    tracing::error!(%problem, %error, kept, "a new policy is refused");
                }
                _ => tracing::info!(%problem, "policy unchanged"),
            }
        }
        became
    }
}

fn became(old: Result<&Policy, &ModelError>, new: Result<&Policy, &ModelError>) -> Reloaded {
    match (old, new) {
        (Ok(old), Ok(new)) if old.about == new.about => Reloaded::Same,
        (_, Ok(_)) => Reloaded::Taken,
        (Err(old), Err(new)) if old == new => Reloaded::Same,
        (_, Err(new)) => Reloaded::Refused(new.clone()),
    }
}

fn in_use(policy: &Policy) {
    let about = &policy.about;
    let (problem, source, digest) = (about.problem, &about.source, &about.digest);
    tracing::info!(%problem, source, digest, "policy in use");
}
