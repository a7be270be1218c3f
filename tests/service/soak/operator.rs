//! The operator: pages through the history all the time, and has `voltour check` look at every plan in it.

use std::collections::{HashMap, HashSet};
use std::fmt;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

use serde_json::Value;

use super::history::History;
use crate::crash::aim::Killed;
use crate::time::pause;

/// Pages of one walk through requests or departures; the rest is for the next.
const PAGES: usize = 20;

#[derive(Debug)]
pub struct Operator {
    /// Where the documents to check are put.
    folder: PathBuf,
    /// The departure of every plan that was checked, by plan.
    checked: HashMap<String, String>,
    /// The plan of every departure.
    planned: HashMap<String, String>,
    pages: u64,
}

impl Operator {
    pub fn new(folder: PathBuf) -> Self {
        fs::create_dir(&folder).expect("a folder");
        Self { folder, checked: HashMap::new(), planned: HashMap::new(), pages: 0 }
    }

    /// Reads until the process is killed.
    pub async fn read(&mut self, history: &History, killed: &Killed) {
        while !killed.struck() {
            let read = self.round(history, killed).await;
            if let Err(error) = read {
                assert!(killed.struck(), "the operator: {error}");
            }
            pause(100).await;
        }
    }

    async fn round(&mut self, history: &History, killed: &Killed) -> reqwest::Result<()> {
        self.catch_up(history).await?;
        for list in ["/v1/requests", "/v1/departures", "/v1/networks"] {
            if !killed.struck() {
                self.walk(history, list).await?;
            }
        }
        history.text("/v1/plans.csv").await.map(drop)
    }

    /// No item twice, whatever is stored meanwhile.
    async fn walk(&mut self, history: &History, list: &str) -> reqwest::Result<()> {
        let (mut seen, mut cursor) = (HashSet::new(), None);
        for _ in 0..PAGES {
            let (items, next) = history.page(list, cursor.as_deref()).await?;
            self.pages += 1;
            for item in items {
                assert!(seen.insert(text(&item, "id")), "twice in {list}: {item}");
            }
            cursor = next;
            if cursor.is_none() {
                break;
            }
        }
        Ok(())
    }

    /// Checks every plan that was not there before: the newest come first.
    pub async fn catch_up(&mut self, history: &History) -> reqwest::Result<()> {
        let mut cursor = None;
        loop {
            let (plans, next) = history.page("/v1/plans", cursor.as_deref()).await?;
            self.pages += 1;
            let new: Vec<_> =
                plans.iter().filter(|plan| !self.checked.contains_key(&text(plan, "id"))).collect();
            for plan in &new {
                self.check(history, &text(plan, "id"), &text(plan, "departure_id")).await?;
            }
            cursor = next;
            // A kill may have left older ones unchecked, but never more than a page of them.
            if cursor.is_none() || new.is_empty() {
                return Ok(());
            }
        }
    }

    async fn check(
        &mut self,
        history: &History,
        plan: &str,
        departure: &str,
    ) -> reqwest::Result<()> {
        let envelope = history.json(&format!("/v1/plans/{plan}")).await?;
        let scenario = history.text(&format!("/v1/plans/{plan}/scenario")).await?;
        self.judge(plan, departure, &scenario, &envelope["plan"].to_string()).await;
        Ok(())
    }

    /// Fails where `voltour check` refuses a plan, or where its departure has another.
    pub async fn judge(&mut self, id: &str, departure: &str, scenario: &str, plan: &str) {
        let files = ["scenario.json", "plan.json"].map(|name| self.folder.join(name));
        fs::write(&files[0], scenario).expect("the scenario is written");
        fs::write(&files[1], plan).expect("the plan is written");
        let mut check = Command::new(env!("CARGO_BIN_EXE_voltour"));
        check.arg("check").args(&files);
        let checked = tokio::task::spawn_blocking(move || check.output());
        let checked = checked.await.expect("no panic").expect("voltour runs");
        let said = String::from_utf8_lossy(&checked.stdout);
        assert_eq!(checked.status.code(), Some(0), "check refuses plan {id}: {said}");
        let before = self.planned.insert(departure.to_owned(), id.to_owned());
        assert_eq!(before, None, "departure {departure} is planned twice, the second time as {id}");
        self.checked.insert(id.to_owned(), departure.to_owned());
    }

    /// A tour that a charger was given is of a plan that was checked.
    pub fn knows(&self, plan: &str, departure: &str) {
        let found = self.checked.get(plan).map(String::as_str);
        assert_eq!(found, Some(departure), "plan {plan} is not in the history");
    }
}

impl fmt::Display for Operator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} pages read, {} plans checked", self.pages, self.checked.len())
    }
}

fn text(item: &Value, member: &str) -> String {
    item[member].as_str().unwrap_or_else(|| panic!("no {member} in {item}")).to_owned()
}
