//! Colours and classes. The palette is that of Okabe and Ito, which people with any of the common
//! colour vision deficiencies can tell apart; whatever a colour says, a shape or a text says too.

use voltour_solver::plan::{Reason, Status};

/// The tour and its stops.
pub(super) const INK: &str = "#12355b";
/// Coverage that is alive.
pub(super) const TEAL: &str = "#009e73";
/// What is wrong.
pub(super) const VERMILLION: &str = "#d55e00";

/// The style sheet: classes keep the marks short.
pub(super) const CSS: &str = "
text{font-family:system-ui,'Segoe UI','Helvetica Neue',Arial,'DejaVu Sans',sans-serif;fill:#1f2933}
.h1{font-size:24px;font-weight:600}
.h2{font-size:12px;font-weight:600;letter-spacing:.06em;fill:#52606d}
.sub{font-size:14px;fill:#52606d}
.k{font-size:13px;fill:#52606d}
.v{font-size:13px;text-anchor:end;font-weight:600}
.row{font-size:12px}
.num{font-size:12px;text-anchor:end}
.pill{font-size:12px;font-weight:600;fill:#fff;text-anchor:middle}
.tick{font-size:11px;fill:#7b8794}
.end{text-anchor:end}.mid{text-anchor:middle}
.id{font-size:10.5px;fill:#3e4c59;paint-order:stroke;stroke:#fff;stroke-width:3px;stroke-linejoin:round}
.ord{font-size:10.5px;font-weight:700;fill:#12355b;paint-order:stroke;stroke:#fff;stroke-width:3px;stroke-linejoin:round}
.in{font-size:10.5px;font-weight:700;fill:#fff;text-anchor:middle}
.paper{fill:#fff}.map{fill:#f6f7f9}
.grid{stroke:#e4e7eb;stroke-width:1;fill:none}
.rule{stroke:#e4e7eb;stroke-width:1}
.bar{fill:#e4e7eb}.used{fill:#12355b}
.field{fill:#fff}
.edge{fill:none;stroke:#616e7c;stroke-width:1.6;stroke-linejoin:round}
.alive{fill:#009e73}
.dead{fill:none;stroke:#d55e00;stroke-width:1.1;stroke-dasharray:3 4;stroke-opacity:.6}
.short{fill:#d55e00;stroke:#fff;stroke-width:1.2;stroke-linejoin:round}
.belowk{fill:#f0e442;stroke:#1f2933;stroke-width:.7;stroke-linejoin:round}
.halo{fill:none;stroke:#fff;stroke-opacity:.85;stroke-linejoin:round;stroke-linecap:round}
.leg{fill:none;stroke:#12355b;stroke-linejoin:round;stroke-linecap:round}
.arrow{fill:#12355b;stroke:#fff;stroke-width:1}
.trail{fill:none;stroke:#9aa5b1;stroke-width:1;stroke-opacity:.6;stroke-linejoin:round;stroke-dasharray:1 3.2;stroke-linecap:round}
.met{fill:none;stroke:#56b4e9;stroke-width:1.1;stroke-opacity:.55;stroke-linejoin:round;stroke-linecap:round}
.last{fill:none;stroke:#0072b2;stroke-width:2;stroke-linejoin:round;stroke-linecap:round}
.was{fill:#fff;stroke:#56b4e9;stroke-width:1.6}
.idle{fill:#7b8794;stroke:#fff;stroke-width:.8}
.stop{fill:#12355b;stroke:#fff;stroke-width:1.4}
.charged{fill:#fff;stroke:#009e73;stroke-width:2}
.unneeded{fill:#fff;stroke:#0072b2;stroke-width:2}
.unchosen{fill:#e69f00;stroke:#1f2933;stroke-width:1.1;stroke-linejoin:round}
.unreachable{fill:#d55e00;stroke:#fff;stroke-width:1.1;stroke-linejoin:round}
.nocapacity{fill:#cc79a7;stroke:#1f2933;stroke-width:1.1;stroke-linejoin:round}
.must{fill:none;stroke:#d55e00;stroke-width:2}
.base{fill:#1f2933;stroke:#fff;stroke-width:1.6;stroke-linejoin:round}
.goal{fill:#fff;stroke:#1f2933;stroke-width:2.4}
.many{fill:none;stroke-linecap:round;stroke-width:3.4}
";

/// How a request that is no stop is drawn.
pub(super) struct Mark {
    /// The class.
    pub class: &'static str,
    /// Fill or line where marks are merged into dots.
    pub colour: &'static str,
    /// The shape as path data relative to its centre.
    pub shape: &'static str,
    /// What the legend says.
    pub legend: &'static str,
}

const RING: &str = "m-4.6 0a4.6 4.6 0 1 0 9.2 0a4.6 4.6 0 1 0 -9.2 0z";

/// A shape of its own for each reason.
pub(super) fn mark(reason: Reason) -> Mark {
    let (class, colour, shape, legend) = match reason {
        Reason::AlreadyCharged => ("charged", TEAL, RING, "Already charged"),
        Reason::NotNeeded => ("unneeded", "#0072b2", RING, "Not needed"),
        Reason::NotChosen => {
            ("unchosen", "#e69f00", "m0 -6.4l6.4 6.4l-6.4 6.4l-6.4 -6.4z", "Not chosen")
        }
        Reason::Unreachable => (
            "unreachable",
            VERMILLION,
            "m0 -2.4l3.4 -3.4l2.4 2.4l-3.4 3.4l3.4 3.4l-2.4 2.4l-3.4 -3.4l-3.4 3.4l-2.4 -2.4l3.4 -3.4l-3.4 -3.4l2.4 -2.4z",
            "Unreachable in time",
        ),
        Reason::NoCapacity => {
            ("nocapacity", "#cc79a7", "m-4.8 -4.8h9.6v9.6h-9.6z", "Beyond the capacity")
        }
    };
    Mark { class, colour, shape, legend }
}

/// A triangle with its middle at the origin: a place that falls short.
pub(super) const TRIANGLE: &str = "m0 -7l7 12h-14z";
/// The same for what is no fault of the plan, or where there are many.
pub(super) const SMALL_TRIANGLE: &str = "m0 -4l4 6.9h-8z";

/// Words and colour for a status; white text is readable on each.
pub(super) fn status(status: Status) -> (&'static str, &'static str) {
    match status {
        Status::Optimal => ("OPTIMAL", "#00714f"),
        Status::Feasible => ("FEASIBLE", "#0068a3"),
        Status::BestEffort => ("BEST EFFORT", "#a85b00"),
        Status::Infeasible => ("INFEASIBLE", "#a8330a"),
    }
}
