//! The cells that scenarios are drawn from: sizes and settings around those of the paper's tables.

use voltour_solver::generate::{Cell, KCoverage, Mobile, Reward};
use voltour_solver::policy::Problem;

/// The cells of a problem's training; each is drawn from as often.
pub fn cells(problem: Problem) -> Vec<Cell> {
    match problem {
        Problem::KCoverage => k_coverage(),
        Problem::Reward => reward(),
        Problem::Mobile => mobile(),
    }
}

/// n from 32 to 80 with k from 2 to 4. A dense field asks little of a charger unless alpha is high; beyond what
/// stands here tours grow longer than any table of the paper.
fn k_coverage() -> Vec<Cell> {
    const DEPLOYMENTS: [(u32, u32); 9] =
        [(32, 2), (40, 2), (48, 2), (48, 3), (56, 3), (64, 3), (64, 4), (72, 3), (80, 4)];
    const ALPHAS: [f64; 5] = [0.2, 0.4, 0.45, 0.6, 0.8];
    let all = DEPLOYMENTS.into_iter().flat_map(|(n, k)| ALPHAS.map(|alpha| (n, k, alpha)));
    let drawn = all.filter(|(n, _, alpha)| *n < 64 || *alpha <= 0.6);
    drawn
        .map(|(sensors, k, alpha)| {
            Cell::KCoverage(KCoverage { sensors, k, alpha, ..Default::default() })
        })
        .collect()
}

/// n from 40 to 200 with 150 to 400 kJ, few who ask or all; and the same in a dense field.
fn reward() -> Vec<Cell> {
    let mut cells = Vec::new();
    for capacity_j in [150_000.0, 200_000.0, 250_000.0, 300_000.0, 350_000.0, 400_000.0] {
        for sensors in [50, 80, 120, 160, 200] {
            cells.push(Reward { sensors, capacity_j, ..Default::default() });
        }
        for sensors in [20, 40, 60, 80, 120] {
            cells.push(Reward { sensors, capacity_j, alpha: 1.0, ..Default::default() });
        }
        for sensors in [30, 60, 80, 120] {
            cells.push(Reward {
                sensors,
                capacity_j,
                alpha: 1.0,
                side_m: 400.0,
                ..Default::default()
            });
        }
    }
    cells.into_iter().map(Cell::Reward).collect()
}

/// n from 5 to 40 around the paper's half hour.
fn mobile() -> Vec<Cell> {
    let mut cells = Vec::new();
    for sensors in [5, 10, 15, 20, 25, 30, 40] {
        for timespan_s in [1200.0, 1800.0, 2400.0] {
            cells.push(Cell::Mobile(Mobile { sensors, timespan_s, ..Default::default() }));
        }
    }
    cells
}
