//! The tour: its line with its direction, its stops in their order, where it begins and ends.

use std::collections::HashSet;
use std::fmt::Write as _;

use ::svg::node::element::{Circle, Group, Path, Text, Title};
use voltour_solver::plan::Stop;

use super::labels::{Area, Room};
use super::scene::{MANY, Scene};
use super::style::INK;
use super::text::{clean, duration, joules};
use super::view::tenth;

const MOST_ARROWS: usize = 400;
/// Of a stop that is shown without its number.
const SMALL: f64 = 3.6;

/// The radius of a stop that bears its number.
pub(super) fn radius(scene: &Scene<'_>) -> f64 {
    match scene.plan.stops.len() {
        0..=99 => 9.0,
        100..=249 => 7.5,
        _ => SMALL,
    }
}

/// The line from start over the stops to the end; without stops, the empty trip.
pub(super) fn line(scene: &Scene<'_>) -> Group {
    let places = places(scene);
    let mut data = String::new();
    let mut last = [f64::NAN; 2];
    for place in places.iter().map(|p| p.map(tenth)).filter(|p| p.iter().all(|c| c.is_finite())) {
        if place != last {
            let _ = write!(
                data,
                "{}{} {}",
                if data.is_empty() { 'M' } else { 'L' },
                place[0],
                place[1]
            );
            last = place;
        }
    }
    let wide = if places.len() > 150 { 1.5 } else { 2.4 };
    let mut leg = Path::new().set("class", "leg").set("stroke-width", wide).set("d", data.clone());
    if scene.scenario.travel.is_some() {
        // The way is another than the straight line.
        leg = leg.set("stroke-dasharray", "7 5");
    }
    let halo = Path::new().set("class", "halo").set("stroke-width", wide + 3.0).set("d", data);
    arrows(&places).into_iter().fold(Group::new().add(halo).add(leg), Group::add)
}

/// Keeps labels off the line, as long as it is one and no thicket.
pub(super) fn keep_clear(scene: &Scene<'_>, room: &mut Room) {
    const MOST: usize = 150;
    let places = places(scene);
    if places.len() <= MOST {
        places.array_windows().for_each(|&leg| room.take_line(leg));
    }
}

fn places(scene: &Scene<'_>) -> Vec<[f64; 2]> {
    let charger = &scene.scenario.charger;
    let stops = scene.plan.stops.iter().map(|stop| stop.position_m);
    let all = std::iter::once(charger.start_m.into()).chain(stops).chain([charger.end_m.into()]);
    all.map(|place| scene.view.at(place)).collect()
}

/// An arrow head in the middle of each leg that is long enough for one.
fn arrows(places: &[[f64; 2]]) -> Option<Path> {
    const SHORTEST: f64 = 44.0;
    let mut data = String::new();
    let legs = places.windows(2).filter_map(|leg| {
        let [dx, dy] = [leg[1][0] - leg[0][0], leg[1][1] - leg[0][1]];
        let long = dx.hypot(dy);
        (long >= SHORTEST).then(|| (leg[0], [dx, dy], [dx / long, dy / long]))
    });
    for (from, by, [ux, uy]) in legs.take(MOST_ARROWS) {
        let middle = [from[0] + by[0] / 2.0, from[1] + by[1] / 2.0];
        let corner = |along: f64, aside: f64| {
            [middle[0] + along * ux - aside * uy, middle[1] + along * uy + aside * ux].map(tenth)
        };
        let [tip, left, notch, right] =
            [corner(6.5, 0.0), corner(-5.0, 4.8), corner(-2.5, 0.0), corner(-5.0, -4.8)];
        let _ = write!(
            data,
            "M{} {}L{} {}L{} {}L{} {}Z",
            tip[0], tip[1], left[0], left[1], notch[0], notch[1], right[0], right[1]
        );
    }
    (!data.is_empty()).then(|| Path::new().set("class", "arrow").set("d", data))
}

/// The stops. A number stands in its mark where there is room for a large one, else beside a small
/// one; the first, the last and evenly spread ones between them find room first.
pub(super) fn stops(scene: &Scene<'_>, room: &mut Room) -> Group {
    let stops = &scene.plan.stops;
    if stops.len() > MANY {
        return merged(scene);
    }
    let large = radius(scene);
    let (mut small_ones, mut large_ones, mut numbers) = (Group::new(), Group::new(), Group::new());
    let mut beside = Vec::new();
    for order in spread(stops.len()) {
        let stop = &stops[order];
        let at = scene.view.at(stop.position_m).map(tenth);
        let number = (order + 1).to_string();
        let mark = Circle::new().set("class", "stop").set("cx", at[0]).set("cy", at[1]);
        let title = Title::new(title(scene, order, stop));
        if large > SMALL && room.claim(Area::around(at, large - 1.0)) {
            large_ones = large_ones.add(mark.set("r", large).add(title));
            numbers = numbers.add(
                Text::new(number)
                    .set("class", "in")
                    .set("pointer-events", "none")
                    .set("x", at[0])
                    .set("y", tenth(at[1] + 3.7)),
            );
        } else {
            room.take(Area::around(at, SMALL));
            small_ones = small_ones.add(mark.set("r", SMALL).add(title));
            beside.push((number, at));
        }
    }
    let mut group = Group::new().add(large_ones).add(small_ones).add(numbers);
    for (number, at) in beside {
        group = room.write_near(group, &number, "ord", at, SMALL);
    }
    group
}

/// 0 to `count`, each once: both ends, the middle, the quarters, and so on.
fn spread(count: usize) -> Vec<usize> {
    let mut order: Vec<usize> = count.checked_sub(1).into_iter().collect();
    let mut done = vec![false; count];
    if let Some(last) = done.last_mut() {
        *last = true;
    }
    let mut stride = count.next_power_of_two();
    while stride > 0 {
        for i in (0..count).step_by(stride) {
            if !std::mem::replace(&mut done[i], true) {
                order.push(i);
            }
        }
        stride /= 2;
    }
    order
}

fn title(scene: &Scene<'_>, order: usize, stop: &Stop) -> String {
    let mut words = format!(
        "Stop {}: {}\narrives {} ({:.1} s)\nleaves {} ({:.1} s)\ncharges {}",
        order + 1,
        clean(&stop.sensor),
        duration(stop.arrive_s),
        stop.arrive_s,
        duration(stop.depart_s),
        stop.depart_s,
        joules(stop.charge_j),
    );
    if let (Some(sensor), Some(request)) = (scene.sensor_of(stop), scene.request_of(&stop.sensor)) {
        let _ = write!(words, " into a battery of {}", joules(sensor.battery_j));
        if let Some(deadline) = request.deadline_s {
            let _ = write!(words, "\ndeadline {}", duration(deadline));
        }
        if request.ready_s > 0.0 {
            let _ = write!(words, "\nready from {}", duration(request.ready_s));
        }
        if request.required {
            words.push_str("\nrequired");
        }
    }
    words
}

fn merged(scene: &Scene<'_>) -> Group {
    let mut seen = HashSet::new();
    let mut data = String::new();
    for stop in &scene.plan.stops {
        let spot = scene.view.at(stop.position_m).map(|c| (c / 2.0).round() as i32);
        if seen.insert(spot) {
            let _ = write!(data, "M{} {}h0", spot[0] * 2, spot[1] * 2);
        }
    }
    Group::new().add(Path::new().set("class", "many").set("stroke", INK).set("d", data))
}

/// A house where the charger leaves, a ring where it must end; the ring around the house if both are
/// one place.
pub(super) fn depot(scene: &Scene<'_>, room: &mut Room) -> Group {
    let charger = &scene.scenario.charger;
    let [start, end] = [charger.start_m, charger.end_m].map(|p| scene.view.at(p.into()).map(tenth));
    let ring = |at: [f64; 2], radius: f64, words: &'static str| {
        let ring = Circle::new().set("class", "goal").set("cx", at[0]).set("cy", at[1]);
        ring.set("r", radius).add(Title::new(words))
    };
    let group = Group::new();
    room.take(Area::around(start, 11.0));
    if start == end {
        return group.add(ring(start, 12.0, "Start and end")).add(house(
            start,
            0.72,
            "Start and end",
        ));
    }
    room.take(Area::around(end, 9.0));
    let dot = Circle::new().set("r", 3.2).set("cx", end[0]).set("cy", end[1]);
    group.add(ring(end, 8.5, "End")).add(dot.set("fill", "#1f2933")).add(house(start, 1.0, "Start"))
}

/// The house of the depot, scaled.
pub(super) fn house([x, y]: [f64; 2], scale: f64, words: &str) -> Path {
    let corners = [
        (0.0, -10.0),
        (10.0, -1.0),
        (7.0, -1.0),
        (7.0, 8.0),
        (-7.0, 8.0),
        (-7.0, -1.0),
        (-10.0, -1.0),
    ];
    let mut data = String::new();
    for (i, (dx, dy)) in corners.into_iter().enumerate() {
        let letter = if i == 0 { 'M' } else { 'L' };
        let _ = write!(data, "{letter}{} {}", tenth(x + dx * scale), tenth(y + dy * scale));
    }
    data.push('Z');
    Path::new().set("class", "base").set("d", data).add(Title::new(words))
}

#[cfg(test)]
mod tests {
    use super::spread;

    #[test]
    fn spread_is_a_permutation_from_the_ends_inwards() {
        assert!(spread(0).is_empty());
        assert_eq!(spread(1), [0]);
        assert_eq!(spread(5), [4, 0, 2, 1, 3]);
        let mut all = spread(1000);
        all.sort_unstable();
        assert!(all.into_iter().eq(0..1000));
    }
}
