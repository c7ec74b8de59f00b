//! Where a listener connects: the ports that runs on this machine take, an endpoint, or what a file says.

use super::super::config::{SPARE_PORTS, from_file, set};
use super::super::{DEFAULT_PORT, ListenOptions, LiveError};
use serde_json::json;
use std::path::PathBuf;
use zenoh::Config;
use zenoh::config::EndPoint;

/// Shortest and longest time between two attempts to connect, ms. A run of a small scenario takes a second.
const RETRY_MS: [u64; 2] = [100, 250];

/// The configuration, and where that is, in words.
pub(super) fn reached(options: &ListenOptions, from_env: Option<PathBuf>) -> Result<(Config, String), LiveError> {
    let file = options.config_file.clone().or(from_env);
    let (mut config, mut place) = match &file {
        Some(path) => (from_file(path)?, format!("the endpoints of {}", path.display())),
        None => default_ports()?,
    };
    if let Some(endpoint) = &options.connect {
        check(endpoint)?;
        set(&mut config, "connect/endpoints", &json!([endpoint]))?;
        place.clone_from(endpoint);
    }
    Ok((config, place))
}

/// All ports that runs take by default.
fn default_ports() -> Result<(Config, String), LiveError> {
    let last = DEFAULT_PORT + SPARE_PORTS;
    let all = (DEFAULT_PORT..=last).map(|port| format!("tcp/127.0.0.1:{port}"));
    let endpoints: Vec<String> = all.collect();
    let mut config = Config::default();
    let [first, most] = RETRY_MS;
    for (key, value) in [
        // A client would take the first run that answers, and give up where there is none yet.
        ("mode", json!("peer")),
        ("listen/endpoints", json!([])),
        ("connect/endpoints", json!(endpoints)),
        ("connect/retry", json!({"period_init_ms": first, "period_max_ms": most})),
        ("scouting/delay", json!(0)),
        ("scouting/multicast/enabled", json!(false)),
        // Otherwise it would pass the address of each run on to the others.
        ("scouting/gossip/enabled", json!(false)),
    ] {
        set(&mut config, key, &value)?;
    }
    Ok((config, format!("tcp/127.0.0.1:{DEFAULT_PORT} to {last}")))
}

/// zenoh tries an address without a port for ever, and says nothing.
fn check(endpoint: &str) -> Result<(), LiveError> {
    let whole = endpoint.parse::<EndPoint>().is_ok_and(|parsed| {
        let (protocol, address) = (parsed.protocol(), parsed.address());
        let port = address.as_str().rsplit_once(':').map(|(_, port)| port);
        !["tcp", "tls"].contains(&protocol.as_str()) || port.is_some_and(|port| port.parse::<u16>().is_ok())
    });
    whole.then_some(()).ok_or_else(|| LiveError::Endpoint { endpoint: endpoint.to_owned() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_endpoint_has_a_protocol_and_a_port() {
        for good in ["tcp/127.0.0.1:7447", "tcp/[::1]:7447", "tls/ship.example:1", "unixsock-stream/run.sock"] {
            assert_eq!(check(good), Ok(()), "{good}");
        }
        for bad in ["", "127.0.0.1:7447", "tcp/127.0.0.1", "tcp/host:70000"] {
            assert!(check(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn an_endpoint_goes_before_those_of_a_file_and_a_file_before_the_ports_of_runs() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("client.json5");
        let text = "{ mode: 'client', connect: { endpoints: ['tcp/127.0.0.1:1'] } }";
        std::fs::write(&file, text).unwrap();
        let endpoints = |connect: Option<&str>, config_file: Option<PathBuf>| {
            let options =
                ListenOptions { connect: connect.map(str::to_owned), config_file, ..ListenOptions::default() };
            let (config, place) = reached(&options, None).unwrap();
            (config.get_json("connect/endpoints").unwrap(), place)
        };
        let (all, place) = endpoints(None, None);
        assert_eq!(all.matches("tcp/").count(), 64);
        assert_eq!(place, "tcp/127.0.0.1:7447 to 7510");
        assert!(endpoints(None, Some(file.clone())).0.contains(":1\""));
        let (one, place) = endpoints(Some("tcp/127.0.0.1:2"), Some(file));
        assert!(!one.contains(":1\"") && one.contains(":2\""), "{one}");
        assert_eq!(place, "tcp/127.0.0.1:2");
    }
}
