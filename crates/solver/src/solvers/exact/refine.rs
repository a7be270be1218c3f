//! Between two rounds: paths remember more, count more and keep finer times.

use super::layers::MOST_ARRIVALS;
use super::memory::Memory;
use super::multipliers::Ascent;
use super::prover::Prover;
use super::relaxation::{Reading, Resource};
use super::tally::Tally;

/// Layers of time at most, where metres are the cost and where gains are.
const MOST_INTERVALS: usize = 200;
const MOST_INTERVALS_OF_GAIN: usize = 800;
/// Combinations of counts that the states of paths may take.
const MOST_TALLY: usize = 128;
/// Values that the bounds may take up.
const MOST_VALUES: usize = 40_000_000;

impl Prover<'_, '_, '_> {
    /// Makes the paths more like tours: the candidates on each way round remember where it began, and
    /// the demand that paths keep to the least is counted. Whether the budget lasted.
    #[must_use]
    pub(super) fn refine(&mut self, ascent: &mut Ascent, most: usize) -> bool {
        self.paths.read(Reading::Paths);
        if !self.fix(&ascent.best) {
            return false;
        }
        let path = self.paths.path(&ascent.best.prices);
        let mut memory = self.paths.memory().clone();
        learn(&mut memory, &path, most);
        if self.late(&path) && self.may_split() && !self.paths.split(self.model, self.budget) {
            return false;
        }
        if self.paths.size(&memory, self.paths.tally().states) > MOST_VALUES {
            memory = self.paths.memory().clone();
        }
        let mut tally = self.paths.tally().clone();
        if let Some(demand) = ascent.loosest(self.model) {
            let states = tally.states * (self.model.demands[demand].needs as usize + 1);
            if states <= MOST_TALLY && self.paths.size(&memory, states) <= MOST_VALUES {
                let mut demands = tally.demands.clone();
                demands.push(demand);
                tally = Tally::new(self.model, demands);
                ascent.count(self.model, demand);
            }
        }
        self.paths.refine(memory, tally);
        true
    }

    /// Whether finer times are of use and within what memory allows.
    fn may_split(&self) -> bool {
        let most = if self.model.length_counts { MOST_INTERVALS } else { MOST_INTERVALS_OF_GAIN };
        let values = self.paths.size(self.paths.memory(), self.paths.tally().states);
        self.paths.resource() == Resource::Time
            && self.paths.intervals() < most
            && 2 * self.paths.arrivals() <= MOST_ARRIVALS
            && 2 * values <= MOST_VALUES
    }

    /// Whether a relaxed path misses a deadline, which rounding of times hides.
    fn late(&self, path: &[u32]) -> bool {
        let instance = &self.model.wide;
        let mut run = instance.departure();
        path.iter().any(|&stop| {
            run = instance.step(&run, stop);
            !instance.in_time(&run)
        }) || instance.finish(&run).arrive_s > instance.timespan_s
    }
}

/// Makes the candidates on each way round remember where it began.
fn learn(memory: &mut Memory, path: &[u32], most: usize) {
    for (end, &stop) in path.iter().enumerate() {
        if let Some(begin) = path[..end].iter().rposition(|&other| other == stop) {
            memory.learn(stop, &path[begin + 1..end], most);
        }
    }
}
