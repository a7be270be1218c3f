//! Small scenarios of every kind, kept as files beside this one.

/// Each with its optimum, which an enumeration found.
pub const GOLDEN: [(&str, f64); 11] = [
    ("coverage-6", 1602.4040091482204),
    ("coverage-13", 1005.1308956551946),
    ("reward-0", 24897.260210999997),
    ("reward-1", 27008.946648000005),
    ("mobile-1", 7.0),
    ("mobile-2", 7.0),
    ("mixed-7", 215.77702935500295),
    ("mixed-11", 229.57470766062988),
    ("mixed-20", 406.2721076425302),
    ("mixed-21", 5.0),
    ("mixed-24", 3.0),
];
