//! Ports, endpoints and configurations, with the words a user reads when one is wrong.

use super::kit::{client, kept, meta, options};
use crate::common::{free_endpoint, says};
use output::live::{Live, LiveError, LiveOptions};
use std::collections::BTreeSet;
use std::net::TcpListener;
use std::sync::Barrier;
use std::thread;
use zenoh::Wait;

#[test]
fn a_busy_port_is_named_with_the_cure() {
    let other = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = other.local_addr().unwrap().port();
    let endpoint = format!("tcp/127.0.0.1:{port}");
    let options = LiveOptions { listen: Some(endpoint.clone()), ..options("busy_1") };
    let error = Live::start(&options, meta()).unwrap_err();
    says(&error.to_string(), &[&endpoint, "--zenoh-listen", "--no-zenoh"]);
    assert_eq!(error, LiveError::BusyPort { endpoint, port });
}

#[test]
fn without_a_port_given_the_next_free_one_is_taken_and_told() {
    const FIRST: &str = "tcp/127.0.0.1:7447";
    let options = LiveOptions { listen: None, ..options("default_1") };
    // Whoever holds it, ourselves or another program: it is busy. Another program may let it go before the run begins;
    // then we hold it at one of the next tries.
    let tries = (0..1000).find_map(|_| {
        let held = TcpListener::bind(FIRST.trim_start_matches("tcp/"));
        let live = Live::start(&options, meta()).unwrap();
        (held.is_ok() || live.endpoint() != FIRST).then_some((held, live))
    });
    let (_held, live) = tries.expect("others take the port and let it go each time");
    assert_ne!(live.endpoint(), FIRST);
    says(live.notice().expect("it is told"), &["7447", live.endpoint()]);
    let session = client(live.endpoint());
    assert!(kept(&session, "default_1").contains_key("meta/version"));
    session.close().wait().unwrap();
}

/// Many more than would meet at a port that was only tried before.
#[test]
fn runs_that_start_together_each_hold_a_port() {
    const RUNS: usize = 8;
    let together = Barrier::new(RUNS);
    let lives: Vec<Live> = thread::scope(|scope| {
        let starts: Vec<_> = (0..RUNS)
            .map(|k| {
                let together = &together;
                scope.spawn(move || {
                    let options = LiveOptions { listen: None, ..options(&format!("together_{k}")) };
                    together.wait();
                    Live::start(&options, meta()).expect("there are ports enough")
                })
            })
            .collect();
        starts.into_iter().map(|s| s.join().unwrap()).collect()
    });
    let ends: BTreeSet<&str> = lives.iter().map(Live::endpoint).collect();
    assert_eq!(ends.len(), RUNS, "{ends:?}");
    // Each is where it says.
    for (k, live) in lives.iter().enumerate() {
        let session = client(live.endpoint());
        assert!(kept(&session, &format!("together_{k}")).contains_key("meta/version"));
        session.close().wait().unwrap();
    }
}

#[test]
fn a_configuration_file_is_honoured_whole() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("zenoh.json5");
    let endpoint = free_endpoint();
    let text = format!(
        r#"{{ mode: "peer", listen: {{ endpoints: ["{endpoint}"] }}, scouting: {{ multicast: {{ enabled: false }} }} }}"#
    );
    std::fs::write(&file, text).unwrap();
    let options = LiveOptions { listen: None, config_file: Some(file), ..options("config_1") };
    let live = Live::start(&options, meta()).unwrap();
    assert_eq!(live.endpoint(), endpoint);
    assert_eq!(live.notice(), None);
    let session = client(live.endpoint());
    assert_eq!(session.info().peers_zid().wait().count(), 1, "the file says peer, so a peer it is");
    assert!(kept(&session, "config_1").contains_key("meta/version"));
    session.close().wait().unwrap();
}

#[test]
fn a_wrong_configuration_or_endpoint_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("missing.json5");
    let wrong = folder.path().join("wrong.json5");
    std::fs::write(&wrong, r#"{ mode: "captain" }"#).unwrap();
    for file in [missing, wrong] {
        let options = LiveOptions { config_file: Some(file.clone()), ..options("wrong_1") };
        let text = Live::start(&options, meta()).unwrap_err().to_string();
        let named = format!("zenoh configuration {}: ", file.display());
        assert!(text.starts_with(&named) && !text.contains(".rs:"), "{text}");
    }
    let options = LiveOptions { listen: Some("7447".to_owned()), ..options("wrong_1") };
    says(&Live::start(&options, meta()).unwrap_err().to_string(), &["`7447`", "tcp/127.0.0.1:7447"]);
}
