//! Tables inside a document: what stands between two marks is replaced.

/// The document with other content between `<!-- bench NAME -->` and `<!-- bench end -->`; `None` where the
/// marks are not there.
pub fn replaced(document: &str, name: &str, content: &str) -> Option<String> {
    let (begin, end) = (format!("<!-- bench {name} -->"), "<!-- bench end -->");
    let (before, rest) = document.split_once(&begin)?;
    let (_, after) = rest.split_once(end)?;
    Some(format!("{before}{begin}\n\n{}\n\n{end}{after}", content.trim()))
}
