//! The metrics and how they are written: OpenMetrics text.

use std::sync::Arc;

use prometheus_client::encoding::text::encode;
use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::histogram::Histogram;
use prometheus_client::registry::{Registry, Unit};
use voltour_solver::plan::Status;

use super::labels::{
    ExplanationLabels, ExplanationOutcome, FallbackLabels, PlanLabels, ReloadLabels, WinLabels,
};
use crate::policy::{Fallback, Reloaded, Winning};

/// The first one counts the tours that are proven to be the best.
const GAPS: [f64; 10] = [0.0, 0.001, 0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0];
const TIMES_S: [f64; 12] = [0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 2.5, 5.0, 10.0, 30.0, 60.0];

/// Everything that is counted; clones count together.
#[derive(Clone, Debug)]
pub struct Metrics {
    registry: Arc<Registry>,
    plans: Family<PlanLabels, Counter>,
    plan_gap: Histogram,
    plan_time: Histogram,
    explanations: Family<ExplanationLabels, Counter>,
    policy_fallbacks: Family<FallbackLabels, Counter>,
    policy_wins: Family<WinLabels, Counter>,
    policy_reloads: Family<ReloadLabels, Counter>,
}

impl Default for Metrics {
    fn default() -> Self {
        let (plans, explanations) = (Family::default(), Family::default());
        let policy_fallbacks: Family<FallbackLabels, Counter> = Family::default();
        let policy_wins: Family<WinLabels, Counter> = Family::default();
        let policy_reloads: Family<ReloadLabels, Counter> = Family::default();
        let (plan_gap, plan_time) = (Histogram::new(GAPS), Histogram::new(TIMES_S));
        let mut registry = Registry::with_prefix("voltour");
        registry.register("plans", "Plans stored", plans.clone());
        let help = "How far a stored tour may be from the best, where a bound is proven";
        registry.register_with_unit(
            "plan_gap",
            help,
            Unit::Other("ratio".to_owned()),
            plan_gap.clone(),
        );
        let help = "Time from the close of a batch to its plan, for plans stored";
        registry.register_with_unit("plan_time", help, Unit::Seconds, plan_time.clone());
        registry.register("explanations", "Plans explained, or given up", explanations.clone());
        let help = "Plans stored that were made without the policy";
        registry.register("policy_fallbacks", help, policy_fallbacks.clone());
        let help = "Plans stored for which the policy built a tour, by whose tour was the best";
        registry.register("policy_wins", help, policy_wins.clone());
        let help = "Models loaded again while the service runs";
        registry.register("policy_reloads", help, policy_reloads.clone());
        // There from the start: a monitor sees the rise from 0.
        for outcome in [ExplanationOutcome::Done, ExplanationOutcome::Failed] {
            explanations.get_or_create_owned(&ExplanationLabels { outcome });
        }
        for reason in Fallback::ALL.map(Fallback::name) {
            policy_fallbacks.get_or_create_owned(&FallbackLabels { reason });
        }
        for winner in Winning::ALL.map(Winning::name) {
            policy_wins.get_or_create_owned(&WinLabels { winner });
        }
        for outcome in Reloaded::NAMES {
            policy_reloads.get_or_create_owned(&ReloadLabels { outcome });
        }
        let registry = Arc::new(registry);
        Self {
            registry,
            plans,
            plan_gap,
            plan_time,
            explanations,
            policy_fallbacks,
            policy_wins,
            policy_reloads,
        }
    }
}

impl Metrics {
    /// A plan is stored that took so long to make.
    pub fn planned(&self, solver: &str, status: Status, gap: Option<f64>, took_s: f64) {
        let labels = PlanLabels { solver: solver.to_owned(), status: status.name() };
        self.plans.get_or_create_owned(&labels).inc();
        self.plan_time.observe(took_s);
        if let Some(gap) = gap {
            self.plan_gap.observe(gap);
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

    /// All of them, as OpenMetrics text.
    ///
    /// # Errors
    /// A defect: one of them cannot be written.
    pub fn text(&self) -> Result<String, std::fmt::Error> {
        let mut text = String::new();
        encode(&mut text, &self.registry)?;
        Ok(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plans_are_counted_by_solver_and_status_and_gaps_only_where_there_is_a_bound() {
        let metrics = Metrics::default();
        metrics.planned("baseline", Status::Feasible, Some(0.03), 0.2);
        metrics.planned("baseline", Status::Feasible, None, 0.2);
        metrics.planned("exact", Status::Optimal, Some(0.0), 4.0);
        metrics.explained(ExplanationOutcome::Done);
        metrics.policy_fell_back(Fallback::TooSlow);
        metrics.policy_competed(Winning::Policy);
        metrics.policy_reloaded(&Reloaded::Same);
        let text = metrics.text().unwrap();
        for line in [
            r#"voltour_plans_total{solver="baseline",status="feasible"} 2"#,
            r#"voltour_plans_total{solver="exact",status="optimal"} 1"#,
            r#"voltour_plan_gap_ratio_bucket{le="0.0"} 1"#,
            r#"voltour_plan_gap_ratio_bucket{le="0.02"} 1"#,
            r#"voltour_plan_gap_ratio_bucket{le="0.05"} 2"#,
            "voltour_plan_gap_ratio_count 2",
            "voltour_plan_time_seconds_count 3",
            r#"voltour_explanations_total{outcome="done"} 1"#,
            r#"voltour_explanations_total{outcome="failed"} 0"#,
            r#"voltour_policy_fallbacks_total{reason="too_slow"} 1"#,
            r#"voltour_policy_fallbacks_total{reason="no_model"} 0"#,
            r#"voltour_policy_wins_total{winner="policy"} 1"#,
            r#"voltour_policy_wins_total{winner="baseline"} 0"#,
            r#"voltour_policy_reloads_total{outcome="taken"} 0"#,
            r#"voltour_policy_reloads_total{outcome="same"} 1"#,
            "# EOF",
        ] {
            assert!(text.lines().any(|said| said == line), "{line} is not in\n{text}");
        }
    }
}
