# What CI runs. `just check` is the whole of it; the other recipes are its parts. `.ci/run` runs them in a clean
# checkout, the tests by the command that the README gives.

python := justfile_directory() / "target/python"

# Everything that must hold before a change lands.
check: checks test

# All of it but the tests in Rust.
checks: fmt lint layers docs client contract onnx packaging (soak "120" "20")

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

# The binaries and examples as `just test` builds them: another selection of packages would build their
# dependencies again, with other features.
build:
    cargo test --workspace --locked --no-run

# The documentation builds, warnings denied.
docs:
    RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --locked

# A Python client generated from proto/ alone does the whole round against a real server.
client: python build
    {{python}}/bin/python tests/client/round.py target/debug/voltour

# The REST edge against the OpenAPI document that it serves: no server error, nothing that is not described.
contract: python build
    {{python}}/bin/python tests/client/contract.py target/debug/voltour

# Writes docs/openapi.json as the handlers make it; a test compares the two.
openapi:
    VOLTOUR_WRITE_OPENAPI=1 cargo test --workspace --locked --lib openapi

# At a release: the contract as it is becomes the one that nothing may be taken back from.
released:
    cp proto/voltour/v1/*.proto tests/proto/released/voltour/v1/

# A model as the trainer writes it passes the ONNX checker, and onnxruntime computes what the trainer does.
onnx: python build
    mkdir -p target/onnx
    target/debug/examples/onnx_values target/onnx
    {{python}}/bin/python tests/onnx/agree.py target/onnx

# The files of deploy/ against their schemas, the Dockerfile and the binary; the image's last stage with this binary.
packaging: python build
    {{python}}/bin/python tests/packaging/deploy.py target/debug/voltour
    {{python}}/bin/python tests/packaging/image.py target/debug/voltour

# All steps of the Dockerfile without a container engine, the release build included.
image: python
    {{python}}/bin/python tests/packaging/image.py

# Four base stations, two chargers, an operator, and kill -9 again and again: half an hour, or two minutes in CI.
soak seconds="1800" life="60":
    VOLTOUR_SOAK_S={{seconds}} VOLTOUR_SOAK_KILL_S={{life}} cargo test --workspace --locked --test service soak -- --ignored --nocapture

# A fuzz target for ten minutes (scenario, message, query, cursor, policy); `cargo test` runs each for a moment. See fuzz/README.md.
fuzz target seconds="600":
    mkdir -p fuzz/corpus/{{target}}
    cd fuzz && cargo +nightly fuzz run --sanitizer none {{target}} corpus/{{target}} seeds/{{target}} -- -max_total_time={{seconds}} -max_len=8192

# The Python that the tests in Python run in.
python:
    test -x {{python}}/bin/python || python3 -m venv {{python}}
    {{python}}/bin/python -m pip install --quiet --disable-pip-version-check --requirement tests/client/requirements.txt --requirement tests/onnx/requirements.txt --requirement tests/packaging/requirements.txt

# The benchmarks, each printing a ratio against its reference.
bench:
    cargo bench --workspace

# 200 trials of kill -9 at random moments (CI runs fewer).
crash trials="200":
    VOLTOUR_CRASH_TRIALS={{trials}} cargo test --release --locked --test service crash -- --nocapture

# 1,000 power cuts at random moments (CI makes fewer).
power trials="1000":
    VOLTOUR_POWER_TRIALS={{trials}} cargo test --workspace --locked --lib power_loss
