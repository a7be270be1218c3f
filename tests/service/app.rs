//! The one helper: a real server process on port 0 over a real database in a directory of its own.
//! Everything it waits for has a deadline; the process dies with the helper, and its log is shown
//! where a test fails.

use std::fs::{self, File};
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use tempfile::TempDir;
use tonic::transport::{Channel, Endpoint};
use voltour::proto::departure_service_client::DepartureServiceClient;
use voltour::proto::network_service_client::NetworkServiceClient;
use voltour::proto::request_service_client::RequestServiceClient;
use voltour::proto::tour_service_client::TourServiceClient;

/// Longest wait for anything: long, because the machine may be busy; a passing test never waits so long.
pub const PATIENCE: Duration = Duration::from_secs(30);

/// What a test sets of the configuration; durations as the file spells them.
#[derive(Clone, Debug)]
pub struct Settings {
    pub solver: &'static str,
    pub budget: &'static str,
    pub lead: &'static str,
    pub max_late: &'static str,
    pub overdue_after: &'static str,
    pub explanation_budget: &'static str,
    /// Further sections.
    pub more: String,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            solver: "auto",
            budget: "150ms",
            lead: "400ms",
            max_late: "10m",
            overdue_after: "30m",
            explanation_budget: "2s",
            more: String::new(),
        }
    }
}

impl Settings {
    fn toml(&self, store: &Path) -> String {
        let Self { solver, budget, lead, max_late, overdue_after, explanation_budget, more } = self;
        format!(
            "[grpc]\nlisten = \"127.0.0.1:0\"\n\n[rest]\nlisten = \"127.0.0.1:0\"\n\n\
             [store]\npath = {store:?}\n\n\
             [planning]\nsolver = {solver:?}\nbudget = {budget:?}\nlead = {lead:?}\n\
             max_late = {max_late:?}\noverdue_after = {overdue_after:?}\n\
             explanation_budget = {explanation_budget:?}\nseed = 7\n\n{more}"
        )
    }
}

/// A running server.
pub struct TestApp {
    dir: TempDir,
    child: Option<Child>,
    channel: Channel,
    /// Base address of the gRPC edge.
    pub grpc: String,
    /// Base address of the REST edge.
    pub rest: String,
}

impl TestApp {
    /// A server with the usual settings over an empty database.
    pub async fn start() -> Self {
        Self::with(Settings::default()).await
    }

    /// A server over an empty database.
    pub async fn with(settings: Settings) -> Self {
        Self::over(settings, |_| {}).await
    }

    /// A server over a database that `make` has put at its path.
    pub async fn over(settings: Settings, make: impl FnOnce(&Path)) -> Self {
        let dir = tempfile::tempdir().expect("a temporary directory");
        let channel = Endpoint::from_static("http://127.0.0.1:1").connect_lazy();
        let mut app = Self { dir, child: None, channel, grpc: String::new(), rest: String::new() };
        app.configure(settings);
        make(&app.database());
        app.launch().await;
        app
    }

    /// Writes the configuration, for the next launch.
    pub fn configure(&self, settings: Settings) {
        let config = settings.toml(&self.database());
        fs::write(self.config_path(), config).expect("the configuration is written");
    }

    /// Starts the process, again if it ran before, and waits until it says that it is ready.
    pub async fn launch(&mut self) {
        assert!(self.child.is_none(), "the server runs already");
        let (child, line) = spawn(&self.config_path(), &self.log_path());
        self.child = Some(child);
        let line = line.recv_timeout(PATIENCE).unwrap_or_else(|_| self.fail("never got ready"));
        let address = |key: &str| line.split(' ').find_map(|word| word.strip_prefix(key));
        match (line.starts_with("voltour ready "), address("grpc="), address("rest=")) {
            (true, Some(grpc), Some(rest)) => {
                (self.grpc, self.rest) = (grpc.to_owned(), rest.to_owned());
            }
            _ => self.fail(&format!("said {line:?} in place of the line that it is ready")),
        }
        let endpoint = Endpoint::from_shared(self.grpc.clone()).expect("an address");
        self.channel = endpoint.timeout(PATIENCE).connect().await.expect("a connection");
    }

    /// Stops the process as a power cut does.
    pub fn kill9(&mut self) {
        if let Some(mut child) = self.child.take() {
            child.kill().expect("kill -9");
            child.wait().expect("the end of the process");
        }
    }

    /// `kill -9`, then a new process over the same database.
    pub async fn restart(&mut self) {
        self.kill9();
        self.launch().await;
    }

    /// Asks the process to end, and waits for that.
    pub async fn sigterm(&mut self) -> ExitStatus {
        let mut child = self.child.take().expect("a running server");
        let pid = child.id().to_string();
        let sent = Command::new("kill").args(["-TERM", &pid]).status().expect("kill runs");
        assert!(sent.success(), "SIGTERM was not sent");
        wait_exit(&mut child).await.unwrap_or_else(|| {
            self.child = Some(child);
            self.fail("did not end after SIGTERM")
        })
    }

    /// Waits until the process ends by itself.
    pub async fn ended(&mut self) -> ExitStatus {
        let mut child = self.child.take().expect("a running server");
        wait_exit(&mut child).await.unwrap_or_else(|| {
            self.child = Some(child);
            self.fail("does not end")
        })
    }

    /// Asks the process to load its policies again.
    pub fn sighup(&self) {
        let pid = self.pid().to_string();
        let sent = Command::new("kill").args(["-HUP", &pid]).status().expect("kill runs");
        assert!(sent.success(), "SIGHUP was not sent");
    }

    /// The process's number.
    pub fn pid(&self) -> u32 {
        self.child.as_ref().expect("a running server").id()
    }

    /// The database file.
    pub fn database(&self) -> PathBuf {
        self.dir.path().join("voltour.db")
    }

    /// The configuration file.
    pub fn config_path(&self) -> PathBuf {
        self.dir.path().join("voltour.toml")
    }

    /// A file of the test's own beside the database.
    pub fn file(&self, name: &str) -> PathBuf {
        self.dir.path().join(name)
    }

    /// What the server has logged.
    pub fn log(&self) -> String {
        fs::read_to_string(self.log_path()).unwrap_or_default()
    }

    pub fn networks(&self) -> NetworkServiceClient<Channel> {
        NetworkServiceClient::new(self.channel.clone())
    }

    pub fn requests(&self) -> RequestServiceClient<Channel> {
        RequestServiceClient::new(self.channel.clone())
    }

    pub fn departures(&self) -> DepartureServiceClient<Channel> {
        DepartureServiceClient::new(self.channel.clone())
    }

    pub fn tours(&self) -> TourServiceClient<Channel> {
        TourServiceClient::new(self.channel.clone())
    }

    /// The connection, for the clients of other services.
    pub fn channel(&self) -> Channel {
        self.channel.clone()
    }

    fn log_path(&self) -> PathBuf {
        self.dir.path().join("stderr.log")
    }

    // The log is shown by `drop`, as for every other failure.
    fn fail(&self, what: &str) -> ! {
        panic!("the server {what}")
    }
}

impl Drop for TestApp {
    fn drop(&mut self) {
        if let Some(mut child) = self.child.take() {
            let _ = child.kill();
            let _ = child.wait();
        }
        if thread::panicking() {
            eprintln!("--- the server's log\n{}---", self.log());
        }
    }
}

/// Runs `voltour serve`; the first line of its standard output comes through the channel.
fn spawn(config: &Path, log: &Path) -> (Child, mpsc::Receiver<String>) {
    let log = File::options().create(true).append(true).open(log).expect("a log file");
    let mut child = Command::new(env!("CARGO_BIN_EXE_voltour"))
        .args(["serve", "--config"])
        .arg(config)
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(log)
        .spawn()
        .expect("the server starts");
    let stdout = child.stdout.take().expect("its standard output");
    let (send, line) = mpsc::channel();
    thread::spawn(move || {
        // Reads to the end, so that the server never writes into a closed pipe.
        for line in BufReader::new(stdout).lines().map_while(Result::ok) {
            let _ = send.send(line);
        }
    });
    (child, line)
}

/// Waits for the end of a process; none if it outlives our patience. The test goes on meanwhile: its
/// connections have to hear that the server wants to close them.
pub async fn wait_exit(child: &mut Child) -> Option<ExitStatus> {
    let end = Instant::now() + PATIENCE;
    while Instant::now() < end {
        if let Some(status) = child.try_wait().expect("the process's state") {
            return Some(status);
        }
        tokio::time::sleep(Duration::from_millis(10)).await;
    }
    None
}
