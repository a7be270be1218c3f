//! Which of two forms the caller would rather have: JSON or text (RFC 9110, 12.5.1). Who accepts neither
//! gets JSON all the same: an answer that can be read is worth more than a refusal.

use axum::http::HeaderMap;
use axum::http::header::ACCEPT;

/// Whether text is liked better than JSON.
pub(super) fn prefers_text(headers: &HeaderMap) -> bool {
    let lists = headers.get_all(ACCEPT).iter().filter_map(|list| list.to_str().ok());
    let ranges: Vec<_> = lists.flat_map(|list| list.split(',')).map(range).collect();
    weight(&ranges, "text/plain") > weight(&ranges, "application/json")
}

/// A media range and its weight.
fn range(text: &str) -> (String, f64) {
    let mut parts = text.split(';').map(|part| part.trim().to_ascii_lowercase());
    let name = parts.next().unwrap_or_default();
    let weight = parts.find_map(|part| part.strip_prefix("q=")?.trim().parse().ok());
    (name, weight.unwrap_or(1.0))
}

/// That of the most specific range that holds the type; 0 where none does.
fn weight(ranges: &[(String, f64)], name: &str) -> f64 {
    let any = name.split('/').next().map(|kind| format!("{kind}/*")).unwrap_or_default();
    let of = |range: &str| ranges.iter().find(|(name, _)| name == range).map(|(_, weight)| *weight);
    of(name).or_else(|| of(&any)).or_else(|| of("*/*")).unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use axum::http::HeaderValue;

    #[test]
    fn the_most_specific_range_decides_and_json_wins_a_draw() {
        let prefers = |list: &'static str| {
            prefers_text(&HeaderMap::from_iter([(ACCEPT, HeaderValue::from_static(list))]))
        };
        for text in ["text/plain", "Text/Plain; Q=0.5", "text/*, application/json;q=0.9"] {
            assert!(prefers(text), "{text}");
        }
        let browser = "text/html,application/xhtml+xml,application/xml;q=0.9,*/*;q=0.8";
        for json in ["", "*/*", browser, "application/json, text/plain", "text/plain;q=0, */*"] {
            assert!(!prefers(json), "{json}");
        }
        assert!(!prefers_text(&HeaderMap::new()));
    }
}
