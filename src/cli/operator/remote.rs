//! Where the service is, how it is trusted, and who calls.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Duration;

use tonic::metadata::{Ascii, MetadataValue};
use tonic::service::Interceptor;
use tonic::service::interceptor::InterceptedService;
use tonic::transport::{Certificate, Channel, ClientTlsConfig, Endpoint, Identity};
use tonic::{Request, Status};

use crate::access::Secret;
use crate::cli::{Failure, input};

/// Where a service listens if nobody has configured anything.
const DEFAULT: &str = "http://127.0.0.1:7440";
/// For a connection, its handshake included.
const TIMEOUT: Duration = Duration::from_secs(5);

/// A connection to the service, in the caller's name.
pub type Service = InterceptedService<Channel, Bearer>;

/// The service, and the caller's token.
#[derive(Clone, Debug, clap::Args)]
pub struct Remote {
    /// Address of the running service; https:// where it has TLS
    #[arg(
        long,
        value_name = "URL",
        env = "VOLTOUR_SERVER",
        default_value = DEFAULT,
        hide_env_values = true
    )]
    server: String,
    /// Token for the service; better in the environment, for others on this machine may see the command line
    #[arg(long, value_name = "TOKEN", env = "VOLTOUR_TOKEN", hide_env_values = true)]
    token: Option<Hidden>,
    /// Certificate authority of the service (PEM), in place of those that this machine trusts
    #[arg(long, value_name = "FILE", env = "VOLTOUR_CA", hide_env_values = true)]
    ca: Option<PathBuf>,
    /// Certificate to show to the service (PEM)
    #[arg(
        long,
        value_name = "FILE",
        env = "VOLTOUR_CLIENT_CERT",
        hide_env_values = true,
        requires = "client_key"
    )]
    client_cert: Option<PathBuf>,
    /// Private key of that certificate (PEM)
    #[arg(
        long,
        value_name = "FILE",
        env = "VOLTOUR_CLIENT_KEY",
        hide_env_values = true,
        requires = "client_cert"
    )]
    client_key: Option<PathBuf>,
}

/// A token that was not looked at yet, so that no parser's error shows it.
#[derive(Clone)]
struct Hidden(String);

impl std::str::FromStr for Hidden {
    type Err = std::convert::Infallible;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(Self(text.to_owned()))
    }
}

impl std::fmt::Debug for Hidden {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("\"********\"")
    }
}

/// Puts the token on every call.
#[derive(Clone)]
pub struct Bearer(Option<MetadataValue<Ascii>>);

impl Interceptor for Bearer {
    fn call(&mut self, mut call: Request<()>) -> Result<Request<()>, Status> {
        if let Some(value) = &self.0 {
            call.metadata_mut().insert("authorization", value.clone());
        }
        Ok(call)
    }
}

impl std::fmt::Debug for Bearer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("Bearer")
    }
}

impl Remote {
    /// A service of this process, without TLS.
    pub fn plain(server: String, token: Option<Secret>) -> Self {
        let token = token.map(|token| Hidden(token.reveal().to_owned()));
        Self { server, token, ca: None, client_cert: None, client_key: None }
    }

    /// Connects.
    ///
    /// # Errors
    /// The address, the token or a file is no good, or no service answers.
    pub async fn connect(&self) -> Result<Service, Failure> {
        let server = &self.server;
        let bad = |why: &dyn std::fmt::Display| {
            Failure::input(format!("--server {server:?} must be like {DEFAULT}: {why}"))
        };
        let bearer = self.bearer()?;
        let mut endpoint = Endpoint::from_shared(server.clone()).map_err(|error| bad(&error))?;
        match endpoint.uri().scheme_str() {
            Some("http") => {}
            Some("https") => {
                let tls = self.tls()?;
                endpoint = endpoint.tls_config(tls).map_err(|error| {
                    Failure::input(format!("--ca, --client-cert or --client-key: {}", why(&error)))
                })?;
            }
            _ => return Err(bad(&"it begins with http:// or https://")),
        }
        let connecting = endpoint.connect_timeout(TIMEOUT).connect().await;
        let channel = connecting.map_err(|error| {
            let why = error.source().map(|source| format!(": {}", why(source))).unwrap_or_default();
            Failure::other(format!(
                "no service answers at {server}{why}; is `voltour serve` running?"
            ))
        })?;
        Ok(InterceptedService::new(channel, bearer))
    }

    fn bearer(&self) -> Result<Bearer, Failure> {
        let Some(Hidden(token)) = self.token.as_ref().filter(|token| !token.0.is_empty()) else {
            return Ok(Bearer(None));
        };
        let bad = |why: String| Failure::input(format!("--token: {why}"));
        let token: Secret = token.parse().map_err(bad)?;
        let value = format!("Bearer {}", token.reveal()).parse();
        let mut value: MetadataValue<Ascii> = value.map_err(|_| bad("is no token".to_owned()))?;
        value.set_sensitive(true);
        Ok(Bearer(Some(value)))
    }

    fn tls(&self) -> Result<ClientTlsConfig, Failure> {
        let file = |path: &Path| input::read(path).map(String::into_bytes);
        let mut tls = match &self.ca {
            Some(path) => ClientTlsConfig::new().ca_certificate(Certificate::from_pem(file(path)?)),
            None => ClientTlsConfig::new().with_native_roots(),
        };
        if let (Some(certificate), Some(key)) = (&self.client_cert, &self.client_key) {
            tls = tls.identity(Identity::from_pem(file(certificate)?, file(key)?));
        }
        Ok(tls)
    }
}

/// An error with all that is behind it, in one line.
fn why(error: &dyn Error) -> String {
    let causes = std::iter::successors(Some(error), |error: &&dyn Error| (*error).source());
    let mut words: Vec<String> = causes.map(ToString::to_string).collect();
    words.dedup();
    words.join(": ")
}
