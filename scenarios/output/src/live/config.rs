//! The configuration of the zenoh session: where it listens, unless a file says so.

use super::{DEFAULT_PORT, LiveError, LiveOptions};
use std::net::{SocketAddr, TcpListener};
use std::path::{Path, PathBuf};
use world::files;
use zenoh::Config;
use zenoh::config::EndPoint;

/// Number of ports after the default one that are tried.
pub(super) const SPARE_PORTS: u16 = 16;

/// Where zenoh's configuration says how many batches of 64 kB wait for a subscriber.
const QUEUE: &str = "transport/link/tx/queue/size/data";

/// As many as zenoh allows, 1 MB. With its default of two, one plume of 10 000 points fills the queue. On a busy machine
/// the sending thread then runs too late, and a healthy subscriber loses what follows: digest and last clock of a run.
const BATCHES: usize = 16;

/// The configuration, and a line for the user if necessary.
pub(super) fn configured(
    options: &LiveOptions,
    from_env: Option<PathBuf>,
) -> Result<(Config, Option<String>), LiveError> {
    if let Some(path) = options.config_file.clone().or(from_env) {
        let mut config = from_file(&path)?;
        if let Some(endpoint) = &options.listen {
            free_port_of(endpoint)?;
            set(
                &mut config,
                "listen/endpoints",
                &serde_json::json!([endpoint]),
            )?;
        }
        return Ok((config, None));
    }
    let (endpoint, notice) = match &options.listen {
        Some(endpoint) => {
            free_port_of(endpoint)?;
            (endpoint.clone(), None)
        }
        None => default_endpoint()?,
    };
    // Nodes of ROS expect a router at the default port: if it is not this session, then this session joins it.
    let (joined, notice) = match notice {
        Some(notice) if options.ros2.is_some() => {
            let router = format!("tcp/127.0.0.1:{DEFAULT_PORT}");
            let notice = format!("{notice}, and connects to {router} for ROS 2");
            (Some(router), Some(notice))
        }
        notice => (None, notice),
    };
    let mut config = Config::default();
    set(&mut config, "mode", &"router".into())?;
    set(
        &mut config,
        "listen/endpoints",
        &serde_json::json!([endpoint]),
    )?;
    match joined {
        Some(router) => set(
            &mut config,
            "connect/endpoints",
            &serde_json::json!([router]),
        )?,
        // A router waits so long for those whom it may find, half a second by default; it looks for nobody here.
        None => set(&mut config, "scouting/delay", &0.into())?,
    }
    // Multicast is slow or refused on many machines; clients are told the endpoint instead.
    set(&mut config, "scouting/multicast/enabled", &false.into())?;
    set(&mut config, QUEUE, &BATCHES.into())?;
    Ok((config, notice))
}

/// The configuration in a file.
pub(super) fn from_file(path: &Path) -> Result<Config, LiveError> {
    let unread = |why: String| LiveError::Config {
        path: path.to_path_buf(),
        why,
    };
    files::open(path).map_err(|e| unread(e.to_string()))?;
    Config::from_file(path).map_err(|e| unread(plain(&e)))
}

pub(super) fn set(
    config: &mut Config,
    key: &str,
    value: &serde_json::Value,
) -> Result<(), LiveError> {
    config
        .insert_json5(key, &value.to_string())
        .map_err(|e| LiveError::Open { why: plain(&e) })
}

fn default_endpoint() -> Result<(String, Option<String>), LiveError> {
    let last = DEFAULT_PORT + SPARE_PORTS;
    let free = |port: &u16| TcpListener::bind(("127.0.0.1", *port)).is_ok();
    let port = (DEFAULT_PORT..=last)
        .find(free)
        .ok_or(LiveError::NoFreePort {
            first: DEFAULT_PORT,
            last,
        })?;
    let endpoint = format!("tcp/127.0.0.1:{port}");
    let notice = (port != DEFAULT_PORT)
        .then(|| format!("port {DEFAULT_PORT} is already in use: zenoh listens on {endpoint}"));
    Ok((endpoint, notice))
}

/// Reports a busy port before zenoh does, with a message that names the cure.
fn free_port_of(endpoint: &str) -> Result<(), LiveError> {
    let bad = || LiveError::Endpoint {
        endpoint: endpoint.to_owned(),
    };
    let parsed: EndPoint = endpoint.parse().map_err(|_| bad())?;
    if !matches!(parsed.protocol().as_str(), "tcp" | "tls") {
        return Ok(());
    }
    // zenoh itself interprets names, and options after the address.
    let Ok(address) = parsed.address().as_str().parse::<SocketAddr>() else {
        return Ok(());
    };
    match TcpListener::bind(address) {
        Err(e) if e.kind() == std::io::ErrorKind::AddrInUse => Err(LiveError::BusyPort {
            endpoint: endpoint.to_owned(),
            port: address.port(),
        }),
        _ => Ok(()),
    }
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
        let file = |options: &LiveOptions| match configured(options, from_env.clone()) {
            Err(LiveError::Config { path, .. }) => path,
            other => panic!("neither file exists: {other:?}"),
        };
        assert_eq!(file(&options), PathBuf::from("/nowhere/env.json5"));
        options.config_file = Some("/nowhere/given.json5".into());
        assert_eq!(file(&options), PathBuf::from("/nowhere/given.json5"));
    }
}
