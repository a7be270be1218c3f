//! Calls of the service, and what its refusals look like here.

use std::time::Duration;

use tonic::{Code, Request, Status};

use crate::cli::Failure;
use crate::domain::Refusal;
use crate::grpc::violations;

/// A call that does not wait for anything is answered at once; this is for a busy database.
const TIMEOUT: Duration = Duration::from_secs(30);
/// The largest message that is taken: the most that a service can be configured to send.
pub const MESSAGE_BYTES: usize = 64 * 1024 * 1024;

/// A call with the usual time for an answer.
pub fn call<T>(message: T) -> Request<T> {
    waiting(message, TIMEOUT)
}

/// A call with this time for an answer.
pub fn waiting<T>(message: T, wait: Duration) -> Request<T> {
    let mut request = Request::new(message);
    request.set_timeout(wait);
    request
}

/// What the service refused: one line a field, or one line.
pub fn refused(status: Status) -> Failure {
    let code = if status.code() == Code::InvalidArgument { 2 } else { 1 };
    let violations = violations(&status);
    if violations.is_empty() {
        return Failure {
            code,
            lines: vec![format!("{}: {}", name(status.code()), status.message())],
        };
    }
    let lines = violations.into_iter().map(|v| format!("{}: {}", v.field, v.description));
    Failure { code, lines: lines.collect() }
}

/// An answer that cannot be read: another version of the service, most likely.
pub fn unreadable(refusal: Refusal) -> Failure {
    Failure::other(format!("the service's answer cannot be read: {refusal}"))
}

fn name(code: Code) -> &'static str {
    match code {
        Code::NotFound => "not found",
        Code::AlreadyExists => "already exists",
        Code::FailedPrecondition => "not possible now",
        Code::Aborted => "aborted",
        Code::DeadlineExceeded | Code::Cancelled => "not in time",
        Code::ResourceExhausted => "too much at once",
        Code::Unavailable => "unavailable",
        Code::InvalidArgument => "bad input",
        Code::Unauthenticated => "not let in",
        Code::PermissionDenied => "not allowed",
        _ => "failed",
    }
}
