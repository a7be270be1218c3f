//! The plan history as a table (RFC 4180), for a spreadsheet or a notebook: read and sent page by page, so that the
//! whole of it is never in memory, and as fast as the caller takes it.

use axum::body::Body;
use axum::extract::State;
use axum::http::header::{CONTENT_DISPOSITION, CONTENT_TYPE};
use axum::http::{HeaderValue, Uri};
use axum::response::Response;
use csv::WriterBuilder;
use futures_util::stream::{self, Stream, StreamExt};

use super::RestState;
use super::plans::filter;
use super::problem::Problem;
use super::query::Params;
use super::view::{PlanStatus, PlanSummary};
use crate::access::Caller;
use crate::store::{self, Listed, Page, PlanFilter};

const MEDIA_TYPE: &str = "text/csv; charset=utf-8; header=present";

/// The fields of a plan in a list, in their order.
const COLUMNS: [&str; 16] = [
    "id",
    "departure_id",
    "revision",
    "network_id",
    "charger_id",
    "status",
    "solver",
    "objective",
    "bound",
    "gap",
    "distance_m",
    "stops",
    "unserved",
    "start",
    "finish",
    "created_at",
];

/// The history of plans as a table (CSV), newest first
///
/// A header, then a line a plan with the fields of `/v1/plans`; a field that is null there is empty. The answer ends
/// early, without its proper end, where the service stops meanwhile.
#[utoipa::path(get, path = "/v1/plans.csv", operation_id = "plans_table", tag = "plans", params(
    ("network" = Option<String>, Query, pattern = "^[A-Za-z0-9._:-]{1,64}$",
     description = "Of this network"),
    ("charger" = Option<String>, Query, pattern = "^[A-Za-z0-9._:-]{1,64}$",
     description = "Of this charger"),
    ("status" = Option<PlanStatus>, Query, description = "Of this status"),
    ("solver" = Option<String>, Query, description = "Whose tour this solver found"),
    ("from" = Option<jiff::Timestamp>, Query, description = "Made at or after it"),
    ("until" = Option<jiff::Timestamp>, Query, description = "Made before it"),
), responses(
    (status = 200, description = "A table", body = String, content_type = "text/csv"),
))]
pub(super) async fn plans(
    State(state): State<RestState>,
    caller: Caller,
    uri: Uri,
) -> Result<Response, Problem> {
    let mut params = Params::of(&uri)?;
    let filter = filter(&caller, &mut params);
    params.finish()?;
    // The first page before the headers: what fails at once gets a problem document.
    let first = state.reads.plans(&filter, &page(None)).await?;
    let mut response = Response::new(Body::from_stream(table(state, filter, first)));
    let headers = response.headers_mut();
    headers.insert(CONTENT_TYPE, HeaderValue::from_static(MEDIA_TYPE));
    let name = HeaderValue::from_static("attachment; filename=\"plans.csv\"");
    headers.insert(CONTENT_DISPOSITION, name);
    Ok(response)
}

/// Why a table broke off: the caller sees only that it did.
#[derive(Debug, thiserror::Error)]
pub(super) enum Cut {
    #[error("{0}")]
    Store(#[from] store::StoreError),
    #[error("a row of the export: {0}")]
    Row(#[from] csv::Error),
    #[error("the service is stopping")]
    Stopping,
}

/// What is to be sent next.
enum Next {
    Header(Listed<store::PlanSummary>),
    After(String),
    End,
}

/// The pieces of a table, from its first page on.
pub(super) fn table(
    state: RestState,
    filter: PlanFilter,
    first: Listed<store::PlanSummary>,
) -> impl Stream<Item = Result<Vec<u8>, Cut>> {
    let pieces = stream::unfold(Next::Header(first), move |next| {
        let (state, filter) = (state.clone(), filter.clone());
        async move {
            let piece = match next {
                Next::Header(first) => piece(first, true),
                Next::After(id) => match rest(&state, &filter, id).await {
                    Ok(listed) => piece(listed, false),
                    Err(cut) => Err(cut),
                },
                Next::End => return None,
            };
            Some(match piece {
                Ok((text, next)) => (Ok(text), next.map_or(Next::End, Next::After)),
                Err(cut) => {
                    tracing::warn!(%cut, "an export broke off");
                    (Err(cut), Next::End)
                }
            })
        }
    });
    // The layer that compresses asks once more after the end.
    pieces.fuse()
}

async fn rest(
    state: &RestState,
    filter: &PlanFilter,
    after: String,
) -> Result<Listed<store::PlanSummary>, Cut> {
    // Nobody waits for the end of a long history.
    if state.shutting_down.is_cancelled() {
        return Err(Cut::Stopping);
    }
    Ok(state.reads.plans(filter, &page(Some(after))).await?)
}

fn page(after: Option<String>) -> Page {
    Page { limit: Page::LARGEST, after }
}

/// A page as lines, and after which plan to go on. Ids are letters, digits and `._:-`: no cell begins a formula.
fn piece(
    listed: Listed<store::PlanSummary>,
    with_header: bool,
) -> Result<(Vec<u8>, Option<String>), Cut> {
    let mut table = WriterBuilder::new()
        .has_headers(false)
        .terminator(csv::Terminator::CRLF)
        .from_writer(Vec::new());
    if with_header {
        table.write_record(COLUMNS)?;
    }
    for plan in listed.items {
        table.serialize(PlanSummary::from(plan))?;
    }
    let text = table.into_inner().map_err(|error| csv::Error::from(error.into_error()))?;
    Ok((text, listed.next))
}

#[cfg(test)]
mod tests {
    use jiff::Timestamp;
    use uuid::Uuid;
    use voltour_solver::plan::Status;

    use super::*;
    use crate::domain::{DepartureId, PlanId};

    fn plan(bound: Option<f64>) -> store::PlanSummary {
        store::PlanSummary {
            id: PlanId(Uuid::nil()),
            departure_id: DepartureId(Uuid::nil()),
            revision: 1,
            network_id: "net".parse().unwrap(),
            charger_id: "truck".parse().unwrap(),
            status: Status::BestEffort,
            solver: "greedy".to_owned(),
            objective: 0.1,
            bound,
            gap: None,
            distance_m: 1e300,
            stops: 2,
            unserved: 0,
            start: Timestamp::UNIX_EPOCH,
            finish: Timestamp::UNIX_EPOCH,
            created_at: Timestamp::UNIX_EPOCH,
        }
    }

    #[test]
    fn the_columns_are_the_fields_of_the_list_in_their_order() {
        let line = serde_json::to_string(&PlanSummary::from(plan(None))).unwrap();
        let mut last = 0;
        for column in COLUMNS {
            let at = line.find(&format!("\"{column}\":")).unwrap_or_else(|| panic!("{column}"));
            assert!(at >= last, "{column} in {line}");
            last = at;
        }
        assert_eq!(line.matches("\":").count(), COLUMNS.len());
    }

    #[test]
    fn a_page_is_lines_and_only_the_first_has_a_header() {
        let listed = |next| Listed { items: vec![plan(None), plan(Some(1.5))], next };
        let (text, next) = piece(listed(Some("x".to_owned())), true).unwrap();
        let text = String::from_utf8(text).unwrap();
        let lines: Vec<_> = text.split("\r\n").collect();
        assert_eq!((lines.len(), lines[3], next.as_deref()), (4, "", Some("x")));
        assert!(lines[0].starts_with("id,departure_id,revision,"), "{text}");
        assert!(lines[1].contains(",best_effort,greedy,0.1,,,"), "{text}");
        assert!(lines[2].contains(",0.1,1.5,,"), "{text}");
        let (text, _) = piece(listed(None), false).unwrap();
        assert_eq!(String::from_utf8(text).unwrap().split("\r\n").count(), 3);
    }
}
