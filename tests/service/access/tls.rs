//! TLS on both ports, and clients with certificates.

use std::fs;
use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::sync::Arc;

use rcgen::{BasicConstraints, CertificateParams, CertifiedIssuer, IsCa, KeyPair};
use tempfile::TempDir;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::TcpStream;
use tokio_rustls::TlsConnector;
use tokio_rustls::rustls::crypto::ring;
use tokio_rustls::rustls::pki_types::pem::PemObject;
use tokio_rustls::rustls::pki_types::{CertificateDer, PrivateKeyDer};
use tokio_rustls::rustls::{ClientConfig, RootCertStore};

use crate::calls::soon;

type Authority = CertifiedIssuer<'static, KeyPair>;

fn authority() -> Authority {
    let mut params = CertificateParams::new(Vec::new()).unwrap();
    params.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
    CertifiedIssuer::self_signed(params, KeyPair::generate().unwrap()).unwrap()
}

/// A directory with certificates, and perhaps a service.
struct Tls {
    dir: TempDir,
    server: Option<(Child, String, String)>,
}

impl Tls {
    /// An authority for the service, one for its clients, and a certificate of each.
    fn new() -> Self {
        let tls = Self { dir: tempfile::tempdir().unwrap(), server: None };
        for (who, name) in [("server", "127.0.0.1"), ("client", "truck-1")] {
            let authority = authority();
            fs::write(tls.file(&format!("{who}-ca.pem")), authority.pem()).unwrap();
            let key = KeyPair::generate().unwrap();
            let params = CertificateParams::new([name.to_owned()]).unwrap();
            let certificate = params.signed_by(&key, &authority).unwrap();
            fs::write(tls.file(&format!("{who}.pem")), certificate.pem()).unwrap();
            fs::write(tls.file(&format!("{who}.key")), key.serialize_pem()).unwrap();
        }
        tls
    }

    fn file(&self, name: &str) -> PathBuf {
        self.dir.path().join(name)
    }

    fn command(&self, section: &str) -> Command {
        let config = self.file("voltour.toml");
        let store = self.file("voltour.db");
        let text = format!(
            "[grpc]\nlisten = \"127.0.0.1:0\"\n[rest]\nlisten = \"127.0.0.1:0\"\n\
             [store]\npath = {store:?}\n[tls]\n{section}"
        );
        fs::write(&config, text).unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_voltour"));
        command.args(["serve", "--config"]).arg(config).stdout(Stdio::piped());
        command
    }

    /// Starts a service; with `clients` only those with a certificate are let in.
    fn serve(&mut self, clients: bool) {
        let (certificate, key) = (self.file("server.pem"), self.file("server.key"));
        let mut section = format!("certificate_file = {certificate:?}\nkey_file = {key:?}\n");
        if clients {
            section += &format!("client_ca_file = {:?}\n", self.file("client-ca.pem"));
        }
        let mut child = self.command(&section).stderr(Stdio::null()).spawn().unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let at = |key: &str| line.split_whitespace().find_map(|word| word.strip_prefix(key));
        let (grpc, rest) = (at("grpc=https://"), at("rest=https://"));
        let (grpc, rest) = (grpc.expect(&line).to_owned(), rest.expect(&line).to_owned());
        self.server = Some((child, grpc, rest));
    }

    /// `voltour network list` with these files; its exit code and what it said.
    fn list(&self, files: &[(&str, &str)]) -> (Option<i32>, String) {
        let (_, grpc, _) = self.server.as_ref().unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_voltour"));
        command.args(["network", "list", "--server", &format!("https://{grpc}")]);
        for (option, name) in files {
            command.arg(option).arg(self.file(name));
        }
        let output = command.output().unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    }

    /// The REST edge's answer to `GET /readyz`, if it lets us in.
    async fn ready(&self, shows_certificate: bool) -> std::io::Result<String> {
        let mut roots = RootCertStore::empty();
        roots.add(CertificateDer::from_pem_file(self.file("server-ca.pem")).unwrap()).unwrap();
        let builder = ClientConfig::builder_with_provider(Arc::new(ring::default_provider()))
            .with_safe_default_protocol_versions()
            .unwrap()
            .with_root_certificates(roots);
        let config = if shows_certificate {
            let own = CertificateDer::from_pem_file(self.file("client.pem")).unwrap();
            let key = PrivateKeyDer::from_pem_file(self.file("client.key")).unwrap();
            builder.with_client_auth_cert(vec![own], key).unwrap()
        } else {
            builder.with_no_client_auth()
        };
        let (_, _, rest) = self.server.as_ref().unwrap();
        let stream = TcpStream::connect(rest).await?;
        let name = "127.0.0.1".try_into().unwrap();
        let mut stream = TlsConnector::from(Arc::new(config)).connect(name, stream).await?;
        let call = format!("GET /readyz HTTP/1.1\r\nHost: {rest}\r\nConnection: close\r\n\r\n");
        stream.write_all(call.as_bytes()).await?;
        let mut answer = String::new();
        stream.read_to_string(&mut answer).await?;
        Ok(answer)
    }
}

impl Drop for Tls {
    fn drop(&mut self) {
        if let Some((mut child, ..)) = self.server.take() {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

#[tokio::test]
async fn both_ports_speak_tls_and_nothing_else() {
    let mut tls = Tls::new();
    tls.serve(false);
    assert_eq!(tls.list(&[("--ca", "server-ca.pem")]), (Some(0), String::new()));
    let answer = soon("an answer", tls.ready(false)).await.unwrap();
    assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
    let (code, said) = tls.list(&[("--ca", "client-ca.pem")]);
    assert_eq!(code, Some(1), "the service is not who it should be: {said}");
    let (_, grpc, rest) = tls.server.as_ref().unwrap();
    let plain = reqwest::Client::new().get(format!("http://{rest}/readyz")).send().await;
    assert!(plain.is_err(), "{plain:?}");
    let plain = tonic::transport::Endpoint::from_shared(format!("http://{grpc}")).unwrap();
    let mut plain =
        voltour::proto::network_service_client::NetworkServiceClient::new(plain.connect_lazy());
    let call = plain.list(voltour::proto::ListNetworksRequest::default());
    assert!(soon("the end of the call", call).await.is_err());
    // A client that never shakes hands holds nobody up.
    let _idle = TcpStream::connect(rest).await.unwrap();
    assert!(soon("an answer", tls.ready(false)).await.is_ok());
}

#[tokio::test]
async fn with_an_authority_for_clients_only_its_clients_are_let_in() {
    let mut tls = Tls::new();
    tls.serve(true);
    let ca = ("--ca", "server-ca.pem");
    let own = [ca, ("--client-cert", "client.pem"), ("--client-key", "client.key")];
    assert_eq!(tls.list(&own), (Some(0), String::new()));
    assert_ne!(tls.list(&[ca]).0, Some(0), "without a certificate");
    let anothers = [ca, ("--client-cert", "server.pem"), ("--client-key", "server.key")];
    assert_ne!(tls.list(&anothers).0, Some(0), "with one of another authority");
    let answer = soon("an answer", tls.ready(true)).await.unwrap();
    assert!(answer.starts_with("HTTP/1.1 200"), "{answer}");
    let refused = soon("an end", tls.ready(false)).await;
    assert!(
        refused.as_ref().is_err() || refused.as_ref().is_ok_and(String::is_empty),
        "{refused:?}"
    );
}

#[tokio::test]
async fn files_that_are_no_good_are_refused_with_their_key() {
    let tls = Tls::new();
    fs::write(tls.file("empty.pem"), "nothing\n").unwrap();
    for (certificate, key, says) in [
        ("missing.pem", "server.key", "tls.certificate_file"),
        ("empty.pem", "server.key", "tls.certificate_file"),
        ("server.pem", "server.pem", "tls.key_file"),
        ("server.pem", "client.key", "tls.key_file"),
    ] {
        let (certificate, key) = (tls.file(certificate), tls.file(key));
        let section = format!("certificate_file = {certificate:?}\nkey_file = {key:?}\n");
        let output = tls.command(&section).stderr(Stdio::piped()).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{section}: {said}");
        assert!(said.contains(says), "{section}: {said}");
    }
}
