//! The base station: streams requests, remembers which were acknowledged, and after a crash sends those
//! again, under the same client ids, that were not.

use std::collections::VecDeque;
use std::time::Duration;

use tokio::sync::mpsc;
use tokio_stream::wrappers::ReceiverStream;
use tonic::transport::Channel;
use tonic::{Code, Status};
use voltour::proto::acknowledgement::Result as Outcome;
use voltour::proto::request_service_client::RequestServiceClient;
use voltour::proto::{ChargingRequest, SubmitRequest};

use super::SENSORS;
use super::aim::Killed;
use super::rng::Rng;
use crate::calls::soon;
use crate::field::{FIELD, sensor};
use crate::time::from_now;

/// Items under way at most.
const UNACKNOWLEDGED: usize = 200;

#[derive(Clone, Debug)]
pub struct Station {
    name: &'static str,
    rng: Rng,
    /// Between two requests.
    pace: Duration,
    made: u64,
    /// Sent and not acknowledged, in the order of sending.
    pub waiting: VecDeque<SubmitRequest>,
    /// Acknowledged: what was sent, and the id that it got.
    pub acknowledged: Vec<(SubmitRequest, String)>,
}

impl Station {
    pub fn new(name: &'static str, seed: u64, pace: Duration) -> Self {
        let rng = Rng::new(seed);
        let (waiting, acknowledged) = (VecDeque::new(), Vec::new());
        Self { name, rng, pace, made: 0, waiting, acknowledged }
    }

    /// Sends requests until the process is killed.
    pub async fn pour(&mut self, requests: RequestServiceClient<Channel>, killed: &Killed) {
        let ended = self.stream(requests, u64::MAX).await;
        assert!(killed.struck(), "the stream ended without a kill: {ended:?}");
    }

    /// Sends again what was not acknowledged, and some more, and waits for all answers.
    pub async fn finish(&mut self, requests: RequestServiceClient<Channel>) {
        let ended = soon("the last answers", self.stream(requests, self.made + 20)).await;
        ended.expect("no failure");
        assert!(self.waiting.is_empty());
    }

    async fn stream(
        &mut self,
        mut requests: RequestServiceClient<Channel>,
        last: u64,
    ) -> Result<(), Status> {
        let (send, items) = mpsc::channel(16);
        let answers = requests.submit_stream(ReceiverStream::new(items)).await?;
        let (mut answers, mut send) = (answers.into_inner(), Some(send));
        let mut pace = tokio::time::interval(self.pace);
        // Of those that wait, this many were sent on this stream.
        let (mut sent, mut position) = (0, 0);
        loop {
            let more = sent < self.waiting.len() || self.made < last;
            if !more {
                send = None;
            }
            tokio::select! {
                _ = pace.tick(), if send.is_some() && sent < UNACKNOWLEDGED => {
                    if sent == self.waiting.len() {
                        let made = self.make();
                        self.waiting.push_back(made);
                    }
                    let item = self.waiting[sent].clone();
                    sent += 1;
                    if let Some(send) = &send {
                        send.send(item).await.map_err(|_| Status::new(Code::Aborted, "closed"))?;
                    }
                }
                answer = answers.message() => {
                    let Some(answer) = answer? else { return Ok(()) };
                    let item = self.waiting.pop_front().expect("an item for each answer");
                    assert_eq!((answer.position, &answer.client_id), (position, &item.client_id));
                    position += 1;
                    sent -= 1;
                    match answer.result {
                        Some(Outcome::Request(request)) => self.acknowledge(item, request),
                        other => panic!("item {item:?}: {other:?}"),
                    }
                }
            }
        }
    }

    fn acknowledge(&mut self, item: SubmitRequest, request: ChargingRequest) {
        assert_eq!(request.submitted.as_ref(), Some(&item));
        self.acknowledged.push((item, request.id));
    }

    /// Any request, some of them with so short a deadline that they expire.
    fn make(&mut self) -> SubmitRequest {
        self.made += 1;
        let rng = &mut self.rng;
        SubmitRequest {
            client_id: format!("{}-{}", self.name, self.made),
            network_id: FIELD.into(),
            sensor_id: sensor(rng.range(1, SENSORS as u64 + 1) as usize).id,
            deadline: from_now(rng.range(100, 600_000) as i64).filter(|_| rng.one_in(2)),
            residual_j: Some(rng.range(0, 90) as f64 + 0.25).filter(|_| rng.one_in(2)),
            drain_w: Some(0.125).filter(|_| rng.one_in(3)),
            reward: Some(rng.range(1, 100) as f64).filter(|_| rng.one_in(3)),
            ..SubmitRequest::default()
        }
    }
}
