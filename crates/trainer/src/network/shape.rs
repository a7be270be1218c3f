//! The size of a network, and where its parameters stand in one flat vector.

use serde::{Deserialize, Serialize};
use voltour_solver::policy::FEATURES;

use crate::error::{Error, Result};

/// The size of a Q-network.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shape {
    /// Width of an embedding, p.
    pub width: usize,
    /// Rounds of messages, T.
    pub rounds: usize,
    /// The scale of each kernel, in units of the edges.
    pub kernels: Vec<f32>,
}

impl Default for Shape {
    fn default() -> Self {
        Self { width: 64, rounds: 3, kernels: vec![0.15, 0.5] }
    }
}

/// One matrix of parameters: `[rows, columns]`, row by row, from `start` in the flat vector.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Its name in models and checkpoints.
    pub name: String,
    /// Rows: what goes in.
    pub rows: usize,
    /// Columns: what comes out.
    pub columns: usize,
    /// Where it begins.
    pub start: usize,
}

impl Part {
    /// The number of parameters.
    pub fn len(&self) -> usize {
        self.rows * self.columns
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl Shape {
    /// The shape, if a network can have it.
    ///
    /// # Errors
    /// A width of 0 or past 1,024, more than 16 rounds or 8 kernels, a scale that is not positive.
    pub fn checked(self) -> Result<Self> {
        let rule = |name, value: String, rule, holds: bool| {
            if holds { Ok(()) } else { Err(Error::Option { name, value, rule }) }
        };
        rule(
            "width",
            self.width.to_string(),
            "must be 1 to 1024",
            (1..=1024).contains(&self.width),
        )?;
        rule("rounds", self.rounds.to_string(), "must be at most 16", self.rounds <= 16)?;
        let scales =
            self.kernels.iter().all(|s| s.is_finite() && *s > 0.0) && self.kernels.len() <= 8;
        rule(
            "kernels",
            format!("{:?}", self.kernels),
            "must be at most 8 positive numbers",
            scales,
        )?;
        Ok(self)
    }

    /// The matrices of such a network, in the order of the flat vector: input and its bias, messages (own,
    /// then one a kernel), head (node, state, bias), output and its bias.
    pub fn parts(&self) -> Vec<Part> {
        let p = self.width;
        let mut sizes = vec![
            ("input.weight".to_owned(), FEATURES, p),
            ("input.bias".to_owned(), 1, p),
            ("message.own".to_owned(), p, p),
        ];
        sizes.extend((0..self.kernels.len()).map(|k| (format!("message.kernel{k}"), p, p)));
        sizes.extend([
            ("head.node".to_owned(), p, p),
            ("head.state".to_owned(), 2 * p, p),
            ("head.bias".to_owned(), 1, p),
            ("output.weight".to_owned(), p, 1),
            ("output.bias".to_owned(), 1, 1),
        ]);
        let mut start = 0;
        let place = |(name, rows, columns)| {
            let part = Part { name, rows, columns, start };
            start += rows * columns;
            part
        };
        sizes.into_iter().map(place).collect()
    }

    /// The number of parameters.
    pub fn parameters(&self) -> usize {
        self.parts().iter().map(Part::len).sum()
    }
}
