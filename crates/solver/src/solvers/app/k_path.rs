//! Short paths between two places through some of those between, one for every reward that it comes by.
//!
//! Deviation: min-excess paths rest on a primal-dual tree of a given reward (K. Chaudhuri et al., "Paths,
//! trees, and minimum latency tours", 2003), of which the edges off the path are doubled. Here a path grows from the
//! straight edge by the place with the most reward for its detour: all rewards in one go, and in practice
//! shorter; but its ratio is not proven. The tests hold the quarter against the optimum instead.

use super::orienteering::Graph;

/// A path between two places.
pub struct Wiggle {
    /// Its places, both ends included.
    pub places: Vec<usize>,
    /// Collected between the ends.
    pub reward: u64,
    /// Its length.
    pub length: f64,
}

/// A place that is not yet on the path, and where it would be inserted at which detour.
struct Outside {
    place: usize,
    at: usize,
    detour: f64,
}

/// Paths from `from` to `to` of rising reward and length, the straight edge first, none longer than `room`.
pub fn wiggles(graph: &Graph, from: usize, to: usize, between: &[usize], room: f64) -> Vec<Wiggle> {
    let mut all = Vec::new();
    let mut places = vec![from, to];
    let (mut reward, mut length) = (0, graph.length(from, to));
    if length > room {
        return all;
    }
    let outside = between.iter().map(|&place| Outside::new(graph, &places, place));
    // A detour only grows as the path does, but for the two new edges: what is too far away stays it,
    // as the way from one end over it to the other is no longer than any.
    let mut outside: Vec<Outside> =
        outside.filter(|outside| length + outside.detour <= room).collect();
    loop {
        all.push(Wiggle { places: places.clone(), reward, length });
        let worth = |o: &Outside| graph.rewards[o.place] as f64 / o.detour.max(1e-9);
        let next = (0..outside.len())
            .filter(|&i| length + outside[i].detour <= room)
            .reduce(|a, b| if worth(&outside[b]) > worth(&outside[a]) { b } else { a });
        let Some(next) = next else { return all };
        let joins = outside.swap_remove(next);
        places.insert(joins.at, joins.place);
        reward += graph.rewards[joins.place];
        length += joins.detour;
        for other in &mut outside {
            other.update(graph, &places, joins.at);
        }
    }
}

impl Outside {
    fn new(graph: &Graph, path: &[usize], place: usize) -> Self {
        let mut best = Self { place, at: 1, detour: f64::INFINITY };
        for at in 1..path.len() {
            best.offer(graph, path, at);
        }
        best
    }

    fn offer(&mut self, graph: &Graph, path: &[usize], at: usize) {
        let (before, after) = (path[at - 1], path[at]);
        let via = graph.length(before, self.place) + graph.length(self.place, after);
        let detour = via - graph.length(before, after);
        if detour < self.detour {
            (self.at, self.detour) = (at, detour);
        }
    }

    /// After a place was inserted at `fresh`: the remembered place moves, is beaten, or is gone.
    fn update(&mut self, graph: &Graph, path: &[usize], fresh: usize) {
        if self.at == fresh {
            *self = Self::new(graph, path, self.place);
            return;
        }
        if self.at > fresh {
            self.at += 1;
        }
        self.offer(graph, path, fresh);
        self.offer(graph, path, fresh + 1);
    }
}
