//! The table T of the area segmentation: how many sensors each sub-region still asks for, by colour set.

use crate::instance::Instance;

/// Colours that a set can hold.
const MOST: usize = u128::BITS as usize;

/// A set of colours, a bit each.
pub type Colours = u128;

/// Table T at v0, from which the table of any colour set follows. Sub-regions of case I have no row; in
/// those of case II all members are asked for, in those of case III some.
pub struct Table {
    /// The candidate of each colour: those that a row counts.
    pub candidates: Vec<u32>,
    /// Colours of the sensors that cover a sub-region, and how many of them are asked for.
    rows: Vec<(Colours, u32)>,
    /// By colour, the rows that it lowers.
    of: Vec<Vec<u32>>,
}

impl Table {
    /// The table; `None` where there are more sensors to colour than a set can hold.
    pub fn new(instance: &Instance<'_>) -> Option<Self> {
        let demands = &instance.demands;
        let asked = |&c: &u32| !demands.of[c as usize].is_empty();
        let candidates: Vec<u32> = (0..instance.len() as u32).filter(asked).collect();
        if candidates.len() > MOST {
            return None;
        }
        let colours = |members: &[u32]| {
            let bits = members.iter().filter_map(|member| candidates.binary_search(member).ok());
            bits.fold(0, |set: Colours, colour| set | 1 << colour)
        };
        let rows = demands.demands.iter().map(|d| (colours(&d.members), d.needs)).collect();
        let of = candidates.iter().map(|&c| demands.of[c as usize].clone()).collect();
        Some(Self { candidates, rows, of })
    }

    /// Whether every entry is zero.
    pub fn is_met(&self, set: Colours) -> bool {
        self.rows.iter().all(|&(members, needs)| (members & set).count_ones() >= needs)
    }

    /// Whether a colour lowers an entry.
    pub fn helps(&self, set: Colours, colour: usize) -> bool {
        self.of[colour].iter().any(|&row| {
            let (members, needs) = self.rows[row as usize];
            (members & set).count_ones() < needs
        })
    }
}
