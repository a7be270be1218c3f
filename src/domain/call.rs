//! Idempotency: a call that changes something, under the id that its client gave it.

use serde::Serialize;
use sha2::{Digest, Sha256};

use super::{ClientId, DepartureId, NetworkId, NetworkSpec, RequestId, SensorId, TimedPoint};

/// SHA-256 of a call's content: the same id with another one is refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fingerprint(pub [u8; 32]);

/// A call's content under its client id.
#[derive(Clone, Debug)]
pub struct Call<T> {
    /// The client's id for this call.
    pub client_id: ClientId,
    /// What is asked.
    pub content: T,
}

impl<T: Serialize> Call<T> {
    /// The fingerprint of the content; the client id is no part of it.
    pub fn fingerprint(&self) -> Fingerprint {
        let mut hasher = Sha256::new();
        // Writing into a hasher cannot fail, and every content is a plain struct of plain fields.
        let json = serde_json::to_vec(&self.content).unwrap_or_default();
        hasher.update(&json);
        Fingerprint(hasher.finalize().into())
    }
}

/// Content of `NetworkService.Put`.
#[derive(Clone, Debug, Serialize)]
#[allow(missing_docs)]
pub struct PutNetwork {
    pub network_id: NetworkId,
    pub spec: NetworkSpec,
    pub expected_version: Option<u64>,
}

/// Content of `NetworkService.UpdateTrajectory`.
#[derive(Clone, Debug, Serialize)]
#[allow(missing_docs)]
pub struct UpdateTrajectories {
    pub network_id: NetworkId,
    pub trajectories: Vec<(SensorId, Vec<TimedPoint>)>,
}

/// Content of `RequestService.Withdraw`.
#[derive(Clone, Debug, Serialize)]
#[allow(missing_docs)]
pub struct Withdraw {
    pub network_id: NetworkId,
    pub request_id: RequestId,
}

/// Content of `DepartureService.Cancel`.
#[derive(Clone, Debug, Serialize)]
#[allow(missing_docs)]
pub struct CancelDeparture {
    pub departure_id: DepartureId,
    pub reason: String,
}
