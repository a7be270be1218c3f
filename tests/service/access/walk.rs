//! Every method and every route, from the one table, for every kind of caller.

use tonic::{Code, Status};
use voltour::access::table::{GRPC, REST, Who};
use voltour::domain::Role;

use super::example::World;
use super::{closed, get, raw, token};
use crate::app::TestApp;

const OTHER: &str = "voltour_AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA";

async fn call(
    app: &TestApp,
    world: &World,
    method: &str,
    token: Option<&str>,
) -> Result<Option<Vec<u8>>, Status> {
    raw::call(app.channel(), method, token, world.message(method)).await
}

/// What a caller gets of a method, in one text.
async fn said(app: &TestApp, world: &World, method: &str, token: &str) -> String {
    match call(app, world, method, Some(token)).await {
        Ok(message) => String::from_utf8_lossy(&message.unwrap_or_default()).into_owned(),
        Err(status) => format!("{:?} {}", status.code(), status.message()),
    }
}

/// What a caller gets of a route, in one text.
async fn shown(app: &TestApp, path: &str, token: &str) -> String {
    let answer = get(app, path, Some(token)).await;
    let (status, tag) = (answer.status(), answer.headers().get("etag").cloned());
    format!("{status} {tag:?} {}", answer.text().await.unwrap())
}

fn is_for(who: Who, role: Role) -> bool {
    match who {
        Who::Anybody | Who::Holders => true,
        Who::Roles(roles) | Who::Everywhere(roles) => roles.contains(&role),
    }
}

/// A token of a role in this network; a charger's is truck-A's.
fn of(app: &TestApp, role: Role, network: &str) -> String {
    let charger = if role == Role::Charger { " --charger truck-A" } else { "" };
    token(app, &format!("--role {role} --network {network}{charger}"))
}

#[tokio::test]
async fn whoever_has_no_good_token_gets_nothing() {
    let app = TestApp::start().await;
    let world = World::new(&app).await;
    let revoked = token(&app, "--role admin --all-networks");
    closed(&app).await;
    let listed = super::command(&app, &["list"]);
    let name = String::from_utf8(listed.stdout).unwrap();
    let name = name.split(' ').next().unwrap();
    assert_eq!(super::command(&app, &["revoke", name]).status.code(), Some(0));
    crate::time::until("the token is refused", || async {
        (get(&app, "/v1/plans", Some(&revoked)).await.status() == 401).then_some(())
    })
    .await;
    for bad in [None, Some(OTHER), Some(revoked.as_str()), Some("no token at all")] {
        for (method, who) in GRPC {
            let answer = call(&app, &world, method, bad).await;
            match who {
                Who::Anybody => assert!(answer.is_ok(), "{method}: {answer:?}"),
                _ => assert_eq!(
                    answer.unwrap_err().code(),
                    Code::Unauthenticated,
                    "{method} {bad:?}"
                ),
            }
        }
        for (route, who) in REST {
            for path in world.paths(route) {
                let answer = get(&app, &path, bad).await;
                let expected = if *who == Who::Anybody { 200 } else { 401 };
                assert_eq!(answer.status(), expected, "{path} {bad:?}");
                if expected == 401 {
                    assert_eq!(answer.headers()["www-authenticate"], "Bearer realm=\"voltour\"");
                    assert_eq!(answer.headers()["content-type"], "application/problem+json");
                    assert!(!world.is_in(answer.text().await.unwrap().as_bytes()), "{path}");
                }
            }
        }
    }
    let open: Vec<_> = GRPC.iter().chain(REST).filter(|(_, who)| *who == Who::Anybody).collect();
    let open: Vec<_> = open.into_iter().map(|(name, _)| *name).collect();
    let health = ["/grpc.health.v1.Health/Check", "/grpc.health.v1.Health/Watch"];
    assert_eq!(open, [&health[..], &["/healthz", "/readyz"]].concat(), "nothing else is open");
}

#[tokio::test]
async fn each_role_may_call_what_is_its_and_nothing_else() {
    let app = TestApp::start().await;
    let world = World::new(&app).await;
    for role in Role::ALL {
        let token = of(&app, role, &world.network);
        closed(&app).await;
        for (method, who) in GRPC {
            let code = call(&app, &world, method, Some(&token)).await.err().map(|s| s.code());
            if is_for(*who, role) {
                let refused = [Code::Unauthenticated, Code::PermissionDenied, Code::Unimplemented];
                let refused = code.is_some_and(|code| refused.contains(&code));
                assert!(!refused, "{method} as {role}: {code:?}");
            } else {
                assert_eq!(code, Some(Code::PermissionDenied), "{method} as {role}");
            }
        }
        for (route, who) in REST {
            for path in world.paths(route) {
                let answer = get(&app, &path, Some(&token)).await;
                // Each of these tokens is for one network.
                let passes = is_for(*who, role) && !matches!(who, Who::Everywhere(_));
                let expected = if passes { 200 } else { 403 };
                assert_eq!(answer.status(), expected, "{path} as {role}");
            }
        }
    }
    let everywhere = token(&app, "--role operator --all-networks");
    assert_eq!(get(&app, "/metrics", Some(&everywhere)).await.status(), 200);
}

#[tokio::test]
async fn for_a_token_of_another_network_there_is_nothing_of_this_one() {
    let app = TestApp::start().await;
    let (world, phantom) = (World::new(&app).await, World::phantom());
    for role in Role::ALL {
        let token = of(&app, role, "elsewhere");
        closed(&app).await;
        for (method, who) in GRPC {
            if !is_for(*who, role) {
                continue;
            }
            let real = said(&app, &world, method, &token).await;
            let ghost = World { charger: world.charger.clone(), ..phantom.clone() };
            let missing = said(&app, &ghost, method, &token).await;
            assert_eq!(world.told_of(&ghost, &real), missing, "{method} as {role}");
            assert!(!is_leaked(&world, &missing), "{method} as {role}: {missing}");
            let admitted = matches!(who, Who::Anybody | Who::Holders) || method.ends_with("/List");
            let refused =
                missing.starts_with("NotFound") || missing.starts_with("PermissionDenied");
            let item = method.ends_with("/SubmitStream") && missing.contains("there is no network");
            assert!(admitted || refused || item, "{method} as {role}: {missing}");
        }
        for (route, who) in REST.iter().filter(|(_, who)| is_for(*who, role)) {
            for (path, ghost) in world.paths(route).iter().zip(phantom.paths(route)) {
                let real = shown(&app, path, &token).await;
                let missing = shown(&app, &ghost, &token).await;
                // What is for all holders tells of no network, and may say the words that are ids here.
                let holders = *who == Who::Holders;
                let told = if holders { real } else { world.told_of(&phantom, &real) };
                assert_eq!(told, missing, "{path} as {role}");
                assert!(holders || !world.is_in(missing.as_bytes()), "{path} as {role}: {missing}");
                if route.contains("{id}") {
                    assert!(missing.starts_with("404"), "{path} {who:?} as {role}: {missing}");
                }
            }
        }
    }
    // And nothing was changed in its name.
    let admin = token(&app, "--role admin --all-networks");
    let read = shown(&app, &format!("/v1/networks/{}", world.network), &admin).await;
    assert!(read.contains("\"version\":1"), "{read}");
    let read = shown(&app, &format!("/v1/departures/{}", world.departure), &admin).await;
    assert!(read.contains("\"planned\""), "{read}");
    let read = shown(&app, "/v1/requests", &admin).await;
    assert_eq!(read.matches("\"sensor_id\"").count(), 2, "{read}");
}

/// Whether anything is told but the charger, whom the caller has named itself.
fn is_leaked(world: &World, text: &str) -> bool {
    World { charger: world.plan.clone(), ..world.clone() }.is_in(text.as_bytes())
}

#[tokio::test]
async fn a_charger_has_nothing_to_do_with_anothers_tours() {
    let app = TestApp::start().await;
    let world = World::new(&app).await;
    let other = token(&app, "--role charger --network field --charger truck-B");
    let own = of(&app, Role::Charger, &world.network);
    closed(&app).await;
    for (method, who) in GRPC {
        if !is_for(*who, Role::Charger) || matches!(who, Who::Anybody | Who::Holders) {
            continue;
        }
        let said = said(&app, &world, method, &other).await;
        if method.ends_with("/List") || method.ends_with("/Watch") {
            assert!(!world.is_in(said.as_bytes()), "{method}: {said}");
        } else {
            assert!(said.starts_with("PermissionDenied"), "{method}: {said}");
        }
    }
    let read = shown(&app, &format!("/v1/departures/{}", world.departure), &own).await;
    assert!(read.starts_with("403"), "history is the operators': {read}");
    for method in ["DepartureService/List", "TourService/Watch", "TourService/GetNext"] {
        let said = said(&app, &world, &format!("/voltour.v1.{method}"), &own).await;
        assert!(said.contains(&world.departure), "{method}: {said}");
    }
    let done = call(&app, &world, "/voltour.v1.TourService/ReportVisit", Some(&own)).await;
    assert!(done.is_ok(), "{done:?}");
    let done = call(&app, &world, "/voltour.v1.TourService/Complete", Some(&own)).await;
    assert!(done.is_ok(), "{done:?}");
}
