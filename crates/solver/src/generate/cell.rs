//! [`Cell`]: a family of scenarios, as in a cell of the paper's tables.

use std::fmt;
use std::str::FromStr;

use super::{GenerateError, KCoverage, Mobile, Reward, k_coverage, mobile, reward};
use crate::policy::Problem;
use crate::scenario::Document;

/// Seeds of the scenarios that measure solvers begin here; those that policies are trained on lie below.
pub const FIRST_TEST_SEED: u64 = 1 << 40;

/// Scenarios that differ in nothing but their seed.
#[derive(Clone, Debug, PartialEq)]
pub enum Cell {
    /// `k_coverage/N/K/ALPHA`: the field as in the paper, larger with more than 80 sensors, at the same density.
    KCoverage(KCoverage),
    /// `reward/N/CAPACITY_J/ALPHA`, and `dense/N`: in 400 m with alpha 1.0.
    Reward(Reward),
    /// `mobile/N`.
    Mobile(Mobile),
}

/// The text names no cell.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "unknown cell {0:?}; a cell is k_coverage/N/K/ALPHA, reward/N/CAPACITY_J/ALPHA, dense/N or mobile/N"
)]
pub struct UnknownCell(String);

/// The cells of the paper's tables, the hard and the large ones that go beyond them.
const K_COVERAGE: [&str; 14] = [
    "k_coverage/48/3/0.45",
    "k_coverage/64/3/0.45",
    "k_coverage/72/3/0.45",
    "k_coverage/80/3/0.45",
    "k_coverage/64/2/0.45",
    "k_coverage/64/4/0.45",
    "k_coverage/32/2/0.2",
    "k_coverage/32/2/0.4",
    "k_coverage/32/2/0.6",
    "k_coverage/32/2/0.8",
    "k_coverage/48/3/0.2",
    "k_coverage/48/3/0.4",
    "k_coverage/48/3/0.6",
    "k_coverage/48/3/0.8",
];
const REWARD: [&str; 16] = [
    "reward/50/300000/0.2",
    "reward/100/300000/0.2",
    "reward/150/300000/0.2",
    "reward/200/300000/0.2",
    "reward/120/200000/0.2",
    "reward/120/250000/0.2",
    "reward/120/350000/0.2",
    "reward/50/300000/1.0",
    "reward/100/300000/1.0",
    "reward/150/300000/1.0",
    "reward/200/300000/1.0",
    "reward/120/200000/1.0",
    "reward/120/250000/1.0",
    "reward/120/350000/1.0",
    "dense/80",
    "dense/120",
];
const MOBILE: [&str; 3] = ["mobile/10", "mobile/20", "mobile/30"];

impl Cell {
    /// The cells of a problem.
    pub fn of(problem: Problem) -> Vec<Self> {
        let names: &[&str] = match problem {
            Problem::KCoverage => &K_COVERAGE,
            Problem::Reward => &REWARD,
            Problem::Mobile => &MOBILE,
        };
        names.iter().filter_map(|name| name.parse().ok()).collect()
    }

    /// The problem that it belongs to.
    pub fn problem(&self) -> Problem {
        match self {
            Self::KCoverage(_) => Problem::KCoverage,
            Self::Reward(_) => Problem::Reward,
            Self::Mobile(_) => Problem::Mobile,
        }
    }

    /// Its scenario of a seed.
    ///
    /// # Errors
    /// An option is out of its range.
    pub fn draw(&self, seed: u64) -> Result<Document, GenerateError> {
        match self {
            Self::KCoverage(options) => k_coverage(options, seed),
            Self::Reward(options) => reward(options, seed),
            Self::Mobile(options) => mobile(options, seed),
        }
    }
}

impl FromStr for Cell {
    type Err = UnknownCell;

    fn from_str(text: &str) -> Result<Self, UnknownCell> {
        let parts: Vec<&str> = text.split('/').collect();
        let unknown = || UnknownCell(text.to_owned());
        let count = |text: &str| text.parse::<u32>().map_err(|_| unknown());
        let number = |text: &str| text.parse::<f64>().map_err(|_| unknown());
        match parts.as_slice() {
            ["k_coverage", n, k, alpha] => {
                let (sensors, k, alpha) = (count(n)?, count(k)?, number(alpha)?);
                let options = KCoverage { sensors, k, alpha, ..KCoverage::default() };
                let grown = (f64::from(sensors) / 80.0).sqrt().max(1.0);
                let side_m = options.side_m * grown;
                Ok(Self::KCoverage(KCoverage { side_m, ..options }))
            }
            ["reward", n, capacity_j, alpha] => {
                let (sensors, capacity_j, alpha) = (count(n)?, number(capacity_j)?, number(alpha)?);
                Ok(Self::Reward(Reward { sensors, capacity_j, alpha, ..Reward::default() }))
            }
            ["dense", n] => Ok(Self::Reward(Reward {
                sensors: count(n)?,
                side_m: 400.0,
                alpha: 1.0,
                ..Reward::default()
            })),
            ["mobile", n] => Ok(Self::Mobile(Mobile { sensors: count(n)?, ..Mobile::default() })),
            _ => Err(unknown()),
        }
    }
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::KCoverage(KCoverage { sensors, k, alpha, .. }) => {
                write!(f, "k_coverage/{sensors}/{k}/{alpha}")
            }
            Self::Reward(Reward { sensors, side_m, .. }) if *side_m == 400.0 => {
                write!(f, "dense/{sensors}")
            }
            Self::Reward(Reward { sensors, capacity_j, alpha, .. }) => {
                write!(f, "reward/{sensors}/{capacity_j}/{alpha}")
            }
            Self::Mobile(Mobile { sensors, .. }) => write!(f, "mobile/{sensors}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_cell_is_read_back_by_its_name() {
        for problem in Problem::ALL {
            let cells = Cell::of(problem);
            assert!(cells.len() >= 3);
            for cell in cells {
                assert_eq!(cell.problem(), problem);
                assert_eq!(cell.to_string().parse::<Cell>(), Ok(cell));
            }
        }
        for wrong in ["", "mobile", "mobile/x", "k_coverage/48/3", "reward/1/2/3/4"] {
            assert!(wrong.parse::<Cell>().is_err(), "{wrong}");
        }
    }
}
