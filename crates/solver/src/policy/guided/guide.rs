//! [`Guide`]: a Q-function at work on one instance.

use std::cell::Cell;

use crate::framework::{Definition, Episode};
use crate::instance::Instance;
use crate::policy::{Batch, Encoder, Encoding, QError, QFunction};

/// Values nearer than this are equal; the smaller index in document order wins.
pub(super) const EQUAL: f32 = 1e-5;

/// A Q-function and the instance on which it guides.
pub struct Guide<'a> {
    pub(super) instance: &'a Instance<'a>,
    pub(super) definition: &'a dyn Definition,
    q: &'a dyn QFunction,
    encoder: Encoder,
    /// States valued so far.
    valued: Cell<u64>,
}

/// The values of the actions of a state, by action.
pub(super) type Values = Vec<f32>;

impl<'a> Guide<'a> {
    /// A guide.
    pub fn new(
        instance: &'a Instance<'a>,
        definition: &'a dyn Definition,
        q: &'a dyn QFunction,
    ) -> Self {
        let encoder = Encoder::new(Episode::new(instance, definition).state());
        let encoder = if q.reads_ahead() { encoder } else { encoder.without_ahead() };
        Self { instance, definition, q, encoder, valued: Cell::new(0) }
    }

    /// An episode at its beginning.
    pub fn begin(&self) -> Episode<'a> {
        Episode::new(self.instance, self.definition)
    }

    /// States valued so far.
    pub fn valued(&self) -> u64 {
        self.valued.get()
    }

    /// The values of the actions of episodes that are not over, in one batch.
    pub(super) fn values(&self, episodes: &[&Episode<'a>]) -> Result<Vec<Values>, QError> {
        if episodes.is_empty() {
            return Ok(Vec::new());
        }
        let encode = |episode: &&Episode<'a>| {
            if self.q.has_time() { Ok(self.encoder.encode(episode)) } else { Err(QError::TooSlow) }
        };
        let encodings: Vec<Encoding> = episodes.iter().map(encode).collect::<Result<_, _>>()?;
        let batch = Batch::pack(&encodings);
        let q = self.q.values(&batch)?;
        let expected = batch.states * batch.rows;
        if q.len() != expected {
            return Err(QError::WrongSize { expected, found: q.len() });
        }
        self.valued.set(self.valued.get() + encodings.len() as u64);
        encodings
            .iter()
            .zip(q.chunks_exact(batch.rows.max(1)))
            .map(|(e, q)| by_action(e, q))
            .collect()
    }
}

fn by_action(encoding: &Encoding, q: &[f32]) -> Result<Values, QError> {
    // Rows and actions rise with the candidates alike.
    let actions = encoding.actions.iter().zip(q).filter(|(action, _)| action.is_some());
    let finite = |(_, &q): (_, &f32)| {
        if q.is_finite() { Ok(q) } else { Err(QError::NotFinite(q.to_string())) }
    };
    actions.map(finite).collect()
}

/// The index of the best value, the smaller among equals.
pub(super) fn best(values: &[f32]) -> Option<usize> {
    let most = values.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    values.iter().position(|&value| value >= most - EQUAL)
}
