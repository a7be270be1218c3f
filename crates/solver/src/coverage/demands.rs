//! From regions to demands, and from those to the few that no other implies.

use super::sets::Sets;
use super::{Demand, Region};
use crate::scenario::{Point, Scenario};

/// The demands of the scenario that no other demand implies, in a fixed order: the ones that leave
/// the least choice come first.
pub fn demands(scenario: &Scenario, regions: &[Region]) -> Vec<Demand> {
    let mut all = asked(scenario, regions);
    // A demand may leave `spare` of its members unserved. Whoever implies another has no more to
    // spare and needs no fewer, so it stands before it in this order.
    let spare = |demand: &Demand| demand.members.len() - demand.needs as usize;
    all.sort_by(|a, b| {
        (spare(a), b.needs).cmp(&(spare(b), a.needs)).then_with(|| a.members.cmp(&b.members))
    });
    let mut kept = Kept::new(scenario.requests.len());
    for demand in all {
        if !kept.imply(&demand) {
            kept.push(demand);
        }
    }
    kept.demands
}

/// T(a) = max(0, min(k, c) - (c - |r|)) of the requesters r of each region, where that is more than
/// 0; of the regions with the same requesters the one that asks for most.
fn asked(scenario: &Scenario, regions: &[Region]) -> Vec<Demand> {
    let Some(coverage) = &scenario.coverage else { return Vec::new() };
    let mut request_of = vec![None; scenario.sensors.len()];
    for (i, request) in (0..).zip(&scenario.requests) {
        if !scenario.already_charged(request) {
            request_of[request.sensor] = Some(i);
        }
    }
    let mut sets = Sets::default();
    let mut asked: Vec<(u32, Point)> = Vec::new();
    let mut members: Vec<u32> = Vec::new();
    for region in regions {
        members.clear();
        members.extend(region.covering.iter().filter_map(|&sensor| request_of[sensor as usize]));
        let covers = region.covering.len();
        let others = covers - members.len();
        let needs = (coverage.k as usize).min(covers).saturating_sub(others) as u32;
        if needs == 0 {
            continue;
        }
        members.sort_unstable();
        let id = sets.intern(&members) as usize;
        match asked.get_mut(id) {
            Some(most) if most.0 < needs => *most = (needs, region.witness),
            Some(_) => {}
            None => asked.push((needs, region.witness)),
        }
    }
    let demand = |(id, (needs, witness))| Demand { members: sets.get(id).to_vec(), needs, witness };
    (0..).zip(asked).map(demand).collect()
}

/// The demands that remain, found by their members.
///
/// (R', T') implies (R, T) where T' - |R' \ R| >= T: then R misses fewer than T' members of R', so
/// among any T' of them there is one that is in R. It is enough to list a demand under T' of its
/// members, the ones with the shortest lists.
struct Kept {
    demands: Vec<Demand>,
    listed: Vec<Vec<u32>>,
    marked: Marks,
    tried: Marks,
}

impl Kept {
    fn new(requests: usize) -> Self {
        let listed = vec![Vec::new(); requests];
        let (marked, tried) = (Marks::new(requests), Marks::default());
        Self { demands: Vec::new(), listed, marked, tried }
    }

    fn imply(&mut self, demand: &Demand) -> bool {
        let Self { demands, listed, marked, tried } = self;
        marked.clear();
        tried.clear();
        demand.members.iter().for_each(|&member| _ = marked.set(member));
        let lists = demand.members.iter().flat_map(|&member| &listed[member as usize]);
        lists.into_iter().any(|&i| tried.set(i) && implies(&demands[i as usize], demand, marked))
    }

    fn push(&mut self, demand: Demand) {
        let id = self.demands.len() as u32;
        let mut members = demand.members.clone();
        members.sort_by_key(|&member| self.listed[member as usize].len());
        for &member in members.iter().take(demand.needs as usize) {
            self.listed[member as usize].push(id);
        }
        self.tried.grow(id as usize + 1);
        self.demands.push(demand);
    }
}

/// Whether whoever satisfies `strong` satisfies `weak`, whose members are marked.
fn implies(strong: &Demand, weak: &Demand, members_of_weak: &Marks) -> bool {
    let Some(may_miss) = strong.needs.checked_sub(weak.needs) else { return false };
    let missed = strong.members.iter().filter(|&&member| !members_of_weak.has(member));
    missed.take(may_miss as usize + 1).count() <= may_miss as usize
}

/// A set of small numbers that is emptied in constant time.
#[derive(Default)]
struct Marks {
    round: u32,
    rounds: Vec<u32>,
}

impl Marks {
    fn new(numbers: usize) -> Self {
        Self { round: 0, rounds: vec![0; numbers] }
    }

    fn grow(&mut self, numbers: usize) {
        self.rounds.resize(numbers, 0);
    }

    fn clear(&mut self) {
        self.round += 1;
    }

    /// Whether the number is new.
    fn set(&mut self, number: u32) -> bool {
        std::mem::replace(&mut self.rounds[number as usize], self.round) != self.round
    }

    fn has(&self, number: u32) -> bool {
        self.rounds[number as usize] == self.round
    }
}
