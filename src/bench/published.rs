//! The paper's own figures, from its tables.

use std::collections::HashMap;

use serde::Deserialize;

/// What the paper says of an algorithm in a setting; it leaves out what did not finish, and shows the
/// objectives of two problems in plots alone.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Published {
    /// Computing time, in seconds; for the DQN with the training.
    pub seconds: Option<f64>,
    /// Whether a feasible path was found.
    pub found: Option<bool>,
    /// Energy spent on travelling, in kJ.
    pub objective: Option<f64>,
}

/// All of it, by table, value of what differs, and solver.
#[derive(Clone, Debug)]
pub struct Figures(HashMap<(String, String, String), Published>);

impl Figures {
    /// Those of one row.
    pub fn of(&self, table: &str, x: f64, solver: &str) -> Published {
        let key = (table.to_owned(), x.to_string(), solver.to_owned());
        self.0.get(&key).copied().unwrap_or_default()
    }

    /// How many rows there are.
    #[cfg(test)]
    pub fn count(&self) -> usize {
        self.0.len()
    }
}

#[derive(Deserialize)]
struct Row {
    table: String,
    x: f64,
    algorithm: String,
    seconds: Option<f64>,
    feasible: Option<String>,
    objective: Option<f64>,
}

/// The figures of the paper's tables.
pub fn published() -> Figures {
    let rows = csv::Reader::from_reader(&include_bytes!("published.csv")[..]);
    // The file is part of the binary, and a test reads every line of it.
    let rows = rows.into_deserialize().filter_map(|row: Result<Row, csv::Error>| row.ok());
    let of = |row: Row| {
        let found = row.feasible.map(|found| found == "yes");
        let figures = Published { seconds: row.seconds, found, objective: row.objective };
        ((row.table, row.x.to_string(), row.algorithm), figures)
    };
    Figures(rows.map(of).collect())
}
