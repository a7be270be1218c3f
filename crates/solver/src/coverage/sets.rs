//! Distinct sets of numbers, written as rising sequences, each stored once under a small id.
//! Equality is exact; the hash only finds the candidates.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::hash::{BuildHasherDefault, Hasher};

/// Sets by id, ids in the order of their first appearance.
#[derive(Default)]
pub(super) struct Sets {
    elements: Vec<u32>,
    ends: Vec<usize>,
    index: HashMap<u64, u32, BuildHasherDefault<AsItIs>>,
}

impl Sets {
    pub(super) fn len(&self) -> usize {
        self.ends.len()
    }

    /// The elements of a set, rising.
    pub(super) fn get(&self, id: u32) -> &[u32] {
        let id = id as usize;
        let start = id.checked_sub(1).map_or(0, |before| self.ends[before]);
        &self.elements[start..self.ends[id]]
    }

    /// The id of a set given by its rising elements, new or known.
    pub(super) fn intern(&mut self, set: &[u32]) -> u32 {
        self.intern_hashed(set, hash(set))
    }

    /// The same for whoever knows the set's [`hash`] already.
    pub(super) fn intern_hashed(&mut self, set: &[u32], hash: u64) -> u32 {
        let mut key = hash;
        loop {
            match self.index.entry(key) {
                Entry::Vacant(free) => {
                    let id = self.ends.len() as u32;
                    free.insert(id);
                    self.elements.extend_from_slice(set);
                    self.ends.push(self.elements.len());
                    return id;
                }
                Entry::Occupied(taken) => {
                    let id = *taken.get();
                    if self.get(id) == set {
                        return id;
                    }
                    key = key.wrapping_add(0x9e37_79b9_7f4a_7c15);
                }
            }
        }
    }
}

/// The sum of the elements' hashes: the hash of a set follows from those of its parts.
pub(super) fn hash(set: &[u32]) -> u64 {
    set.iter().map(|&element| mix(u64::from(element))).fold(0, u64::wrapping_add)
}

/// The finaliser of SplitMix64.
fn mix(element: u64) -> u64 {
    let x = element.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// The keys are hashes already.
#[derive(Default)]
pub(super) struct AsItIs(u64);

impl Hasher for AsItIs {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = mix(self.0 ^ u64::from(*byte));
        }
    }

    fn write_u64(&mut self, key: u64) {
        self.0 = key;
    }
}
