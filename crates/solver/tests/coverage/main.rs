//! Regions and demands: special configurations with known answers, and properties against oracles
//! that know nothing of arrangements.

mod arrangements;
mod properties;
mod reduction;
mod world;
