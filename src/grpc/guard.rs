//! In front of every method: the access table, and then the caller's token.

use std::pin::Pin;

use axum::http::{Extensions, Request, Response};
use futures_util::stream::{self, Stream, StreamExt};
use tonic::Status;
use tonic::body::Body;
use tower_http::auth::AsyncAuthorizeRequest;

use crate::access::{Caller, Gate, table};
use crate::domain::Refusal;

/// Lets calls through, with their caller among their extensions.
#[derive(Clone, Debug)]
pub(super) struct Guard(pub Gate);

impl<B: Send + 'static> AsyncAuthorizeRequest<B> for Guard {
    type RequestBody = B;
    type ResponseBody = Body;
    type Future =
        Pin<Box<dyn Future<Output = Result<Request<B>, Response<Body>>> + Send + 'static>>;

    fn authorize(&mut self, mut call: Request<B>) -> Self::Future {
        let Self(gate) = self.clone();
        Box::pin(async move {
            let path = call.uri().path();
            let who = table::grpc(path).ok_or_else(|| {
                let path: String = path.chars().take(200).collect();
                Status::unimplemented(format!("there is no method {path:?}")).into_http()
            })?;
            match gate.admit(who, call.headers()).await {
                Ok(None) => {}
                Ok(Some(caller)) => drop(call.extensions_mut().insert(caller)),
                Err(refusal) => return Err(Status::from(refusal).into_http()),
            }
            Ok(call)
        })
    }
}

/// Whom a call comes from.
///
/// # Errors
/// A defect: nobody asked.
pub(super) fn caller(extensions: &Extensions) -> Result<Caller, Refusal> {
    let caller = extensions.get().cloned();
    caller.ok_or_else(|| Refusal::Internal("a defect: a call came past the guard".to_owned()))
}

/// What a call gets whose caller is not let in any more while it waits.
pub(super) fn revoked() -> Refusal {
    Refusal::Unauthenticated("the token was revoked, or one is needed by now".to_owned())
}

/// The stream for as long as its caller is let in; then the refusal that the next call would get.
pub(super) fn guarded<T: Send + 'static>(
    gate: &Gate,
    caller: &Caller,
    messages: impl Stream<Item = Result<T, Status>> + Send + 'static,
) -> Pin<Box<dyn Stream<Item = Result<T, Status>> + Send>> {
    let parts = (Box::pin(messages), Box::pin(gate.revoked(caller)));
    Box::pin(stream::unfold(Some(parts), |parts| async move {
        let (mut messages, mut revoked) = parts?;
        let message = tokio::select! {
            biased;
            () = &mut revoked => Err(self::revoked().into()),
            message = messages.next() => message?,
        };
        let rest = message.is_ok().then_some((messages, revoked));
        Some((message, rest))
    }))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use prost::Message;
    use prost_types::FileDescriptorSet;

    use super::table;
    use crate::proto::DESCRIPTORS;

    #[test]
    fn every_method_has_an_entry_in_the_access_table_and_every_entry_a_method() {
        let mut methods = BTreeSet::new();
        for served in [
            DESCRIPTORS,
            tonic_health::pb::FILE_DESCRIPTOR_SET,
            tonic_reflection::pb::v1::FILE_DESCRIPTOR_SET,
            tonic_reflection::pb::v1alpha::FILE_DESCRIPTOR_SET,
        ] {
            for file in FileDescriptorSet::decode(served).unwrap().file {
                for service in &file.service {
                    let path = format!("/{}.{}", file.package(), service.name());
                    let paths = service.method.iter().map(|m| format!("{path}/{}", m.name()));
                    methods.extend(paths);
                }
            }
        }
        let entries: BTreeSet<String> =
            table::GRPC.iter().map(|(path, _)| (*path).into()).collect();
        assert_eq!(entries, methods);
        assert_eq!(entries.len(), table::GRPC.len(), "an entry is there twice");
    }
}
