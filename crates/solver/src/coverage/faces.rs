//! The sets that the faces of the arrangement have, each with the vertices that claim it and the
//! deepest point known to lie in it. A claim becomes a region only through such a witness.

use std::collections::BTreeMap;

use nalgebra::Vector2;

use super::Region;
use super::disks::Curves;
use super::sectors::Sectors;
use super::sets::{Sets, hash};
use super::surroundings::Surroundings;
use crate::scenario::Point;

/// Metres: faces of which every border piece is shorter are ignored.
const LEAST_PIECE: f64 = 1e-9;
/// Metres: a deeper witness ends the search; shallower ones may just have missed a border.
const DEEP_ENOUGH: f64 = 1e-6;
/// From one probing circle to the next.
const STEP: f64 = 8.0;
/// In place of a set.
const NONE: u32 = u32::MAX;

/// A point inside a face, and how far it is from the nearest curve.
#[derive(Clone, Copy)]
struct Witness {
    at: Point,
    depth: f64,
}

/// What is known of the faces of one set.
#[derive(Clone, Default)]
struct Face {
    vertices: Vector2<f64>,
    count: u32,
    /// Seen so far from a vertex that it cannot be a speck.
    is_large: bool,
    witness: Option<Witness>,
}

/// A vertex in general position and the sets that its sectors should have.
struct Claim {
    vertex: Point,
    disk: u32,
    sets: [u32; 4],
}

/// All faces by their sets of covering disks.
#[derive(Default)]
pub(super) struct Faces {
    sets: Sets,
    faces: Vec<Face>,
    claims: Vec<Claim>,
    set: Vec<u32>,
}

impl Faces {
    /// A simple vertex on a disk's circle: its sectors have the covering disks with each choice of
    /// the touching ones.
    pub(super) fn claim(&mut self, vertex: Point, disk: u32, sectors: &Sectors) {
        let mut sets = [NONE; 4];
        let base = hash(&sectors.covering);
        for (choice, claimed) in sets.iter_mut().enumerate().take(1 << sectors.touching.len()) {
            self.set.clone_from(&sectors.covering);
            let mut key = base;
            for (bit, disk) in sectors.touching.iter().enumerate() {
                if choice >> bit & 1 == 1 {
                    let at = self.set.partition_point(|other| other < disk);
                    self.set.insert(at, *disk);
                    key = key.wrapping_add(hash(&[*disk]));
                }
            }
            let id = self.sets.intern_hashed(&self.set, key);
            let face = self.face(id);
            face.vertices += vertex.coords;
            face.count += 1;
            *claimed = id;
        }
        self.claims.push(Claim { vertex, disk, sets });
    }

    /// A point that is known to have this set, its depth, and its face is no speck.
    pub(super) fn large(&mut self, at: Point, set: &[u32], depth: f64) {
        self.witness(at, set, depth).is_large = true;
    }

    /// A point that is known to have this set, and its depth.
    fn witness(&mut self, at: Point, set: &[u32], depth: f64) -> &mut Face {
        let id = self.sets.intern(set);
        let face = self.face(id);
        if face.witness.is_none_or(|best| depth > best.depth) {
            face.witness = Some(Witness { at, depth });
        }
        face
    }

    /// Finds a witness for every set that has one; the surroundings are those of the disks.
    pub(super) fn settle(&mut self, curves: &Curves, around: &[Surroundings]) {
        self.try_middles(curves, around);
        self.try_sectors(curves, around);
        self.drop_specks(around);
    }

    /// One region for each set with a witness, in the order in which the sets were found.
    pub(super) fn into_regions(self, curves: &Curves) -> Vec<Region> {
        let with_witness =
            (0..).zip(&self.faces).filter_map(|(id, face)| Some((id, face.witness?)));
        let region = |(id, witness): (u32, Witness)| Region {
            covering: curves.disks.sensors(self.sets.get(id)),
            witness: curves.frame.world(witness.at),
        };
        with_witness.map(region).collect()
    }

    fn face(&mut self, id: u32) -> &mut Face {
        if self.faces.len() < self.sets.len() {
            self.faces.resize_with(self.sets.len(), Face::default);
        }
        &mut self.faces[id as usize]
    }

    /// The middle of a face's vertices mostly lies in it, and deep.
    fn try_middles(&mut self, curves: &Curves, around: &[Surroundings]) {
        let (mut offsets, mut set) = (Vec::new(), Vec::new());
        for (id, face) in (0..).zip(&mut self.faces).filter(|(_, face)| face.count > 0) {
            let middle = Point::from(face.vertices / f64::from(face.count));
            let middle = curves.frame.representable(middle);
            let expected = self.sets.get(id);
            let fewest = expected.iter().map(|&disk| &around[disk as usize]);
            let depth = match fewest.min_by_key(|near| near.disks.len()) {
                Some(near) => near.locate(curves, middle, &mut offsets, &mut set),
                None => {
                    let near = Surroundings::of_point(curves, middle);
                    near.locate(curves, middle, &mut offsets, &mut set)
                }
            };
            let best = face.witness.map_or(0.0, |witness| witness.depth);
            if let Some(depth) = depth.filter(|&depth| set == expected && depth > best) {
                face.witness = Some(Witness { at: middle, depth });
            }
        }
    }

    /// Probes the vertices of which a claim has no good witness yet. The circles shrink from the
    /// nearest other curve; where that is not enough, they grow beyond it, because a sliver between
    /// nearly parallel curves is widest far from its ends.
    fn try_sectors(&mut self, curves: &Curves, around: &[Surroundings]) {
        let mut sectors = Sectors::default();
        for claim in std::mem::take(&mut self.claims) {
            let near = &around[claim.disk as usize];
            if self.is_open(&claim) {
                sectors.survey(near, claim.vertex);
                let start = 0.5 * sectors.gap;
                let series =
                    |first, ratio| std::iter::successors(Some(first), move |r| Some(r * ratio));
                let shrinking = series(start, 1.0 / STEP).take_while(|r| *r > near.tolerance);
                let growing = series(start * STEP, STEP).take_while(|r| *r < near.reach);
                for radius in shrinking.chain(growing) {
                    let found = |at, set: &[u32], depth| _ = self.witness(at, set, depth);
                    sectors.probe(curves, near, claim.vertex, radius, found);
                    if !self.is_open(&claim) {
                        break;
                    }
                }
            }
            self.claims.push(claim);
        }
    }

    fn is_open(&self, claim: &Claim) -> bool {
        let shallow = |face: &Face| face.witness.is_none_or(|witness| witness.depth < DEEP_ENOUGH);
        claim.sets.iter().any(|&id| id != NONE && shallow(&self.faces[id as usize]))
    }

    /// Takes back the sets of which every border piece is too short to count.
    fn drop_specks(&mut self, around: &[Surroundings]) {
        let shallow = |face: &Face| face.witness.is_some_and(|w| w.depth < LEAST_PIECE);
        let suspects = (0..).zip(&self.faces).filter(|(_, face)| !face.is_large && shallow(face));
        let mut corners: BTreeMap<u32, Vec<Corner>> =
            suspects.map(|(id, _)| (id, vec![])).collect();
        if corners.is_empty() {
            return;
        }
        let mut sectors = Sectors::default();
        for claim in &self.claims {
            for id in &claim.sets {
                if let Some(corners) = corners.get_mut(id) {
                    sectors.survey(&around[claim.disk as usize], claim.vertex);
                    corners.push(Corner {
                        vertex: claim.vertex,
                        circles: sectors.touching.clone(),
                        on_edge: sectors.edges > 0,
                    });
                }
            }
        }
        for (id, corners) in corners {
            if longest_piece(&corners) < LEAST_PIECE {
                self.faces[id as usize].witness = None;
            }
        }
    }
}

/// A vertex of a face that may be a speck, and the curves that meet there.
struct Corner {
    vertex: Point,
    circles: Vec<u32>,
    on_edge: bool,
}

/// The longest way between two corners on a common curve. In a speck every curve has one piece, and
/// it is as good as straight.
fn longest_piece(corners: &[Corner]) -> f64 {
    let share = |a: &Corner, b: &Corner| {
        (a.on_edge && b.on_edge) || a.circles.iter().any(|circle| b.circles.contains(circle))
    };
    let pairs =
        corners.iter().enumerate().flat_map(|(i, a)| corners[..i].iter().map(move |b| (a, b)));
    let lengths = pairs.filter(|(a, b)| share(a, b)).map(|(a, b)| (a.vertex - b.vertex).norm());
    lengths.fold(0.0, f64::max)
}
