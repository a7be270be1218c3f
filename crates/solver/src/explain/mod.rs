//! Explanations: why nothing is feasible, why a request is not served, what a stop is good for, and what the next
//! change would buy.
//!
//! [`explain`] takes a scenario and a plan of it, whatever solver made that. Where no tour keeps every constraint it
//! looks for a *conflict*: a few clauses that contradict each other by themselves, none of which can be spared.
//! Places, ready times, charges and the speed are facts and never clauses. [`Explanation`] is the document; its
//! `Display` is the same in an operator's words.
//!
//! | field | meaning |
//! | --- | --- |
//! | `format` | `voltour/explanation/1` |
//! | `scenario` | the scenario's name, or null |
//! | `status` | the plan's; `infeasible` also where only the explanation has proven it |
//! | `objective` | the scenario's |
//! | `conflict` | null unless infeasibility is proven: `clauses`, `irreducible` (proven: without any one of them a tour keeps the others), `sentence`, `alone` (what each sensor concerned takes as the only stop) |
//! | `conflict.clauses[]` | `kind` is `demand` (`at_m`, `needs`, `members`), `required` (`sensor`), `deadline` (`sensor`, `deadline_s`), `capacity` (`capacity_j`) or `timespan` (`timespan_s`) |
//! | `feasible_tour` | sensors in order, where the plan is not feasible and a tour that is was found on the way; else null |
//! | `unserved[]` | `sensor`, `reason` (the plan's), `alone`, and `insertion`: `after` (null: first), `extra_m`, `extra_s`, `extra_j`, `breaks` |
//! | `alone` | `sensor`, `arrive_s`, `deadline_s`, `finish_s`, `energy_j` of the tour with that stop only |
//! | `breaks[]` | `kind` is `deadline` (`sensor`, `arrive_s`, `deadline_s`), `capacity` (`energy_j`, `capacity_j`) or `timespan` (`finish_s`, `timespan_s`) |
//! | `served[]` | `sensor`, `required`, `short` (the sub-regions that would fall short without it: `at_m`, `needs`, `has`), `reward`, `saves_m`, `saves_s`, `saves_j`, `breaks` |
//! | `next[]` | `change` (`kind` is `capacity`, `timespan`, `speed` or `deadline`, with the number `from` and `to`), `buys` (`kind` is `feasible`, `stop` with the `sensor` and the values `from` and `to`, or `shorter`), `tour`, `too_little`, `proven` |
//! | `complete` | whether every question got its answer before the stop rule ended it |
//! | `iterations` | how many it took: decisions, searches and simulated insertions together |
//!
//! Every entry of `next` carries a tour whose plan passed the check of the changed scenario. `proven` says that no
//! less than the change would do, to one per cent; `too_little` is then the largest value known not to do. All
//! else is as in the scenario, a residual energy or reward that was derived from a deadline included.
//!
//! ```
//! use voltour_solver::explain::explain;
//! use voltour_solver::scenario::Scenario;
//! use voltour_solver::solvers::empty_plan;
//! use voltour_solver::stop::MaxIterations;
//!
//! let scenario = Scenario::from_json(br#"{
//!   "format": "voltour/scenario/1", "objective": "min_distance",
//!   "charger": {"start_m": [0, 0], "speed_mps": 5, "travel_jpm": 1, "transfer_w": 10},
//!   "sensors": [{"id": "s1", "position_m": [100, 0], "battery_j": 100}],
//!   "requests": [{"sensor": "s1", "deadline_s": 10, "required": true}]
//! }"#)?;
//! let explanation = explain(&scenario, &empty_plan(&scenario), 0, &MaxIterations(1_000));
//! let conflict = explanation.conflict.ok_or("none")?;
//! assert_eq!(conflict.sentence, "s1 is required before 10 s; the charger cannot reach it in time: \
//!     at the earliest s1 is reached at 20 s.");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod change;
mod conflict;
mod entry;
mod explanation;
mod facts;
mod ground;
mod insertion;
mod meter;
mod next;
mod planning;
mod sentence;
mod stops;
mod text;
mod words;

pub use change::{Buys, Change, NextChange};
pub use entry::explain;
pub use explanation::{
    Alone, Breach, CheapestInsertion, Clause, Conflict, Explanation, FORMAT, Short, WhyServed,
    WhyUnserved,
};
