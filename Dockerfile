# syntax=docker/dockerfile:1
# The service in an image with neither shell nor package manager: the binary, the libraries that it links, nothing else.
#
#   docker build -t voltour .
#   docker run -d --read-only -p 7440:7440 -p 7480:7480 -v voltour:/var/lib/voltour \
#     -e VOLTOUR_ACCESS__BOOTSTRAP_TOKEN="$(openssl rand -hex 32)" voltour
#
# `just image` follows these steps without a container engine (tests/packaging/image.py), so write them as plainly as now.

FROM rust:1.95-bookworm AS build
WORKDIR /build
COPY Cargo.toml Cargo.lock build.rs ./
COPY crates crates
COPY proto proto
COPY migrations migrations
COPY models models
COPY benches benches
COPY tests tests
COPY src src
# What was downloaded and compiled before is kept from one build to the next.
RUN --mount=type=cache,target=/usr/local/cargo/registry --mount=type=cache,target=/build/target cargo build --release --locked --package voltour --bin voltour && mkdir -p /out/var/lib/voltour && cp target/release/voltour /out/voltour

# glibc, libgcc and certificates; no shell. Its user `nonroot` is 65532.
FROM gcr.io/distroless/cc-debian12:nonroot
COPY --from=build /out/voltour /usr/local/bin/voltour
COPY --from=build --chown=65532:65532 /out/var/lib/voltour /var/lib/voltour
USER 65532:65532
WORKDIR /var/lib/voltour
ENV VOLTOUR_STORE__PATH=/var/lib/voltour/voltour.db VOLTOUR_GRPC__LISTEN=0.0.0.0:7440 VOLTOUR_REST__LISTEN=0.0.0.0:7480 VOLTOUR_LOG__FORMAT=json
VOLUME /var/lib/voltour
EXPOSE 7440 7480
STOPSIGNAL SIGTERM
# Where TLS is on, VOLTOUR_SERVER names the service as its certificate does, and VOLTOUR_CA who signed that.
HEALTHCHECK --interval=10s --timeout=5s --start-period=30s --retries=3 CMD ["/usr/local/bin/voltour", "health"]
ENTRYPOINT ["/usr/local/bin/voltour"]
CMD ["serve"]
