//! A command on its way through the writer, and who waits for its answer.

use std::future::Future;
use std::pin::Pin;

use tokio::sync::oneshot;
use tracing::{Instrument, Span};

use super::Writing;
use crate::domain::Refusal;
use crate::metrics::Entered;
use crate::store::StoreError;

/// Why a command was not applied.
#[derive(Debug)]
pub(crate) enum Failure {
    /// It may not be; decided before it wrote anything.
    Refused(Refusal),
    /// The database failed; the transaction must be rolled back.
    Broken(StoreError),
}

impl From<Refusal> for Failure {
    fn from(refusal: Refusal) -> Self {
        Self::Refused(refusal)
    }
}

impl From<StoreError> for Failure {
    fn from(error: StoreError) -> Self {
        Self::Broken(error)
    }
}

impl From<sqlx::Error> for Failure {
    fn from(error: sqlx::Error) -> Self {
        Self::Broken(error.into())
    }
}

/// Something that changes the database. A refusal must be decided before anything is written: the
/// transaction goes on without the command.
pub(crate) trait Command: Send + Sync + 'static {
    /// What its caller gets.
    type Answer: Send + 'static;

    /// Applies it within the transaction; perhaps more than once, if that was rolled back.
    fn apply(
        &self,
        writing: &mut Writing,
    ) -> impl Future<Output = Result<Self::Answer, Failure>> + Send;
}

/// A command of any kind.
pub(super) trait Job: Send {
    /// Applies the command and keeps the answer.
    fn run<'a>(
        &'a mut self,
        writing: &'a mut Writing,
    ) -> Pin<Box<dyn Future<Output = Result<(), StoreError>> + Send + 'a>>;

    /// Gives the answer kept.
    fn answer(self: Box<Self>);

    /// Answers with a refusal, whatever was kept.
    fn refuse(self: Box<Self>, refusal: Refusal);
}

pub(super) struct Asked<C: Command> {
    command: C,
    kept: Option<Result<C::Answer, Refusal>>,
    caller: oneshot::Sender<Result<C::Answer, Refusal>>,
    /// In the span of its caller, from now until it is answered.
    span: Span,
    /// Counted as on its way until it is answered.
    _counted: Entered,
}

impl<C: Command> Asked<C> {
    pub fn new(
        command: C,
        counted: Entered,
    ) -> (Self, oneshot::Receiver<Result<C::Answer, Refusal>>) {
        let (caller, answer) = oneshot::channel();
        let span = tracing::debug_span!("command", otel.name = name::<C>());
        (Self { command, kept: None, caller, span, _counted: counted }, answer)
    }
}

/// What a command is called, without its module.
fn name<C>() -> &'static str {
    let path = std::any::type_name::<C>();
    path.rsplit("::").next().unwrap_or(path)
}

impl<C: Command> Job for Asked<C> {
    fn run<'a>(
        &'a mut self,
        writing: &'a mut Writing,
    ) -> Pin<Box<dyn Future<Output = Result<(), StoreError>> + Send + 'a>> {
        // Nobody waits for it any more: the call was given up, or its time is over.
        if self.caller.is_closed() {
            return Box::pin(std::future::ready(Ok(())));
        }
        // Its own span is its caller's; the transaction is that of many.
        self.span.follows_from(Span::current());
        let span = tracing::debug_span!(parent: &self.span, "apply");
        let applied = async move {
            self.kept = Some(match self.command.apply(writing).await {
                Ok(answer) => Ok(answer),
                Err(Failure::Refused(refusal)) => Err(refusal),
                Err(Failure::Broken(error)) => return Err(error),
            });
            Ok(())
        };
        Box::pin(applied.instrument(span))
    }

    // A caller that has gone away does not want the answer.
    fn answer(self: Box<Self>) {
        if let Some(kept) = self.kept {
            let _ = self.caller.send(kept);
        }
    }

    fn refuse(self: Box<Self>, refusal: Refusal) {
        let _ = self.caller.send(Err(refusal));
    }
}
