//! The time-expanded graph: a vertex is a sensor at a step of time, and where it is then.

use crate::instance::Instance;
use crate::scenario::Point;
use crate::solvers::paper::PaperOptions;

/// A sensor at a step, or the start, or the end.
#[derive(Clone, Copy, Debug)]
pub struct Vertex {
    /// The candidate, or a place behind the candidates.
    pub node: u32,
    /// Where it is.
    pub point: Point,
    /// Charging begins.
    pub arrive_s: f64,
    /// Charging ends.
    pub depart_s: f64,
}

/// The vertices by rising time. Edges follow from them, and go forward in time.
pub struct TimeExpanded<'a, 'b> {
    instance: &'a Instance<'b>,
    /// All but start and end.
    pub vertices: Vec<Vertex>,
    /// Where the tour begins, at time 0.
    pub start: Vertex,
    /// Where it ends, at the end of the time span.
    pub end: Vertex,
}

impl<'a, 'b> TimeExpanded<'a, 'b> {
    /// The graph; `None` where it needs more memory than that.
    pub fn new(instance: &'a Instance<'b>, options: &PaperOptions) -> Option<Self> {
        let steps = (instance.timespan_s / options.app_step_s).floor().max(0.0);
        let bytes = (steps + 1.0) * instance.len() as f64 * size_of::<Vertex>() as f64;
        if bytes > options.memory_bytes as f64 {
            return None;
        }
        let charger = &instance.scenario.charger;
        let level = 1.0 - options.app_epsilon;
        let vertex = |candidate: u32, step: u64| {
            let asks = &instance.candidates[candidate as usize];
            let arrive_s = step as f64 * options.app_step_s;
            let left_j = asks.target_j - asks.charge_j(arrive_s);
            let charge_j = (level * asks.target_j - left_j).max(0.0);
            let depart_s = arrive_s + charge_j / charger.transfer_w;
            let open = asks.ready_s <= arrive_s
                && arrive_s <= asks.due_s
                && depart_s <= instance.timespan_s;
            let point = instance.point_at(candidate, arrive_s);
            open.then_some(Vertex { node: candidate, point, arrive_s, depart_s })
        };
        let candidates = || 0..instance.len() as u32;
        let at = |step| candidates().filter_map(move |candidate| vertex(candidate, step));
        let (node, until_s) = (instance.start() as u32, instance.timespan_s);
        Some(Self {
            instance,
            vertices: (0..=steps as u64).flat_map(at).collect(),
            start: Vertex { node, point: charger.start_m, arrive_s: 0.0, depart_s: 0.0 },
            end: Vertex {
                node: node + 1,
                point: charger.end_m,
                arrive_s: until_s,
                depart_s: until_s,
            },
        })
    }

    /// Whether the charger, having charged the one, is at the other when its step begins.
    pub fn has_edge(&self, from: &Vertex, to: &Vertex) -> bool {
        let leg_m = if self.instance.moving {
            (to.point - from.point).norm()
        } else {
            self.instance.distance_m(from.node as usize, to.node as usize)
        };
        from.depart_s + leg_m / self.instance.scenario.charger.speed_mps <= to.arrive_s
    }

    /// Whether ways are straight, so that whoever comes by another vertex could also have come without it.
    pub fn is_metric(&self) -> bool {
        self.instance.scenario.travel.is_none()
    }
}
