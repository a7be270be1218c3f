//! [`Table`]: what is measured, and against what it is laid out.

use voltour_solver::generate::Cell;

use super::Entrant;

/// One of the paper's tables.
#[derive(Clone, Debug)]
pub struct Table {
    /// Its name on the command line and of its files.
    pub name: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// What differs between its settings.
    pub varied: &'static str,
    /// What an objective is shown as.
    pub measure: Measure,
    /// Its settings, in the order of what differs.
    pub settings: Vec<Setting>,
}

/// A family of scenarios and who solves them.
#[derive(Clone, Debug)]
pub struct Setting {
    /// The value of what differs.
    pub x: f64,
    /// The scenarios.
    pub cell: Cell,
    /// The rows.
    pub entrants: Vec<Entrant>,
}

/// How an objective is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Metres, as energy spent on travelling in kJ: the paper's 600 J/m.
    TravelKj,
    /// Joules charged, in kJ.
    ChargedKj,
    /// Sensors charged.
    Sensors,
}

impl Measure {
    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::TravelKj => "travel, kJ",
            Self::ChargedKj => "charged, kJ",
            Self::Sensors => "sensors charged",
        }
    }

    /// An objective as it is shown.
    pub fn of(self, objective: f64) -> f64 {
        match self {
            Self::TravelKj => objective * 0.6,
            Self::ChargedKj => objective / 1e3,
            Self::Sensors => objective,
        }
    }

    /// Whether less is better.
    pub fn is_cost(self) -> bool {
        self == Self::TravelKj
    }
}
