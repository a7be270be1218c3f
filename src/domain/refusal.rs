//! Why a call was refused: the one error of the service's inside. The edges map it, once each, to a
//! gRPC status or an HTTP problem.

/// A field that breaks a rule.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FieldViolation {
    /// Path of the field as the contract names it, such as `spec.sensors[3].battery_j`.
    pub field: String,
    /// The value and the rule that it breaks.
    pub description: String,
}

/// Why a call was refused. Nothing of a refused call is stored.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Refusal {
    /// Fields break rules.
    #[error("{}", invalid(.0))]
    Invalid(Vec<FieldViolation>),
    /// There is no such thing.
    #[error("there is no {what} {id:?}")]
    NotFound {
        /// Such as `network`.
        what: &'static str,
        /// As the caller named it.
        id: String,
    },
    /// The client id was used with other content before.
    #[error("client_id {client_id:?} was used before with other content")]
    AlreadyExists {
        /// The client's id.
        client_id: String,
    },
    /// The caller did not say who it is, or nobody is known by that.
    #[error("{0}")]
    Unauthenticated(String),
    /// The caller is known, and may not.
    #[error("{0}")]
    PermissionDenied(String),
    /// The thing's state does not allow it.
    #[error("{0}")]
    FailedPrecondition(String),
    /// The version is not the expected one.
    #[error("{0}")]
    Aborted(String),
    /// The caller's deadline, or the service's own longest wait, is over.
    #[error("{0}")]
    DeadlineExceeded(String),
    /// A limit is reached; nothing was stored, try again later.
    #[error("{reason}")]
    ResourceExhausted {
        /// The limit, as the configuration names it if it does: `limits.streams`.
        limit: &'static str,
        /// What there is too much of.
        reason: String,
    },
    /// The database cannot be written now; perhaps nothing was stored, try again under the same id.
    #[error("{0}")]
    Unavailable(String),
    /// A defect of the service.
    #[error("{0}")]
    Internal(String),
}

impl Refusal {
    /// A limit is reached.
    pub fn exhausted(limit: &'static str, reason: impl Into<String>) -> Self {
        Self::ResourceExhausted { limit, reason: reason.into() }
    }

    /// One field that breaks a rule.
    pub fn invalid(field: impl Into<String>, description: impl Into<String>) -> Self {
        Self::Invalid(vec![FieldViolation { field: field.into(), description: description.into() }])
    }
}

fn invalid(violations: &[FieldViolation]) -> String {
    let one = |v: &FieldViolation| format!("{}: {}", v.field, v.description);
    violations.iter().map(one).collect::<Vec<_>>().join("; ")
}
