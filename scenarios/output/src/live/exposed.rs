//! Whether anybody who reaches a run from another machine may control it.

use std::net::SocketAddr;
use std::path::Path;
use world::files;
use zenoh::Config;
use zenoh::config::EndPoint;

/// Longest dictionary that is read, bytes.
const LONGEST: u64 = 1 << 20;

/// What the user is told of a run that may be controlled, if its configuration lets in whoever comes from elsewhere.
pub(super) fn warning(config: &Config) -> Option<String> {
    let said = |key: &str| {
        let text = config.get_json(key).unwrap_or_default();
        serde_json::from_str(&text).unwrap_or(serde_json::Value::Null)
    };
    // zenoh takes an empty dictionary for none.
    let users = said("transport/auth/usrpwd/dictionary_file");
    let users = users
        .as_str()
        .and_then(|file| files::read_text(Path::new(file), LONGEST).ok());
    let users = users.is_some_and(|text| !text.trim().is_empty());
    if users || said("access_control/enabled") == true {
        return None;
    }
    let certified = said("transport/link/tls/enable_mtls") == true;
    let listens = said("listen/endpoints");
    // Either one list, or one for each mode.
    let listens = match said("mode").as_str() {
        Some(mode) if listens.is_object() => &listens[mode],
        _ => &listens,
    };
    let open: Vec<&str> = (listens.as_array().into_iter().flatten())
        .filter_map(|endpoint| endpoint.as_str())
        .filter(|endpoint| is_open(endpoint, certified))
        .collect();
    (!open.is_empty()).then(|| {
        format!(
            "--allow-control without users or access control: whoever reaches {} can control this run; \
             see docs/wire.md for configurations that tell who may",
            open.join(", ")
        )
    })
}

/// Whether other machines reach an endpoint without a certificate.
fn is_open(endpoint: &str, certified: bool) -> bool {
    let Ok(endpoint) = endpoint.parse::<EndPoint>() else {
        return false;
    };
    match endpoint.protocol().as_str() {
        "unixsock-stream" => false,
        "tls" if certified => false,
        _ => {
            let address = endpoint.address();
            match address.as_str().parse::<SocketAddr>() {
                Ok(address) => !address.ip().is_loopback(),
                Err(_) => !address.as_str().starts_with("localhost:"),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn warned(config: &str) -> bool {
        warning(&Config::from_json5(config).expect("legal")).is_some()
    }

    #[test]
    fn only_what_listens_beyond_loopback_is_open() {
        for (endpoint, open) in [
            ("tcp/127.0.0.1:7447", false),
            ("tcp/[::1]:7447", false),
            ("tls/localhost:7447", false),
            ("unixsock-stream/run.sock", false),
            ("tcp/0.0.0.0:7447", true),
            ("tcp/[::]:7447", true),
            ("tcp/192.168.1.5:7447#iface=eth0", true),
            ("tls/ship.example:7447", true),
        ] {
            let text = format!("{{ mode: 'router', listen: {{ endpoints: ['{endpoint}'] }} }}");
            assert_eq!(warned(&text), open, "{endpoint}");
        }
        // zenoh's own default, on all interfaces.
        assert!(warned("{ mode: 'router' }"));
        assert!(warned("{ mode: 'peer' }"));
        let each =
            "listen: { endpoints: { router: ['tcp/127.0.0.1:0'], peer: ['tcp/0.0.0.0:0'] } }";
        assert!(!warned(&format!("{{ mode: 'router', {each} }}")));
        assert!(warned(&format!("{{ mode: 'peer', {each} }}")));
        assert!(!warned("{ mode: 'client' }"), "a client does not listen");
    }

    #[test]
    fn users_access_control_and_client_certificates_close_it() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("users.txt");
        let with = |protocol: &str, more: &str| {
            let listen = format!("listen: {{ endpoints: ['{protocol}/0.0.0.0:7447'] }}");
            warned(&format!("{{ mode: 'router', {listen}, {more} }}"))
        };
        let users = format!("transport: {{ auth: {{ usrpwd: {{ dictionary_file: {file:?} }} }} }}");
        std::fs::write(&file, "\n").unwrap();
        assert!(with("tcp", &users), "nobody is in it");
        std::fs::write(&file, "pilot:secret\n").unwrap();
        assert!(!with("tcp", &users));
        assert!(with("tcp", "access_control: { enabled: false }"));
        assert!(!with("tcp", "access_control: { enabled: true }"));
        let mutual = "transport: { link: { tls: { enable_mtls: true } } }";
        assert!(!with("tls", mutual));
        assert!(with("tcp", mutual), "no certificate is asked for there");
        assert!(with(
            "tls",
            "transport: { link: { tls: { enable_mtls: false } } }"
        ));
    }
}
