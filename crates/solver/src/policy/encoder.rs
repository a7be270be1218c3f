//! [`Encoder`]: from a state of an episode to its features.

use std::sync::Arc;

use super::ahead::Ahead;
use super::knapsack::Knapsack;
use super::pressure::Pressure;
use super::{Edges, Encoding, FEATURES, Feature};
use crate::framework::{Action, Episode, State};
use crate::instance::Instance;
use crate::scenario::Point;
use crate::tour::Run;

/// What the states of one instance share.
#[derive(Clone, Debug)]
pub struct Encoder {
    /// Where nothing moves, the travel times between all useful candidates.
    edges: Option<Arc<Edges>>,
    /// By candidate, its place in `edges`.
    place_of: Vec<u32>,
    /// Whether it looks one step ahead, the dearest of the features.
    ahead: bool,
}

impl Encoder {
    /// The encoder of an instance, given any state of it.
    pub fn new(state: &State<'_>) -> Self {
        let (instance, useful) = (state.instance(), state.useful());
        let mut place_of = vec![u32::MAX; instance.len()];
        for (place, &candidate) in (0..).zip(useful) {
            place_of[candidate as usize] = place;
        }
        let edges = (!instance.moving).then(|| {
            let distance = |&a: &u32, &b: &u32| instance.distance_m(a as usize, b as usize);
            Arc::new(edges(state, useful.len(), useful, distance))
        });
        Self { edges, place_of, ahead: true }
    }

    /// The encoder that leaves the features of the step ahead 0.
    #[must_use]
    pub fn without_ahead(self) -> Self {
        Self { ahead: false, ..self }
    }

    /// The state of an episode, all of its features.
    pub fn encode(&self, episode: &Episode<'_>) -> Encoding {
        let state = episode.state();
        let stops = state.tour().order().iter().map(|&stop| (stop, None));
        let actions = (0u32..).zip(episode.actions());
        let actions = actions.map(|(index, action)| (action.candidate, Some(index)));
        let mut rows: Vec<(u32, Option<u32>)> = stops.chain(actions).collect();
        rows.sort_unstable_by_key(|&(candidate, _)| candidate);
        let candidates: Vec<u32> = rows.iter().map(|&(candidate, _)| candidate).collect();
        let scene = Scene::new(episode, &candidates, self.ahead);
        let mut nodes = vec![0.0; rows.len() * FEATURES];
        for (i, (row, &(candidate, action))) in
            nodes.chunks_exact_mut(FEATURES).zip(&rows).enumerate()
        {
            row.copy_from_slice(&scene.shared);
            let action = action.map(|i| (i as usize, &episode.actions()[i as usize]));
            scene.fill(&mut Row(row), i, candidate, action);
        }
        let (places, edges) = match &self.edges {
            Some(edges) => {
                let place = |&candidate: &u32| self.place_of[candidate as usize];
                (candidates.iter().map(place).collect(), Arc::clone(edges))
            }
            None => {
                let rows: Vec<u32> = (0..candidates.len() as u32).collect();
                let distance = |&a: &u32, &b: &u32| {
                    (scene.points[a as usize] - scene.points[b as usize]).norm()
                };
                let edges = edges(state, rows.len(), &rows, distance);
                (rows, Arc::new(edges))
            }
        };
        let actions = rows.into_iter().map(|(_, action)| action).collect();
        Encoding { candidates, actions, nodes, places, edges }
    }
}

fn edges(
    state: &State<'_>,
    size: usize,
    of: &[u32],
    distance_m: impl Fn(&u32, &u32) -> f64,
) -> Edges {
    let length_m = state.scales().length_m;
    let row = |a: &u32| of.iter().map(|b| (distance_m(a, b) / length_m) as f32).collect::<Vec<_>>();
    Edges { size, values: of.iter().flat_map(row).collect() }
}

/// A number without bound, between -1 and 1.
pub(super) fn sq(x: f64) -> f64 {
    if x.is_infinite() { x.signum() } else { x / (1.0 + x.abs()) }
}

/// One row of features.
struct Row<'a>(&'a mut [f32]);

impl Row<'_> {
    fn set(&mut self, feature: Feature, value: f64) {
        self.0[feature.column()] = value as f32;
    }
}

/// What the rows of one state share.
struct Scene<'a, 'b> {
    state: &'a State<'b>,
    pressure: Pressure,
    ahead: Option<Ahead>,
    knapsack: Knapsack,
    /// The features that are the same on every row.
    shared: [f32; FEATURES],
    /// By row, where it is now; only where something moves.
    points: Vec<Point>,
    /// The charger after the last stop.
    last: Run,
    /// By row, the distance to the nearest action.
    to_action: Vec<f64>,
    candidates: &'a [u32],
}

impl<'a, 'b> Scene<'a, 'b> {
    fn new(episode: &'a Episode<'b>, candidates: &'a [u32], ahead: bool) -> Self {
        let state = episode.state();
        let instance = state.instance();
        let last = state.tour().last(instance);
        let point = |&c: &u32| instance.point_at(c, last.depart_s);
        let points =
            if instance.moving { candidates.iter().map(point).collect() } else { Vec::new() };
        let pressure = Pressure::new(episode);
        let mut scene = Self {
            state,
            ahead: ahead.then(|| Ahead::new(episode, &pressure)),
            pressure,
            knapsack: Knapsack::new(episode),
            shared: [0.0; FEATURES],
            points,
            last,
            to_action: Vec::new(),
            candidates,
        };
        scene.to_action = scene.nearest_actions();
        scene.share();
        scene
    }

    /// Distance in metres between two rows.
    fn between(&self, a: usize, b: usize) -> f64 {
        if self.state.instance().moving {
            (self.points[a] - self.points[b]).norm()
        } else {
            let place = |row: usize| self.candidates[row] as usize;
            self.state.instance().distance_m(place(a), place(b))
        }
    }

    fn nearest_actions(&self) -> Vec<f64> {
        let rows = 0..self.candidates.len();
        let open = |&row: &usize| !self.state.tour().serves(self.candidates[row]);
        let open: Vec<usize> = rows.clone().filter(open).collect();
        let nearest = |row: usize| {
            let others = open.iter().filter(|&&other| other != row);
            others.map(|&other| self.between(row, other)).fold(f64::INFINITY, f64::min)
        };
        rows.map(nearest).collect()
    }

    fn share(&mut self) {
        let (state, scales) = (self.state, self.state.scales());
        let tour = state.tour();
        let mut shared = [0.0; FEATURES];
        let mut row = Row(&mut shared);
        row.set(Feature::Stops, tour.len() as f64 / 8.0);
        row.set(Feature::Length, tour.finished().distance_m / (8.0 * scales.length_m));
        row.set(Feature::Lacking, self.pressure.lacking_share);
        row.set(Feature::Musts, self.pressure.musts as f64 / 8.0);
        row.set(Feature::LeastSlack, sq(tour.least_slack_s(state.instance()) / scales.time_s));
        row.set(Feature::Finish, tour.finished().arrive_s / (16.0 * scales.time_s));
        row.set(Feature::Rows, (self.candidates.len() as f64).ln_1p() / 3.0);
        row.set(Feature::MostLacking, self.pressure.most_lacking / 4.0);
        row.set(Feature::Left, self.knapsack.left_share);
        row.set(Feature::Knapsack, self.knapsack.gain / (8.0 * scales.gain));
        self.shared = shared;
    }

    fn fill(&self, row: &mut Row<'_>, i: usize, candidate: u32, action: Option<(usize, &Action)>) {
        let (state, scales) = (self.state, self.state.scales());
        let instance = state.instance();
        let length = |metres: f64| metres / scales.length_m;
        let it = &instance.candidates[candidate as usize];
        row.set(Feature::ToStart, length(self.to_place(instance, i, instance.start())));
        row.set(Feature::ToEnd, length(self.to_place(instance, i, instance.end())));
        row.set(Feature::ToLast, length(self.to_last(instance, i)));
        row.set(Feature::ToAction, sq(length(self.to_action[i])));
        row.set(Feature::Deadline, sq(it.due_s.min(instance.timespan_s) / (4.0 * scales.time_s)));
        let charge_s = it.charge_j(0.0) / instance.scenario.charger.transfer_w;
        row.set(Feature::Charge, charge_s / scales.time_s);
        self.pressure.fill(state, candidate, |feature, value| row.set(feature, value));
        let Some((index, action)) = action else {
            row.set(Feature::InTour, 1.0);
            return;
        };
        let visit = state.tour().visit(instance, action.insertion.position, candidate);
        row.set(Feature::Reward, action.reward);
        row.set(Feature::Detour, length(visit.detour_m));
        row.set(Feature::DetourAnywhere, length(self.detour_anywhere(instance, candidate, &visit)));
        row.set(Feature::ToTour, length(self.to_tour(instance, i, candidate)));
        row.set(Feature::Slack, sq(visit.slack_s / scales.time_s));
        row.set(Feature::Delay, sq(visit.delay_s / scales.time_s));
        row.set(Feature::Leg, sq(visit.leg_s / scales.time_s));
        row.set(Feature::LegalShare, action.legal_share);
        row.set(Feature::Regret, sq(action.regret / scales.effort));
        if let Some(ahead) = &self.ahead {
            let open = state.open_demands();
            ahead.fill(index, open, scales, |feature, value| row.set(feature, value));
        }
        self.knapsack.fill(action, scales, |feature, value| row.set(feature, value));
    }

    fn to_place(&self, instance: &Instance<'_>, i: usize, place: usize) -> f64 {
        if !instance.moving {
            return instance.distance_m(self.candidates[i] as usize, place);
        }
        let charger = &instance.scenario.charger;
        let point = if place == instance.end() { charger.end_m } else { charger.start_m };
        (self.points[i] - point).norm()
    }

    fn to_last(&self, instance: &Instance<'_>, i: usize) -> f64 {
        if instance.moving {
            (self.points[i] - self.last.place).norm()
        } else {
            instance.distance_m(self.last.node as usize, self.candidates[i] as usize)
        }
    }

    fn to_tour(&self, instance: &Instance<'_>, i: usize, candidate: u32) -> f64 {
        if instance.moving {
            return self.to_last(instance, i);
        }
        let stops = self.state.tour().order().iter().map(|&stop| stop as usize);
        let places = stops.chain([instance.start()]);
        places.map(|p| instance.distance_m(p, candidate as usize)).fold(f64::INFINITY, f64::min)
    }

    fn detour_anywhere(
        &self,
        instance: &Instance<'_>,
        candidate: u32,
        visit: &crate::tour::Visit,
    ) -> f64 {
        if instance.moving {
            return visit.detour_m;
        }
        let tour = self.state.tour();
        let detours = (0..=tour.len()).map(|p| tour.detour_m(instance, p, candidate));
        detours.fold(f64::INFINITY, f64::min)
    }
}
