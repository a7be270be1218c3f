//! Pages of lists. A page token is the id of the last item, in base64url: opaque, so that what it
//! holds may change.

use std::str::FromStr;

use base64::Engine;
use base64::engine::general_purpose::URL_SAFE_NO_PAD;

use super::wire::{Fields, Path};
use crate::store::Page;

/// Longer than the token of any id.
const LONGEST: usize = 128;

/// Reads `page_size` and `page_token`; `T` is the id that the list goes by.
pub(super) fn page<T: FromStr>(fields: &mut Fields, size: u32, token: &str) -> Option<Page> {
    let at = Path::ROOT;
    let limit = match size {
        0 => Some(Page::DEFAULT),
        size if size <= Page::LARGEST => Some(size),
        size => {
            let rule = format!("must be at most {}", Page::LARGEST);
            fields.refuse(at.field("page_size"), format!("{size} {rule}"))
        }
    };
    let after = match token {
        "" => Some(None),
        token => decode::<T>(token).map(Some).or_else(|| {
            let start: String = token.chars().take(80).collect();
            let rule = "is no next_page_token of this list";
            fields.refuse(at.field("page_token"), format!("{start:?} {rule}"))
        }),
    };
    Some(Page { limit: limit?, after: after? })
}

/// The token for the page after this id; empty where there is none.
pub(super) fn token(next: Option<String>) -> String {
    next.map(|id| URL_SAFE_NO_PAD.encode(id)).unwrap_or_default()
}

fn decode<T: FromStr>(token: &str) -> Option<String> {
    let bytes = URL_SAFE_NO_PAD.decode(token).ok().filter(|_| token.len() <= LONGEST)?;
    String::from_utf8(bytes).ok().filter(|id| id.parse::<T>().is_ok())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::{FieldViolation, NetworkId, Refusal, RequestId};

    fn read<T: FromStr>(size: u32, text: &str) -> Result<Page, Vec<FieldViolation>> {
        let mut fields = Fields::default();
        let page = page::<T>(&mut fields, size, text);
        fields.finish(page).map_err(|refusal| match refusal {
            Refusal::Invalid(violations) => violations,
            other => panic!("{other}"),
        })
    }

    #[test]
    fn a_token_leads_to_its_id() {
        let page = read::<NetworkId>(0, &token(Some("north:1".to_owned()))).unwrap();
        assert_eq!((page.limit, page.after.as_deref()), (Page::DEFAULT, Some("north:1")));
        assert_eq!(read::<NetworkId>(500, "").unwrap().after, None);
        assert_eq!(token(None), "");
    }

    #[test]
    fn garbage_and_other_lists_tokens_are_refused() {
        let foreign = token(Some("north".to_owned()));
        for text in ["!", "====", "bm9ydGg=", foreign.as_str(), &"A".repeat(4_000)] {
            let violations = read::<RequestId>(501, text).unwrap_err();
            let fields: Vec<_> = violations.iter().map(|v| v.field.as_str()).collect();
            assert_eq!(fields, ["page_size", "page_token"], "{text}");
        }
    }
}
