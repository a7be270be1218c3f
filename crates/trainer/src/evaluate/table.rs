//! [`Table`]: cells by methods, as Markdown and as CSV.

use std::fmt::Write;

use voltour_solver::gap::to_best;

use super::paired::mean;
use super::{Optimum, Paired, Run};

/// One method in one cell.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    /// Gaps of the runs that solved their scenario, as shares.
    pub gaps: Vec<f64>,
    /// Runs on scenarios that have a feasible tour.
    pub feasible: usize,
    /// Complete roll-outs of all scenarios.
    pub roll_outs: u64,
    /// States valued of all scenarios.
    pub valued: u64,
    /// Processor time of each scenario, in seconds.
    pub seconds: Vec<f64>,
}

impl Summary {
    /// Adds what a method gave on a scenario that has a feasible tour. Returns its gap; `None` if it did not solve it.
    pub fn add(&mut self, run: &Run, best: f64) -> Option<f64> {
        let gap = run.objective.map(|objective| to_best(objective, best));
        self.feasible += 1;
        self.gaps.extend(gap);
        self.roll_outs += run.roll_outs;
        self.valued += run.valued;
        self.seconds.push(run.seconds);
        gap
    }

    /// Mean gap of the scenarios solved, as a share.
    pub fn mean_gap(&self) -> f64 {
        mean(&self.gaps)
    }

    /// Share of the feasible scenarios that were solved.
    pub fn solved_share(&self) -> f64 {
        self.gaps.len() as f64 / self.feasible.max(1) as f64
    }

    /// Median processor time, in seconds.
    pub fn median_s(&self) -> f64 {
        let mut seconds = self.seconds.clone();
        seconds.sort_by(f64::total_cmp);
        seconds.get(seconds.len() / 2).copied().unwrap_or(0.0)
    }
}

/// Rows of cell and method, and methods beside another.
#[derive(Clone, Debug, Default)]
pub struct Table {
    rows: Vec<(String, String, usize, Summary)>,
    pairs: Vec<(String, String, Paired)>,
}

impl Table {
    /// Adds the row of a method in a cell with these references.
    pub fn push(&mut self, cell: &str, method: &str, optima: &[Optimum], summary: Summary) {
        let proven = optima.iter().filter(|optimum| optimum.proven).count();
        self.rows.push((cell.to_owned(), method.to_owned(), proven, summary));
    }

    /// Adds how a method compares with another in a cell.
    pub fn compare(&mut self, cell: &str, methods: &str, paired: Paired) {
        self.pairs.push((cell.to_owned(), methods.to_owned(), paired));
    }

    /// The comparisons as Markdown, in points of gap; empty where there are none.
    pub fn comparisons(&self) -> String {
        if self.pairs.is_empty() {
            return String::new();
        }
        let mut text = String::from(
            "| cell | methods | mean difference | 95 % of cases | better | equal | worse |\n| --- | --- | --- | --- | --- | --- | --- |\n",
        );
        for (cell, methods, paired) in &self.pairs {
            let (mean, margin) = (100.0 * paired.mean(), 100.0 * paired.margin());
            let _ = writeln!(
                text,
                "| {cell} | {methods} | {mean:+.3} | {:+.3} to {:+.3} | {} | {} | {} |",
                mean - margin,
                mean + margin,
                paired.better,
                paired.equal,
                paired.worse,
            );
        }
        text
    }

    /// As CSV, with a head.
    pub fn csv(&self) -> String {
        let mut text = String::from(
            "cell,method,feasible,proven,solved,mean_gap,largest_gap,roll_outs,valued,median_s\n",
        );
        for (cell, method, proven, s) in &self.rows {
            let each = |total: u64| total as f64 / s.feasible.max(1) as f64;
            let largest = s.gaps.iter().copied().fold(0.0, f64::max);
            let (solved, mean) = (s.gaps.len(), s.mean_gap());
            let _ = writeln!(
                text,
                "{cell},{method},{},{proven},{solved},{mean:.6},{largest:.6},{:.1},{:.1},{:.6}",
                s.feasible,
                each(s.roll_outs),
                each(s.valued),
                s.median_s(),
            );
        }
        text
    }

    /// As Markdown, with a mean over the cells for each method at its end.
    pub fn markdown(&self) -> String {
        let mut text = String::from(
            "| cell | method | solved | mean gap | roll-outs | states valued | median ms |\n| --- | --- | --- | --- | --- | --- | --- |\n",
        );
        let mut line = |cell: &str, method: &str, s: &Summary, gap: f64| {
            let each = |total: u64| total as f64 / s.feasible.max(1) as f64;
            let _ = writeln!(
                text,
                "| {cell} | {method} | {} of {} | {:.2} % | {:.0} | {:.0} | {:.1} |",
                s.gaps.len(),
                s.feasible,
                100.0 * gap,
                each(s.roll_outs),
                each(s.valued),
                1e3 * s.median_s(),
            );
        };
        for (cell, method, _, summary) in &self.rows {
            line(cell, method, summary, summary.mean_gap());
        }
        for (method, all, gap) in self.means() {
            line("mean of the cells", method, &all, gap);
        }
        text
    }

    /// For each method, all cells together, and the mean over the cells of their mean gaps.
    fn means(&self) -> Vec<(&str, Summary, f64)> {
        let mut methods: Vec<&str> = Vec::new();
        for (_, method, ..) in &self.rows {
            if !methods.contains(&method.as_str()) {
                methods.push(method);
            }
        }
        let of_cells = |method| {
            let rows: Vec<&Summary> =
                self.rows.iter().filter(|row| row.1 == method).map(|row| &row.3).collect();
            let mut all = Summary::default();
            for row in &rows {
                all.gaps.extend(&row.gaps);
                all.seconds.extend(&row.seconds);
                all.feasible += row.feasible;
                all.roll_outs += row.roll_outs;
                all.valued += row.valued;
            }
            let gaps: Vec<f64> = rows.iter().map(|row| row.mean_gap()).collect();
            (method, all, mean(&gaps))
        };
        methods.into_iter().map(of_cells).collect()
    }
}
