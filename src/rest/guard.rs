//! In front of every route: the name that the caller believes to speak to, the access table, and then
//! the caller's token.

use std::sync::Arc;

use axum::extract::{FromRequestParts, MatchedPath, Request, State};
use axum::http::header::{HOST, WWW_AUTHENTICATE};
use axum::http::request::Parts;
use axum::http::uri::Authority;
use axum::http::{HeaderValue, StatusCode};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use tokio::sync::{Semaphore, SemaphorePermit};

use super::problem::Problem;
use crate::access::table::{self, Who};
use crate::access::{Caller, Gate};
use crate::domain::Refusal;

/// What browsers and clients may send; the first is what a program should.
const CHALLENGES: [&str; 2] = ["Bearer realm=\"voltour\"", "Basic realm=\"voltour\""];

/// What monitors ask for.
const METRICS: &str = "/metrics";
/// Monitors at once.
const MONITORS: usize = 8;

/// Lets calls through, with their caller among their extensions.
#[derive(Clone, Debug)]
pub struct Guard {
    gate: Gate,
    /// None where any name will do.
    hosts: Option<Arc<[String]>>,
    /// For calls, but for those that anybody may make.
    room: Room,
    /// For monitors: what is measured of a service that is busy must not be missing.
    monitors: Room,
}

/// Room for so many calls.
#[derive(Clone, Debug)]
struct Room {
    places: Arc<Semaphore>,
    most: usize,
    name: &'static str,
}

impl Room {
    fn new(name: &'static str, most: usize) -> Self {
        Self { places: Arc::new(Semaphore::new(most)), most, name }
    }

    /// Room for one more call, until its answer begins.
    fn enter(&self) -> Result<SemaphorePermit<'_>, Problem> {
        self.places.try_acquire().map_err(|_| {
            let Self { name, most, .. } = self;
            let detail = format!("{name}: {most} calls are being answered, the most at once");
            Problem::new(StatusCode::TOO_MANY_REQUESTS).detail(detail)
        })
    }
}

impl Guard {
    /// In front of a listener. On loopback only names of this machine are answered to, and `hosts`: a page
    /// that a browser here has loaded from elsewhere may lead any other name to this address.
    /// At most `most` calls are answered at once.
    pub fn new(gate: Gate, is_loopback: bool, hosts: &[String], most: usize) -> Self {
        let lower = || hosts.iter().map(|host| host.to_ascii_lowercase()).collect();
        let (room, monitors) = (Room::new("limits.rest_calls", most), Room::new(METRICS, MONITORS));
        Self { gate, hosts: is_loopback.then(lower), room, monitors }
    }

    fn enter(&self, who: Who, route: &str) -> Result<Option<SemaphorePermit<'_>>, Problem> {
        match who {
            Who::Anybody => Ok(None),
            _ if route == METRICS => self.monitors.enter().map(Some),
            _ => self.room.enter().map(Some),
        }
    }

    fn host(&self, call: &Request) -> Result<(), Problem> {
        let Some(hosts) = &self.hosts else { return Ok(()) };
        let header = call.headers().get(HOST).and_then(|host| host.to_str().ok());
        let named = call.uri().authority().map(Authority::as_str).or(header).unwrap_or_default();
        let name = named.parse::<Authority>().map(|name| name.host().to_ascii_lowercase());
        if name.is_ok_and(|name| is_this_machine(&name) || hosts.contains(&name)) {
            return Ok(());
        }
        let named: String = named.chars().take(80).collect();
        let rule = "must be localhost, a loopback address or one of rest.hosts";
        let problem = Problem::new(StatusCode::MISDIRECTED_REQUEST);
        Err(problem.detail(format!("Host: {named:?} {rule}")))
    }
}

/// The guard's layer. It stands behind the router, which has found the route by then.
pub(super) async fn guard(
    State(guard): State<Guard>,
    mut call: Request,
    next: Next,
) -> Result<Response, Response> {
    guard.host(&call).map_err(Problem::into_response)?;
    let route = call.extensions().get::<MatchedPath>().map(MatchedPath::as_str);
    let route = route.and_then(|route| Some((route, table::rest(route)?)));
    let (route, who) = route.ok_or_else(|| Problem::new(StatusCode::NOT_FOUND).into_response())?;
    // First: a token that is not known costs a look into the database.
    let _room = guard.enter(who, route).map_err(Problem::into_response)?;
    if let Some(caller) = guard.gate.admit(who, call.headers()).await.map_err(refused)? {
        call.extensions_mut().insert(caller);
    }
    Ok(next.run(call).await)
}

fn is_this_machine(name: &str) -> bool {
    let address = name.trim_start_matches('[').trim_end_matches(']');
    name == "localhost" || address.parse().is_ok_and(|ip: std::net::IpAddr| ip.is_loopback())
}

fn refused(refusal: Refusal) -> Response {
    let status = match &refusal {
        Refusal::Unauthenticated(_) => StatusCode::UNAUTHORIZED,
        Refusal::PermissionDenied(_) => StatusCode::FORBIDDEN,
        Refusal::Unavailable(_) => StatusCode::SERVICE_UNAVAILABLE,
        other => return Problem::internal(other).into_response(),
    };
    let mut response = Problem::new(status).detail(refusal.to_string()).into_response();
    if status == StatusCode::UNAUTHORIZED {
        for challenge in CHALLENGES {
            response.headers_mut().append(WWW_AUTHENTICATE, HeaderValue::from_static(challenge));
        }
    }
    response
}

impl<S: Sync> FromRequestParts<S> for Caller {
    type Rejection = Response;

    async fn from_request_parts(parts: &mut Parts, _: &S) -> Result<Self, Response> {
        let caller = parts.extensions.get().cloned();
        let defect = || Problem::internal(&"a defect: a call came past the guard");
        caller.ok_or_else(|| defect().into_response())
    }
}
