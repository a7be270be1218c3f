//! What the configuration says of access: its rules, and the token that it may hold.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::{Config, ConfigError};
use crate::access::Secret;

/// No token is longer, nor is what may stand around one.
const TOKEN_BYTES: u64 = 4_096;

impl Config {
    /// The token that is configured, if one is: reads its file.
    ///
    /// # Errors
    /// The file cannot be read, or does not hold a token.
    pub fn bootstrap(&self) -> Result<Option<Secret>, ConfigError> {
        let Some(path) = &self.access.bootstrap_token_file else {
            return Ok(self.access.bootstrap_token.clone());
        };
        let read = read(path).and_then(|text| text.trim().parse());
        read.map(Some).map_err(|why| {
            let path = path.display();
            ConfigError(vec![format!("access.bootstrap_token_file: {path}: {why}")])
        })
    }

    pub(super) fn check_access(&self, errors: &mut Vec<String>) {
        let (access, tls) = (&self.access, &self.tls);
        if access.bootstrap_token.is_some() && access.bootstrap_token_file.is_some() {
            errors.push("access.bootstrap_token: must not be given beside a file".to_owned());
        }
        let (certificate, key) = (tls.certificate_file.is_some(), tls.key_file.is_some());
        if certificate != key {
            let (has, lacks) = if key { ("key", "certificate") } else { ("certificate", "key") };
            errors.push(format!("tls.{lacks}_file: must be given with tls.{has}_file"));
        }
        if tls.client_ca_file.is_some() && !certificate {
            errors
                .push("tls.client_ca_file: needs tls.certificate_file and tls.key_file".to_owned());
        }
        for host in &self.rest.hosts {
            let allowed = |byte: u8| byte.is_ascii_alphanumeric() || b".-".contains(&byte);
            if !(1..=253).contains(&host.len()) || !host.bytes().all(allowed) {
                let host: String = host.chars().take(80).collect();
                errors.push(format!("rest.hosts: {host:?} must be the name of a host"));
            }
        }
    }
}

fn read(path: &Path) -> Result<String, String> {
    let mut text = String::new();
    let read = File::open(path).and_then(|file| file.take(TOKEN_BYTES).read_to_string(&mut text));
    read.map(|_| text).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_token_of_a_file_may_end_its_line() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("token");
        let token = "x".repeat(40);
        let mut config = Config::default();
        assert_eq!(config.bootstrap(), Ok(None));
        config.access.bootstrap_token_file = Some(path.clone());
        assert!(config.bootstrap().unwrap_err().0[0].starts_with("access.bootstrap_token_file: "));
        std::fs::write(&path, format!("{token}\n")).unwrap();
        assert_eq!(config.bootstrap().unwrap().unwrap().reveal(), token);
        std::fs::write(&path, "secret but short").unwrap();
        let refused = config.bootstrap().unwrap_err().0.remove(0);
        assert!(refused.contains("32 to 256") && !refused.contains("secret"), "{refused}");
    }
}
