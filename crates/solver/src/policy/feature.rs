//! The features of a candidate in a state, by name and column.

/// Version of the features: a model says which it was trained on and is refused with another.
pub const FEATURE_VERSION: u32 = 1;

/// Number of features, F.
pub const FEATURES: usize = 32;

/// Column of the reward that the action would earn at once, in the units of the Q-function: it is known
/// exactly, so a network adds it to its output and learns only what comes after.
pub const REWARD: usize = 0;

/// Column that is 1 for the stops of the tour so far.
pub const IN_TOUR: usize = 1;
