use rand::RngExt;
use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::SeedableRng;

use super::{Batch, Encoder, Encoding, FEATURES, Feature, Problem};
use crate::framework::tests::drawn;
use crate::framework::{Episode, definition};
use crate::generate;
use crate::instance::Instance;
use crate::scenario::{Document, Scenario};

/// Plays random actions, chosen by the sensor's place in its scenario, and collects the encodings by
/// sensor id.
fn encodings(document: &Document, seed: u64) -> Vec<Vec<(String, Vec<f32>)>> {
    let scenario = Scenario::from_document(document).unwrap();
    let instance = Instance::new(&scenario);
    let mut episode = Episode::new(&instance, definition(Problem::of(scenario.objective)));
    let encoder = Encoder::new(episode.state());
    let id = |candidate: u32| {
        let request = instance.candidates[candidate as usize].request;
        scenario.sensors[scenario.requests[request].sensor].id.clone()
    };
    let mut rng = Pcg64Mcg::seed_from_u64(seed);
    let mut states = Vec::new();
    while !episode.is_over() {
        let encoding = encoder.encode(&episode);
        let rows = encoding.nodes.chunks_exact(FEATURES).zip(&encoding.candidates);
        let mut rows: Vec<_> = rows.map(|(row, &c)| (id(c), row.to_vec())).collect();
        rows.sort_by(|a, b| a.0.cmp(&b.0));
        states.push(rows);
        // The same sensor in every relabelling, whatever its index.
        let mut actions: Vec<_> = episode.actions().iter().map(|a| id(a.candidate)).collect();
        actions.sort();
        let chosen = &actions[rng.random_range(0..actions.len())];
        let index = episode.actions().iter().position(|a| id(a.candidate) == *chosen);
        episode.act(index.unwrap());
    }
    states
}

fn assert_close(a: &[Vec<(String, Vec<f32>)>], b: &[Vec<(String, Vec<f32>)>], what: &str) {
    assert_eq!(a.len(), b.len(), "{what}: number of states");
    for (a, b) in a.iter().flatten().zip(b.iter().flatten()) {
        assert_eq!(a.0, b.0, "{what}");
        for (feature, (x, y)) in Feature::ALL.iter().zip(a.1.iter().zip(&b.1)) {
            assert!((x - y).abs() < 2e-3, "{what}: {feature:?} of {} is {x} and {y}", a.0);
        }
    }
}

#[test]
fn the_order_of_the_requests_does_not_matter() {
    for document in drawn(5) {
        let mut other = document.clone();
        other.requests.reverse();
        other.sensors.reverse();
        assert_close(&encodings(&document, 1), &encodings(&other, 1), "reversed");
    }
}

/// The document with every place put elsewhere.
fn moved(document: &Document, to: impl Fn([f64; 2]) -> [f64; 2]) -> Document {
    let mut moved = document.clone();
    let charger = &mut moved.charger;
    let sensors = moved.sensors.iter_mut().flat_map(|sensor| &mut sensor.position_m);
    let ends = [&mut charger.start_m].into_iter().chain(&mut charger.end_m);
    sensors.chain(ends).for_each(|place| *place = to(*place));
    moved
}

#[test]
fn turning_the_field_does_not_matter() {
    let options = generate::Reward { sensors: 40, alpha: 1.0, ..Default::default() };
    let document = generate::reward(&options, 5).unwrap();
    let other = moved(&document, |[x, y]| [3.0 - y, x - 2.0]);
    assert_close(&encodings(&document, 1), &encodings(&other, 1), "turned");
}

#[test]
fn units_do_not_matter() {
    // A field ten times as wide, a charger ten times as fast and as thrifty.
    let options = generate::Reward { sensors: 40, alpha: 1.0, ..Default::default() };
    let document = generate::reward(&options, 6).unwrap();
    let mut other = moved(&document, |[x, y]| [10.0 * x, 10.0 * y]);
    other.charger.speed_mps *= 10.0;
    other.charger.travel_jpm /= 10.0;
    assert_close(&encodings(&document, 2), &encodings(&other, 2), "grown");
}

#[test]
fn features_are_finite_and_of_moderate_size() {
    for seed in 0..10 {
        for document in drawn(seed) {
            for (id, row) in encodings(&document, seed).iter().flatten() {
                for (feature, value) in Feature::ALL.iter().zip(row) {
                    let moderate = value.is_finite() && value.abs() < 30.0;
                    assert!(moderate, "{feature:?} of {id} is {value}");
                }
            }
        }
    }
}

#[test]
fn a_batch_pads_with_zeros() {
    let [document, ..] = drawn(1);
    let scenario = Scenario::from_document(&document).unwrap();
    let instance = Instance::new(&scenario);
    let mut episode = Episode::new(&instance, definition(Problem::KCoverage));
    let encoder = Encoder::new(episode.state());
    let first: Encoding = encoder.encode(&episode);
    episode.act(0);
    let second = encoder.encode(&episode);
    let batch = Batch::pack([&first, &second]);
    let rows = first.rows().max(second.rows());
    assert_eq!((batch.states, batch.rows), (2, rows));
    assert_eq!(batch.nodes.len(), 2 * rows * FEATURES);
    let real: f32 = batch.mask.iter().sum();
    assert_eq!(real as usize, first.rows() + second.rows());
    for (cell, mask) in batch.mask.iter().enumerate() {
        let row = &batch.nodes[cell * FEATURES..(cell + 1) * FEATURES];
        assert!(*mask == 1.0 || row.iter().all(|&value| value == 0.0));
    }
    for (state, encoding) in [&first, &second].into_iter().enumerate() {
        for (i, &a) in encoding.candidates.iter().enumerate() {
            for (j, &b) in encoding.candidates.iter().enumerate() {
                let edge = f64::from(batch.edges[(state * rows + i) * rows + j]);
                let metres = instance.distance_m(a as usize, b as usize);
                assert!((edge - metres / episode.state().scales().length_m).abs() < 1e-5);
            }
        }
    }
}

#[test]
fn an_action_breaks_a_demand_exactly_where_the_episode_fails_by_it() {
    let (mut broken, mut whole) = (0, 0);
    let options = generate::KCoverage { sensors: 32, k: 2, alpha: 0.8, ..Default::default() };
    for seed in 0..20 {
        let document = generate::k_coverage(&options, seed).unwrap();
        let scenario = Scenario::from_document(&document).unwrap();
        let instance = Instance::new(&scenario);
        let mut episode = Episode::new(&instance, definition(Problem::KCoverage));
        let encoder = Encoder::new(episode.state());
        let mut rng = Pcg64Mcg::seed_from_u64(seed);
        while !episode.is_over() {
            let encoding = encoder.encode(&episode);
            for (row, action) in encoding.nodes.chunks_exact(FEATURES).zip(&encoding.actions) {
                let Some(action) = *action else { continue };
                let mut next = episode.clone();
                next.act(action as usize);
                let fails = next.is_over() && !next.succeeded();
                assert_eq!(row[Feature::Breaks.column()] > 0.0, fails, "seed {seed}");
                // Whatever breaks a demand does so by losing others.
                assert!(!fails || row[Feature::Loses.column()] > 0.0, "seed {seed}");
                if fails { broken += 1 } else { whole += 1 }
            }
            episode.act(rng.random_range(0..episode.actions().len()));
        }
    }
    assert!(broken > 50 && whole > 50, "{broken} {whole}");
}
