//! The zenoh session and its configuration: where it listens, unless a file says so.

use super::{DEFAULT_PORT, LiveError, LiveOptions, exposed};
use std::io;
use std::net::TcpListener;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use world::files;
use zenoh::config::EndPoint;
use zenoh::{Config, Session, Wait};

/// Number of ports after the default one that are tried, and at which listeners look for runs. They try all of them a
/// few times a second.
pub(super) const SPARE_PORTS: u16 = 63;

/// Where zenoh's configuration says how many batches of 64 kB wait for a subscriber.
const QUEUE: &str = "transport/link/tx/queue/size/data";

/// As many as zenoh allows, 1 MB. With its default of two, one plume of 10 000 points fills the queue. On a busy machine
/// the sending thread then runs too late, and a healthy subscriber loses what follows: digest and last clock of a run.
const BATCHES: usize = 16;

/// An open session, and what the user is told of it.
pub(super) struct OpenedSession {
    pub(super) session: Session,
    pub(super) told: Notices,
}

/// An open session. The last run that uses it closes it.
#[derive(Debug)]
pub(super) struct Open(pub(super) Session);

impl Open {
    pub(super) fn session(&self) -> &Session {
        &self.0
    }
}

impl Drop for Open {
    fn drop(&mut self) {
        // Explicitly, because a session that is closed when statics are dropped panics.
        let _closed = self.0.close().wait();
    }
}

/// Lines for the user, if necessary.
#[derive(Debug, Default)]
pub(super) struct Notices {
    /// That a port other than the default one was taken.
    pub(super) notice: Option<String>,
    /// That anybody who comes from another machine can control the run.
    pub(super) warning: Option<String>,
}

/// Opens the session of a run.
pub(super) fn opened(options: &LiveOptions, from_env: Option<PathBuf>) -> Result<OpenedSession, LiveError> {
    let file = options.config_file.clone().or(from_env);
    if file.is_none() && options.listen.is_none() {
        let first = DEFAULT_PORT..=DEFAULT_PORT + SPARE_PORTS;
        return at_a_free_port(first, options.ros2.is_some());
    }
    let mut config = match &file {
        Some(path) => from_file(path)?,
        None => here(None)?,
    };
    if let Some(endpoint) = &options.listen {
        is_endpoint(endpoint)?;
        set(&mut config, "listen/endpoints", &serde_json::json!([endpoint]))?;
    }
    let warning = exposed::warning(&config, options)?;
    let session = zenoh::open(config).wait().map_err(|e| {
        let port = options.listen.as_deref().and_then(port);
        match (&options.listen, port) {
            (Some(endpoint), Some(port)) if in_use(&e) => LiveError::BusyPort { endpoint: endpoint.clone(), port },
            _ => LiveError::Open { why: plain(&e) },
        }
    })?;
    let told = Notices { notice: None, warning };
    Ok(OpenedSession { session, told })
}

/// Without configuration and endpoint: the first of these ports that zenoh gets, or any that the system has. zenoh
/// itself takes the port, and tries the next one if another process was faster: runs that start together do not meet.
fn at_a_free_port(ports: RangeInclusive<u16>, ros2: bool) -> Result<OpenedSession, LiveError> {
    let (first, last) = (*ports.start(), *ports.end());
    // To ask costs less than to open a session in vain; it decides nothing.
    let perhaps_free = |port: &u16| TcpListener::bind(("127.0.0.1", *port)).is_ok();
    for port in ports.filter(perhaps_free).chain([0]) {
        // Nodes of ROS expect a router at the default port: if it is not this session, then this session joins it.
        let joined = (ros2 && port != first).then(|| format!("tcp/127.0.0.1:{first}"));
        let mut config = here(joined.as_deref())?;
        set(&mut config, "listen/endpoints", &serde_json::json!([format!("tcp/127.0.0.1:{port}")]))?;
        let session = match zenoh::open(config).wait() {
            Ok(session) => session,
            Err(e) if in_use(&e) => continue,
            Err(e) => return Err(LiveError::Open { why: plain(&e) }),
        };
        let end = endpoint(&session);
        let joins = joined.map_or(String::new(), |router| format!(", and connects to {router} for ROS 2"));
        let notice = match port {
            0 => format!(
                "ports {first} to {last} are already in use: zenoh listens on {end}{joins}; clients have to be told \
                 (rheotaxis listen --connect {end})"
            ),
            _ => format!("port {first} is already in use: zenoh listens on {end}{joins}"),
        };
        let told = Notices { notice: (port != first).then_some(notice), warning: None };
        return Ok(OpenedSession { session, told });
    }
    Err(LiveError::Open { why: "the system has no free port on 127.0.0.1".to_owned() })
}

/// A session that finds nobody by itself, and may join a router.
fn here(joined: Option<&str>) -> Result<Config, LiveError> {
    let mut config = Config::default();
    set(&mut config, "mode", &"router".into())?;
    match joined {
        Some(router) => set(&mut config, "connect/endpoints", &serde_json::json!([router]))?,
        // A router waits so long for those whom it may find, half a second by default; it looks for nobody here.
        None => set(&mut config, "scouting/delay", &0.into())?,
    }
    // Multicast is slow or refused on many machines; clients are told the endpoint instead.
    set(&mut config, "scouting/multicast/enabled", &false.into())?;
    set(&mut config, QUEUE, &BATCHES.into())?;
    Ok(config)
}

/// Where clients connect: the loopback address first, because it is the same on every machine.
pub(super) fn endpoint(session: &Session) -> String {
    let locators = session.info().locators().wait();
    let mut locators: Vec<String> = locators.iter().map(ToString::to_string).collect();
    locators.sort_by_key(|l| !l.contains("127.0.0.1"));
    locators.into_iter().next().unwrap_or_else(|| "none".to_owned())
}

/// The configuration in a file.
pub(super) fn from_file(path: &Path) -> Result<Config, LiveError> {
    let unread = |why: String| LiveError::Config { path: path.to_path_buf(), why };
    files::open(path).map_err(|e| unread(e.to_string()))?;
    Config::from_file(path).map_err(|e| unread(plain(&e)))
}

pub(super) fn set(config: &mut Config, key: &str, value: &serde_json::Value) -> Result<(), LiveError> {
    config.insert_json5(key, &value.to_string()).map_err(|e| LiveError::Open { why: plain(&e) })
}

fn is_endpoint(endpoint: &str) -> Result<(), LiveError> {
    let parsed = endpoint.parse::<EndPoint>();
    parsed.map(drop).map_err(|_| LiveError::Endpoint { endpoint: endpoint.to_owned() })
}

fn port(endpoint: &str) -> Option<u16> {
    let endpoint: EndPoint = endpoint.parse().ok()?;
    let address = endpoint.address();
    address.as_str().rsplit_once(':')?.1.parse().ok()
}

/// Whether zenoh could not listen because another process has the port. It says so only in words, with the number of
/// the system's error.
fn in_use(error: &zenoh::Error) -> bool {
    let text = error.to_string();
    let mut codes = text.split("os error ").skip(1).filter_map(|rest| {
        let digits = rest.split(|c: char| !c.is_ascii_digit()).next();
        digits.and_then(|digits| digits.parse().ok())
    });
    codes.any(|code| io::Error::from_raw_os_error(code).kind() == io::ErrorKind::AddrInUse)
}

/// zenoh's message without positions in its source (` at /…/file.rs:12.`).
pub(super) fn plain(error: &zenoh::Error) -> String {
    let mut words: Vec<String> = Vec::new();
    for word in error.to_string().split_whitespace() {
        if word.contains(".rs:") && words.last().is_some_and(|w| w == "at") {
            words.pop();
        } else {
            words.push(word.to_owned());
        }
    }
    words.join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_file_given_goes_before_the_one_of_the_environment() {
        let from_env = Some(PathBuf::from("/nowhere/env.json5"));
        let mut options = LiveOptions::new("run_1".to_owned());
        let file = |options: &LiveOptions| match opened(options, from_env.clone()).err() {
            Some(LiveError::Config { path, .. }) => path,
            other => panic!("neither file exists: {other:?}"),
        };
        assert_eq!(file(&options), PathBuf::from("/nowhere/env.json5"));
        options.config_file = Some("/nowhere/given.json5".into());
        assert_eq!(file(&options), PathBuf::from("/nowhere/given.json5"));
    }

    #[test]
    fn where_all_its_ports_are_taken_a_run_has_another_and_says_so() {
        let others = TcpListener::bind("127.0.0.1:0").unwrap();
        let taken = others.local_addr().unwrap().port();
        let OpenedSession { session, told } = at_a_free_port(taken..=taken, true).unwrap();
        let end = endpoint(&session);
        assert!(end.starts_with("tcp/127.0.0.1:") && port(&end) != Some(taken));
        let notice = told.notice.unwrap();
        for says in [format!("ports {taken} to {taken} "), format!("--connect {end})")] {
            assert!(notice.contains(&says), "{notice}");
        }
        session.close().wait().unwrap();
    }
}
