//! A set of small numbers in a fixed number of words.

/// A subset of 0 to 64 `W` - 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Bits<const W: usize>([u64; W]);

impl<const W: usize> Bits<W> {
    /// The empty set.
    pub const EMPTY: Self = Self([0; W]);

    /// The set of these numbers.
    pub fn of(members: impl IntoIterator<Item = u32>) -> Self {
        let mut bits = Self::EMPTY;
        for member in members {
            bits.insert(member);
        }
        bits
    }

    #[inline]
    pub fn insert(&mut self, member: u32) {
        self.0[member as usize / 64] |= 1 << (member % 64);
    }

    #[inline]
    pub fn remove(&mut self, member: u32) {
        self.0[member as usize / 64] &= !(1 << (member % 64));
    }

    #[inline]
    pub fn contains(&self, member: u32) -> bool {
        self.0[member as usize / 64] >> (member % 64) & 1 == 1
    }

    #[inline]
    pub fn is_empty(&self) -> bool {
        self.0.iter().all(|&word| word == 0)
    }

    #[inline]
    pub fn union(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|w| self.0[w] | other.0[w]))
    }

    #[inline]
    pub fn minus(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|w| self.0[w] & !other.0[w]))
    }

    /// The intersection.
    #[inline]
    pub fn both(&self, other: &Self) -> Self {
        Self(std::array::from_fn(|w| self.0[w] & other.0[w]))
    }

    /// Size of the intersection.
    #[inline]
    pub fn common(&self, other: &Self) -> u32 {
        self.0.iter().zip(&other.0).map(|(a, b)| (a & b).count_ones()).sum()
    }

    /// The members, rising.
    pub fn iter(self) -> impl Iterator<Item = u32> {
        let mut words = self.0;
        let mut w = 0;
        std::iter::from_fn(move || {
            while w < W && words[w] == 0 {
                w += 1;
            }
            let word = words.get_mut(w)?;
            let bit = word.trailing_zeros();
            *word &= *word - 1;
            Some(64 * w as u32 + bit)
        })
    }
}
