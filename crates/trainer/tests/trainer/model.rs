//! Models: what is written is read back, and tract computes what the trainer does.

use tract_onnx::prelude::*;
use voltour_solver::policy::{Batch, FEATURES, QFunction};
use voltour_trainer::checkpoint::{Checkpoint, Run};
use voltour_trainer::dqn::{Adam, Options};
use voltour_trainer::network::Network;
use voltour_trainer::onnx::{Metadata, Model};
use voltour_trainer::report::Point;

use super::states::{assert_close, batch, weights};

fn model(seed: u64) -> Model {
    let metadata = Metadata {
        problem: "k_coverage".to_owned(),
        training: r#"{"seed":1}"#.to_owned(),
        evaluation: "{}".to_owned(),
    };
    Model { weights: weights(seed), metadata }
}

/// The values by tract, optimised for the batch's size.
fn tract(model: &Model, batch: &Batch) -> Vec<f32> {
    let (b, n) = (batch.states, batch.rows);
    let bytes = model.to_bytes();
    let fact = |dims: &[usize]| InferenceFact::dt_shape(f32::datum_type(), dims);
    let runnable = tract_onnx::onnx()
        .model_for_read(&mut &*bytes)
        .unwrap()
        .with_input_fact(0, fact(&[b, n, FEATURES]))
        .unwrap()
        .with_input_fact(1, fact(&[b, n, n]))
        .unwrap()
        .with_input_fact(2, fact(&[b, n]))
        .unwrap()
        .into_optimized()
        .unwrap()
        .into_runnable()
        .unwrap();
    let tensor = |dims: &[usize], values: &[f32]| Tensor::from_shape(dims, values).unwrap().into();
    let inputs = tvec!(
        tensor(&[b, n, FEATURES], &batch.nodes),
        tensor(&[b, n, n], &batch.edges),
        tensor(&[b, n], &batch.mask)
    );
    let outputs = runnable.run(inputs).unwrap();
    outputs[0].view().as_slice::<f32>().unwrap().to_vec()
}

#[test]
fn tract_computes_what_the_trainer_does() {
    for (seed, (states, rows)) in (0..).zip([(1, 1), (1, 9), (5, 24), (2, 60)]) {
        let (model, batch) = (model(seed), batch(states, rows, seed));
        let q = Network::new(model.weights.clone()).values(&batch).unwrap();
        assert_close(&tract(&model, &batch), &q);
    }
}

#[test]
fn a_model_is_read_back() {
    let model = model(11);
    assert_eq!(Model::from_bytes(&model.to_bytes()).unwrap(), model);
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("deep/model.onnx");
    model.save(&path).unwrap();
    assert_eq!(Model::load(&path).unwrap(), model);
}

#[test]
fn what_is_no_model_is_refused_with_a_reason() {
    let good = model(1).to_bytes();
    let reason = |bytes: &[u8]| Model::from_bytes(bytes).unwrap_err();
    assert!(reason(b"no model").contains("no ONNX model"), "{}", reason(b"no model"));
    assert!(reason(&[]).contains("voltour.feature_version"));
    let damaged = good.iter().rposition(|byte| *byte == b'k').unwrap();
    let mut bytes = good.clone();
    bytes.truncate(damaged);
    assert!(!reason(&bytes).is_empty());
    let mut other = model(1);
    other.weights.values_mut()[3] = f32::NAN;
    assert!(reason(&other.to_bytes()).contains("NaN"));
}

#[test]
fn a_checkpoint_is_read_back() {
    let weights = weights(2);
    let count = weights.values().len();
    let checkpoint = Checkpoint {
        run: Run {
            problem: "mobile".to_owned(),
            command: "voltour-train train mobile".to_owned(),
            options: Options::defaults(),
            steps: 12,
            rounds: 7,
            seconds: 1.5,
            curve: vec![Point { step: 12, gap: 0.1, feasible: 1.0, ..Point::default() }],
        },
        average: super::states::weights(5),
        target: super::states::weights(3),
        best: super::states::weights(4),
        weights,
        adam: Adam { first: vec![0.5; count], second: vec![0.25; count], steps: 12 },
    };
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("checkpoint.safetensors");
    checkpoint.save(&path).unwrap();
    assert_eq!(Checkpoint::load(&path).unwrap(), checkpoint);
    assert_eq!(checkpoint.model(false).weights, checkpoint.best);
    let model = checkpoint.model(true);
    assert_eq!(model.weights, checkpoint.average);
    assert!(model.metadata.training.contains("\"steps\":12"));
    std::fs::write(&path, b"nothing").unwrap();
    assert!(Checkpoint::load(&path).is_err());
}
