//! What stands beside the map: the figures, the legend with its counts, and the first stops as a
//! timetable.

use ::svg::node::element::{Circle, Group, Line, Path, Rectangle, Text};
use voltour_solver::gap::percent;
use voltour_solver::plan::{Reason, Violation};
use voltour_solver::scenario::{Objective, Place};

use super::field::MOST_DISKS;
use super::scene::{Role, Scene};
use super::style::{self, SMALL_TRIANGLE, TRIANGLE};
use super::text::{duration, joules, metres, number, short};
use super::tour;
use super::view::{TOP, tenth};

const LEFT: f64 = 976.0;
const WIDTH: f64 = 272.0;
const RIGHT: f64 = LEFT + WIDTH;

/// The panel as it grows downwards.
struct Panel {
    group: Group,
    y: f64,
}

/// The panel and its lower edge.
pub(super) fn panel(scene: &Scene<'_>) -> (Group, f64) {
    let mut panel = Panel { group: Group::new(), y: TOP + 10.0 };
    figures(&mut panel, scene);
    legend(&mut panel, scene);
    timetable(&mut panel, scene);
    (panel.group, panel.y)
}

impl Panel {
    fn add(&mut self, node: impl Into<Box<dyn ::svg::Node>>) {
        self.group = std::mem::take(&mut self.group).add(node);
    }

    fn text(&mut self, words: impl Into<String>, class: &str, x: f64) {
        let text = Text::new(words).set("class", class).set("x", x).set("y", tenth(self.y));
        self.add(text);
    }

    fn heading(&mut self, words: &str) {
        self.text(words, "h2", LEFT);
        self.y += 8.0;
        let rule = Line::new().set("class", "rule").set("x1", LEFT).set("x2", RIGHT);
        let rule = rule.set("y1", tenth(self.y)).set("y2", tenth(self.y));
        self.add(rule);
        self.y += 19.0;
    }

    fn figure(&mut self, name: &str, value: impl Into<String>) {
        self.text(name, "k", LEFT);
        self.text(value, "v", RIGHT);
        self.y += 21.0;
    }

    /// How much of a limit is used.
    fn bar(&mut self, used: f64, limit: f64) {
        let share = if limit > 0.0 { (used / limit).clamp(0.0, 1.0) } else { 1.0 };
        let share = if share.is_finite() { share } else { 1.0 };
        for (class, wide) in [("bar", WIDTH), ("used", WIDTH * share)] {
            let bar = Rectangle::new().set("class", class).set("x", LEFT).set("rx", 2);
            let bar = bar.set("y", tenth(self.y - 14.0)).set("width", tenth(wide)).set("height", 4);
            self.add(bar);
        }
        self.y += 10.0;
    }

    fn entry(
        &mut self,
        symbol: impl Into<Box<dyn ::svg::Node>>,
        words: &str,
        count: Option<usize>,
    ) {
        self.add(symbol);
        self.text(words, "row", LEFT + 30.0);
        if let Some(count) = count {
            self.text(count.to_string(), "num", RIGHT);
        }
        self.y += 21.0;
    }

    /// The middle of the present row's symbol.
    fn spot(&self) -> [f64; 2] {
        [LEFT + 10.0, tenth(self.y - 4.0)]
    }
}

fn figures(panel: &mut Panel, scene: &Scene<'_>) {
    let plan = scene.plan;
    let charger = &scene.scenario.charger;
    let (name, sign, value): (_, _, fn(f64) -> String) = match scene.scenario.objective {
        Objective::MinDistance => ("Tour length", "≥", metres),
        Objective::MaxReward => ("Reward", "≤", |v| number(v, 2)),
        Objective::MaxCount => ("Sensors charged", "≤", |v| number(v, 0)),
    };
    panel.heading("PLAN");
    panel.figure(name, value(plan.objective));
    if let Some(bound) = plan.bound {
        panel.figure("Proven bound", format!("{sign} {}", value(bound)));
    }
    if let Some(gap) = plan.gap() {
        panel.figure("Gap to the bound", percent(gap));
    }
    if scene.scenario.objective != Objective::MinDistance {
        panel.figure("Distance", metres(plan.distance_m));
    }
    let energy = plan.charge_j + plan.travel_j;
    panel.figure("Delivered", joules(plan.charge_j));
    panel.figure("Travelled", joules(plan.travel_j));
    if let Some(capacity) = charger.capacity_j {
        panel.figure("Energy used", format!("{} of {}", joules(energy), joules(capacity)));
        panel.bar(energy, capacity);
    }
    match charger.timespan_s {
        Some(span) => {
            panel.figure("Finish", format!("{} of {}", duration(plan.finish_s), duration(span)));
            panel.bar(plan.finish_s, span);
        }
        None => panel.figure("Finish", duration(plan.finish_s)),
    }
    panel.figure("Solver", short(&plan.solver, 24));
    panel.figure("Planned in", duration(plan.elapsed_s));
    panel.y += 14.0;
}

fn legend(panel: &mut Panel, scene: &Scene<'_>) {
    panel.heading("LEGEND");
    let one_place = scene.scenario.charger.start_m == scene.scenario.charger.end_m;
    let words = if one_place { "Start and end" } else { "Start" };
    let house = tour::house(panel.spot(), 0.8, words);
    panel.entry(house, words, None);
    if !one_place {
        let ring = circle(panel.spot(), "goal", 6.5);
        panel.entry(ring, "End", None);
    }
    let stop = Group::new().add(circle(panel.spot(), "stop", 8.0)).add(
        Text::new("1").set("class", "in").set("x", panel.spot()[0]).set("y", tenth(panel.y - 0.3)),
    );
    panel.entry(stop, "Charged, in this order", Some(scene.plan.stops.len()));
    use Reason::{AlreadyCharged, NoCapacity, NotChosen, NotNeeded, Unreachable};
    for reason in [NotNeeded, NotChosen, Unreachable, NoCapacity, AlreadyCharged] {
        let count = scene.roles.iter().filter(|&&role| role == Role::Unserved(reason)).count();
        if count > 0 {
            let mark = style::mark(reason);
            let [x, y] = panel.spot();
            let shape =
                Path::new().set("class", mark.class).set("d", format!("M{x} {y}{}", mark.shape));
            panel.entry(shape, mark.legend, Some(count));
        }
    }
    let idle = scene.roles.iter().filter(|&&role| role == Role::Idle).count();
    if idle > 0 {
        let dot = circle(panel.spot(), "idle", 3.2);
        panel.entry(dot, "No request", Some(idle));
    }
    let unmet = |v: &&Violation| matches!(v, Violation::Required { .. });
    let unmet = scene.plan.violations.iter().filter(unmet).count();
    if unmet > 0 {
        let ring = circle(panel.spot(), "must", 8.0);
        panel.entry(ring, "Required, yet not served", Some(unmet));
    }
    moving(panel, scene);
    coverage(panel, scene);
    if scene.scenario.travel.is_some() {
        let [x, y] = panel.spot();
        let leg = Path::new().set("class", "leg").set("stroke-dasharray", "7 5");
        let leg = leg.set("stroke-width", 2.4).set("d", format!("M{} {y}h20", x - 10.0));
        panel.entry(leg, "Straight for a way from a matrix", None);
    }
    panel.y += 14.0;
}

fn circle([x, y]: [f64; 2], class: &str, radius: f64) -> Circle {
    Circle::new().set("class", class).set("cx", x).set("cy", y).set("r", radius)
}

fn moving(panel: &mut Panel, scene: &Scene<'_>) {
    if !scene.scenario.sensors.iter().any(|s| matches!(s.place, Place::Moving(_))) {
        return;
    }
    let [x, y] = panel.spot();
    let way =
        |class: &str| Path::new().set("class", class).set("d", format!("M{} {y}h20", x - 10.0));
    let met = Group::new().add(way("met")).add(circle([x - 8.0, y], "was", 3.0));
    panel.entry(met, "Last way of a sensor to its meeting", None);
    let [x, y] = panel.spot();
    let trail = Path::new().set("class", "trail").set("d", format!("M{} {y}h20", x - 10.0));
    panel.entry(trail, "First way of another sensor", None);
}

fn coverage(panel: &mut Panel, scene: &Scene<'_>) {
    let Some(coverage) = &scene.scenario.coverage else { return };
    if scene.scenario.sensors.len() <= MOST_DISKS {
        let alive = circle(panel.spot(), "alive", 8.0).set("fill-opacity", 0.34);
        panel.entry(alive, "Sensing disks that stay alive", None);
        let dying = scene.roles.iter().filter(|role| !role.is_alive()).count();
        if dying > 0 {
            let dead = circle(panel.spot(), "dead", 8.0);
            panel.entry(dead, "Sensing disks not kept alive", Some(dying));
        }
    }
    let short = |v: &&Violation| matches!(v, Violation::Coverage { .. });
    let short = scene.plan.violations.iter().filter(short).count();
    let below = scene.plan.warnings.len();
    let needs = coverage.k;
    for (class, count, words) in [
        ("short", short, "Coverage falls short".to_owned()),
        ("belowk", below, format!("Never covered {needs} times")),
    ] {
        if count > 0 {
            let [x, y] = panel.spot();
            let shape = Path::new().set("class", class).set(
                "d",
                format!("M{x} {y}{}", if class == "short" { TRIANGLE } else { SMALL_TRIANGLE }),
            );
            panel.entry(shape, &words, Some(count));
        }
    }
}

/// As many stops as find room beside the map.
fn timetable(panel: &mut Panel, scene: &Scene<'_>) {
    const ROW: f64 = 18.0;
    let stops = &scene.plan.stops;
    let rows = ((scene.view.bottom() - panel.y - 40.0) / ROW).floor().max(0.0) as usize;
    if stops.is_empty() || rows < 3 {
        return;
    }
    panel.heading("STOPS");
    let shown = if stops.len() <= rows { stops.len() } else { rows - 1 };
    for (i, stop) in stops.iter().take(shown).enumerate() {
        panel.text((i + 1).to_string(), "num", LEFT + 18.0);
        panel.text(short(&stop.sensor, 11), "row", LEFT + 30.0);
        panel.text(duration(stop.arrive_s), "num", LEFT + 196.0);
        panel.text(joules(stop.charge_j), "num", RIGHT);
        panel.y += ROW;
    }
    if shown < stops.len() {
        panel.text(format!("and {} more", stops.len() - shown), "tick", LEFT + 30.0);
        panel.y += ROW;
    }
}
