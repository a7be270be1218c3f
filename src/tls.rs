//! TLS for both ports: certificates are read once, when the service starts.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use tokio_rustls::TlsAcceptor;
use tokio_rustls::rustls::crypto::ring;
use tokio_rustls::rustls::pki_types::pem::PemObject;
use tokio_rustls::rustls::pki_types::{CertificateDer, PrivateKeyDer};
use tokio_rustls::rustls::server::WebPkiClientVerifier;
use tokio_rustls::rustls::{RootCertStore, ServerConfig};

use crate::config;

/// Why there can be no TLS: a key of the configuration, its value, and what is wrong with it.
#[derive(Debug, thiserror::Error)]
#[error("{key}: {}: {reason}", path.display())]
pub struct TlsError {
    key: &'static str,
    path: PathBuf,
    reason: String,
}

/// Certificate and key, and whose clients are let in.
#[derive(Clone, Debug)]
pub struct Tls {
    config: ServerConfig,
}

impl Tls {
    /// Reads the files; none where none are configured.
    ///
    /// # Errors
    /// A file cannot be read or holds nothing of its kind, or the key is not the certificate's.
    pub fn open(files: &config::Tls) -> Result<Option<Self>, TlsError> {
        let (Some(certificate), Some(key)) = (&files.certificate_file, &files.key_file) else {
            return Ok(None);
        };
        let chain = certificates("tls.certificate_file", certificate)?;
        let private = PrivateKeyDer::from_pem_file(key);
        let private = private.map_err(|error| failed("tls.key_file", key, error))?;
        let provider = Arc::new(ring::default_provider());
        let builder = ServerConfig::builder_with_provider(provider.clone())
            .with_safe_default_protocol_versions()
            .map_err(|error| failed("tls.certificate_file", certificate, error))?;
        let builder = match &files.client_ca_file {
            None => builder.with_no_client_auth(),
            Some(path) => {
                let wrong =
                    |error: &dyn std::fmt::Display| failed("tls.client_ca_file", path, error);
                let mut roots = RootCertStore::empty();
                for root in certificates("tls.client_ca_file", path)? {
                    roots.add(root).map_err(|error| wrong(&error))?;
                }
                let verifier = WebPkiClientVerifier::builder_with_provider(roots.into(), provider);
                builder.with_client_cert_verifier(verifier.build().map_err(|error| wrong(&error))?)
            }
        };
        let config = builder.with_single_cert(chain, private);
        Ok(Some(Self { config: config.map_err(|error| failed("tls.key_file", key, error))? }))
    }

    /// For a port that speaks this protocol (its ALPN name), and nothing else.
    pub fn acceptor(&self, protocol: &str) -> TlsAcceptor {
        let mut config = self.config.clone();
        config.alpn_protocols = vec![protocol.as_bytes().to_vec()];
        TlsAcceptor::from(Arc::new(config))
    }
}

fn certificates(key: &'static str, path: &Path) -> Result<Vec<CertificateDer<'static>>, TlsError> {
    let read = CertificateDer::pem_file_iter(path).and_then(Iterator::collect::<Result<Vec<_>, _>>);
    let read = read.map_err(|error| failed(key, path, error))?;
    if read.is_empty() {
        return Err(failed(key, path, "holds no certificate in PEM"));
    }
    Ok(read)
}

fn failed(key: &'static str, path: &Path, reason: impl std::fmt::Display) -> TlsError {
    TlsError { key, path: path.to_owned(), reason: reason.to_string() }
}
