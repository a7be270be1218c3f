//! `voltour token`: works on the database file, beside a running service or without one. Whoever may
//! write that file may do everything anyway, so that it needs no token itself.

use std::path::Path;
use std::process::ExitCode;

use clap::Subcommand;
use serde_json::{Value, json};

use super::serve::block_on;
use super::{Database, Failure, say};
use crate::access::Secret;
use crate::clock::{Clock, Ids, SystemClock};
use crate::domain::{ChargerId, Grant, NetworkId, NetworkScope, Role, Token, TokenId, TokenName};
use crate::store::{StoreError, TokenFile};

/// What to do with tokens.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Make a token, and print it: this once, it is kept nowhere
    #[command(after_long_help = EXAMPLES)]
    Create(Create),
    /// List the tokens, without the tokens themselves
    List(List),
    /// Revoke a token: a running service refuses it from then on
    Revoke(Revoke),
}

const EXAMPLES: &str = "\
Roles:
  base_station  registers networks, submits requests, hears of departures
  charger       announces its own departures, fetches and reports its own tours
  operator      what the command line does with a running service; history; with --all-networks, metrics
  admin         everything

Examples:
  voltour token create ops --role operator --all-networks
  voltour token create station-7 --role base_station --network north
  voltour token create truck-1 --role charger --network north --charger truck-1

From the first token on the service asks for one. To replace a token make another, hand it over, and revoke
the old one. Clients send `authorization: Bearer TOKEN`; the commands of voltour take VOLTOUR_TOKEN.";

/// Arguments of `create`.
#[derive(Debug, clap::Args)]
pub struct Create {
    /// What to call it: 1 to 64 of A-Z a-z 0-9 . _ : -
    pub name: TokenName,
    /// base_station, charger, operator or admin
    #[arg(long, value_name = "ROLE")]
    pub role: Role,
    /// A network that it is for; may be repeated
    #[arg(long, value_name = "ID", required_unless_present = "all_networks")]
    pub network: Vec<NetworkId>,
    /// It is for every network, also those to come
    #[arg(long, conflicts_with = "network")]
    pub all_networks: bool,
    /// The charger that it is for, with the role charger
    #[arg(long, value_name = "ID")]
    pub charger: Option<ChargerId>,
    /// Print JSON
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    database: Database,
}

/// Arguments of `list`.
#[derive(Debug, clap::Args)]
pub struct List {
    /// Also those that are revoked
    #[arg(long)]
    pub revoked: bool,
    /// Print JSON: one object a line
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    database: Database,
}

/// Arguments of `revoke`.
#[derive(Debug, clap::Args)]
pub struct Revoke {
    /// Its name
    pub name: TokenName,
    #[command(flatten)]
    database: Database,
}

/// Runs a command.
pub fn run(command: Command) -> Result<ExitCode, Failure> {
    block_on(async {
        match command {
            Command::Create(args) => create(args).await,
            Command::List(args) => list(args).await,
            Command::Revoke(args) => revoke(args).await,
        }
    })
}

async fn create(args: Create) -> Result<(), Failure> {
    let path = args.database.path()?;
    let networks = match args.all_networks {
        true => NetworkScope::All,
        false => NetworkScope::Only(args.network.into_iter().collect()),
    };
    let grant = Grant::new(args.role, networks, args.charger);
    let grant = grant.map_err(|why| Failure::input(format!("--{why}")))?;
    let secret = Secret::random().map_err(|error| Failure::other(format!("no token: {error}")))?;
    let now = SystemClock.now();
    let id = TokenId(Ids::default().next(now));
    let token = Token { id, name: args.name, grant, created_at: now, revoked_at: None };
    let is_new = !path.exists();
    let mut file = open(&path, true).await?;
    let place = match (is_new, file.is_served()) {
        (true, _) => "a new database",
        (false, true) => "on which a service runs",
        (false, false) => "on which no service runs now",
    };
    let added = file.add(&token, secret.hash()).await.map_err(|error| failed(&path, error))?;
    file.close().await.map_err(|error| failed(&path, error))?;
    if !added {
        return Err(Failure::input(format!("name: there is a token {} already", token.name)));
    }
    if args.json {
        let mut shown = shown(&token);
        shown["token"] = json!(secret.reveal());
        say(shown);
    } else {
        say(secret.reveal());
        // Another database than the service's would be a riddle later.
        eprintln!("voltour: {}", line(&token));
        eprintln!(
            "voltour: kept as its hash in {}, {place}; it is shown this once",
            path.display()
        );
    }
    Ok(())
}

async fn list(args: List) -> Result<(), Failure> {
    let path = args.database.path()?;
    let mut file = open(&path, false).await?;
    for token in file.list(args.revoked).await.map_err(|error| failed(&path, error))? {
        match args.json {
            true => say(shown(&token)),
            false => say(line(&token)),
        }
    }
    file.close().await.map_err(|error| failed(&path, error))
}

async fn revoke(args: Revoke) -> Result<(), Failure> {
    let path = args.database.path()?;
    let mut file = open(&path, false).await?;
    let revoked = file.revoke(&args.name, SystemClock.now()).await;
    let revoked = revoked.map_err(|error| failed(&path, error))?;
    file.close().await.map_err(|error| failed(&path, error))?;
    if !revoked {
        return Err(Failure::input(format!("name: there is no token {} to revoke", args.name)));
    }
    say(format!("{} is revoked; a running service refuses it within a second", args.name));
    Ok(())
}

async fn open(path: &Path, make: bool) -> Result<TokenFile, Failure> {
    TokenFile::open(path, make).await.map_err(|error| failed(path, error))
}

fn failed(path: &Path, error: StoreError) -> Failure {
    match error {
        StoreError::Missing(_) | StoreError::Full { .. } => Failure::input(error.to_string()),
        StoreError::Older(_) => Failure::other(error.to_string()),
        error => Failure::other(format!("{}: {error}", path.display())),
    }
}

/// A token in a line.
fn line(token: &Token) -> String {
    let Token { name, grant, created_at, .. } = token;
    let networks = match grant.networks() {
        NetworkScope::All => "all networks".to_owned(),
        NetworkScope::Only(ids) => ids.iter().map(NetworkId::as_str).collect::<Vec<_>>().join(", "),
    };
    let charger = grant.charger().map(|id| format!("  charger {id}")).unwrap_or_default();
    let revoked = token.revoked_at.map(|at| format!("  revoked {at:.0}")).unwrap_or_default();
    format!("{name}  {}{charger}  {networks}  made {created_at:.0}{revoked}", grant.role())
}

/// A token as JSON; `networks` is null where it is for all.
fn shown(token: &Token) -> Value {
    let networks = match token.grant.networks() {
        NetworkScope::All => None,
        NetworkScope::Only(ids) => Some(ids),
    };
    json!({
        "id": token.id,
        "name": token.name,
        "role": token.grant.role(),
        "networks": networks,
        "charger_id": token.grant.charger(),
        "created_at": token.created_at,
        "revoked_at": token.revoked_at,
    })
}
