//! Which regions fall short of k, for the violations and the warnings of a plan.

use super::Region;
use crate::scenario::Scenario;

/// A region with fewer covers than it needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shortfall<'a> {
    /// The region.
    pub region: &'a Region,
    /// Covers that it needs.
    pub needs: u32,
    /// Covers that it has, fewer than `needs`.
    pub has: u32,
}

/// The regions that keep fewer than min(k, c) of their c covers, in the order given. A sensor is kept
/// if it has no request, or an already charged one, or if `served(request index)` holds.
pub fn shortfalls<'a>(
    scenario: &Scenario,
    regions: &'a [Region],
    served: impl Fn(usize) -> bool,
) -> Vec<Shortfall<'a>> {
    let Some(coverage) = &scenario.coverage else { return Vec::new() };
    let mut kept = vec![true; scenario.sensors.len()];
    for (i, request) in scenario.requests.iter().enumerate() {
        kept[request.sensor] = scenario.already_charged(request) || served(i);
    }
    let short = |region: &'a Region| {
        let needs = coverage.k.min(region.covering.len() as u32);
        let has = region.covering.iter().filter(|&&sensor| kept[sensor as usize]).count() as u32;
        (has < needs).then_some(Shortfall { region, needs, has })
    };
    regions.iter().filter_map(short).collect()
}

/// The regions that fewer than k sensors cover, whatever is charged; here `needs` is k.
pub fn below_k<'a>(scenario: &Scenario, regions: &'a [Region]) -> Vec<Shortfall<'a>> {
    let Some(coverage) = &scenario.coverage else { return Vec::new() };
    let short = |region: &'a Region| {
        let has = region.covering.len() as u32;
        (has < coverage.k).then_some(Shortfall { region, needs: coverage.k, has })
    };
    regions.iter().filter_map(short).collect()
}
