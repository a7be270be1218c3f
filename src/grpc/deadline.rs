//! How long a call may wait: within its caller's deadline, and never longer than the service allows.

use std::time::Duration;

use tonic::metadata::MetadataMap;

/// Kept free before the caller's deadline, so that the answer arrives and not the caller's time-out.
const MARGIN: Duration = Duration::from_millis(50);

/// How long to wait for something on behalf of a call.
pub(super) fn wait(metadata: &MetadataMap, longest: Duration) -> Duration {
    let Some(timeout) = timeout(metadata) else { return longest };
    let margin = MARGIN.min(timeout / 10);
    longest.min(timeout.saturating_sub(margin))
}

/// The header `grpc-timeout`: up to eight digits and a unit. A bad one counts as none, as gRPC has it.
fn timeout(metadata: &MetadataMap) -> Option<Duration> {
    let text = metadata.get("grpc-timeout")?.to_str().ok()?;
    let (digits, unit) = text.split_at_checked(text.len().checked_sub(1)?)?;
    let wellformed = (1..=8).contains(&digits.len()) && digits.bytes().all(|b| b.is_ascii_digit());
    let count: u64 = digits.parse().ok().filter(|_| wellformed)?;
    Some(match unit {
        "H" => Duration::from_secs(count * 3600),
        "M" => Duration::from_secs(count * 60),
        "S" => Duration::from_secs(count),
        "m" => Duration::from_millis(count),
        "u" => Duration::from_micros(count),
        "n" => Duration::from_nanos(count),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn metadata(text: &str) -> MetadataMap {
        let mut metadata = MetadataMap::new();
        metadata.insert("grpc-timeout", text.parse().unwrap());
        metadata
    }

    #[test]
    fn reads_every_unit() {
        let expected = [
            ("2H", Duration::from_secs(7200)),
            ("3M", Duration::from_secs(180)),
            ("5S", Duration::from_secs(5)),
            ("250m", Duration::from_millis(250)),
            ("7u", Duration::from_micros(7)),
            ("99999999n", Duration::from_nanos(99_999_999)),
        ];
        for (text, duration) in expected {
            assert_eq!(timeout(&metadata(text)), Some(duration), "{text}");
        }
    }

    #[test]
    fn takes_a_bad_one_for_none() {
        for text in ["", "5", "S", "5s", "-5S", "+5S", "5.0S", "123456789S", "5 S"] {
            assert_eq!(timeout(&metadata(text)), None, "{text:?}");
        }
    }

    #[test]
    fn answers_before_the_caller_gives_up() {
        let longest = Duration::from_secs(300);
        assert_eq!(wait(&MetadataMap::new(), longest), longest);
        assert_eq!(wait(&metadata("1H"), longest), longest);
        assert_eq!(wait(&metadata("10S"), longest), Duration::from_millis(9_950));
        assert_eq!(wait(&metadata("100m"), longest), Duration::from_millis(90));
        assert_eq!(wait(&metadata("0S"), longest), Duration::ZERO);
    }
}
