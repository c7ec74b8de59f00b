//! Whether anybody who reaches a run from another machine may control it.
//!
//! zenoh's configuration says by which ways others come: the endpoints where the session listens, those to which it
//! connects, and those whom it finds by multicast and connects to. Users and client certificates are asked of those who
//! come; to whom a session connects by itself, it proves who it is and asks for nothing but, over TLS, the certificate.

use super::{LiveError, LiveOptions};
use serde_json::Value;
use std::net::SocketAddr;
use std::path::Path;
use world::files;
use zenoh::Config;
use zenoh::config::EndPoint;

/// Longest dictionary that is read, bytes.
const LONGEST: u64 = 1 << 20;

/// What the user is told of a run that may be controlled by whoever comes from elsewhere.
///
/// # Errors
/// [`LiveError::Exposed`] if that is not allowed.
pub(super) fn warning(config: &Config, options: &LiveOptions) -> Result<Option<String>, LiveError> {
    let ways = ways(config);
    if ways.is_empty() || !options.plane.allowed() {
        return Ok(None);
    }
    let ways = ways.join(", ");
    if !options.control_from_anywhere {
        return Err(LiveError::Exposed { ways });
    }
    Ok(Some(format!(
        "without users or access control, anybody on the network can control this: {ways}; see docs/interfaces.md for \
         configurations that tell who may"
    )))
}

/// The ways by which others than users of this machine come without saying who they are.
fn ways(config: &Config) -> Vec<String> {
    let said = SessionConfig::from_config(config);
    if said.value("access_control/enabled") == true && said.value("access_control/default_permission") != "allow" {
        return Vec::new();
    }
    let certified = said.value("transport/link/tls/enable_mtls") == true;
    let users = said.users();
    let mut ways = Vec::new();
    for endpoint in texts(&said.of_mode("listen/endpoints")) {
        if !(users || certified && is_tls(&endpoint)) && is_beyond(&endpoint) {
            ways.push(format!("it listens on {endpoint}"));
        }
    }
    let connects = texts(&said.of_mode("connect/endpoints"));
    for endpoint in &connects {
        if !is_tls(endpoint) && is_beyond(endpoint) {
            ways.push(format!("it connects to {endpoint}"));
        }
    }
    if said.scouts(connects.is_empty()) {
        ways.push("it connects to whoever answers by multicast".to_owned());
    }
    ways
}

/// A configuration, and the mode of its session.
struct SessionConfig<'a> {
    config: &'a Config,
    mode: String,
}

impl<'a> SessionConfig<'a> {
    fn from_config(config: &'a Config) -> Self {
        let mut said = Self { config, mode: String::new() };
        // zenoh's own default.
        said.mode = said.value("mode").as_str().unwrap_or("peer").to_owned();
        said
    }

    /// What it says at a key; null where it leaves zenoh's default.
    fn value(&self, key: &str) -> Value {
        let text = self.config.get_json(key).unwrap_or_default();
        serde_json::from_str(&text).unwrap_or_default()
    }

    /// The same where there may be one value for each mode.
    fn of_mode(&self, key: &str) -> Value {
        match self.value(key) {
            Value::Object(mut modes) => modes.remove(&self.mode).unwrap_or_default(),
            value => value,
        }
    }

    /// Whether those who come have to know a password.
    fn users(&self) -> bool {
        let dictionary = self.value("transport/auth/usrpwd/dictionary_file");
        let text = (dictionary.as_str()).and_then(|file| files::read_text(Path::new(file), LONGEST).ok());
        // zenoh takes an empty dictionary for none.
        text.is_some_and(|text| !text.trim().is_empty())
    }

    /// Whether it looks for others by multicast and connects to them; a client does so only if it is told nobody.
    fn scouts(&self, alone: bool) -> bool {
        let scouting = "scouting/multicast";
        let whom = match self.of_mode(&format!("{scouting}/autoconnect")) {
            Value::Null => self.mode != "router",
            Value::Array(whom) => !whom.is_empty(),
            whom => whom != "",
        };
        let only_tls = matches!(&self.value("transport/link/protocols"),
            Value::Array(all) if !all.is_empty() && all.iter().all(|protocol| protocol == "tls"));
        self.value(&format!("{scouting}/enabled")) != false && whom && (self.mode != "client" || alone) && !only_tls
    }
}

/// All endpoints of a list, in which groups of them may stand.
fn texts(list: &Value) -> Vec<String> {
    match list {
        Value::String(endpoint) => vec![endpoint.clone()],
        Value::Array(all) => all.iter().flat_map(texts).collect(),
        Value::Object(group) => group.get("locators").map_or(Vec::new(), texts),
        _ => Vec::new(),
    }
}

fn is_tls(endpoint: &str) -> bool {
    endpoint.starts_with("tls/")
}

/// Whether an endpoint is one of the network, and not of this machine alone.
fn is_beyond(endpoint: &str) -> bool {
    let Ok(endpoint) = endpoint.parse::<EndPoint>() else {
        return false;
    };
    if endpoint.protocol().as_str() == "unixsock-stream" {
        return false;
    }
    let address = endpoint.address();
    match address.as_str().parse::<SocketAddr>() {
        Ok(address) => !address.ip().to_canonical().is_loopback(),
        Err(_) => !address.as_str().starts_with("localhost:"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn open(config: &str) -> bool {
        !ways(&Config::from_json5(config).expect("legal")).is_empty()
    }

    /// No multicast, and these lines.
    fn quiet(lines: &str) -> bool {
        open(&format!("{{ scouting: {{ multicast: {{ enabled: false }} }}, {lines} }}"))
    }

    #[test]
    fn only_what_listens_or_connects_beyond_loopback_is_open() {
        for (endpoint, beyond) in [
            ("tcp/127.0.0.1:7447", false),
            ("tcp/[::1]:7447", false),
            ("tcp/[::ffff:127.0.0.1]:7447", false),
            ("tcp/localhost:7447", false),
            ("unixsock-stream/run.sock", false),
            ("tcp/0.0.0.0:7447", true),
            ("tcp/[::]:7447", true),
            ("tcp/192.168.1.5:7447#iface=eth0", true),
            ("tcp/ship.example:7447", true),
        ] {
            let listens = format!("listen: {{ endpoints: ['{endpoint}'] }}");
            let nowhere = "listen: { endpoints: [] }";
            let group = format!("{{ strategy: 'allOf', locators: ['{endpoint}'] }}");
            let connects = |to: &str| format!("{nowhere}, connect: {{ endpoints: [{to}] }}");
            for lines in [listens, connects(&format!("'{endpoint}'")), connects(&group)] {
                assert_eq!(quiet(&lines), beyond, "{lines}");
            }
        }
        let each = "endpoints: { router: ['tcp/127.0.0.1:0'], peer: ['tcp/0.0.0.0:0'] }";
        for (mode, beyond) in [("router", false), ("peer", true), ("client", false)] {
            let listens = format!("mode: '{mode}', listen: {{ {each} }}");
            assert_eq!(quiet(&listens), beyond, "{mode}");
        }
    }

    #[test]
    fn what_zenoh_does_by_default_is_open() {
        for all in ["{}", "{ mode: 'peer' }", "{ mode: 'router' }"] {
            assert!(open(all), "{all}");
        }
        assert!(quiet("") && quiet("mode: 'router'"), "all interfaces");
        assert!(!quiet("mode: 'client'"), "a client does not listen");
    }

    #[test]
    fn whoever_is_found_by_multicast_comes_in_wherever_it_listens() {
        let here = "listen: { endpoints: ['tcp/127.0.0.1:0'] }";
        let with = |lines: &str| open(&format!("{{ {here}, {lines} }}"));
        assert!(with("") && with("mode: 'client'") && with("mode: 'peer'"));
        assert!(!with("mode: 'router'"), "a router connects to nobody");
        let told = "connect: { endpoints: ['tcp/127.0.0.1:7447'] }";
        assert!(with(told));
        assert!(!with(&format!("mode: 'client', {told}")));
        let whom = |whom: &str| format!("scouting: {{ multicast: {{ autoconnect: {whom} }} }}");
        assert!(!with(&whom("[]")) && !with(&whom("{ peer: [] }")));
        assert!(with(&whom("{ router: [] }")) && with(&whom("['router']")));
        let asked = whom("{ router: ['peer'] }");
        assert!(with(&format!("mode: 'router', {asked}")));
        assert!(!with("transport: { link: { protocols: ['tls'] } }"));
        assert!(with("transport: { link: { protocols: ['tls', 'tcp'] } }"));
    }

    #[test]
    fn users_access_control_and_certificates_close_it() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("users.txt");
        let with = |protocol: &str, more: &str| {
            quiet(&format!("listen: {{ endpoints: ['{protocol}/0.0.0.0:7447'] }}, {more}"))
        };
        let users = format!("transport: {{ auth: {{ usrpwd: {{ dictionary_file: {file:?} }} }} }}");
        std::fs::write(&file, "\n").unwrap();
        assert!(with("tcp", &users), "nobody is in it");
        std::fs::write(&file, "pilot:secret\n").unwrap();
        assert!(!with("tcp", &users));
        assert!(open(&format!("{{ {users} }}")), "found by multicast");
        let router = "connect: { endpoints: ['tcp/192.168.1.5:7447'] }";
        assert!(with("tcp", &format!("{users}, {router}")));
        assert!(!with("tcp", &format!("{users}, {}", router.replace("tcp", "tls"))));
        assert!(with("tcp", "access_control: { enabled: false }"));
        let nobody = "rules: [], subjects: [], policies: []";
        let deny = format!("access_control: {{ enabled: true, default_permission: 'deny', {nobody} }}");
        assert!(!with("tcp", &deny) && !open(&format!("{{ {deny} }}")));
        assert!(with("tcp", &deny.replace("deny", "allow")));
        let mutual = "transport: { link: { tls: { enable_mtls: true } } }";
        assert!(!with("tls", mutual));
        assert!(with("tcp", mutual), "no certificate is asked for there");
        assert!(with("tls", &mutual.replace("true", "false")));
    }
}
