//! `Withdraw`: takes a request back; that of a frozen batch takes effect if its tour leaves it out.

use super::remembered::Remembered;
use crate::domain::{Call, Refusal, Request, RequestId, RequestState, Withdraw};
use crate::store::read;
use crate::store::words::Word;
use crate::store::writer::{Command, Failure, Writing};

/// A request to take back.
#[derive(Debug)]
pub struct TakeBack(pub Call<Withdraw>);

impl Command for TakeBack {
    type Answer = Request;

    async fn apply(&self, w: &mut Writing) -> Result<Request, Failure> {
        let Withdraw { network_id, request_id } = &self.0.content;
        let call = Remembered::new("withdraw", network_id, &self.0);
        let before: Option<RequestId> = call.find(w).await?;
        let missing = || Refusal::NotFound { what: "request", id: request_id.to_string() };
        let request = read::request(&mut w.conn, *request_id).await?;
        let request = request.filter(|request| request.asked.network_id == *network_id);
        let request = request.ok_or_else(missing)?;
        if before.is_some() {
            return Ok(request);
        }
        let sql = match request.state {
            RequestState::Open => {
                "UPDATE requests SET state = 'withdrawn', updated_us = ?1, change = ?2 \
                 WHERE id = ?3 AND state = 'open'"
            }
            RequestState::Batched | RequestState::Planned => {
                "UPDATE requests SET withdraw_us = coalesce(withdraw_us, ?1), updated_us = ?1, \
                 change = ?2 WHERE id = ?3 AND state IN ('batched', 'planned')"
            }
            ended => {
                let reason = format!("request {request_id} is {} already", ended.word());
                return Err(Refusal::FailedPrecondition(reason).into());
            }
        };
        let (now_us, change) = (w.now_us(), w.coming_change());
        let update = sqlx::query(sql).bind(now_us).bind(change).bind(request_id.to_string());
        let done = update.execute(&mut w.conn).await?;
        w.took_changes(done.rows_affected());
        call.keep(w, request_id).await?;
        Ok(read::request(&mut w.conn, *request_id).await?.ok_or_else(missing)?)
    }
}
