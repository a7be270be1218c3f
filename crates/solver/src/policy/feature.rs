//! The features of a candidate in a state, by name and column.
//!
//! None depends on units, on scale, on where the field lies, or on the order of the candidates: lengths are in
//! [`crate::framework::Scales`]' lengths, times in its times, and what has no bound goes through
//! `sq(x) = x / (1 + |x|)`. Rows are the stops so far and the legal actions; nothing else.

/// Version of the features: a model says which it was trained on and is refused with another.
pub const FEATURE_VERSION: u32 = 2;

/// Declares the features, each with its column.
macro_rules! features {
    ($($(#[$doc:meta])* $name:ident),+ $(,)?) => {
        /// A feature; its discriminant is its column.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[repr(usize)]
        pub enum Feature {
            $($(#[$doc])* $name),+
        }

        impl Feature {
            /// All, in the order of their columns.
            pub const ALL: &'static [Self] = &[$(Self::$name),+];

            /// Its column.
            pub const fn column(self) -> usize {
                self as usize
            }

            /// Its name, as it is written here.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$name => stringify!($name)),+
                }
            }
        }
    };
}

features! {
    /// The reward that the action earns at once, in the units of the Q-function. It is known exactly, so a
    /// network adds it to its output and learns only what comes after.
    Reward,
    /// 1 for the stops of the tour so far.
    InTour,
    /// Metres by which the insertion lengthens the tour.
    Detour,
    /// The least such metres over all positions, legal or not.
    DetourAnywhere,
    /// Distance to the start.
    ToStart,
    /// Distance to the end.
    ToEnd,
    /// Distance to the last stop, the start if there is none.
    ToLast,
    /// Distance to the nearest stop or the start.
    ToTour,
    /// Distance to the nearest other action.
    ToAction,
    /// Slack that the insertion leaves: of its own deadline, and of the rest of the tour.
    Slack,
    /// The deadline.
    Deadline,
    /// Time to charge at time 0.
    Charge,
    /// Seconds by which the insertion delays what comes behind it.
    Delay,
    /// Seconds from leaving the stop before it to the beginning of its charge.
    Leg,
    /// Share of the positions that are legal.
    LegalShare,
    /// Effort by which the second-cheapest legal position is dearer; 1 if there is none.
    Regret,
    /// Share of the other actions, by weight, that would have no legal position any more.
    Loses,
    /// Demands that would become impossible, as a share of the open ones.
    Breaks,
    /// Effort by which the others would grow dearer, in the mean by weight.
    Dearer,
    /// Share of what is left of the scarce resource that the insertion takes.
    Share,
    /// Gain for effort, beside that of the mean candidate.
    Ratio,
    /// How full the scarce resource would be if all better ratios were taken first: the fractional knapsack.
    Before,
    /// Share of the open demands that it helps to meet.
    Helps,
    /// Sum, over these, of what each lacks by its members that are actions.
    Pressure,
    /// The largest of these.
    MostPressure,
    /// 1 if some demand cannot do without it.
    Must,
    /// Share of its demands that are met.
    Met,
    /// Share of all demands that it is in.
    Member,
    /// Stops so far (the same on every row, as all below).
    Stops,
    /// Length of the tour so far.
    Length,
    /// Share of all covers still lacking.
    Lacking,
    /// Number of actions that a demand cannot do without.
    Musts,
    /// Smallest slack of a stop so far.
    LeastSlack,
    /// When the tour so far ends.
    Finish,
    /// Number of rows.
    Rows,
    /// The most that a demand lacks.
    MostLacking,
    /// Share of the scarce resource that is left.
    Left,
    /// Gain of the fractional knapsack of what is left.
    Knapsack,
}

/// Number of features, F.
pub const FEATURES: usize = Feature::ALL.len();

/// Column of [`Feature::Reward`].
pub const REWARD: usize = Feature::Reward.column();

/// Column of [`Feature::InTour`].
pub const IN_TOUR: usize = Feature::InTour.column();
