//! The candidates nearest to each, computed when first asked for.

use crate::instance::Instance;

/// Length of a list.
const NEAREST: usize = 48;

/// Nearest first; for moving sensors by their places at time 0.
pub struct Neighbours {
    lists: Vec<Option<Box<[u32]>>>,
    keyed: Vec<(f64, u32)>,
}

impl Neighbours {
    /// No list yet.
    pub fn new(instance: &Instance<'_>) -> Self {
        Self { lists: vec![None; instance.len()], keyed: Vec::new() }
    }

    /// The nearest candidates to one, itself left out.
    pub fn of(&mut self, instance: &Instance<'_>, candidate: u32) -> &[u32] {
        let keyed = &mut self.keyed;
        self.lists[candidate as usize].get_or_insert_with(|| {
            let others = (0..instance.len() as u32).filter(|&other| other != candidate);
            keyed.clear();
            keyed.extend(others.map(|other| (near(instance, candidate, other), other)));
            let compare = |a: &(f64, u32), b: &(f64, u32)| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1));
            if keyed.len() > NEAREST {
                keyed.select_nth_unstable_by(NEAREST, compare);
                keyed.truncate(NEAREST);
            }
            keyed.sort_unstable_by(compare);
            keyed.iter().map(|&(_, other)| other).collect()
        })
    }
}

fn near(instance: &Instance<'_>, a: u32, b: u32) -> f64 {
    if instance.moving {
        let point = |c: u32| instance.candidates[c as usize].point;
        (point(a) - point(b)).norm()
    } else {
        let (a, b) = (a as usize, b as usize);
        instance.distance_m(a, b) + instance.distance_m(b, a)
    }
}
