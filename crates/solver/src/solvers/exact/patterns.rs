//! What a candidate remembers, as far as it matters to those who follow.
//!
//! A mask says of each remembered neighbour whether it was visited. A pattern says the same of some of them, and of
//! the others that either will do: the head of an arc forgets most of what its tail remembers. Patterns are words of
//! three digits (not visited, visited, either) and lie in rows, one for each word of the neighbours beyond the third;
//! only the rows that some arc needs are kept. What is best for all masks under all patterns is then a matter of
//! comparing whole rows and blocks, digit by digit, much as in Yates's algorithm for sums over subsets
//! (F. Yates, "The design and analysis of factorial experiments", 1937).

use std::collections::BTreeMap;

/// Digits within a row at most.
const LOW: usize = 3;

/// The patterns of one candidate.
#[derive(Clone, Debug)]
pub struct Patterns {
    /// Neighbours remembered.
    near: usize,
    /// Rows by the neighbours beyond the first ones: those for which either will do, and those visited. Where none is
    /// left open, the number of a row is that of its mask.
    rows: BTreeMap<(usize, usize), usize>,
    /// In the order in which masks come to know: a row that leaves a neighbour open, and the rows that do not.
    opened: Vec<[usize; 3]>,
}

impl Patterns {
    /// Those of a candidate that remembers so many neighbours, for masks alone and for the pattern of all of them.
    pub fn new(near: usize) -> Self {
        let mut patterns = Self { near, rows: BTreeMap::new(), opened: Vec::new() };
        for visited in 0..1 << patterns.high() {
            patterns.row(0, visited);
        }
        patterns.row((1 << patterns.high()) - 1, 0);
        patterns
    }

    /// The cell of a pattern: `open` are the neighbours for which either will do, as a mask.
    pub fn cell(&mut self, open: usize, visited: usize) -> usize {
        let low = self.low();
        let row = self.row(open >> low, visited >> low);
        let digit = |bit: usize| 2 * (open >> bit & 1) + (visited >> bit & 1);
        (0..low).rev().fold(row, |word, bit| 3 * word + digit(bit))
    }

    /// The cell of the pattern of all masks.
    pub fn all(&self) -> usize {
        let row = self.rows[&((1 << self.high()) - 1, 0)];
        (row + 1) * self.block() - 1
    }

    /// Adds the rows between those of the patterns and those of the masks. No pattern may be added any more.
    pub fn connect(&mut self) {
        for bit in (0..self.high()).rev() {
            let rows: Vec<_> = self.rows.iter().map(|(&key, &row)| (key, row)).collect();
            for ((open, visited), row) in rows.into_iter().filter(|((open, _), _)| open >> bit == 1)
            {
                let left = open ^ 1 << bit;
                let knowing = [self.row(left, visited), self.row(left, visited | 1 << bit)];
                self.opened.push([row, knowing[0], knowing[1]]);
            }
        }
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.rows.len() * self.block()
    }

    /// The least of each mask over the patterns that it matches. What the cells hold is lost.
    #[inline]
    pub fn fold(&self, cells: &mut [f64], masks: &mut [f64]) {
        match self.low() {
            0 => masks[0] = cells[0],
            1 => self.fold_rows::<3, 2>(cells, masks, fold_one),
            2 => self.fold_rows::<9, 4>(cells, masks, fold_two),
            _ => self.fold_rows::<27, 8>(cells, masks, fold_three),
        }
    }

    /// The least of each pattern over the masks that match it.
    #[inline]
    pub fn spread(&self, masks: &[f64], cells: &mut [f64]) {
        match self.low() {
            0 => cells[0] = masks[0],
            1 => self.spread_rows::<3, 2>(masks, cells, spread_one),
            2 => self.spread_rows::<9, 4>(masks, cells, spread_two),
            _ => self.spread_rows::<27, 8>(masks, cells, spread_three),
        }
    }

    #[inline]
    fn fold_rows<const C: usize, const M: usize>(
        &self,
        cells: &mut [f64],
        masks: &mut [f64],
        fold: impl Fn(&mut [f64; C], &mut [f64; M]),
    ) {
        let rows = cells.as_chunks_mut::<C>().0;
        for &[open, without, with] in &self.opened {
            let known = rows[open];
            fall(&mut rows[without], &known);
            fall(&mut rows[with], &known);
        }
        for (row, masks) in rows.iter_mut().zip(masks.as_chunks_mut::<M>().0) {
            fold(row, masks);
        }
    }

    #[inline]
    fn spread_rows<const C: usize, const M: usize>(
        &self,
        masks: &[f64],
        cells: &mut [f64],
        spread: impl Fn(&[f64; M], &mut [f64; C]),
    ) {
        let rows = cells.as_chunks_mut::<C>().0;
        let masks = masks.as_chunks::<M>().0;
        for (row, masks) in rows.iter_mut().zip(masks) {
            spread(masks, row);
        }
        rows[masks.len()..].fill([f64::INFINITY; C]);
        for &[open, without, with] in self.opened.iter().rev() {
            let (without, with) = (rows[without], rows[with]);
            fall(&mut rows[open], &without);
            fall(&mut rows[open], &with);
        }
    }

    fn row(&mut self, open: usize, visited: usize) -> usize {
        let next = self.rows.len();
        *self.rows.entry((open, visited)).or_insert(next)
    }

    fn low(&self) -> usize {
        self.near.min(LOW)
    }

    fn high(&self) -> usize {
        self.near - self.low()
    }

    /// Cells of a row.
    fn block(&self) -> usize {
        3_usize.pow(self.low() as u32)
    }
}

#[inline]
fn least(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline]
fn fall<const C: usize>(cells: &mut [f64; C], others: &[f64; C]) {
    for (cell, &other) in cells.iter_mut().zip(others) {
        *cell = least(other, *cell);
    }
}

#[inline]
fn fold_one(cells: &mut [f64; 3], masks: &mut [f64; 2]) {
    *masks = [least(cells[0], cells[2]), least(cells[1], cells[2])];
}

#[inline]
fn fold_two(cells: &mut [f64; 9], masks: &mut [f64; 4]) {
    fold_digit(cells.as_chunks_mut().0, masks.as_chunks_mut().0, fold_one);
}

#[inline]
fn fold_three(cells: &mut [f64; 27], masks: &mut [f64; 8]) {
    fold_digit(cells.as_chunks_mut().0, masks.as_chunks_mut().0, fold_two);
}

/// The last digit: cells of masks that match, of those that do not, and of both.
#[inline]
fn fold_digit<const C: usize, const M: usize>(
    cells: &mut [[f64; C]],
    masks: &mut [[f64; M]],
    fold: impl Fn(&mut [f64; C], &mut [f64; M]),
) {
    let either = cells[2];
    for (cells, masks) in cells.iter_mut().zip(masks) {
        fall(cells, &either);
        fold(cells, masks);
    }
}

#[inline]
fn spread_one(masks: &[f64; 2], cells: &mut [f64; 3]) {
    *cells = [masks[0], masks[1], least(masks[0], masks[1])];
}

#[inline]
fn spread_two(masks: &[f64; 4], cells: &mut [f64; 9]) {
    spread_digit(masks.as_chunks().0, cells.as_chunks_mut().0, spread_one);
}

#[inline]
fn spread_three(masks: &[f64; 8], cells: &mut [f64; 27]) {
    spread_digit(masks.as_chunks().0, cells.as_chunks_mut().0, spread_two);
}

#[inline]
fn spread_digit<const C: usize, const M: usize>(
    masks: &[[f64; M]],
    cells: &mut [[f64; C]],
    spread: impl Fn(&[f64; M], &mut [f64; C]),
) {
    for (cells, masks) in cells.iter_mut().zip(masks) {
        spread(masks, cells);
    }
    cells[2] = cells[0];
    let with = cells[1];
    fall(&mut cells[2], &with);
}
