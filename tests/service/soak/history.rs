//! The REST history, asked by somebody who may find the service dead.

use reqwest::{Client, StatusCode};
use serde_json::Value;

use crate::app::PATIENCE;

/// Items of a page.
const LIMIT: usize = 100;

#[derive(Clone, Debug)]
pub struct History {
    client: Client,
    rest: String,
}

impl History {
    pub fn of(rest: &str) -> Self {
        let client = Client::builder().timeout(PATIENCE).build().expect("a client");
        Self { client, rest: rest.to_owned() }
    }

    /// What a route answers; an error only where there was no answer.
    pub async fn text(&self, path: &str) -> reqwest::Result<String> {
        let answer = self.client.get(format!("{}{path}", self.rest)).send().await?;
        let (status, text) = (answer.status(), answer.text().await?);
        assert_eq!(status, StatusCode::OK, "{path}: {text}");
        Ok(text)
    }

    pub async fn json(&self, path: &str) -> reqwest::Result<Value> {
        let text = self.text(path).await?;
        Ok(serde_json::from_str(&text).unwrap_or_else(|e| panic!("{path}: {e}: {text}")))
    }

    /// The items of a list and the cursor of the next page.
    pub async fn page(
        &self,
        list: &str,
        cursor: Option<&str>,
    ) -> reqwest::Result<(Vec<Value>, Option<String>)> {
        let cursor = cursor.map(|cursor| format!("&cursor={cursor}")).unwrap_or_default();
        let mut page = self.json(&format!("{list}?limit={LIMIT}{cursor}")).await?;
        let items = page["items"].as_array_mut().map(std::mem::take).expect("items");
        assert!(items.len() <= LIMIT, "{} items on a page of {LIMIT}", items.len());
        Ok((items, page["next_cursor"].as_str().map(str::to_owned)))
    }
}
