//! [`Sheet`]: a table with its figures, as Markdown and as CSV.

use std::fmt::Write;

use super::summary::{Reference, references};
use super::{BenchError, Figures, Published, Run, Summary, Table, summaries};

/// A table filled in.
#[derive(Clone, Debug)]
pub struct Sheet<'a> {
    /// What is laid out.
    pub table: &'a Table,
    /// Its rows: those of a setting after those of the one before.
    pub rows: Vec<Row>,
    /// Scenarios of each setting: with a feasible tour, without, and how many of both are proven.
    counts: Vec<(f64, Counts)>,
    /// Median processor time of building the graph, over all scenarios, in seconds.
    compile_s: f64,
}

/// One algorithm in one setting.
#[derive(Clone, Debug)]
pub struct Row {
    /// The value of what differs.
    pub x: f64,
    /// What was measured.
    pub summary: Summary,
    /// What the paper says.
    pub published: Published,
}

#[derive(Clone, Copy, Debug)]
struct Counts {
    feasible: usize,
    infeasible: usize,
    proven: usize,
}

impl<'a> Sheet<'a> {
    /// Fills a table in.
    ///
    /// # Errors
    /// Runs contradict each other.
    pub fn of(table: &'a Table, runs: &[Run], figures: &Figures) -> Result<Self, BenchError> {
        let (mut rows, mut counts, mut compile_s) = (Vec::new(), Vec::new(), Vec::new());
        for setting in &table.settings {
            let group = setting.cell.to_string();
            let known = references(runs, &group, table.measure.is_cost())?;
            let feasible = known.values().filter(|r| r.objective.is_some()).count();
            let without = |r: &&Reference| r.proven && r.objective.is_none();
            let infeasible = known.values().filter(without).count();
            let proven = known.values().filter(|r| r.proven).count();
            counts.push((setting.x, Counts { feasible, infeasible, proven }));
            compile_s.extend(runs.iter().filter(|run| run.group == group).map(|run| run.compile_s));
            let names: Vec<String> = setting.entrants.iter().map(ToString::to_string).collect();
            let measured = summaries(runs, &group, &known, &names);
            rows.extend(measured.into_iter().zip(&setting.entrants).map(|(summary, entrant)| {
                let published = figures.of(table.name, setting.x, entrant.solver.name());
                let published = Some(published).filter(|_| entrant.is_the_papers());
                Row { x: setting.x, summary, published: published.unwrap_or_default() }
            }));
        }
        compile_s.sort_by(f64::total_cmp);
        let compile_s = compile_s.get(compile_s.len() / 2).copied().unwrap_or(0.0);
        Ok(Self { table, rows, counts, compile_s })
    }

    /// As Markdown; `training` is the time that the policy took to learn, and the scenarios that shared it.
    pub fn markdown(&self, training: Option<(f64, usize)>) -> String {
        let Table { varied, measure, title, .. } = self.table;
        let has_objectives = self.rows.iter().any(|row| row.published.objective.is_some());
        let mut text = format!(
            "### {title}\n\n| {varied} | algorithm | median time | longest | solved | not finished | {} | mean gap | largest | paper: time |",
            measure.name()
        );
        let mut columns = 10;
        if has_objectives {
            let _ = write!(text, " found | {} |", measure.name());
            columns += 2;
        }
        text += "\n|";
        text += &" --- |".repeat(columns);
        text.push('\n');
        for row in &self.rows {
            text += &self.line(row, has_objectives);
        }
        text.push('\n');
        text += &self.notes(training);
        text
    }

    fn line(&self, row: &Row, has_objectives: bool) -> String {
        let Row { x, summary: s, published } = row;
        let percent =
            |gap: Option<f64>| gap.map_or("".into(), |gap| format!("{:.2} %", 100.0 * gap));
        let shown = |objective: f64| format!("{:.1}", self.table.measure.of(objective));
        let mark =
            if s.cut_short > 0 { format!(" ({} cut short)", s.cut_short) } else { String::new() };
        let mut line = format!(
            "| {x} | {} | {} | {} | {} of {}{mark} | {} | {} | {} | {} | {} |",
            s.algorithm,
            time(s.median_s),
            time(s.largest_s),
            s.solved,
            s.feasible,
            if s.unfinished > 0 { s.unfinished.to_string() } else { String::new() },
            s.mean_objective.map_or(String::new(), shown),
            percent(s.mean_gap),
            percent(s.largest_gap),
            published.seconds.map_or(String::new(), |seconds| format!("{seconds} s")),
        );
        if has_objectives {
            let found = published.found.map_or("", |found| if found { "yes" } else { "no" });
            let objective = published.objective.map_or(String::new(), |kj| kj.to_string());
            let _ = write!(line, " {found} | {objective} |");
        }
        line.push('\n');
        line
    }

    fn notes(&self, training: Option<(f64, usize)>) -> String {
        let mut text = String::new();
        for (x, Counts { feasible, infeasible, proven }) in &self.counts {
            let _ = write!(
                text,
                "{} {x}: {feasible} scenarios with a feasible tour",
                self.table.varied
            );
            if *infeasible > 0 {
                let _ = write!(text, ", {infeasible} proven to have none");
            }
            let _ = writeln!(text, ", {proven} proven.");
        }
        let _ = write!(
            text,
            "Gaps are to the best tour known, which is the optimum where proven. Building the graph took {} more in the median, for every algorithm alike.",
            time(self.compile_s)
        );
        if let Some((whole_s, shared)) = training {
            let each_s = whole_s / shared.max(1) as f64;
            let _ = write!(
                text,
                " The policy of dqn and auto was trained once, in {whole_s:.0} s: {} for each of the {shared} scenarios of this run. The paper's times of DQN include a training for each scenario.",
                time(each_s)
            );
        }
        text.push('\n');
        text
    }

    /// As CSV, with a head.
    ///
    /// # Errors
    /// None that memory does not give.
    pub fn csv(&self) -> Result<Vec<u8>, csv::Error> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record([
            "table",
            "x",
            "algorithm",
            "feasible",
            "solved",
            "unfinished",
            "cut_short",
            "objective",
            "mean_gap",
            "largest_gap",
            "median_s",
            "largest_s",
            "paper_s",
            "paper_found",
            "paper_kj",
        ])?;
        let number = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
        for Row { x, summary: s, published } in &self.rows {
            let counts = [s.feasible, s.solved, s.unfinished, s.cut_short].map(|n| n.to_string());
            let objective = s.mean_objective.map(|objective| self.table.measure.of(objective));
            let mut record = vec![self.table.name.to_owned(), x.to_string(), s.algorithm.clone()];
            record.extend(counts);
            record.extend([objective, s.mean_gap, s.largest_gap].map(number));
            record.extend([Some(s.median_s), Some(s.largest_s), published.seconds].map(number));
            record.push(published.found.map_or(String::new(), |found| found.to_string()));
            record.push(number(published.objective));
            writer.write_record(record)?;
        }
        writer.into_inner().map_err(|error| error.into_error().into())
    }
}

/// Three digits of a time, in the unit that suits it.
pub(super) fn time(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s < 1e-3 => (s * 1e6, "µs"),
        s if s < 1.0 => (s * 1e3, "ms"),
        s => (s, "s"),
    };
    let digits = match value {
        v if v < 10.0 => 2,
        v if v < 100.0 => 1,
        _ => 0,
    };
    format!("{value:.digits$} {unit}")
}
