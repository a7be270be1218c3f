"""A model as the trainer writes it, before the ONNX checker and onnxruntime.

    cargo run --package voltour-trainer --example onnx_values -- DIRECTORY
    python tests/onnx/agree.py DIRECTORY

Checks the model with the ONNX checker, shape inference included, and compares onnxruntime's values with
those that the trainer wrote beside it. Ends with the exit code 0 or 1.
"""

import json
import pathlib
import sys

import numpy
import onnx
import onnxruntime

TOLERANCE = 1e-5  # relative to the largest value of a batch
METADATA = {f"voltour.{key}" for key in ("feature_version", "problem", "network", "training", "evaluation")}


def check(path):
    """The checker passes the model, its sizes are symbols, its metadata whole."""
    model = onnx.load(path)
    onnx.checker.check_model(model, full_check=True)
    assert [(o.domain, o.version) for o in model.opset_import] == [("", 17)]
    sizes = {
        value.name: [d.dim_param or d.dim_value for d in value.type.tensor_type.shape.dim]
        for value in [*model.graph.input, *model.graph.output]
    }
    features = sizes["nodes"][2]
    assert sizes == {"nodes": ["B", "N", features], "edges": ["B", "N", "N"], "mask": ["B", "N"], "q": ["B", "N"]}
    metadata = {entry.key: entry.value for entry in model.metadata_props}
    assert set(metadata) == METADATA, metadata
    for key in ("network", "training", "evaluation"):
        json.loads(metadata[f"voltour.{key}"])
    return features


def compare(path, batches, features):
    """The largest relative difference between onnxruntime and the trainer."""
    session = onnxruntime.InferenceSession(path, providers=["CPUExecutionProvider"])
    worst = 0.0
    for batch in batches:
        b, n = batch["states"], batch["rows"]
        shapes = {"nodes": (b, n, features), "edges": (b, n, n), "mask": (b, n)}
        inputs = {name: numpy.float32(batch[name]).reshape(shape) for name, shape in shapes.items()}
        (found,) = session.run(["q"], inputs)
        expected = numpy.float32(batch["q"]).reshape(b, n)
        assert found.shape == expected.shape and numpy.isfinite(found).all()
        scale = max(1.0, numpy.abs(expected).max())
        worst = max(worst, float(numpy.abs(found - expected).max() / scale))
    return worst


def main():
    directory = pathlib.Path(sys.argv[1])
    path = str(directory / "model.onnx")
    features = check(path)
    batches = json.loads((directory / "values.json").read_text())
    worst = compare(path, batches, features)
    sizes = ", ".join(f"{b['states']} x {b['rows']}" for b in batches)
    print(f"checker passed; onnxruntime {onnxruntime.__version__} differs by at most {worst:.1e} ({sizes})")
    return 0 if worst <= TOLERANCE else 1


if __name__ == "__main__":
    sys.exit(main())
