//! The paper's tables and figures (section "Performance Comparison"), as settings of ours.

use std::collections::BTreeMap;

use voltour_solver::generate::{Cell, KCoverage, Mobile, Reward};
use voltour_solver::solvers::SolverName;

use super::{Entrant, Job, Measure, Setting, Source, Table};

/// What ours are beside the paper's algorithms.
const OURS: [Entrant; 3] = [
    Entrant::plain(SolverName::Baseline),
    Entrant::plain(SolverName::Auto),
    Entrant::plain(SolverName::Exact),
];

/// Step of the time of `app` among moving sensors where it is not what differs, in seconds.
const STEP_S: u32 = 300;

/// All of them, in the order of the paper.
pub fn tables() -> Vec<Table> {
    let sizes = [48, 64, 72, 80].map(|n| k_coverage(f64::from(n), n, 3, 0.45));
    let requirements = [2, 3, 4].map(|k| k_coverage(f64::from(k), 64, k, 0.45));
    let thresholds = |n, k| [0.2, 0.4, 0.6, 0.8].map(|alpha| k_coverage(alpha, n, k, alpha));
    let mobiles = [10, 20, 30].map(|n| mobile(f64::from(n), n, STEP_S));
    let steps = [90, 180, 300].map(|step_s| mobile(f64::from(step_s), 10, step_s));
    let fields = [50, 100, 150, 200].map(|n| reward(f64::from(n), n, 300e3));
    let capacities = [200.0, 250.0, 300.0, 350.0].map(|kj| reward(kj, 120, kj * 1e3));
    let table = |name, title, varied, measure, settings: &[Setting]| Table {
        name,
        title,
        varied,
        measure,
        settings: settings.to_vec(),
    };
    use Measure::{ChargedKj, Sensors, TravelKj};
    vec![
        table(
            "mobile-network-size",
            "Mobile sensors: network size (steps of 300 s)",
            "n",
            Sensors,
            &mobiles,
        ),
        table(
            "mobile-time-step",
            "Mobile sensors: time step of app (n = 10)",
            "step, s",
            Sensors,
            &steps,
        ),
        table("reward-network-size", "Reward: network size (300 kJ)", "n", ChargedKj, &fields),
        table(
            "reward-capacity",
            "Reward: charger capacity (n = 120)",
            "capacity, kJ",
            ChargedKj,
            &capacities,
        ),
        table(
            "network-size",
            "k-coverage: network size (k = 3, alpha = 0.45)",
            "n",
            TravelKj,
            &sizes,
        ),
        table(
            "coverage-requirement",
            "k-coverage: coverage requirement (n = 64, alpha = 0.45)",
            "k",
            TravelKj,
            &requirements,
        ),
        table(
            "energy-threshold-32",
            "k-coverage: remaining energy threshold (n = 32, k = 2)",
            "alpha",
            TravelKj,
            &thresholds(32, 2),
        ),
        table(
            "energy-threshold-48",
            "k-coverage: remaining energy threshold (n = 48, k = 3)",
            "alpha",
            TravelKj,
            &thresholds(48, 3),
        ),
    ]
}

/// The jobs of some tables: each cell once, whatever tables it is in. The first scenario of every cell comes
/// before the second of any, so that what is there of an interrupted bench is even.
pub fn paper_jobs(tables: &[Table], scenarios: u64, seed: u64) -> Vec<Job> {
    let mut cells: BTreeMap<String, (Cell, Vec<Entrant>)> = BTreeMap::new();
    for setting in tables.iter().flat_map(|table| &table.settings) {
        let fresh = || (setting.cell.clone(), Vec::new());
        let (_, entrants) = cells.entry(setting.cell.to_string()).or_insert_with(fresh);
        let new = setting.entrants.iter().filter(|entrant| !entrants.contains(entrant));
        let new: Vec<Entrant> = new.copied().collect();
        entrants.extend(new);
    }
    let job = |index: u64| {
        cells.values().map(move |(cell, entrants)| Job {
            source: Source::Cell { cell: cell.clone(), seed },
            index,
            entrants: entrants.clone(),
        })
    };
    (0..scenarios).flat_map(job).collect()
}

fn k_coverage(x: f64, sensors: u32, k: u32, alpha: f64) -> Setting {
    let theirs = [
        Entrant::plain(SolverName::Dp),
        Entrant::plain(SolverName::Dqn),
        Entrant::plain(SolverName::Acs),
        Entrant::plain(SolverName::Random),
        Entrant::literal(SolverName::Random),
        Entrant::plain(SolverName::Nearest),
        Entrant::literal(SolverName::Nearest),
    ];
    let options = KCoverage { sensors, k, alpha, ..KCoverage::default() };
    setting(x, Cell::KCoverage(options), &theirs)
}

fn mobile(x: f64, sensors: u32, step_s: u32) -> Setting {
    let theirs = [
        Entrant::plain(SolverName::Dqn),
        Entrant::stepping(SolverName::App, step_s),
        Entrant::plain(SolverName::Nearest),
        Entrant::plain(SolverName::Random),
    ];
    setting(x, Cell::Mobile(Mobile { sensors, ..Mobile::default() }), &theirs)
}

fn reward(x: f64, sensors: u32, capacity_j: f64) -> Setting {
    let theirs = [
        Entrant::plain(SolverName::Dqn),
        Entrant::plain(SolverName::App),
        Entrant::plain(SolverName::Mst),
        Entrant::plain(SolverName::Cmst),
        Entrant::plain(SolverName::Nearest),
    ];
    let options = Reward { sensors, capacity_j, alpha: 0.2, ..Reward::default() };
    setting(x, Cell::Reward(options), &theirs)
}

fn setting(x: f64, cell: Cell, theirs: &[Entrant]) -> Setting {
    Setting { x, cell, entrants: theirs.iter().chain(&OURS).copied().collect() }
}
