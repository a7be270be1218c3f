//! Whether any tour keeps every constraint.

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;

use super::{Aim, Effort, Incumbent, Model, prove};
use crate::instance::Instance;
use crate::solvers::Budget;

/// What is known of an instance.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// This tour, as candidates in order, keeps every constraint.
    Feasible(Vec<u32>),
    /// Proven: no tour that the check accepts keeps every constraint.
    Infeasible,
    /// The budget ended before either was shown.
    Unknown,
}

/// Decides whether any tour keeps every constraint.
pub fn decide(instance: &Instance<'_>, budget: &mut Budget<'_>) -> Verdict {
    let model = Model::new(instance, Aim::AnyTour);
    let mut incumbent = Incumbent::none(&model);
    let mut rng = Pcg64Mcg::seed_from_u64(0);
    let proof = prove(&model, Effort::Whole, &mut incumbent, &mut rng, budget);
    match proof.order {
        Some(order) => Verdict::Feasible(order),
        None if proof.closed && incumbent.beyond == f64::INFINITY => Verdict::Infeasible,
        None => Verdict::Unknown,
    }
}
