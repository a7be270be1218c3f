//! A backup of a running service, and a service that begins with it.

use std::path::Path;
use std::process::{Command, Output};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use voltour::proto::GetRequestRequest;

use crate::app::{Settings, TestApp};
use crate::calls::{OPEN, sensors};
use crate::field::{line, request};
use crate::time::until;

fn voltour(command: &str, file: &Path, database: &Path, more: &[&str]) -> Output {
    let mut run = Command::new(env!("CARGO_BIN_EXE_voltour"));
    run.arg(command).arg(file).arg("--database").arg(database).args(more);
    run.output().unwrap()
}

fn said(output: &Output) -> (Option<i32>, String) {
    let text = [&output.stdout[..], &output.stderr[..]].concat();
    (output.status.code(), String::from_utf8(text).unwrap())
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_backup_made_while_requests_stream_in_starts_another_service() {
    let mut app = TestApp::start().await;
    app.put(line(40)).await;
    let tour = app.drive("A").await;
    let over = Arc::new(AtomicBool::new(false));
    let acknowledged = Arc::new(std::sync::Mutex::new(Vec::new()));
    let streaming = tokio::spawn({
        let (over, acknowledged, requests) = (over.clone(), acknowledged.clone(), app.requests());
        async move {
            let mut sensor = 0;
            while !over.load(Ordering::Relaxed) {
                sensor = sensor % 40 + 1;
                let asked = request(&format!("s{sensor}"));
                let stored = requests.clone().submit(asked).await.expect("Submit").into_inner();
                acknowledged.lock().unwrap().push(stored);
            }
        }
    });
    let stored = || acknowledged.lock().unwrap().clone();
    until("requests stream in", async || (stored().len() > 50).then_some(())).await;
    let (before, file) = (stored(), app.file("backup.db"));
    let (code, text) = said(&voltour("backup", &file, &app.database(), &[]));
    assert_eq!(code, Some(0), "{text}");
    assert!(text.contains("requests, 1 plans; checked"), "{text}");
    let meanwhile = stored().len();
    until("they go on", async || (stored().len() > meanwhile).then_some(())).await;
    over.store(true, Ordering::Relaxed);
    streaming.await.unwrap();
    let last = stored().pop().unwrap();

    // A service in a new place.
    app.kill9();
    let other = TestApp::over(Settings::default(), |database| {
        let (code, text) = said(&voltour("restore", &file, database, &[]));
        assert_eq!(code, Some(0), "{text}");
    });
    let app = other.await;
    for request in &before {
        let found = app.request(&request.id).await;
        assert_eq!((&found.id, &found.submitted), (&request.id, &request.submitted));
    }
    let gone = app.requests().get(GetRequestRequest { request_id: last.id }).await;
    assert_eq!(gone.unwrap_err().code(), tonic::Code::NotFound, "it came after the backup");
    assert_eq!(app.tour_state(&tour.id).await, "out");
    app.complete(&tour).await;
    // A call that is repeated is stored again, and the service plans on.
    let again = app.submit(last.submitted.unwrap()).await;
    assert_eq!(again.state, OPEN);
    assert_eq!(sensors(&app.drive("B").await).len(), 40);
}

#[tokio::test]
async fn what_cannot_be_backed_up_or_restored_is_said_and_nothing_is_touched() {
    let mut app = TestApp::start().await;
    app.put(line(2)).await;
    app.ask("s1").await;
    let (db, file) = (app.database(), app.file("backup.db"));
    let refused = |output: Output, expected: i32, says: &str| {
        let (code, text) = said(&output);
        assert_eq!((code, text.contains(says)), (Some(expected), true), "{text}");
        assert!(output.stdout.is_empty() && text.lines().count() == 1, "{text}");
    };
    refused(voltour("backup", &file, &app.file("none.db"), &[]), 2, "there is no database");
    refused(voltour("backup", &app.file("no/folder"), &db, &[]), 1, "No such file or directory");
    refused(voltour("backup", &db, &db, &["--force"]), 2, "is the database itself");
    assert_eq!(said(&voltour("backup", &file, &db, &[])).0, Some(0));
    refused(voltour("backup", &file, &db, &[]), 2, "is there already; --force replaces it");
    app.ask("s2").await;
    assert_eq!(said(&voltour("backup", &file, &db, &["--force"])).0, Some(0));
    refused(voltour("restore", &file, &db, &["--force"]), 1, "is in use by another process");
    app.sigterm().await;
    refused(voltour("restore", &file, &db, &[]), 2, "is there already");

    let whole = std::fs::read(&file).unwrap();
    let mut damaged = whole.clone();
    damaged[3 * 4096..][..200].fill(0x5a);
    std::fs::write(&file, damaged).unwrap();
    refused(voltour("restore", &file, &db, &["--force"]), 2, "is damaged: ");
    std::fs::write(&file, "something else").unwrap();
    refused(voltour("restore", &file, &db, &["--force"]), 2, "file is not a database");
    std::fs::write(&file, whole).unwrap();
    app.launch().await;
    app.sigterm().await;
    let (code, text) = said(&voltour("restore", &file, &db, &["--force"]));
    assert_eq!((code, text.contains("is kept as")), (Some(0), true), "{text}");
    let left = std::fs::read_dir(db.parent().unwrap()).unwrap();
    let left = left.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    assert!(!left.into_iter().any(|name| name.ends_with(".part")), "nothing half is left");
}
