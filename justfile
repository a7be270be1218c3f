# What CI runs. `just check` is the whole of it; the other recipes are its parts.

python := justfile_directory() / "target/python"

# Everything that must hold before a change lands.
check: fmt lint layers test docs client onnx

# Formatting.
fmt:
    cargo fmt --all --check

# Lints, warnings denied.
lint:
    cargo clippy --workspace --all-targets --locked -- -D warnings

# The arrows between the crates: the service never depends on the trainer, the solver on nothing that waits.
layers:
    ! cargo tree --package voltour --edges normal --prefix none | grep -E '^(voltour-trainer|burn) '
    ! cargo tree --package voltour-solver --edges normal --prefix none | grep -E '^(tokio|sqlx|tonic|axum) '

# Unit, property, integration and crash tests.
test:
    cargo test --workspace --locked

# The documentation builds, warnings denied.
docs:
    RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --locked

# A Python client generated from proto/ alone does the whole round against a real server.
client: python
    cargo build --locked
    {{python}}/bin/python tests/client/round.py target/debug/voltour

# A model as the trainer writes it passes the ONNX checker, and onnxruntime computes what the trainer does.
onnx: python
    mkdir -p target/onnx
    cargo run --quiet --package voltour-trainer --example onnx_values --locked -- target/onnx
    {{python}}/bin/python tests/onnx/agree.py target/onnx

# The Python that the client test and the ONNX test run in.
python:
    test -x {{python}}/bin/python || python3 -m venv {{python}}
    {{python}}/bin/pip install --quiet --disable-pip-version-check --requirement tests/client/requirements.txt --requirement tests/onnx/requirements.txt

# The benchmarks, each printing a ratio against its reference.
bench:
    cargo bench --workspace

# 200 trials of kill -9 at random moments (CI runs fewer).
crash trials="200":
    VOLTOUR_CRASH_TRIALS={{trials}} cargo test --release --locked --test service crash -- --nocapture
