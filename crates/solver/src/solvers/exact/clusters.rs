//! Disjoint sets of candidates of each of which a feasible tour serves at least one.

use super::{Model, Places};

/// Sets kept at most; a bound over some of them is a bound.
const MOST: usize = 2_500;

/// A packing of disjoint sets that every feasible tour meets, the small ones first; `None` where not
/// even serving all who can be served would do.
pub fn clusters(model: &Model<'_>, places: &Places) -> Option<Vec<Vec<u32>>> {
    let mut free = vec![false; model.len()];
    places.open.iter().for_each(|&i| free[i as usize] = true);
    let mut asked = Vec::new();
    for demand in &model.demands {
        let members: Vec<u32> =
            demand.members.iter().copied().filter(|&i| free[i as usize]).collect();
        // So many members cannot all be left out.
        let size = (members.len() + 1).checked_sub(demand.needs as usize).filter(|&s| s > 0)?;
        asked.push((size, members));
    }
    asked.sort_by_key(|(size, _)| *size);
    let mut sets: Vec<Vec<u32>> = Vec::new();
    for (size, mut members) in asked {
        members.retain(|&i| free[i as usize]);
        while members.len() >= size {
            let near = members[0] as usize;
            members.sort_by(|&a, &b| {
                let apart_m = |i: u32| places.least_m(near, i as usize);
                apart_m(a).total_cmp(&apart_m(b)).then(a.cmp(&b))
            });
            let set: Vec<u32> = members.drain(..size).collect();
            set.iter().for_each(|&i| free[i as usize] = false);
            sets.push(set);
        }
    }
    if sets.len() > MOST {
        let kept = (0..MOST).map(|k| sets[k * sets.len() / MOST].clone());
        return Some(kept.collect());
    }
    Some(sets)
}
