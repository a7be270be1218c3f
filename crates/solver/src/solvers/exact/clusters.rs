//! Disjoint sets of candidates of each of which a feasible tour serves at least one.

use super::{Model, Places};

/// Sets kept at most; a bound over some of them is a bound.
const MOST: usize = 2_500;

/// Which demands a packing takes first.
#[derive(Clone, Copy, Debug)]
pub enum First {
    /// Those of which few members make a set.
    Few,
    /// Those whose members are close together, so that the sets are far apart.
    Close,
}

/// A packing of disjoint sets that every feasible tour meets; `None` where not even serving all who can be
/// served would do.
pub fn clusters(model: &Model<'_>, places: &Places, first: First) -> Option<Vec<Vec<u32>>> {
    let mut free = vec![false; model.len()];
    places.open.iter().for_each(|&i| free[i as usize] = true);
    let mut asked = Vec::new();
    for demand in &model.demands {
        let members: Vec<u32> =
            demand.members.iter().copied().filter(|&i| free[i as usize]).collect();
        // So many members cannot all be left out.
        let size = (members.len() + 1).checked_sub(demand.needs as usize).filter(|&s| s > 0)?;
        let close = nearest(places, &members, size);
        let extent_m = places.least_m(close[0] as usize, close[size - 1] as usize);
        asked.push((size, extent_m, members));
    }
    match first {
        First::Few => asked.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))),
        First::Close => asked.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0))),
    }
    let mut sets: Vec<Vec<u32>> = Vec::new();
    for (size, _, mut members) in asked {
        members.retain(|&i| free[i as usize]);
        while members.len() >= size {
            let set = nearest(places, &members, size);
            set.iter().for_each(|&i| free[i as usize] = false);
            members.retain(|&i| free[i as usize]);
            sets.push(set);
        }
    }
    if sets.len() > MOST {
        let kept = (0..MOST).map(|k| sets[k * sets.len() / MOST].clone());
        return Some(kept.collect());
    }
    Some(sets)
}

/// The first member and so many in all of those nearest to it, the farthest last.
fn nearest(places: &Places, members: &[u32], size: usize) -> Vec<u32> {
    let mut near = members.to_vec();
    if let Some(&first) = members.first() {
        let apart_m = |i: u32| places.least_m(first as usize, i as usize);
        near[1..].sort_by(|&a, &b| apart_m(a).total_cmp(&apart_m(b)).then(a.cmp(&b)));
    }
    near.truncate(size);
    near
}
