//! Beam: the most promising partial tours, all grown by one stop at a time.

use rustc_hash::FxHashSet;

use super::Guide;
use super::guide::EQUAL;
use crate::framework::Episode;
use crate::policy::QError;

/// A child that may enter the next beam.
struct Child {
    parent: usize,
    action: usize,
    candidate: u32,
    /// What its episode would earn in all: earned so far, and the value of the action.
    promise: f64,
}

impl<'a> Guide<'a> {
    /// Keeps, stop by stop, the `width` children that promise most and leave no demand impossible, of those
    /// with the same stops only the one that promises most. The episodes that ended, `width` at most, are
    /// returned: each narrows the beam by one. Where none meets the demands, one that failed is returned.
    ///
    /// # Errors
    /// The Q-function cannot answer.
    pub fn beam(&self, width: usize) -> Result<Vec<Episode<'a>>, QError> {
        let (mut beam, mut ended, mut failed) = (vec![self.begin()], Vec::new(), None);
        if beam[0].is_over() {
            return Ok(beam);
        }
        while !beam.is_empty() {
            let values = self.values(&beam.iter().collect::<Vec<_>>())?;
            let mut next = Vec::with_capacity(width);
            for child in promising(&beam, &values) {
                if ended.len() + next.len() >= width {
                    break;
                }
                let mut episode = beam[child.parent].clone();
                episode.act(child.action);
                if !episode.is_over() {
                    next.push(episode);
                } else if episode.succeeded() {
                    ended.push(episode);
                } else {
                    failed.get_or_insert(episode);
                }
            }
            beam = next;
        }
        if ended.is_empty() {
            ended.extend(failed);
        }
        Ok(ended)
    }
}

/// The children that may enter the next beam, the most promising first.
fn promising(beam: &[Episode<'_>], values: &[Vec<f32>]) -> Vec<Child> {
    let mut children: Vec<Child> = Vec::new();
    for (parent, (episode, values)) in beam.iter().zip(values).enumerate() {
        for (action, (of, &q)) in episode.actions().iter().zip(values).enumerate() {
            let promise = episode.earned() + f64::from(q);
            children.push(Child { parent, action, candidate: of.candidate, promise });
        }
    }
    // In steps of what counts as equal, so that the order is total and rounding does not decide.
    let step = |child: &Child| (child.promise / f64::from(EQUAL)).round();
    children.sort_by(|a, b| {
        step(b).total_cmp(&step(a)).then(a.parent.cmp(&b.parent)).then(a.action.cmp(&b.action))
    });
    let mut seen = FxHashSet::default();
    let mut stops = Vec::new();
    let mut fresh = |child: &Child| {
        stops.clear();
        stops.extend_from_slice(beam[child.parent].order());
        stops.push(child.candidate);
        stops.sort_unstable();
        seen.insert(stops.clone())
    };
    children.retain(|child| fresh(child));
    children
}
