//! The rules of an announcement.

use std::time::Duration;

use jiff::Timestamp;

use super::{KnownNetwork, SLACK, Violations};
use crate::clock::{minus, plus};
use crate::domain::{Announcement, Refusal};

/// How far ahead a departure may be announced.
const AHEAD: Duration = Duration::from_hours(7 * 24);

/// Judges an announcement by the present version of its network; gives it back with the charger type
/// filled in.
///
/// # Errors
/// Every broken rule that was found, under the names of the announcement's fields.
pub fn announcement(
    network: &KnownNetwork,
    announced: &Announcement,
    now: Timestamp,
) -> Result<Announcement, Refusal> {
    let mut violations = Violations::default();
    if let Some(t0) = announced.t0 {
        if t0 < minus(now, SLACK) {
            violations.add("t0", format!("{t0}: must be at most {} s ago", SLACK.as_secs()));
        } else if t0 > plus(now, AHEAD) {
            violations.add("t0", format!("{t0}: must be at most 7 days ahead"));
        }
    }
    violations.finite("start_m", announced.start_m);
    violations.finite("end_m", announced.end_m);
    violations.not_negative("capacity_j", announced.capacity_j);
    violations.not_negative("timespan_s", announced.timespan_s);
    let kind = network.charger_type(announced.charger_type.as_deref());
    if kind.is_none() {
        violations.add(
            "charger_type",
            match &announced.charger_type {
                Some(name) => format!("{name:?}: no charger type of the network"),
                None => "missing: required where the network has several charger types".into(),
            },
        );
    }
    violations.verdict()?;
    Ok(Announcement { charger_type: kind.map(|kind| kind.name.clone()), ..announced.clone() })
}
