//! The whole picture: caption above, map below, panel beside it.

use ::svg::Document;
use ::svg::node::element::{Definitions, Description, Group, Rectangle, Style, Text};
use voltour_solver::gap::percent;
use voltour_solver::plan::{Plan, Violation};
use voltour_solver::scenario::{Objective, Scenario};

use super::labels::Room;
use super::scene::Scene;
use super::text::{duration, joules, metres, number, short, width};
use super::view::{LEFT, tenth};
use super::{field, panel, sensors, style, tour, trails};

const WIDTH: f64 = 1280.0;

/// The picture of a plan, as the text of an SVG document.
///
/// A plan of another scenario gives a picture too: of that scenario, with the plan's stops.
pub fn picture(scenario: &Scenario, plan: &Plan) -> String {
    let scene = Scene::new(scenario, plan);
    let mut room = Room::new(&scene.view);
    // What claims room first is drawn last: the depot before the stops, both before any label.
    let depot = tour::depot(&scene, &mut room);
    let stops = tour::stops(&scene, &mut room);
    let witnesses = field::witnesses(&scene, &mut room);
    tour::keep_clear(&scene, &mut room);
    let sensors = sensors::sensors(&scene, &mut room);
    let ids = sensors::ids(&scene, &mut room);
    let map = field::field(&scene).into_iter().fold(Group::new(), Group::add);
    let map = map
        .set("clip-path", "url(#map)")
        .add(trails::trails(&scene))
        .add(tour::line(&scene))
        .add(witnesses)
        .add(sensors)
        .add(stops)
        .add(depot)
        .add(ids);

    let (panel, panel_bottom) = panel::panel(&scene);
    let height = (scene.view.bottom() + 56.0).max(panel_bottom + 24.0).ceil();
    let paper = Rectangle::new().set("class", "paper").set("width", WIDTH).set("height", height);
    let document = Document::new()
        .set("viewBox", (0, 0, WIDTH, height))
        .set("role", "img")
        .set("aria-label", format!("Plan of {}", name(&scene)))
        .add(Description::new().add(::svg::node::Text::new(description(&scene))))
        .add(Style::new(style::CSS))
        .add(Definitions::new().add(field::clips(&scene)))
        .add(paper)
        .add(caption(&scene))
        .add(field::ground(&scene))
        .add(map)
        .add(panel);
    document.to_string()
}

fn name(scene: &Scene<'_>) -> String {
    let name = scene.plan.scenario.as_ref().or(scene.scenario.name.as_ref());
    name.map_or_else(|| "Unnamed scenario".into(), |name| short(name, 64))
}

fn caption(scene: &Scene<'_>) -> Group {
    let (words, colour) = style::status(scene.plan.status);
    let wide = width(words, 12.0) * 1.12 + 24.0;
    let pill = Rectangle::new()
        .set("x", tenth(WIDTH - 32.0 - wide))
        .set("y", 28)
        .set("width", tenth(wide))
        .set("height", 26)
        .set("rx", 13)
        .set("fill", colour);
    let word = Text::new(words)
        .set("class", "pill")
        .set("x", tenth(WIDTH - 32.0 - wide / 2.0))
        .set("y", 45.5);
    let line = |words: String, class: &str, y: f64| {
        Text::new(words).set("class", class).set("x", LEFT).set("y", y)
    };
    Group::new()
        .add(line(name(scene), "h1", 48.0))
        .add(line(summary(scene), "sub", 74.0))
        .add(pill)
        .add(word)
}

/// What was asked and what came of it, in a line.
fn summary(scene: &Scene<'_>) -> String {
    let scenario = scene.scenario;
    let goal = match scenario.objective {
        Objective::MinDistance => "shortest tour",
        Objective::MaxReward => "largest reward",
        Objective::MaxCount => "most sensors",
    };
    let mut parts = vec![
        format!("{} of {} requests served", scene.plan.stops.len(), scenario.requests.len()),
        format!("{} sensors", scenario.sensors.len()),
        goal.to_owned(),
    ];
    if let Some(coverage) = &scenario.coverage {
        parts.push(format!("{}-coverage", coverage.k));
    }
    for violation in &scene.plan.violations {
        match violation {
            Violation::Timespan { limit, needs } => {
                parts.push(format!(
                    "even the empty trip takes {} of {}",
                    duration(*needs),
                    duration(*limit)
                ));
            }
            Violation::Capacity { limit, needs } => {
                parts.push(format!(
                    "even the empty trip costs {} of {}",
                    joules(*needs),
                    joules(*limit)
                ));
            }
            _ => {}
        }
    }
    parts.join("  ·  ")
}

/// The caption for those who hear it.
fn description(scene: &Scene<'_>) -> String {
    let plan = scene.plan;
    let mut words = format!(
        "{}. Status {}, solver {}, objective {}, {} long, finished after {}. {}.",
        name(scene),
        plan.status.name(),
        short(&plan.solver, 64),
        number(plan.objective, 3),
        metres(plan.distance_m),
        duration(plan.finish_s),
        summary(scene),
    );
    if let Some(bound) = plan.bound {
        words.push_str(&format!(" Proven bound {}.", number(bound, 3)));
    }
    if let Some(gap) = plan.gap() {
        words.push_str(&format!(" Gap {}.", percent(gap)));
    }
    words
}
