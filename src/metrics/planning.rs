//! What becomes of departures: plans, what part the policy had in them, and their explanations.

use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::histogram::Histogram;
use prometheus_client::registry::{Registry, Unit};
use voltour_solver::plan::Status;

use super::labels::{
    ExplanationLabels, ExplanationOutcome, FallbackLabels, PlanLabels, ReloadLabels, SolverLabels,
    WinLabels,
};
use super::{Level, TIMES_S};
use crate::policy::{Fallback, Reloaded, Winning};

/// The first one counts the tours that are proven to be the best.
const GAPS: [f64; 10] = [0.0, 0.001, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0];

/// Clones count together.
#[derive(Clone, Debug)]
pub struct Planning {
    plans: Family<PlanLabels, Counter>,
    gap: Histogram,
    time: Family<SolverLabels, Histogram, fn() -> Histogram>,
    explanations: Family<ExplanationLabels, Counter>,
    policy_fallbacks: Family<FallbackLabels, Counter>,
    policy_wins: Family<WinLabels, Counter>,
    policy_reloads: Family<ReloadLabels, Counter>,
    /// Departures that are due and wait for a planner's thread.
    pub waiting: Level,
    /// Searches that run.
    pub running: Level,
}

impl Planning {
    pub(super) fn register(registry: &mut Registry) -> Self {
        let counted = Self {
            plans: Family::default(),
            gap: Histogram::new(GAPS),
            time: Family::new_with_constructor(|| Histogram::new(TIMES_S)),
            explanations: Family::default(),
            policy_fallbacks: Family::default(),
            policy_wins: Family::default(),
            policy_reloads: Family::default(),
            waiting: Level::default(),
            running: Level::default(),
        };
        let Self { plans, gap, time, explanations, waiting, running, .. } = counted.clone();
        registry.register("plans", "Plans stored", plans);
        let help = "How far a stored tour may be from the best, where a bound is proven";
        registry.register_with_unit("plan_gap", help, Unit::Other("ratio".to_owned()), gap);
        let help =
            "Time from the close of a batch to its plan, for plans stored, by whose tour it is";
        registry.register_with_unit("plan_time", help, Unit::Seconds, time);
        let unit = || Unit::Other("departures".to_owned());
        let help = "That are due and wait for a planner's thread";
        registry.register_with_unit("planner_waiting", help, unit(), waiting.0);
        let help = "Whose tour is searched for now";
        registry.register_with_unit("planner_running", help, unit(), running.0);
        registry.register("explanations", "Plans explained, or given up", explanations);
        counted.register_policies(registry);
        counted.begin();
        counted
    }

    fn register_policies(&self, registry: &mut Registry) {
        let help = "Plans stored that were made without the policy";
        registry.register("policy_fallbacks", help, self.policy_fallbacks.clone());
        let help = "Plans stored for which the policy built a tour, by whose tour was the best";
        registry.register("policy_wins", help, self.policy_wins.clone());
        let help = "Models loaded again while the service runs";
        registry.register("policy_reloads", help, self.policy_reloads.clone());
    }

    /// There from the start: a monitor sees the rise from 0.
    fn begin(&self) {
        for outcome in [ExplanationOutcome::Done, ExplanationOutcome::Failed] {
            self.explanations.get_or_create_owned(&ExplanationLabels { outcome });
        }
        for reason in Fallback::ALL.map(Fallback::name) {
            self.policy_fallbacks.get_or_create_owned(&FallbackLabels { reason });
        }
        for winner in Winning::ALL.map(Winning::name) {
            self.policy_wins.get_or_create_owned(&WinLabels { winner });
        }
        for outcome in Reloaded::NAMES {
            self.policy_reloads.get_or_create_owned(&ReloadLabels { outcome });
        }
    }

    /// A plan is stored that took so long to make.
    pub fn planned(&self, solver: &str, status: Status, gap: Option<f64>, took_s: f64) {
        let labels = PlanLabels { solver: solver.to_owned(), status: status.name() };
        self.plans.get_or_create_owned(&labels).inc();
        let labels = SolverLabels { solver: solver.to_owned() };
        self.time.get_or_create_owned(&labels).observe(took_s);
        if let Some(gap) = gap {
            self.gap.observe(gap);
        }
    }

    /// An explanation has ended.
    pub fn explained(&self, outcome: ExplanationOutcome) {
        self.explanations.get_or_create_owned(&ExplanationLabels { outcome }).inc();
    }

    /// A plan is stored that was made without the policy.
    pub fn policy_fell_back(&self, reason: Fallback) {
        let labels = FallbackLabels { reason: reason.name() };
        self.policy_fallbacks.get_or_create_owned(&labels).inc();
    }

    /// A plan is stored for which the policy built a tour.
    pub fn policy_competed(&self, winner: Winning) {
        self.policy_wins.get_or_create_owned(&WinLabels { winner: winner.name() }).inc();
    }

    /// A model was loaded again.
    pub fn policy_reloaded(&self, became: &Reloaded) {
        let labels = ReloadLabels { outcome: became.name() };
        self.policy_reloads.get_or_create_owned(&labels).inc();
    }
}
