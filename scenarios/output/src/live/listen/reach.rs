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
pub(super) fn reached(
    options: &ListenOptions,
    from_env: Option<PathBuf>,
) -> Result<(Config, String), LiveError> {
    if let Some(endpoint) = &options.connect {
        checked(endpoint)?;
    }
    if let Some(path) = options.config_file.clone().or(from_env) {
        let mut config = from_file(&path)?;
        let mut place = format!("the endpoints of {}", path.display());
        if let Some(endpoint) = &options.connect {
            set(&mut config, "connect/endpoints", &json!([endpoint]))?;
            place.clone_from(endpoint);
        }
        return Ok((config, place));
    }
    let (endpoints, place) = match &options.connect {
        Some(endpoint) => (vec![endpoint.clone()], endpoint.clone()),
        None => {
            let last = DEFAULT_PORT + SPARE_PORTS;
            let all = (DEFAULT_PORT..=last).map(|port| format!("tcp/127.0.0.1:{port}"));
            (
                all.collect(),
                format!("tcp/127.0.0.1:{DEFAULT_PORT} to {last}"),
            )
        }
    };
    let mut config = Config::default();
    let [first, most] = RETRY_MS;
    for (key, value) in [
        // A client would take the first run that answers, and give up where there is none yet.
        ("mode", json!("peer")),
        ("listen/endpoints", json!([])),
        ("connect/endpoints", json!(endpoints)),
        ("connect/retry/period_init_ms", json!(first)),
        ("connect/retry/period_max_ms", json!(most)),
        ("scouting/delay", json!(0)),
        ("scouting/multicast/enabled", json!(false)),
        // Otherwise it would pass the address of each run on to the others.
        ("scouting/gossip/enabled", json!(false)),
    ] {
        set(&mut config, key, &value)?;
    }
    Ok((config, place))
}

/// zenoh tries an address without a port for ever, and says nothing.
fn checked(endpoint: &str) -> Result<(), LiveError> {
    let bad = || LiveError::Endpoint {
        endpoint: endpoint.to_owned(),
    };
    let parsed: EndPoint = endpoint.parse().map_err(|_| bad())?;
    let port = |address: &str| {
        let (host, port) = address.rsplit_once(':')?;
        (!host.is_empty()).then(|| port.parse::<u16>().ok())?
    };
    match parsed.protocol().as_str() {
        "tcp" | "tls" => port(parsed.address().as_str()).map(|_| ()).ok_or_else(bad),
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_endpoint_has_a_protocol_a_host_and_a_port() {
        for good in [
            "tcp/127.0.0.1:7447",
            "tcp/[::1]:7447",
            "tls/ship.example:1",
            "unixsock-stream/run.sock",
        ] {
            assert_eq!(checked(good), Ok(()), "{good}");
        }
        for bad in [
            "",
            "127.0.0.1:7447",
            "tcp/127.0.0.1",
            "tcp/:7447",
            "tcp/host:port",
            "tcp/host:70000",
        ] {
            assert!(
                matches!(checked(bad), Err(LiveError::Endpoint { .. })),
                "{bad}"
            );
        }
    }

    #[test]
    fn an_endpoint_goes_before_those_of_a_file_and_a_file_before_the_ports_of_runs() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("client.json5");
        std::fs::write(
            &file,
            "{ mode: 'client', connect: { endpoints: ['tcp/127.0.0.1:1'] } }",
        )
        .unwrap();
        let place = |connect: Option<&str>, file: Option<&PathBuf>| {
            let options = ListenOptions {
                connect: connect.map(str::to_owned),
                config_file: file.cloned(),
                ..ListenOptions::default()
            };
            let (config, place) = reached(&options, None).unwrap();
            let endpoints = config.get_json("connect/endpoints").unwrap();
            (endpoints.matches("tcp/").count(), endpoints, place)
        };
        assert_eq!(place(None, None).0, 17);
        assert_eq!(place(None, None).2, "tcp/127.0.0.1:7447 to 7463");
        assert!(place(None, Some(&file)).1.contains(":1\""));
        let (count, endpoints, said) = place(Some("tcp/127.0.0.1:2"), Some(&file));
        assert!(count == 1 && endpoints.contains(":2\""), "{endpoints}");
        assert_eq!(said, "tcp/127.0.0.1:2");
    }
}
