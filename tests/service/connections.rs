//! Connections: so many and no more, none for those who are slow to ask, and an end that waits for nobody.

use std::io::{Read, Write};
use std::net::TcpStream;

use crate::app::{PATIENCE, TestApp};
use crate::calls::{MOMENT, OPEN};
use crate::field::line;
use crate::limits::limited;

/// What a client of HTTP/2 begins with, and its settings.
const PREFACE: &[u8] = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n\0\0\0\x04\0\0\0\0\0";

/// A connection to the REST edge on which nothing was said yet.
fn connect(app: &TestApp) -> TcpStream {
    connect_to(&app.rest)
}

fn connect_to(edge: &str) -> TcpStream {
    let stream = TcpStream::connect(edge.trim_start_matches("http://")).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    stream
}

#[tokio::test]
async fn who_is_slow_to_ask_loses_the_connection() {
    let app = TestApp::with(limited("slow_client = \"1s\"\nconnections = 1")).await;
    for said in ["", "GET /healthz HTTP/1.1\r\nHost: local"] {
        let mut slow = connect(&app);
        slow.write_all(said.as_bytes()).unwrap();
        let mut answer = Vec::new();
        // The end of the connection, and perhaps a refusal before.
        slow.read_to_end(&mut answer).expect("it is closed");
        assert!(!answer.starts_with(b"HTTP/1.1 200"), "{said}");
    }
    assert_eq!(app.get("/healthz").await.status(), 200);
}

#[tokio::test]
async fn who_does_not_begin_to_speak_to_grpc_loses_the_connection() {
    let app = TestApp::with(limited("slow_client = \"1s\"")).await;
    for said in [&b""[..], &PREFACE[..23]] {
        let mut slow = connect_to(&app.grpc);
        slow.write_all(said).unwrap();
        // What the service says first is its settings.
        slow.read_to_end(&mut Vec::new()).expect("it is closed");
    }
    // The client that has spoken is silent for as long as it likes.
    app.put(line(1)).await;
}

#[tokio::test]
async fn the_end_waits_for_nobody_who_is_slow_to_ask() {
    let mut app = TestApp::start().await;
    app.put(line(1)).await;
    let said = [
        (&app.grpc, &b""[..]),
        (&app.grpc, &PREFACE[..23]),
        // It never answers when it is told to go.
        (&app.grpc, PREFACE),
        (&app.rest, b"GET /healthz HTTP/1.1\r\nHost: local"),
    ];
    let slow: Vec<_> = said
        .into_iter()
        .map(|(edge, said)| {
            let mut slow = connect_to(edge);
            slow.write_all(said).unwrap();
            slow
        })
        .collect();
    // Accepted after them, and answered.
    assert_eq!(app.get("/healthz").await.status(), 200);
    assert_eq!(app.ask("s1").await.state, OPEN);
    assert_eq!(app.sigterm().await.code(), Some(0));
    drop(slow);
}

#[tokio::test]
async fn a_head_that_is_too_long_is_refused() {
    let app = TestApp::start().await;
    let mut long = connect(&app);
    let head =
        format!("GET /healthz HTTP/1.1\r\nHost: localhost\r\nX: {}\r\n\r\n", "x".repeat(100_000));
    // The service may have closed it before all is written.
    let _ = long.write_all(head.as_bytes());
    let mut answer = [0; 12];
    let refused = long.read_exact(&mut answer).is_err() || &answer == b"HTTP/1.1 431";
    assert!(refused, "{}", String::from_utf8_lossy(&answer));
}

#[tokio::test]
async fn connections_beyond_the_limit_wait_until_one_ends() {
    let app = TestApp::with(limited("connections = 1")).await;
    let ask = b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n";
    let mut answer = [0; 15];
    let mut first = connect(&app);
    first.write_all(ask).unwrap();
    first.read_exact(&mut answer).unwrap();
    assert_eq!(&answer, b"HTTP/1.1 200 OK");
    let mut second = connect(&app);
    second.write_all(ask).unwrap();
    second.set_read_timeout(Some(MOMENT)).unwrap();
    assert!(second.read_exact(&mut answer).is_err(), "the first is still open");
    drop(first);
    second.set_read_timeout(Some(PATIENCE)).unwrap();
    second.read_exact(&mut answer).unwrap();
    assert_eq!(&answer, b"HTTP/1.1 200 OK");
}
