//! What of the log is written: a filter that can be changed while the service runs.

use std::sync::{Arc, Mutex, PoisonError};

use tracing_subscriber::filter::ParseError;
use tracing_subscriber::{EnvFilter, Registry, reload};

/// The longest filter.
const MOST: usize = 1_024;

/// The filter that is in force; clones change the same.
#[derive(Clone, Debug)]
pub struct LogFilter {
    text: Arc<Mutex<String>>,
    /// None where nothing is logged through it: in tests.
    layer: Option<reload::Handle<EnvFilter, Registry>>,
}

impl Default for LogFilter {
    /// Of no log.
    fn default() -> Self {
        Self { text: Arc::new(Mutex::new("info".to_owned())), layer: None }
    }
}

impl LogFilter {
    /// The filter of a log, and the layer that it is in force in.
    pub(super) fn new(
        text: &str,
    ) -> Result<(Self, reload::Layer<EnvFilter, Registry>), ParseError> {
        let (layer, handle) = reload::Layer::new(filter(text)?);
        Ok((Self { text: Arc::new(Mutex::new(text.to_owned())), layer: Some(handle) }, layer))
    }

    /// As it was set last.
    pub fn text(&self) -> String {
        self.text.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// From now on.
    ///
    /// # Errors
    /// It is no filter: the rule that it breaks.
    pub fn set(&self, text: &str) -> Result<(), String> {
        if text.len() > MOST {
            return Err(format!("{} bytes: must be at most {MOST}", text.len()));
        }
        let wrong = |why: &dyn std::fmt::Display| {
            format!("{text:?} must be a filter such as info or info,voltour=debug: {why}")
        };
        let parsed = filter(text).map_err(|error| wrong(&error))?;
        // Held while it is changed, so that what is shown is what is in force.
        let mut shown = self.text.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(layer) = &self.layer {
            layer.reload(parsed).map_err(|error| wrong(&error))?;
        }
        text.clone_into(&mut shown);
        Ok(())
    }
}

/// Reads a filter. Values of fields are compared as they are written, not as regular expressions, which may cost any
/// time and memory.
///
/// # Errors
/// It is none.
pub fn filter(text: &str) -> Result<EnvFilter, ParseError> {
    EnvFilter::builder().with_regex(false).parse(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bad_filter_changes_nothing() {
        let filter = LogFilter::default();
        for bad in ["voltour=loud", "info,,a=b=c", &"x".repeat(5_000)] {
            assert!(filter.set(bad).is_err(), "{bad}");
            assert_eq!(filter.text(), "info");
        }
        filter.clone().set("warn,voltour::store=trace").unwrap();
        assert_eq!(filter.text(), "warn,voltour::store=trace");
    }
}
