//! The values of a model, whatever they are asked together with.

use voltour_solver::policy::{Batch, FEATURES, QError};

use super::support::{batch, close, good, part};
use crate::policy::probe::probes;
use crate::policy::{Fault, Policies};

#[test]
fn its_values_are_those_of_the_graph() {
    let (policy, batch) = (good(), batch(3, 11));
    let values = policy.function.values(&batch).unwrap();
    let h = |state: usize, row: usize| -> f64 {
        let at = (state * batch.rows + row) * FEATURES;
        let weighted = |f: usize| f64::from(batch.nodes[at + f]) / (1.0 + f as f64);
        (0..FEATURES).map(weighted).sum()
    };
    for (i, value) in values.iter().enumerate() {
        let (state, row) = (i / batch.rows, i % batch.rows);
        let edge = |to: usize| f64::from(batch.edges[i * batch.rows + to]);
        let met: f64 = (0..batch.rows).map(|to| edge(to) * h(state, to)).sum();
        assert!(close(*value, (h(state, row) + met / 20.0) as f32), "{i}: {value}");
    }
}

#[test]
fn neither_padding_nor_company_changes_a_value() {
    let (policy, whole) = (good(), batch(37, 13));
    let values = policy.function.values(&whole).unwrap();
    assert_eq!(values.len(), 37 * 13);
    assert_eq!(policy.function.values(&whole).unwrap(), values, "the same, to the last bit");
    for (from, states, more) in [(0, 1, 0), (5, 3, 2), (31, 6, 11), (0, 37, 5)] {
        let part = part(&whole, from, states, more);
        let found = policy.function.values(&part).unwrap();
        for (i, value) in found.iter().enumerate() {
            let (state, row) = (from + i / part.rows, i % part.rows);
            let expected = if row < 13 { values[state * 13 + row] } else { 0.0 };
            assert!(close(*value, expected), "{from} {states} {more}: {value} for {expected}");
        }
    }
}

#[test]
fn several_threads_get_the_same_values() {
    let (policy, batch) = (good(), batch(5, 9));
    let values = policy.function.values(&batch).unwrap();
    std::thread::scope(|scope| {
        let ask = || scope.spawn(|| policy.function.values(&batch).unwrap());
        let asked: Vec<_> = (0..4).map(|_| ask()).collect();
        asked.into_iter().for_each(|thread| assert_eq!(thread.join().unwrap(), values));
    });
}

#[test]
fn sizes_out_of_bounds_are_refused() {
    let policy = good();
    assert_eq!(policy.function.values(&Batch::default()), Ok(Vec::new()));
    let short = Batch { states: 2, ..batch(1, 4) };
    assert!(matches!(policy.function.values(&short), Err(QError::Failed(_))));
    let large = Batch { states: 0, rows: 5_000, ..Batch::default() };
    assert!(matches!(policy.function.values(&large), Err(QError::Failed(_))));
}

#[test]
fn a_value_that_is_not_finite_is_an_error() {
    let policy = good();
    let mut bad = batch(2, 5);
    bad.nodes[FEATURES * 7] = f32::INFINITY;
    let error = policy.function.values(&bad).unwrap_err();
    assert!(matches!(&error, QError::NotFinite(said) if said.contains("state 1")), "{error}");
}

#[test]
fn what_is_part_of_the_binary_passes_every_check() {
    for (problem, policy) in Policies::load(None).iter() {
        match policy {
            Ok(policy) => {
                // Padding does not change what it says.
                let [_, probe, _] = probes();
                let padded = part(&probe, 0, probe.states, 9);
                let (few, many) = (
                    policy.function.values(&probe).unwrap(),
                    policy.function.values(&padded).unwrap(),
                );
                for (i, value) in few.iter().enumerate().filter(|(i, _)| probe.mask[*i] == 1.0) {
                    let other = many[i / probe.rows * padded.rows + i % probe.rows];
                    assert!(close(*value, other), "{problem}: {value} for {other}");
                }
            }
            Err(error) => assert_eq!(error.fault, Fault::Missing, "{problem}: {error}"),
        }
    }
}
