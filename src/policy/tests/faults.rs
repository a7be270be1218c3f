//! What each check finds.

use prost::Message;
use tract_onnx::pb::ModelProto;
use voltour_solver::policy::{FEATURE_VERSION, FEATURES, Problem};

use super::onnx::{Onnx, value};
use super::support::loaded;
use crate::policy::{Fallback, Fault, Policy, file, load};

/// What a model is refused for, after it was broken.
fn fault(change: impl FnOnce(&mut ModelProto)) -> Fault {
    let mut model = Onnx::of("reward").model();
    change(&mut model);
    loaded(&model.encode_to_vec()).unwrap_err()
}

#[test]
fn a_good_model_says_what_it_is() {
    let bytes = Onnx::of("reward").bytes();
    let Policy { about, .. } = loaded(&bytes).unwrap();
    assert_eq!((about.name.as_str(), about.source.as_str()), ("reward", "folder/reward.onnx"));
    assert_eq!((about.problem, about.feature_version), (Problem::Reward, FEATURE_VERSION));
    assert_eq!((about.training.as_str(), about.digest.len()), (r#"{"steps": 0}"#, 64));
    assert_ne!(
        about.digest,
        loaded(&Onnx { factor: 2.0, ..Onnx::of("reward") }.bytes()).unwrap().about.digest
    );
    assert_eq!(load("x.onnx", &bytes, None).unwrap().about.digest, about.digest);
}

#[test]
fn damage_is_found() {
    let bytes = Onnx::of("reward").bytes();
    for bytes in [&bytes[..bytes.len() / 2], &bytes[..20], b"", b"no model at all", &[0xff; 64]] {
        let fault = loaded(bytes).unwrap_err();
        assert!(matches!(fault, Fault::Damaged(_)), "{fault}");
        assert_eq!(Fallback::from(&fault), Fallback::Damaged);
        assert!(!fault.to_string().contains('\n'));
    }
    let unknown = fault(|model| model.graph.as_mut().unwrap().node[0].op_type = "Guess".to_owned());
    assert!(matches!(unknown, Fault::Damaged(_)), "{unknown}");
    let dangling = fault(|model| model.graph.as_mut().unwrap().node.truncate(6));
    assert!(matches!(dangling, Fault::Damaged(_)), "{dangling}");
}

#[test]
fn another_version_or_problem_is_refused() {
    let old = Onnx { version: "0".to_owned(), ..Onnx::of("reward") };
    let fault = loaded(&old.bytes()).unwrap_err();
    assert_eq!(fault, Fault::WrongVersion { found: "0".to_owned() });
    let found = self::fault(|model| model.metadata_props.clear());
    assert_eq!(found, Fault::WrongVersion { found: "none".to_owned() });
    let fault = loaded(&Onnx::of("mobile").bytes()).unwrap_err();
    assert!(matches!(&fault, Fault::WrongProblem { found, .. } if found == "mobile"), "{fault}");
    assert_eq!(Fallback::from(&fault), Fallback::WrongProblem);
    let error = load("x", &Onnx::of("parking").bytes(), None).unwrap_err().to_string();
    assert!(error.contains("parking") && error.contains("k_coverage or reward"), "{error}");
}

#[test]
fn other_tensors_are_refused() {
    let wide = Onnx { features: FEATURES + 1, ..Onnx::of("reward") };
    let fault = loaded(&wide.bytes()).unwrap_err().to_string();
    let said =
        format!("nodes is float [?, ?, {}]; float [?, ?, {FEATURES}] is required", FEATURES + 1);
    assert!(fault.contains(&said), "{fault}");
    let input = |model: &mut ModelProto, i: usize, sizes: &[Option<i64>]| {
        let input = &mut model.graph.as_mut().unwrap().input[i];
        *input = value(&input.name.clone(), sizes);
    };
    let faults = [
        self::fault(|model| input(model, 1, &[None, None])),
        // B and N must be open.
        self::fault(|model| input(model, 2, &[None, Some(8)])),
        self::fault(|model| {
            model.graph.as_mut().unwrap().input.remove(2);
        }),
        self::fault(|model| model.graph.as_mut().unwrap().input[0].name = "states".to_owned()),
        self::fault(|model| model.graph.as_mut().unwrap().input.push(value("more", &[None]))),
        self::fault(|model| model.graph.as_mut().unwrap().output[0].name = "v".to_owned()),
        // What it computes is not what it declares.
        self::fault(|model| {
            let graph = model.graph.as_mut().unwrap();
            graph.node.truncate(4);
            graph.node[3].output = vec!["q".to_owned()];
        }),
    ];
    for fault in faults {
        assert!(matches!(fault, Fault::WrongShape { .. }), "{fault}");
        assert_eq!(Fallback::from(&fault), Fallback::WrongShape);
    }
}

#[test]
fn values_that_are_not_finite_are_found_before_use() {
    for factor in [f32::NAN, f32::INFINITY] {
        let fault = loaded(&Onnx { factor, ..Onnx::of("reward") }.bytes()).unwrap_err();
        assert!(matches!(fault, Fault::NotFinite(_)), "{fault}");
    }
}

#[test]
fn a_file_that_is_not_there_or_no_file_is_an_error_that_names_it() {
    let folder = tempfile::tempdir().unwrap();
    let missing = file(&folder.path().join("reward.onnx"), None).unwrap_err();
    assert!(missing.fault == Fault::Missing && missing.to_string().contains("reward.onnx"));
    assert!(matches!(file(folder.path(), None).unwrap_err().fault, Fault::Unreadable(_)));
}
