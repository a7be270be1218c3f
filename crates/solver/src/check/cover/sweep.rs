//! One walk along a curve: who covers which stretch of it.

/// A stretch of the curve, in metres from its beginning, that one disk covers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stretch {
    pub(super) from: f64,
    pub(super) to: f64,
    pub(super) who: u32,
}

/// Stands in for a disk over the stretches that lie outside the field.
pub(super) const OUTSIDE: u32 = u32::MAX;

/// Pieces shorter than this make no sub-region, says the format.
const SHORTEST_M: f64 = 1e-9;

/// Calls `visit` with begin, end and covering disks of each piece of the curve, of those that lie
/// in the field and are long enough. The disks come in no particular order.
pub(super) fn pieces(length: f64, stretches: &[Stretch], mut visit: impl FnMut(f64, f64, &[u32])) {
    let mut events = Vec::with_capacity(2 * stretches.len() + 1);
    for stretch in stretches.iter().filter(|stretch| stretch.from < stretch.to) {
        events.push((stretch.from, stretch.who, true));
        events.push((stretch.to, stretch.who, false));
    }
    events.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
    events.push((length, OUTSIDE, true));
    let mut covering = Vec::new();
    let mut from = 0.0;
    for (at, who, begins) in events {
        if at - from >= SHORTEST_M && !covering.contains(&OUTSIDE) {
            visit(from, at, &covering);
        }
        from = at;
        if begins {
            covering.push(who);
        } else if let Some(place) = covering.iter().position(|other| *other == who) {
            covering.swap_remove(place);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn walk(length: f64, stretches: &[(f64, f64, u32)]) -> Vec<(f64, f64, Vec<u32>)> {
        let stretch = |&(from, to, who)| Stretch { from, to, who };
        let stretches: Vec<_> = stretches.iter().map(stretch).collect();
        let mut seen = Vec::new();
        pieces(length, &stretches, |from, to, covering| {
            let mut covering = covering.to_vec();
            covering.sort_unstable();
            seen.push((from, to, covering));
        });
        seen
    }

    #[test]
    fn pieces_lie_between_events() {
        let seen = walk(10.0, &[(0.0, 4.0, 1), (2.0, 10.0, 2)]);
        let right = [(0.0, 2.0, vec![1]), (2.0, 4.0, vec![1, 2]), (4.0, 10.0, vec![2])];
        assert_eq!(seen, right);
        assert_eq!(walk(3.0, &[]), [(0.0, 3.0, vec![])]);
    }

    #[test]
    fn what_is_outside_or_too_short_is_passed_over() {
        let tiny = 7.0 + 5e-10;
        let seen = walk(10.0, &[(0.0, 5.0, OUTSIDE), (7.0, tiny, 3), (8.0, 8.0, 4)]);
        assert_eq!(seen, [(5.0, 7.0, vec![]), (tiny, 10.0, vec![])]);
    }
}
