//! Patterns and masks against a comparison of each with each.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use super::patterns::Patterns;

/// A pattern: neighbours for which either will do, those visited, and its cell.
type Pattern = (usize, usize, usize);

/// Some patterns of a candidate that remembers so many neighbours.
fn some(near: usize, rng: &mut Pcg64Mcg) -> (Patterns, Vec<Pattern>) {
    let full = (1 << near) - 1;
    let mut patterns = Patterns::new(near);
    let count = rng.random_range(0..20);
    let chosen = (0..count).map(|_| {
        let open = rng.random_range(0..=full);
        let visited = rng.random_range(0..=full) & !open;
        (open, visited, patterns.cell(open, visited))
    });
    let mut chosen: Vec<Pattern> = chosen.collect();
    patterns.connect();
    chosen.push((full, 0, patterns.all()));
    (patterns, chosen)
}

fn matches(mask: usize, &(open, visited, _): &Pattern) -> bool {
    mask & !open == visited
}

#[test]
fn masks_take_the_least_of_the_patterns_they_match_and_patterns_of_their_masks() {
    let mut rng = Pcg64Mcg::seed_from_u64(3);
    for trial in 0..400 {
        let near = trial % 9;
        let (patterns, chosen) = some(near, &mut rng);
        let mut cells = vec![f64::INFINITY; patterns.cells()];
        for &(.., cell) in &chosen {
            cells[cell] = rng.random_range(-1.0..1.0);
        }
        let least = |mask: usize| {
            let costs = chosen.iter().filter(|p| matches(mask, p)).map(|p| cells[p.2]);
            costs.fold(f64::INFINITY, f64::min)
        };
        let expected: Vec<f64> = (0..1 << near).map(least).collect();
        let mut masks = vec![0.0; 1 << near];
        patterns.fold(&mut cells.clone(), &mut masks);
        assert_eq!(masks, expected, "{near} remembered, {chosen:?}");

        let cost = |_| if rng.random_bool(0.2) { f64::INFINITY } else { rng.random() };
        let costs: Vec<f64> = masks.iter().map(cost).collect();
        // What the cells held before must not show.
        patterns.spread(&costs, &mut cells);
        for pattern in &chosen {
            let masks = (0..1 << near).filter(|&mask| matches(mask, pattern));
            let least = masks.map(|mask| costs[mask]).fold(f64::INFINITY, f64::min);
            assert_eq!(cells[pattern.2], least, "{near} remembered, {pattern:?}");
        }
    }
}
