//! Demands by candidate: at least so many of these must be served.
//!
//! A `required` request is a demand of one member. Two sets exist: the reduced one, in which no
//! demand implies another, is what a search works with; the complete one counts the missing covers
//! as a plan's violations do, one for each distinct set of covering sensors.

use std::collections::BTreeMap;

use super::Candidate;
use crate::coverage::{self, Region};
use crate::scenario::Scenario;

/// At least `needs` of `members` must be served.
#[derive(Clone, Debug, PartialEq)]
pub struct Demand {
    /// Rising candidate indices.
    pub members: Vec<u32>,
    /// From 1 to the number of members.
    pub needs: u32,
    /// How many covering sets ask exactly this.
    pub sets: u32,
    /// Whether it stands for a `required` request rather than for coverage.
    pub required: bool,
}

/// The demands, and for each candidate those it helps to meet.
#[derive(Clone, Debug, Default)]
pub struct DemandSet {
    /// In a fixed order, `required` ones first.
    pub demands: Vec<Demand>,
    /// For each candidate, rising indices into `demands`.
    pub of: Vec<Vec<u32>>,
}

impl DemandSet {
    /// The demands that no other implies.
    pub(super) fn reduced(
        scenario: &Scenario,
        regions: &[Region],
        candidates: &[Candidate],
    ) -> Self {
        Self::over_requests(scenario, &coverage::demands(scenario, regions), candidates)
    }

    /// These demands of coverage, whose members are requests, and the `required` ones.
    pub(super) fn over_requests(
        scenario: &Scenario,
        demands: &[coverage::Demand],
        candidates: &[Candidate],
    ) -> Self {
        let mut by_request = vec![None; scenario.requests.len()];
        for (i, candidate) in candidates.iter().enumerate() {
            by_request[candidate.request] = Some(i as u32);
        }
        let covers = demands.iter().map(|demand| Demand {
            members: demand.members.iter().filter_map(|&r| by_request[r as usize]).collect(),
            needs: demand.needs,
            sets: 1,
            required: false,
        });
        Self::index(candidates, covers.collect())
    }

    /// What every covering set asks, equal ones counted together.
    pub(super) fn complete(
        scenario: &Scenario,
        regions: &[Region],
        candidates: &[Candidate],
    ) -> Self {
        let k = scenario.coverage.as_ref().map_or(0, |coverage| coverage.k as usize);
        let mut by_sensor = vec![None; scenario.sensors.len()];
        for (i, candidate) in candidates.iter().enumerate() {
            by_sensor[scenario.requests[candidate.request].sensor] = Some(i as u32);
        }
        let mut sets: BTreeMap<(Vec<u32>, u32), u32> = BTreeMap::new();
        for region in regions {
            let covering = region.covering.len();
            let mut members: Vec<u32> =
                region.covering.iter().filter_map(|&s| by_sensor[s as usize]).collect();
            members.sort_unstable();
            let needs = k.min(covering).saturating_sub(covering - members.len());
            if needs > 0 {
                *sets.entry((members, needs as u32)).or_default() += 1;
            }
        }
        let covers = sets.into_iter().map(|((members, needs), sets)| Demand {
            members,
            needs,
            sets,
            required: false,
        });
        Self::index(candidates, covers.collect())
    }

    fn index(candidates: &[Candidate], covers: Vec<Demand>) -> Self {
        let required = (0u32..).zip(candidates).filter(|(_, c)| c.required).map(|(i, _)| Demand {
            members: vec![i],
            needs: 1,
            sets: 1,
            required: true,
        });
        let demands: Vec<Demand> = required.chain(covers).collect();
        let mut of = vec![Vec::new(); candidates.len()];
        for (d, demand) in (0u32..).zip(&demands) {
            for &member in &demand.members {
                of[member as usize].push(d);
            }
        }
        Self { demands, of }
    }

    /// Missing `required` requests and missing covers, where `served` tells who is served.
    pub fn missing(&self, served: impl Fn(u32) -> bool) -> (u32, u64) {
        let (mut required, mut covers) = (0, 0);
        for demand in &self.demands {
            let has = demand.members.iter().filter(|&&member| served(member)).count() as u32;
            let short = demand.needs.saturating_sub(has);
            if demand.required {
                required += short;
            } else {
                covers += u64::from(short) * u64::from(demand.sets);
            }
        }
        (required, covers)
    }
}
