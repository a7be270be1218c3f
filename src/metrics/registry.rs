//! All metrics together, and how they are written: OpenMetrics text.

use std::sync::Arc;
use std::sync::atomic::AtomicU64;

use prometheus_client::encoding::text::encode;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::metrics::info::Info;
use prometheus_client::registry::{Registry, Unit};

use super::counted::LookedUp;
use super::{Calls, Planning, WriterMetrics};
use crate::clock::{Clock, SystemClock, unix_s};
use crate::store::Census;

/// Everything that is counted; clones count together.
#[derive(Clone, Debug)]
pub struct Metrics {
    registry: Arc<Registry>,
    /// Of the edges.
    pub calls: Calls,
    /// Of the scheduler, the planner and the explainer.
    pub planning: Planning,
    looked_up: LookedUp,
}

impl Default for Metrics {
    /// On the machine's clock, of a store of its own.
    fn default() -> Self {
        Self::new(Arc::new(SystemClock), &WriterMetrics::default())
    }
}

impl Metrics {
    /// Of a service on this clock, over a store whose writer counts here.
    pub fn new(clock: Arc<dyn Clock>, writer: &WriterMetrics) -> Self {
        let mut registry = Registry::with_prefix("voltour");
        let build = Info::new(vec![("version", env!("CARGO_PKG_VERSION"))]);
        registry.register("build", "The version that runs", build);
        let start: Gauge<f64, AtomicU64> = Gauge::default();
        start.set(unix_s(clock.now()));
        let help = "When the service was started, in Unix time";
        registry.register_with_unit("start_time", help, Unit::Seconds, start);
        let planning = Planning::register(&mut registry);
        writer.register(&mut registry);
        let calls = Calls::register(&mut registry, clock, writer.submissions.clone());
        let looked_up = LookedUp::register(&mut registry);
        Self { registry: Arc::new(registry), calls, planning, looked_up }
    }

    /// The database was looked at for a monitor; none where it could not be.
    pub fn see(&self, census: Option<&Census>) {
        match census {
            Some(census) => self.looked_up.see(census),
            None => self.looked_up.failed(),
        }
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
    use std::time::Duration;

    use jiff::Timestamp;
    use tonic::Code;
    use voltour_solver::plan::Status;

    use super::*;
    use crate::clock::{ManualClock, plus};
    use crate::metrics::ExplanationOutcome;
    use crate::policy::{Fallback, Reloaded, Winning};

    fn check(metrics: &Metrics, lines: &[&str]) {
        let text = metrics.text().unwrap();
        for line in lines {
            assert!(text.lines().any(|said| said == *line), "{line} is not in\n{text}");
        }
    }

    #[test]
    fn plans_are_counted_by_solver_and_status_and_gaps_only_where_there_is_a_bound() {
        let metrics = Metrics::default();
        let planning = &metrics.planning;
        planning.planned("baseline", Status::Feasible, Some(0.03), 0.2);
        planning.planned("baseline", Status::Feasible, None, 0.2);
        planning.planned("exact", Status::Optimal, Some(0.0), 4.0);
        planning.explained(ExplanationOutcome::Done);
        planning.policy_fell_back(Fallback::TooSlow);
        planning.policy_competed(Winning::Policy);
        planning.policy_reloaded(&Reloaded::Same);
        check(
            &metrics,
            &[
                r#"voltour_plans_total{solver="baseline",status="feasible"} 2"#,
                r#"voltour_plans_total{solver="exact",status="optimal"} 1"#,
                r#"voltour_plan_gap_ratio_bucket{le="0.0"} 1"#,
                r#"voltour_plan_gap_ratio_bucket{le="0.02"} 1"#,
                r#"voltour_plan_gap_ratio_bucket{le="0.05"} 2"#,
                "voltour_plan_gap_ratio_count 2",
                r#"voltour_plan_time_seconds_count{solver="baseline"} 2"#,
                r#"voltour_plan_time_seconds_count{solver="exact"} 1"#,
                r#"voltour_explanations_total{outcome="done"} 1"#,
                r#"voltour_explanations_total{outcome="failed"} 0"#,
                r#"voltour_policy_fallbacks_total{reason="too_slow"} 1"#,
                r#"voltour_policy_fallbacks_total{reason="no_model"} 0"#,
                r#"voltour_policy_wins_total{winner="policy"} 1"#,
                r#"voltour_policy_wins_total{winner="baseline"} 0"#,
                r#"voltour_policy_reloads_total{outcome="taken"} 0"#,
                r#"voltour_policy_reloads_total{outcome="same"} 1"#,
                "# EOF",
            ],
        );
    }

    #[test]
    fn no_caller_makes_a_label() {
        let metrics = Metrics::default();
        metrics.calls.grpc("/voltour.v1.RequestService/Submit").ended(Code::Ok);
        metrics.calls.grpc("/voltour.v1.RequestService/Watch").ended(Code::Unavailable);
        metrics.calls.grpc("/any.thing/At\"all");
        metrics.calls.rest("GET", Some("/v1/plans/{id}"))(200);
        metrics.calls.rest("BREW", Some("/v1/plans/42"))(404);
        check(
            &metrics,
            &[
                r#"voltour_grpc_calls_total{method="voltour.v1.RequestService/Submit",code="OK"} 1"#,
                r#"voltour_grpc_calls_total{method="voltour.v1.RequestService/Watch",code="UNAVAILABLE"} 1"#,
                r#"voltour_grpc_calls_total{method="unknown",code="CANCELLED"} 1"#,
                r#"voltour_rest_calls_total{method="GET",route="/v1/plans/{id}",code="200"} 1"#,
                r#"voltour_rest_calls_total{method="other",route="unknown",code="404"} 1"#,
            ],
        );
        let text = metrics.text().unwrap();
        assert!(
            !text.contains("time_seconds_count{method=\"voltour.v1.RequestService/Watch"),
            "{text}"
        );
    }

    #[test]
    fn a_clock_that_is_set_during_a_call_makes_it_no_longer() {
        let clock = Arc::new(ManualClock::new(Timestamp::UNIX_EPOCH));
        let metrics = Metrics::new(clock.clone(), &WriterMetrics::default());
        let call = metrics.calls.grpc("/voltour.v1.RequestService/Submit");
        let answered = metrics.calls.rest("GET", Some("/healthz"));
        clock.set(plus(clock.now(), Duration::from_secs(3_600)));
        clock.advance(Duration::from_secs(2));
        drop(call);
        answered(200);
        check(
            &metrics,
            &[
                r#"voltour_grpc_call_time_seconds_sum{method="voltour.v1.RequestService/Submit"} 2.0"#,
                r#"voltour_rest_call_time_seconds_sum{route="/healthz"} 2.0"#,
            ],
        );
    }

    #[test]
    fn what_is_inside_is_counted_until_it_leaves() {
        let metrics = Metrics::default();
        let (one, two) = (metrics.calls.streams.enter(), metrics.calls.streams.clone().enter());
        check(&metrics, &["voltour_streams 2"]);
        drop((one, two));
        check(&metrics, &["voltour_streams 0"]);
    }
}
