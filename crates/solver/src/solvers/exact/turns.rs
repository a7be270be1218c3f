//! What following an arc means for the states at its ends.
//!
//! Most of what the tail of an arc remembers is forgotten at its head. Masks of the tail that lead to one mask of
//! the head are looked at as one, a slot; arcs from one candidate whose heads remember the same share slots.

use super::memory::Memory;
use super::network::Network;

/// An arc between states.
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    /// What it costs under the prices of the last evaluation.
    pub cost: f64,
    pub to: u32,
    /// The state of a layer that its first slot leads to, before anything is counted.
    head: u32,
    /// Where the states that its slots lead to begin.
    heads: u32,
    /// Its first slot among those of its tail.
    slot: u32,
    /// How many slots lead on.
    slots: u16,
    /// Its group among those that leave its tail.
    pub group: u16,
    /// How many neighbours its head remembers.
    near: u16,
}

impl Turn {
    /// Its slots among those of its tail.
    #[inline]
    fn slots(&self) -> std::ops::Range<usize> {
        self.slot as usize..self.slot as usize + usize::from(self.slots)
    }

    /// By how much the states of its head lie further on where the tally is in this state.
    #[inline]
    pub fn counted(&self, tally: usize) -> usize {
        tally << self.near
    }
}

/// The arcs from one candidate whose heads remember the same of what it does.
#[derive(Clone, Copy, Debug)]
pub struct Group {
    /// Where its slots begin among those of the candidate; the last one, of masks that may not take the
    /// arc, stays empty.
    pub first: u32,
    /// How many slots lead on.
    pub slots: u32,
    /// Whether all masks share one slot.
    pub whole: bool,
    /// Where the slots of masks begin.
    fold: u32,
}

/// All arcs between candidates, with their slots.
#[derive(Debug, Default)]
pub struct Turns {
    /// By arc.
    pub all: Vec<Turn>,
    /// By candidate, where its groups begin; last, their number.
    first: Vec<usize>,
    groups: Vec<Group>,
    /// By group and mask, its slot.
    fold: Vec<u16>,
    /// By arc and slot, the state at its end, before anything is counted.
    heads: Vec<u32>,
}

impl Turns {
    /// The arcs under this memory; `offset` says where the states of each candidate begin in a layer.
    pub fn new(network: &Network, memory: &Memory, offset: &[usize]) -> Self {
        let mut turns = Self { first: vec![0], ..Self::default() };
        // By group of the candidate: the bit of the head itself and the bits that the head remembers too.
        let mut kinds: Vec<(usize, usize)> = Vec::new();
        for from in 0..memory.of.len() {
            let near = &memory.of[from];
            kinds.clear();
            for arc in &network.arcs[network.leaving(from)] {
                let ahead = &memory.of[arc.to as usize];
                let bit = |place: Result<usize, usize>| place.map_or(0, |bit| 1_usize << bit);
                let back = bit(near.binary_search(&arc.to));
                let shared =
                    near.iter().enumerate().filter(|(_, other)| ahead.binary_search(other).is_ok());
                let kept = shared.fold(0, |kept, (bit, _)| kept | 1 << bit);
                let group = kinds.iter().position(|kind| *kind == (back, kept));
                let group = group.unwrap_or_else(|| {
                    kinds.push((back, kept));
                    turns.add_group(from, near.len(), back, kept);
                    kinds.len() - 1
                });
                let own = bit(ahead.binary_search(&(from as u32)));
                let held: Vec<usize> = near
                    .iter()
                    .map(|other| bit(ahead.binary_search(other)))
                    .filter(|bit| *bit > 0)
                    .collect();
                let state = offset[arc.to as usize] + own;
                let Group { first, slots, .. } = turns.groups[turns.first[from] + group];
                turns.all.push(Turn {
                    cost: 0.0,
                    to: arc.to,
                    head: state as u32,
                    heads: turns.heads.len() as u32,
                    slot: first,
                    slots: slots as u16,
                    group: group as u16,
                    near: ahead.len() as u16,
                });
                for slot in 0..1_usize << held.len() {
                    let bits = held.iter().enumerate().filter(|(k, _)| slot >> k & 1 == 1);
                    turns.heads.push(bits.fold(state, |state, (_, bit)| state + bit) as u32);
                }
            }
            turns.first.push(turns.groups.len());
        }
        turns
    }

    fn add_group(&mut self, from: usize, near: usize, back: usize, kept: usize) {
        let before = self.groups[self.first[from]..].last();
        let first = before.map_or(0, |group| group.first + group.slots + 1);
        let slots = 1_u32 << kept.count_ones();
        self.groups.push(Group {
            first,
            slots,
            whole: back | kept == 0,
            fold: self.fold.len() as u32,
        });
        for mask in 0..1_usize << near {
            let bits = (0..near).filter(|bit| kept >> bit & 1 == 1);
            let slot = bits.enumerate().fold(0, |slot, (k, bit)| slot | (mask >> bit & 1) << k);
            self.fold.push(if mask & back == 0 { slot as u16 } else { slots as u16 });
        }
    }

    /// The groups of a candidate.
    pub fn groups(&self, candidate: usize) -> &[Group] {
        &self.groups[self.first[candidate]..self.first[candidate + 1]]
    }

    /// Slots of a candidate, the empty ones too; at least one.
    pub fn slots(&self, candidate: usize) -> usize {
        self.groups(candidate).last().map_or(1, |group| (group.first + group.slots) as usize + 1)
    }

    /// By mask of the candidate, its slot in the group.
    #[inline]
    pub fn fold(&self, group: &Group, masks: usize) -> &[u16] {
        &self.fold[group.fold as usize..group.fold as usize + masks]
    }

    /// Calls with each slot of an arc and the state of a layer that it leads to, before anything is counted.
    #[inline]
    pub fn each_head(&self, turn: &Turn, mut each: impl FnMut(usize, usize)) {
        // Most heads remember nothing of what their tails do.
        if turn.slots == 1 {
            return each(turn.slot as usize, turn.head as usize);
        }
        let heads = &self.heads[turn.heads as usize..turn.heads as usize + turn.slots as usize];
        for (slot, &head) in turn.slots().zip(heads) {
            each(slot, head as usize);
        }
    }

    /// The state at the end of an arc, before anything is counted; none if the mask at its tail remembers its head.
    pub fn head(&self, turn: &Turn, group: &Group, mask: usize) -> Option<usize> {
        let slot = usize::from(self.fold[group.fold as usize + mask]);
        let leads = slot < usize::from(turn.slots);
        leads.then(|| self.heads[turn.heads as usize + slot] as usize)
    }
}
