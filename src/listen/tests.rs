use std::io;
use std::time::Duration;

use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};
use tokio_util::sync::CancellationToken;

use super::Counted;
use crate::metrics::Level;

#[tokio::test]
async fn who_does_not_take_what_is_sent_loses_the_connection_and_its_place() {
    let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
    let address = listener.local_addr().unwrap();
    let (patience, open) = (Duration::from_millis(200), Level::default());
    let mut counted = Counted::new(listener, 1, patience, open.clone(), None);
    let client = TcpStream::connect(address).await.unwrap();
    let (mut connection, _) = counted.next().await;
    assert_eq!(open.count(), 1);
    let endless = async { while connection.write_all(&[0; 65_536]).await.is_ok() {} };
    tokio::time::timeout(Duration::from_secs(30), endless).await.expect("an end");
    let refused = connection.write_all(&[0; 65_536]).await.unwrap_err();
    assert_eq!(refused.kind(), io::ErrorKind::TimedOut);
    drop(connection);
    assert_eq!(open.count(), 0);
    drop(client);
}

#[tokio::test]
async fn who_does_not_begin_as_http2_does_loses_the_connection_and_a_stop_does_not_wait_for_it() {
    const PREFACE: &[u8] = b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";
    let hour = Duration::from_secs(3_600);
    for (patience, stops) in [(Duration::from_millis(200), false), (hour, true)] {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = listener.local_addr().unwrap();
        let (open, stop) = (Level::default(), CancellationToken::new());
        let mut counted =
            Counted::new(listener, 2, patience, open, None).with_preface(stop.clone());
        let mut slow = TcpStream::connect(address).await.unwrap();
        let (mut of_slow, _) = counted.next().await;
        let mut good = TcpStream::connect(address).await.unwrap();
        let (mut of_good, _) = counted.next().await;
        slow.write_all(&PREFACE[..23]).await.unwrap();
        good.write_all(PREFACE).await.unwrap();
        of_good.read_exact(&mut [0; 24]).await.unwrap();
        if stops {
            stop.cancel();
        }
        let mut said = Vec::new();
        let read = of_slow.read_to_end(&mut said);
        let read = tokio::time::timeout(Duration::from_secs(30), read).await.expect("an end");
        let timed_out = read.as_ref().is_err_and(|error| error.kind() == io::ErrorKind::TimedOut);
        assert_eq!((said.len(), timed_out), (23, !stops), "{read:?}");
        // Whoever has begun as one should may be silent.
        tokio::time::sleep(Duration::from_millis(300)).await;
        good.write_all(b"x").await.unwrap();
        assert_eq!(of_good.read(&mut [0; 8]).await.unwrap(), 1);
    }
}
