//! The header that a token comes in: `Authorization: Bearer TOKEN` (RFC 6750), or as the password of
//! `Basic` (RFC 7617), which is what a browser can send.

use axum::http::HeaderMap;
use axum::http::header::AUTHORIZATION;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::Secret;

/// The token of a call; none where there is no such header, or what is in it can be none.
pub(super) fn token(headers: &HeaderMap) -> Option<Secret> {
    let mut values = headers.get_all(AUTHORIZATION).iter();
    let value = values.next()?.to_str().ok()?;
    // Which of two is meant is not for us to say.
    if values.next().is_some() {
        return None;
    }
    let (scheme, rest) = value.split_once(' ')?;
    let rest = rest.trim();
    if scheme.eq_ignore_ascii_case("bearer") {
        return rest.parse().ok();
    }
    if scheme.eq_ignore_ascii_case("basic") {
        let pair = String::from_utf8(STANDARD.decode(rest).ok()?).ok()?;
        return pair.split_once(':')?.1.parse().ok();
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOKEN: &str = "voltour_0123456789012345678901234567890123456789012";

    fn read(values: &[String]) -> Option<Secret> {
        let values = values.iter().map(|value| (AUTHORIZATION, value.parse().unwrap()));
        token(&HeaderMap::from_iter(values))
    }

    #[test]
    fn a_token_comes_as_a_bearers_or_as_a_password() {
        let basic = STANDARD.encode(format!("anyone:{TOKEN}"));
        for value in
            [format!("Bearer {TOKEN}"), format!("bearer  {TOKEN}"), format!("Basic {basic}")]
        {
            assert_eq!(read(&[value]).unwrap().reveal(), TOKEN);
        }
    }

    #[test]
    fn anything_else_is_none() {
        let without_colon = STANDARD.encode(TOKEN);
        let bad = ["", "Bearer", "Bearer ", "Bearer short", "Digest x", "Basic !", TOKEN];
        for value in bad.map(str::to_owned).into_iter().chain([format!("Basic {without_colon}")]) {
            assert_eq!(read(std::slice::from_ref(&value)), None, "{value}");
        }
        let twice = format!("Bearer {TOKEN}");
        assert_eq!(read(&[twice.clone(), twice]), None);
        assert_eq!(read(&[]), None);
    }
}
