//! Times, points, places and trajectories.

use jiff::Timestamp;

use super::{Fields, Path, Rule};
use crate::domain::{Place, TimedPoint};
use crate::proto;

/// A time for the wire.
pub fn time_to_wire(time: Timestamp) -> prost_types::Timestamp {
    // Before 1970 both parts of a jiff time are negative, the wire wants the nanos positive.
    let (seconds, nanos) = (time.as_second(), time.subsec_nanosecond());
    if nanos < 0 {
        prost_types::Timestamp { seconds: seconds - 1, nanos: nanos + 1_000_000_000 }
    } else {
        prost_types::Timestamp { seconds, nanos }
    }
}

/// A point for the wire.
pub(super) fn point_to_wire([x_m, y_m]: [f64; 2]) -> proto::Point {
    proto::Point { x_m, y_m }
}

/// A place for the wire.
pub(super) fn place_to_wire(place: &Place) -> proto::Place {
    use proto::place::Place as Wire;
    let place = match place {
        Place::PositionM(at) => Wire::PositionM(point_to_wire(*at)),
        Place::Trajectory(points) => Wire::Trajectory(trajectory_to_wire(points)),
    };
    proto::Place { place: Some(place) }
}

/// A trajectory for the wire.
pub(super) fn trajectory_to_wire(points: &[TimedPoint]) -> proto::Trajectory {
    let waypoint = |point: &TimedPoint| proto::Waypoint {
        time: Some(time_to_wire(point.time)),
        position_m: Some(point_to_wire(point.position_m)),
    };
    proto::Trajectory { waypoints: points.iter().map(waypoint).collect() }
}

impl Fields {
    /// A point.
    pub(super) fn point(&mut self, at: Path<'_>, point: proto::Point) -> Option<[f64; 2]> {
        let x = self.number(at.field("x_m"), point.x_m, Rule::Finite);
        let y = self.number(at.field("y_m"), point.y_m, Rule::Finite);
        Some([x?, y?])
    }

    /// A point that must be there.
    pub(super) fn required_point(
        &mut self,
        at: Path<'_>,
        point: Option<proto::Point>,
    ) -> Option<[f64; 2]> {
        let point = self.present(at, point)?;
        self.point(at, point)
    }

    /// A point that may be left out.
    pub(super) fn optional_point(
        &mut self,
        at: Path<'_>,
        point: Option<proto::Point>,
    ) -> Option<Option<[f64; 2]>> {
        match point {
            None => Some(None),
            Some(point) => self.point(at, point).map(Some),
        }
    }

    /// A place: a position or a trajectory.
    pub(super) fn place(&mut self, at: Path<'_>, place: proto::Place) -> Option<Place> {
        use proto::place::Place as Wire;
        match self.present(at, place.place)? {
            Wire::PositionM(point) => {
                self.point(at.field("position_m"), point).map(Place::PositionM)
            }
            Wire::Trajectory(trajectory) => {
                self.trajectory(at.field("trajectory"), trajectory).map(Place::Trajectory)
            }
        }
    }

    /// At least one waypoint, the times strictly rising.
    pub(super) fn trajectory(
        &mut self,
        at: Path<'_>,
        trajectory: proto::Trajectory,
    ) -> Option<Vec<TimedPoint>> {
        let at = at.field("waypoints");
        if trajectory.waypoints.is_empty() {
            return self.refuse(at, "must have at least one waypoint");
        }
        let mut before: Option<Timestamp> = None;
        self.each(at, trajectory.waypoints, |fields, at, waypoint| {
            let position_m = fields.required_point(at.field("position_m"), waypoint.position_m);
            let time = fields.required_time(at.field("time"), waypoint.time)?;
            if let Some(before) = before.replace(time).filter(|before| time <= *before) {
                let rule = "must be later than that of the waypoint before";
                return fields.refuse(at.field("time"), format!("{time} {rule}, {before}"));
            }
            Some(TimedPoint { time, position_m: position_m? })
        })
    }
}
