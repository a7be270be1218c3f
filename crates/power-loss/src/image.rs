//! A file as it would be found after a power cut: what was synced, and what was not.

use rand::RngExt;
use rand_pcg::Pcg64Mcg;

/// What a disk writes wholly or not at all.
const SECTOR: usize = 512;

/// A change of a file's content that was not synced.
#[derive(Clone, Debug)]
pub(crate) enum Change {
    Write { at: u64, bytes: Vec<u8> },
    Truncate(u64),
}

/// The content of a file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Image {
    pub synced: Vec<u8>,
    pub unsynced: Vec<Change>,
}

impl Image {
    /// Of a file that was there before.
    pub fn found(content: Vec<u8>) -> Self {
        Self { synced: content, unsynced: Vec::new() }
    }

    /// Takes note of a change.
    pub fn change(&mut self, change: Change) {
        self.unsynced.push(change);
    }

    /// All that was written is there for good.
    pub fn sync(&mut self) {
        for change in std::mem::take(&mut self.unsynced) {
            apply(&mut self.synced, &change);
        }
    }

    /// What a power cut leaves; with no dice, nothing that was not synced.
    pub fn survivor(&self, dice: Option<&mut Pcg64Mcg>) -> Vec<u8> {
        let mut left = self.synced.clone();
        let Some(dice) = dice else { return left };
        for change in &self.unsynced {
            match (dice.random_range(0..4), change) {
                (0, _) => {}
                (1, Change::Write { at, bytes }) => {
                    for (number, sector) in bytes.chunks(SECTOR).enumerate() {
                        if dice.random() {
                            let at = at + (number * SECTOR) as u64;
                            apply(&mut left, &Change::Write { at, bytes: sector.to_vec() });
                        }
                    }
                }
                _ => apply(&mut left, change),
            }
        }
        left
    }
}

fn apply(content: &mut Vec<u8>, change: &Change) {
    match change {
        Change::Truncate(length) => content.resize(*length as usize, 0),
        Change::Write { at, bytes } => {
            let (from, to) = (*at as usize, *at as usize + bytes.len());
            if content.len() < to {
                content.resize(to, 0);
            }
            content[from..to].copy_from_slice(bytes);
        }
    }
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::*;

    #[test]
    fn only_what_was_synced_is_sure() {
        let mut image = Image::found(b"old".to_vec());
        image.change(Change::Write { at: 0, bytes: b"new".to_vec() });
        assert_eq!(image.survivor(None), b"old");
        image.sync();
        image.change(Change::Write { at: 2, bytes: vec![1; 2 * SECTOR] });
        image.change(Change::Truncate(1));
        assert_eq!(image.survivor(None), b"new");
    }

    #[test]
    fn the_rest_may_be_there_or_not_or_in_part_and_the_same_seed_says_the_same() {
        let mut image = Image::default();
        image.change(Change::Write { at: 0, bytes: vec![1; 4 * SECTOR] });
        let left = |seed| image.survivor(Some(&mut Pcg64Mcg::seed_from_u64(seed)));
        let ones = |seed| left(seed).iter().filter(|byte| **byte == 1).count() / SECTOR;
        let all: Vec<usize> = (0..200).map(ones).collect();
        for sectors in 0..=4 {
            assert!(all.contains(&sectors), "{sectors} of 4 sectors");
        }
        assert!((0..200).all(|seed| left(seed) == left(seed)));
    }
}
