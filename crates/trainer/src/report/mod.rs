//! What is told of a training: the learning curve as CSV and SVG.

mod csv;
mod point;
mod svg;

pub use point::{Point, save};
