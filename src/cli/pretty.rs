//! JSON that reads well: what fits on a line stands on one, so that a stop or a request is a row.

use serde::Serialize;

use super::Failure;

/// Long enough for a stop with all its digits.
const LINE: usize = 180;

/// A document as text, with a line feed at its end.
pub(super) fn json(document: &impl Serialize) -> Result<String, Failure> {
    let compact = serde_json::to_string(document)
        .map_err(|error| Failure::other(format!("the document cannot be written: {error}")))?;
    let mut text = String::with_capacity(compact.len() * 5 / 4);
    lay_out(&compact, 0, &mut text);
    text.push('\n');
    Ok(text)
}

/// Lays out one value. `compact` comes from the serializer, so that its brackets match.
fn lay_out(compact: &str, indent: usize, text: &mut String) {
    let brackets = compact.starts_with(['{', '[']);
    // Spaces are set after colons and commas, so that a line grows a little.
    let short = indent > 0 && compact.len() + compact.len() / 8 + indent <= LINE;
    if !brackets || compact.len() == 2 || short {
        return one_line(compact, text);
    }
    let (open, close) = (&compact[..1], &compact[compact.len() - 1..]);
    text.push_str(open);
    let mut separator = "\n";
    for member in members(&compact[1..compact.len() - 1]) {
        text.push_str(separator);
        separator = ",\n";
        text.extend(std::iter::repeat_n(' ', indent + 2));
        let value = value_at(member);
        one_line(&member[..value], text);
        lay_out(&member[value..], indent + 2, text);
    }
    text.push('\n');
    text.extend(std::iter::repeat_n(' ', indent));
    text.push_str(close);
}

fn one_line(compact: &str, text: &mut String) {
    let mut scan = Scan::default();
    for c in compact.chars() {
        text.push(c);
        scan.step(c);
        if !scan.quoted && matches!(c, ',' | ':') {
            text.push(' ');
        }
    }
}

/// Where the value of a member begins: after its key, if it has one.
fn value_at(member: &str) -> usize {
    if !member.starts_with('"') {
        return 0;
    }
    let mut scan = Scan::default();
    for (i, c) in member.char_indices() {
        scan.step(c);
        if !scan.quoted && c == ':' {
            return i + 1;
        }
    }
    0
}

/// The inside of brackets, cut at its outermost commas.
fn members(inside: &str) -> impl Iterator<Item = &str> {
    let mut scan = Scan::default();
    inside.split(move |c| {
        scan.step(c);
        c == ',' && !scan.quoted && scan.depth == 0
    })
}

/// Where a scan of JSON text is.
#[derive(Default)]
struct Scan {
    quoted: bool,
    escaped: bool,
    depth: usize,
}

impl Scan {
    fn step(&mut self, c: char) {
        match c {
            _ if self.escaped => self.escaped = false,
            '\\' if self.quoted => self.escaped = true,
            '"' => self.quoted = !self.quoted,
            '{' | '[' if !self.quoted => self.depth += 1,
            '}' | ']' if !self.quoted => self.depth = self.depth.saturating_sub(1),
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::json as pretty;

    #[test]
    fn short_values_stand_on_one_line() {
        let text = pretty(&json!({"a": [1, 2], "b": "x, \"y\": {"})).unwrap();
        assert_eq!(text, "{\n  \"a\": [1, 2],\n  \"b\": \"x, \\\"y\\\": {\"\n}\n");
    }

    #[test]
    fn long_ones_are_rows() {
        let rows: Vec<_> = (0..9).map(|i| json!({"id": format!("s{i}"), "at": [i, 0.5]})).collect();
        let text = pretty(&json!({"name": "n", "rows": rows, "none": []})).unwrap();
        assert!(text.contains("\n    {\"at\": [3, 0.5], \"id\": \"s3\"},\n"), "{text}");
        assert!(text.contains("\n  \"none\": [],\n"), "{text}");
    }

    #[test]
    fn the_document_is_the_same() {
        let document = json!({"k": ["[,]", "\\", "\"", {"": vec![1.5; 200]}, null, true, "é\n"]});
        let text = pretty(&document).unwrap();
        assert_eq!(serde_json::from_str::<serde_json::Value>(&text).unwrap(), document);
    }
}
