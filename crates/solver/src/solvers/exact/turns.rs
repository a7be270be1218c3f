//! What following an arc means for the states at its ends.
//!
//! Most of what the tail of an arc remembers is forgotten at its head. Masks of the tail that lead to one mask of
//! the head are looked at as one, a pattern; arcs from one candidate whose heads remember the same share patterns.

use super::memory::Memory;
use super::network::Network;
use super::patterns::Patterns;

/// An arc between states.
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    /// What it costs under the prices of the last evaluation.
    pub cost: f64,
    pub to: u32,
    /// The state of a layer that its first pattern leads to, before anything is counted.
    head: u32,
    /// The cell of that pattern among those of its tail.
    cell: u32,
    /// Where the states that its patterns lead to begin.
    heads: u32,
    /// Where their cells begin.
    cells: u32,
    /// How many patterns lead on.
    patterns: u16,
    /// How many neighbours its head remembers.
    near: u16,
}

impl Turn {
    /// By how much the states of its head lie further on where the tally is in this state.
    #[inline]
    pub fn counted(&self, tally: usize) -> usize {
        tally << self.near
    }
}

/// All arcs between candidates, with the states at their ends.
#[derive(Debug, Default)]
pub struct Turns {
    /// By arc.
    pub all: Vec<Turn>,
    /// By candidate.
    pub patterns: Vec<Patterns>,
    /// By arc and pattern, the state at its end, before anything is counted.
    heads: Vec<u32>,
    /// By pattern of arcs whose heads remember the same, its cell among those of their tail.
    cells: Vec<u32>,
}

impl Turns {
    /// The arcs under this memory; `offset` says where the states of each candidate begin in a layer.
    pub fn new(network: &Network, memory: &Memory, offset: &[usize]) -> Self {
        let mut turns = Self::default();
        // Of arcs whose heads remember the same: the bit of the head itself, the bits that the head remembers too,
        // and where their cells begin.
        let mut kinds: Vec<(usize, usize, usize)> = Vec::new();
        // What both ends of an arc remember, as the bits here and there.
        let mut shared: Vec<(usize, usize)> = Vec::new();
        for from in 0..memory.of.len() {
            let near = &memory.of[from];
            let mut patterns = Patterns::new(near.len());
            kinds.clear();
            for arc in &network.arcs[network.leaving(from)] {
                let ahead = &memory.of[arc.to as usize];
                let bit = |place: Result<usize, usize>| place.map_or(0, |bit| 1_usize << bit);
                let back = bit(near.binary_search(&arc.to));
                let own = bit(ahead.binary_search(&(from as u32)));
                shared.clear();
                for (here, other) in near.iter().enumerate() {
                    if let Ok(there) = ahead.binary_search(other) {
                        shared.push((1 << here, 1 << there));
                    }
                }
                let kept = shared.iter().fold(0, |kept, (here, _)| kept | here);
                let known = kinds.iter().find(|kind| (kind.0, kind.1) == (back, kept));
                let cells = known.map_or(turns.cells.len(), |kind| kind.2);
                if known.is_none() {
                    kinds.push((back, kept, cells));
                    let open = ((1 << near.len()) - 1) & !(back | kept);
                    let here = subsets(&shared, |(here, _)| here);
                    turns.cells.extend(here.map(|visited| patterns.cell(open, visited) as u32));
                }
                let state = offset[arc.to as usize] + own;
                turns.all.push(Turn {
                    cost: 0.0,
                    to: arc.to,
                    head: state as u32,
                    cell: turns.cells[cells],
                    heads: turns.heads.len() as u32,
                    cells: cells as u32,
                    patterns: 1 << shared.len(),
                    near: ahead.len() as u16,
                });
                let there = subsets(&shared, |(_, there)| there);
                turns.heads.extend(there.map(|visited| (state + visited) as u32));
            }
            patterns.connect();
            turns.patterns.push(patterns);
        }
        turns
    }

    /// Calls with the cell of each pattern of an arc and the state of a layer that it leads to, before anything is
    /// counted.
    #[inline]
    pub fn each_head(&self, turn: &Turn, mut each: impl FnMut(usize, usize)) {
        // Most heads remember nothing of what their tails do.
        if turn.patterns == 1 {
            return each(turn.cell as usize, turn.head as usize);
        }
        let of = |first: u32| first as usize..first as usize + usize::from(turn.patterns);
        for (&cell, &head) in self.cells[of(turn.cells)].iter().zip(&self.heads[of(turn.heads)]) {
            each(cell as usize, head as usize);
        }
    }
}

/// The unions of some bits, for each subset of them.
fn subsets(
    bits: &[(usize, usize)],
    of: impl Fn((usize, usize)) -> usize + Copy,
) -> impl Iterator<Item = usize> {
    (0..1_usize << bits.len()).map(move |subset| {
        let chosen = bits.iter().enumerate().filter(move |(k, _)| subset >> k & 1 == 1);
        chosen.fold(0, |union, (_, &both)| union | of(both))
    })
}
