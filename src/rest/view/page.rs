//! Pages of lists.

use serde::Serialize;
use utoipa::ToSchema;

use super::{Departure, Network, PlanSummary, Request};
use crate::rest::query::cursor;
use crate::store::Listed;

macro_rules! page {
    ($(#[$doc:meta])* $name:ident, $item:ident, $from:ty) => {
        $(#[$doc])*
        #[derive(Debug, Serialize, ToSchema)]
        pub(in crate::rest) struct $name {
            /// At most as many as asked
            items: Vec<$item>,
            /// `cursor` for the next page; null on the last
            next_cursor: Option<String>,
        }

        impl From<Listed<$from>> for $name {
            fn from(listed: Listed<$from>) -> Self {
                let items = listed.items.into_iter().map(Into::into).collect();
                Self { items, next_cursor: cursor(listed.next) }
            }
        }
    };
}

page! {
    /// A page of networks
    NetworkPage, Network, crate::domain::Network
}
page! {
    /// A page of requests
    RequestPage, Request, crate::domain::Request
}
page! {
    /// A page of departures
    DeparturePage, Departure, crate::domain::Departure
}
page! {
    /// A page of plans
    PlanPage, PlanSummary, crate::store::PlanSummary
}
