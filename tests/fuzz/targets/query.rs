//! The address of a REST call, with its query: answered, or refused with a problem document.

use std::str::from_utf8;

use reqwest::header::CONTENT_TYPE;

use super::service::Service;

pub fn query(data: &[u8]) -> bool {
    let Ok(path) = from_utf8(data) else { return false };
    if !path.starts_with('/') || path.starts_with("//") {
        return false;
    }
    let running = Service::running();
    let Ok(address) = format!("{}{path}", running.rest).parse::<reqwest::Url>() else {
        return false;
    };
    running.wait(async {
        let answer = running.client.get(address).send().await.expect("an answer");
        let status = answer.status();
        assert!(!status.is_server_error(), "{path:?}: {status}");
        let kind = answer.headers().get(CONTENT_TYPE).map(|kind| kind.as_bytes().to_vec());
        answer.bytes().await.expect("the whole answer");
        if status.is_client_error() {
            let is_problem = kind.as_deref() == Some(b"application/problem+json");
            assert!(is_problem, "{path:?}: {status} with {kind:?}");
        }
        status.is_success()
    })
}
