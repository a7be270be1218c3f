//! Why a call was refused, in gRPC's words: the one mapping for calls, the one for items of streams.

use std::time::Duration;

use tonic::{Code, Status};
use tonic_types::{ErrorDetails, StatusExt};

use crate::domain::{FieldViolation, Refusal};
use crate::proto;
use crate::store::{StoreError, Trouble};

/// Details travel in the trailers, of which clients take 16 KiB, in base64: so much of them may be
/// violations.
const DETAIL_BYTES: usize = 4096;

/// When to try again what failed for want of a database or of room.
const RETRY: Duration = Duration::from_secs(1);

impl From<Refusal> for Status {
    fn from(refusal: Refusal) -> Self {
        let code = code(&refusal);
        let mut details = ErrorDetails::new();
        match &refusal {
            Refusal::Invalid(violations) => {
                let (kept, message) = cut(violations);
                let kept =
                    kept.iter().map(|v| tonic_types::FieldViolation::new(&v.field, &v.description));
                details = ErrorDetails::with_bad_request(kept.collect::<Vec<_>>());
                return Self::with_error_details(code, message, details);
            }
            Refusal::NotFound { what, id } => {
                details.set_resource_info(*what, id, "", "");
            }
            Refusal::ResourceExhausted { limit, reason } => {
                details.add_quota_failure_violation(*limit, reason);
            }
            Refusal::Internal(message) => tracing::error!(%message, "a call failed"),
            _ => {}
        }
        if let Some(after) = retry_after(&refusal) {
            details.set_retry_info(Some(after));
        }
        Self::with_error_details(code, refusal.to_string(), details)
    }
}

impl From<Refusal> for proto::Refusal {
    fn from(refusal: Refusal) -> Self {
        let code = code(&refusal).into();
        let retry_after = retry_after(&refusal).and_then(|after| after.try_into().ok());
        match &refusal {
            Refusal::Invalid(violations) => {
                let (kept, message) = cut(violations);
                let field_violations = kept
                    .into_iter()
                    .map(|v| proto::FieldViolation { field: v.field, description: v.description });
                Self { code, message, field_violations: field_violations.collect(), retry_after }
            }
            _ => Self {
                code,
                message: refusal.to_string(),
                field_violations: Vec::new(),
                retry_after,
            },
        }
    }
}

/// When what was refused may come again unchanged.
fn retry_after(refusal: &Refusal) -> Option<Duration> {
    match refusal {
        Refusal::Unavailable(_) | Refusal::ResourceExhausted { .. } => Some(RETRY),
        _ => None,
    }
}

fn code(refusal: &Refusal) -> Code {
    match refusal {
        Refusal::Invalid(_) => Code::InvalidArgument,
        Refusal::NotFound { .. } => Code::NotFound,
        Refusal::AlreadyExists { .. } => Code::AlreadyExists,
        Refusal::Unauthenticated(_) => Code::Unauthenticated,
        Refusal::PermissionDenied(_) => Code::PermissionDenied,
        Refusal::FailedPrecondition(_) => Code::FailedPrecondition,
        Refusal::Aborted(_) => Code::Aborted,
        Refusal::DeadlineExceeded(_) => Code::DeadlineExceeded,
        Refusal::ResourceExhausted { .. } => Code::ResourceExhausted,
        Refusal::Unavailable(_) => Code::Unavailable,
        Refusal::Internal(_) => Code::Internal,
    }
}

/// As many violations as there is room for, and the first of them as a message.
fn cut(violations: &[FieldViolation]) -> (Vec<FieldViolation>, String) {
    let mut room = DETAIL_BYTES;
    let fits = |v: &&FieldViolation| {
        let bytes = v.field.len() + v.description.len();
        room.checked_sub(bytes).inspect(|left| room = *left).is_some()
    };
    let kept: Vec<FieldViolation> = violations.iter().take_while(fits).cloned().collect();
    let message = match (kept.first(), violations.len()) {
        (Some(first), 1) => format!("{}: {}", first.field, first.description),
        (Some(first), n) => {
            format!("{}: {} (and {} more)", first.field, first.description, n - 1)
        }
        (None, n) => format!("{n} fields break rules"),
    };
    (kept, message)
}

/// The refusal of a call whose reading failed.
pub(super) fn read_failed(error: StoreError) -> Refusal {
    match error {
        StoreError::Row { .. } => Refusal::Internal(error.to_string()),
        error => {
            let trouble = Trouble::of(&error);
            tracing::warn!(%error, "a read failed");
            let why = trouble.map(|trouble| format!(" ({trouble})")).unwrap_or_default();
            Refusal::Unavailable(format!("the database cannot be read now{why}; try again"))
        }
    }
}

/// A message that is too long is refused by the transport as out of range: here that is a limit like the others, but
/// for the advice to try again.
pub(super) fn too_long(status: Status, most: usize) -> Status {
    if status.code() != Code::OutOfRange {
        return status;
    }
    let reason = format!("a message is longer than {most} bytes");
    let mut details = ErrorDetails::new();
    details.add_quota_failure_violation("limits.message_bytes", &reason);
    Status::with_error_details(Code::ResourceExhausted, reason, details)
}

/// What a call gets that the service's end cut short.
pub(super) fn stopping() -> Status {
    Refusal::Unavailable("the service is stopping; try again".to_owned()).into()
}

/// The violations in a status, for the commands that show them.
pub fn violations(status: &Status) -> Vec<FieldViolation> {
    let field_violations =
        status.get_details_bad_request().map(|bad| bad.field_violations).unwrap_or_default();
    let domain = |v: tonic_types::FieldViolation| FieldViolation {
        field: v.field,
        description: v.description,
    };
    field_violations.into_iter().map(domain).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn violations_travel_with_the_status() {
        let status = Status::from(Refusal::invalid("deadline", "1 is no time"));
        assert_eq!(status.code(), Code::InvalidArgument);
        assert_eq!(status.message(), "deadline: 1 is no time");
        assert_eq!(violations(&status)[0].field, "deadline");
    }

    #[test]
    fn a_thousand_violations_fit_into_the_trailers() {
        let violation = |i| FieldViolation {
            field: format!("spec.sensors[{i}].battery_j"),
            description: "-1 must be finite and greater than 0".to_owned(),
        };
        let status = Status::from(Refusal::Invalid((0..1_000).map(violation).collect()));
        assert!(status.details().len() < 8_192, "{}", status.details().len());
        assert!(status.message().ends_with("(and 999 more)"), "{}", status.message());
        assert!(violations(&status).len() > 10);
    }

    #[test]
    fn an_item_is_refused_with_the_code_of_a_call() {
        let refusal = || Refusal::NotFound { what: "network", id: "north".to_owned() };
        assert_eq!(proto::Refusal::from(refusal()).code, 5);
        assert_eq!(Status::from(refusal()).code(), Code::NotFound);
        let bad = proto::Refusal::from(Refusal::invalid("reward", "-1 must be at least 0"));
        assert_eq!((bad.code, bad.field_violations[0].field.as_str()), (3, "reward"));
        assert_eq!(bad.retry_after, None);
        let full = || Refusal::exhausted("limits.queue", "the writer has its hands full");
        let advice = Status::from(full()).get_details_retry_info().unwrap().retry_delay;
        assert_eq!(advice, Some(RETRY));
        let item = proto::Refusal::from(full()).retry_after.unwrap();
        assert_eq!(Duration::try_from(item), Ok(RETRY));
    }
}
