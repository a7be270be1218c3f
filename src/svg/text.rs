//! Words and numbers: what a reader sees, safe to stand in XML.

/// Free text as one line that XML may hold: control characters, and those that turn the direction of
/// what follows, become a replacement character. The markup itself is escaped by the `svg` crate.
pub(super) fn clean(text: &str) -> String {
    let bad = |c: char| {
        c.is_control()
            || matches!(c, '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{fffe}' | '\u{ffff}')
    };
    text.chars().map(|c| if bad(c) { '\u{fffd}' } else { c }).collect()
}

/// [`clean`], cut at so many characters.
pub(super) fn short(text: &str, longest: usize) -> String {
    let text = clean(text);
    match text.char_indices().nth(longest) {
        Some(_) => {
            let cut: String = text.chars().take(longest.saturating_sub(1)).collect();
            format!("{}…", cut.trim_end())
        }
        None => text,
    }
}

/// A guess at the width of a text: no font is asked.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let em = |c: char| match c {
        'i' | 'j' | 'l' | '.' | ',' | ':' | '\'' | '|' => 0.32,
        'm' | 'w' | 'M' | 'W' => 0.86,
        c if c.is_ascii() => 0.6,
        _ => 1.0,
    };
    text.chars().map(em).sum::<f64>() * size
}

/// A number with at most `decimals` of them and no trailing zeros; very large and very small ones
/// in scientific notation.
pub(super) fn number(value: f64, decimals: usize) -> String {
    let size = value.abs();
    if value != 0.0 && !(1e-6..1e9).contains(&size) {
        return format!("{value:.2e}");
    }
    let text = format!("{value:.decimals$}");
    let text =
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".into() } else { text.into() }
}

/// Such as `282.8 m`.
pub(super) fn metres(value: f64) -> String {
    match value.abs() {
        size if size >= 1e4 => format!("{} km", number(value / 1e3, 2)),
        _ => format!("{} m", number(value, 1)),
    }
}

/// Such as `9.19 kJ`; the same number of decimals for all of a size, so that columns line up.
pub(super) fn joules(value: f64) -> String {
    match value.abs() {
        size if size >= 1e9 => format!("{} J", number(value, 0)),
        size if size >= 1e6 => format!("{:.2} MJ", value / 1e6),
        size if size >= 1e3 => format!("{:.2} kJ", value / 1e3),
        _ => format!("{} J", number(value, 1)),
    }
}

/// Such as `8 min 36 s`; what is above 100 hours in hours.
pub(super) fn duration(seconds: f64) -> String {
    if !seconds.is_finite() || seconds < 0.0 {
        return format!("{} s", number(seconds, 1));
    }
    if seconds < 60.0 {
        return match seconds {
            s if s == 0.0 || s >= 1.0 => format!("{} s", number(s, 1)),
            s => format!("{} ms", number(s * 1e3, if s < 0.01 { 2 } else { 0 })),
        };
    }
    if seconds >= 360_000.0 {
        return format!("{} h", number(seconds / 3600.0, 0));
    }
    let whole = seconds.round() as u64;
    match (whole / 3600, whole / 60 % 60, whole % 60) {
        (0, minutes, seconds) => format!("{minutes} min {seconds:02} s"),
        (hours, minutes, _) => format!("{hours} h {minutes:02} min"),
    }
}

#[cfg(test)]
mod tests {
    use super::{clean, duration, joules, number, short};

    #[test]
    fn numbers_read_well() {
        assert_eq!(number(282.842712, 1), "282.8");
        assert_eq!(number(-0.01, 1), "0");
        assert_eq!(number(100.0, 0), "100");
        assert_eq!(number(1e300, 1), "1.00e300");
        assert_eq!(joules(169_705.6), "169.71 kJ");
        assert_eq!(duration(515.99), "8 min 36 s");
        assert_eq!(duration(7_300.0), "2 h 01 min");
        assert_eq!(duration(0.0004), "0.4 ms");
        assert_eq!(duration(1e300), "2.78e296 h");
    }

    #[test]
    fn text_is_one_clean_line() {
        assert_eq!(clean("a\u{0}b\n\u{202e}c"), "a\u{fffd}b\u{fffd}\u{fffd}c");
        assert_eq!(short("a long sensor name", 7), "a long…");
        assert_eq!(short("ééééé", 5), "ééééé");
    }
}
