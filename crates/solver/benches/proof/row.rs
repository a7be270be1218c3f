//! One line of the table: both times, both values, and whether they can both be true.

use std::fmt;

use voltour_solver::check::check;
use voltour_solver::scenario::{Objective, Scenario};
use voltour_solver::solvers::plan_from_order;
use voltour_solver::tolerance::tolerance;

use super::cpsat::{Answer, Verdict};
use super::ours::Ours;

/// A scenario solved by both.
pub struct Row {
    name: String,
    ours: Ours,
    wall_s: f64,
    verdict: Verdict,
    bound: Option<f64>,
    /// Value of CP-SAT's tour, recomputed; where `check` refuses it, why.
    replayed: Option<Result<f64, String>>,
    mismatch: Option<String>,
}

impl Row {
    /// The title line.
    pub const HEAD: &str = "scenario                     compile s    ours s  CP-SAT s     ours value   CP-SAT value     ratio";

    /// Compares the two.
    pub fn new(name: &str, scenario: &Scenario, ours: Ours, theirs: &Answer) -> Self {
        let replayed = theirs.order.as_ref().map(|order| replay(scenario, order));
        let mismatch = mismatch(scenario, &ours, theirs, replayed.as_ref());
        Self {
            name: name.to_owned(),
            wall_s: theirs.wall_s,
            verdict: theirs.status,
            bound: theirs.bound,
            ours,
            replayed,
            mismatch,
        }
    }

    /// Whether both answers can be true.
    pub fn agrees(&self) -> bool {
        self.mismatch.is_none()
    }

    /// CP-SAT's time over ours, from the compiled instance on, as both get it. Its limit stands for a
    /// proof that it did not find, a lower bound on the ratio; a proof that we did not find counts as no
    /// speed at all, since nothing bounds it.
    fn ratio(&self) -> f64 {
        if self.ours.is_proven() { self.wall_s / self.ours.solve_s } else { 0.0 }
    }

    /// The same with the compilation on our side, and nothing for it on the other.
    fn whole_ratio(&self) -> f64 {
        let whole_s = self.ours.compile_s + self.ours.solve_s;
        if self.ours.is_proven() { self.wall_s / whole_s } else { 0.0 }
    }

    fn is_timed_out(&self) -> bool {
        matches!(self.verdict, Verdict::Feasible | Verdict::Unknown)
    }
}

/// The value of a tour by our arithmetic, or what breaks.
fn replay(scenario: &Scenario, order: &[usize]) -> Result<f64, String> {
    let plan = plan_from_order(scenario, order, "cp-sat");
    let broken = check(scenario, &plan);
    match broken.first() {
        Some(broken) => Err(broken.to_string()),
        None if !plan.status.is_feasible() => Err("a demand is not met".to_owned()),
        None => Ok(plan.objective),
    }
}

/// Why the two answers exclude each other: a value better than a bound, a tour where there is none, or one
/// that is no tour.
fn mismatch(
    scenario: &Scenario,
    ours: &Ours,
    theirs: &Answer,
    replayed: Option<&Result<f64, String>>,
) -> Option<String> {
    // What is better is smaller.
    let sign = if scenario.objective == Objective::MinDistance { 1.0 } else { -1.0 };
    let exceeds = |value: f64, bound: f64| sign * value < sign * bound - 2.0 * tolerance(bound);
    let feasible = ours.plan.status.is_feasible();
    if theirs.status == Verdict::Infeasible && feasible {
        return Some("we have a tour where CP-SAT proved that there is none".to_owned());
    }
    if let (true, Some(bound)) = (feasible, theirs.bound)
        && exceeds(ours.plan.objective, bound)
    {
        return Some(format!("our tour beats CP-SAT's bound {bound}"));
    }
    let value = match replayed? {
        Ok(value) => value,
        // A hair's breadth of lateness is the model's rounding; anything else is a mistake in it.
        Err(reason) => return Some(format!("the check refuses CP-SAT's tour: {reason}")),
    };
    if ours.is_proven() && !feasible {
        return Some("CP-SAT has a tour where we proved that there is none".to_owned());
    }
    let bound = ours.plan.bound.filter(|&bound| exceeds(*value, bound))?;
    Some(format!("CP-SAT's tour beats our bound {bound}"))
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mark = |late: bool| if late { ">" } else { "" };
        let ours = format!("{}{:.4}", mark(!self.ours.is_proven()), self.ours.solve_s);
        let theirs = format!("{}{:.3}", mark(self.is_timed_out()), self.wall_s);
        let value = if self.ours.plan.status.is_feasible() {
            format!("{:.3}", self.ours.plan.objective)
        } else {
            self.ours.plan.status.name().to_owned()
        };
        let their_value = match &self.replayed {
            Some(Ok(value)) => format!("{value:.3}"),
            Some(Err(_)) => "refused".to_owned(),
            None => format!("{:?}", self.verdict).to_lowercase(),
        };
        let ratio = format!("{}{:.1}", mark(self.is_timed_out()), self.ratio());
        write!(
            f,
            "{:28} {:>9.4} {ours:>9} {theirs:>9} {value:>14} {their_value:>14} {ratio:>9}",
            self.name, self.ours.compile_s
        )?;
        if let (true, Some(bound)) = (self.is_timed_out(), self.bound) {
            write!(f, "  CP-SAT's bound {bound:.3}")?;
        }
        if let Some(mismatch) = &self.mismatch {
            write!(f, "\n*** MISMATCH: {mismatch} ***")?;
        }
        Ok(())
    }
}

/// The last lines: how much was proven, and the median ratios.
pub fn summary(rows: &[Row]) -> String {
    let ours = rows.iter().filter(|row| row.ours.is_proven()).count();
    let theirs = rows.iter().filter(|row| !row.is_timed_out()).count();
    let wrong = rows.iter().filter(|row| !row.agrees()).count();
    format!(
        "proven: ours {ours}, CP-SAT {theirs} of {}; mismatches: {wrong}\n\
         median ratio: {}; with the compilation in our time: {}\n\
         (a time-out of CP-SAT counts as its limit, one of ours as the ratio 0)",
        rows.len(),
        median(rows, Row::ratio),
        median(rows, Row::whole_ratio),
    )
}

/// The median, marked as a lower bound where a time-out of CP-SAT stands at the middle or below: with
/// more time that row could move up.
fn median(rows: &[Row], ratio: impl Fn(&Row) -> f64) -> String {
    let mut sorted: Vec<&Row> = rows.iter().collect();
    sorted.sort_by(|a, b| ratio(a).total_cmp(&ratio(b)));
    let [low, high] = [(sorted.len() - 1) / 2, sorted.len() / 2];
    let late = sorted[..=high].iter().any(|row| row.is_timed_out() && row.ours.is_proven());
    let least = if late { "at least " } else { "" };
    format!("{least}{:.1}", (ratio(sorted[low]) + ratio(sorted[high])) / 2.0)
}
