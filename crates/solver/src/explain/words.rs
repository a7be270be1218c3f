//! Numbers, names and lists as an operator reads them.

/// A number with at most two decimals, none where it is whole.
pub(super) fn number(value: f64) -> String {
    trimmed(format!("{value:.2}"))
}

/// A number that must not be read as less than it is.
pub(super) fn at_least(value: f64) -> String {
    let up = (value * 100.0 - 1e-6).ceil() / 100.0;
    number(up)
}

fn trimmed(text: String) -> String {
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    };
    if text == "-0" { "0".to_owned() } else { text }
}

/// A change of a number, with its sign.
pub(super) fn signed(value: f64) -> String {
    let text = number(value);
    if text.starts_with('-') { text } else { format!("+{text}") }
}

/// An id; in quotes where it could be misread.
pub(super) fn name(id: &str) -> String {
    let plain = |c: char| c.is_alphanumeric() || "-_.:/#".contains(c);
    if id.chars().all(plain) { id.to_owned() } else { format!("{id:?}") }
}

/// A place.
pub(super) fn place(at_m: [f64; 2]) -> String {
    format!("({}, {})", number(at_m[0]), number(at_m[1]))
}

/// Names with commas.
pub(super) fn names(ids: &[String]) -> String {
    ids.iter().map(|id| name(id)).collect::<Vec<_>>().join(", ")
}

/// Phrases with commas, the last with "and".
pub(super) fn all_of(phrases: &[String]) -> String {
    match phrases {
        [] => String::new(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// The text with its first letter as a capital one, unless that would change a name.
pub(super) fn sentence_case(text: &str, begins_with_name: bool) -> String {
    let mut chars = text.chars();
    match chars.next() {
        Some(first) if !begins_with_name => first.to_uppercase().chain(chars).collect(),
        _ => text.to_owned(),
    }
}
