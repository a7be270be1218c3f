//! The picture of a plan: one self-contained SVG document, without script, drawn from a scenario and
//! its plan alone. Knows neither the service nor the command line.
//!
//! Its size is bounded whatever the plan's: labels are thinned out, and past a few thousand sensors
//! marks that would fall on one another are drawn once and without tooltips.

mod field;
mod labels;
mod panel;
mod picture;
mod scene;
mod sensors;
mod style;
mod text;
mod tour;
mod trails;
mod view;

#[cfg(test)]
mod tests;

pub use picture::picture;
