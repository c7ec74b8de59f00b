//! Who may do what on the wire: the configurations of `docs/zenoh`, each with a real run and real sessions.

use super::certificates::Authority;
use super::kit::{AMP, Run, channel, client, controller, endless, external, opened, patience_ms};
use super::plane::command;
use super::rogue::{Rogue, Watcher, samples};
use crate::common::{Ended, command as rheotaxis, root, says};
use crate::waits::until;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use zenoh::handlers::FifoChannelHandler;
use zenoh::query::{Queryable, Reply};
use zenoh::{Config, Session, Wait};

const LOOPBACK: &str = "tcp/127.0.0.1";

/// A run that asks and, if nobody answers, goes on until a test ends it.
fn asks() -> String {
    endless(&external("Hold"))
}

fn example(name: &str) -> PathBuf {
    root().join("docs/zenoh").join(name)
}

/// A run with a configuration of the docs.
fn secured(name: &str, listen: &str, text: &str, more: &[&str], prepare: impl FnOnce(&Path)) -> Run {
    let config = example(name);
    let mut args = vec!["--zenoh-config", config.to_str().expect("a plain path")];
    args.extend(more);
    Run::at(listen, text, &args, prepare)
}

/// A client's configuration of the docs, with some values changed. It tries again until the run listens, or only once.
fn client_config(name: &str, endpoint: &str, patient: bool, values: &[(&str, Value)]) -> Config {
    let mut config = Config::from_file(example(name)).expect("legal");
    let mut set = |key: &str, value: &Value| {
        let set = config.insert_json5(key, &value.to_string());
        set.expect("a key of zenoh");
    };
    set("connect/endpoints", &json!([endpoint]));
    set("connect/timeout_ms", &json!(if patient { patience_ms() as u64 } else { 0 }));
    for (key, value) in values {
        set(key, value);
    }
    config
}

/// No session comes of it.
#[track_caller]
fn refused(config: Config) {
    assert!(zenoh::open(config).wait().is_err());
}

/// Answers the questions of `auv0`, and counts them.
fn counted(session: &Session) -> (Queryable<()>, Arc<AtomicU64>) {
    let asked = Arc::new(AtomicU64::new(0));
    let count = Arc::clone(&asked);
    let queryable = controller(session, "auv0", move |_| {
        count.fetch_add(1, Ordering::SeqCst);
        json!({"steer": {"heading_rad": 1.5, "altitude_m": 3, "speed_m_s": 1.5}}).to_string()
    });
    (queryable, asked)
}

#[test]
fn watchers_see_a_run_that_nobody_can_touch() {
    let nobody = ["--allow-control", "--control-wait", "0", "--speed", "3"];
    let run = secured("watchers.json5", LOOPBACK, &asks(), &nobody, |_| {});
    let watcher = Watcher::new(client(&run.endpoint));
    let rogues = ["client", "peer", "router"].map(|mode| Rogue::at(&run.endpoint, mode));
    let [replies, forged] = watcher.asks();
    assert!(replies > 0 && forged == 0, "{replies} {forged}");
    assert_eq!(watcher.tokens(), ["sim"]);
    watcher.hears(20, 0);
    let end = run.interrupt();
    watcher.see_it_end();
    assert_eq!(watcher.heard()[1], 0);
    assert_eq!(end.count(0, "asked"), end.count(0, "absent"));
    end.run_again();
    for rogue in rogues {
        assert_eq!(rogue.asked(), 0);
        rogue.leave();
    }
}

#[test]
fn without_a_configuration_a_rogue_is_heard_but_changes_nothing_by_publishing() {
    // Slow enough that the source is found long after a test has ended it.
    let run = Run::start(&endless(AMP), &["--speed", "0.5"]);
    let watcher = Watcher::new(client(&run.endpoint));
    let rogue = Rogue::at(&run.endpoint, "client");
    let [replies, forged] = watcher.asks();
    assert!(replies > 1 && forged == 1, "{replies} {forged}");
    assert_eq!(watcher.tokens(), ["client", "sim"]);
    watcher.hears(5, 10);
    assert!(rogue.asked() > 0);
    let end = run.interrupt();
    assert_eq!(end.summary["outcome"], "interrupted");
    end.run_again();
    rogue.leave();

    let run = Run::controlled(&channel(&external("Hold"), 10.0));
    let session = client(&run.endpoint);
    let (_answers, asked) = counted(&session);
    let end = run.end();
    assert_eq!(end.count(0, "answered"), 10, "whoever comes is asked");
    assert_eq!(asked.load(Ordering::SeqCst), 10);
    session.close().wait().unwrap();
}

/// Sends a command that the run must not take, and returns once it would have been taken: the run takes what a session
/// says in its order, and answers what was asked after it.
fn in_vain(session: &Session, command: &str) -> FifoChannelHandler<Reply> {
    let replies = session.get(format!("rheotaxis/asks_1/rpc/{command}"));
    let replies = replies.wait().expect("sent");
    until("the run answers", || {
        let version = session.get("rheotaxis/asks_1/meta/version").wait();
        version.expect("sent").recv().ok()?.into_result().ok()
    });
    replies
}

/// Commands a run to stop. A link over TLS may break and come again, on a busy machine (docs/interfaces.md): what was
/// asked then has no reply, and is asked again.
fn stop(run: &mut Run, pilot: &Session) {
    until("the run is stopped", || (command(pilot, "stop").is_ok() || run.has_ended()).then_some(()));
}

/// Pilots command and are asked; watchers see the run, and their commands and answers go nowhere.
fn pilots_steer_and_watchers_watch(mut run: Run, pilot: &Session, watcher: Session) {
    let (_rogue, never) = counted(&watcher);
    let status = in_vain(&watcher, "status");
    let told = until("the run tells how it stands", || command(pilot, "status").ok());
    assert_eq!(told["controllable"], true);
    let (_answers, asked) = counted(pilot);
    let watching = Watcher::new(watcher.clone());
    let asked = || asked.load(Ordering::SeqCst);
    let asked_until = |n| until("the pilot is asked", || (asked() >= n).then_some(()));
    asked_until(3);
    let vain = in_vain(&watcher, "stop");
    asked_until(asked() + 3);
    assert_eq!(watching.tokens(), ["sim"]);
    stop(&mut run, pilot);
    watching.see_it_end();
    watching.hears(1, 0);
    let over_tls = run.endpoint.starts_with("tls/");
    let end = run.end();
    for replies in [status, vain] {
        assert!(samples(replies).is_empty(), "a watcher was obeyed");
    }
    assert_eq!(end.code, 130, "{}", end.said);
    assert_eq!(never.load(Ordering::SeqCst), 0, "a watcher was asked");
    // All are answered; over TLS, all that reached the pilot but the one under way when a link broke.
    let (told, answered) = (end.count(0, "asked"), end.count(0, "answered"));
    assert!(answered == told || over_tls && answered + 1 >= asked(), "{answered} of {told}");
    assert!(answered < told || !end.said.contains("warning"), "{}", end.said);
}

#[test]
fn users_need_their_password_and_only_the_pilot_steers() {
    let passwords = "pilot:to steer\nwatcher:to look\nstranger:let in\n";
    let steered = ["--allow-control", "--speed", "10"];
    let run = secured("users.json5", LOOPBACK, &asks(), &steered, |dir| {
        fs::write(dir.join("users.txt"), passwords).expect("the folder is ours");
    });
    let user = |name: &str, password: &str, patient: bool| {
        let values = [("transport/auth/usrpwd/user", json!(name)), ("transport/auth/usrpwd/password", json!(password))];
        client_config("as_user.json5", &run.endpoint, patient, &values)
    };
    let pilot = opened(user("pilot", "to steer", true));
    refused(user("pilot", "to look", false));
    refused(user("nobody", "to steer", false));
    let nameless = "{ mode: 'client', scouting: { multicast: { enabled: false } } }";
    let mut nameless = Config::from_json5(nameless).unwrap();
    let endpoints = json!([run.endpoint]).to_string();
    nameless.insert_json5("connect/endpoints", &endpoints).unwrap();
    refused(nameless);
    let stranger = zenoh::open(user("stranger", "let in", false)).wait().unwrap();
    let stranger = Watcher::new(stranger);
    let questions = stranger.questions();
    let watcher = opened(user("watcher", "to look", true));
    pilots_steer_and_watchers_watch(run, &pilot, watcher);
    assert_eq!(stranger.heard(), [0, 0]);
    for replies in questions {
        assert!(samples(replies).is_empty(), "a stranger was answered");
    }
    pilot.close().wait().unwrap();
}

/// A client of a run over TLS that trusts this authority, and shows a certificate if it has one.
fn over_tls(run: &Run, dir: &Path, authority: &str, name: Option<&str>, patient: bool) -> Config {
    let mut values = vec![("transport/link/tls/root_ca_certificate", json!(dir.join(authority)))];
    if let Some(name) = name {
        let own = |end: &str| json!(dir.join(format!("{name}.{end}")));
        values.push(("transport/link/tls/connect_certificate", own("pem")));
        values.push(("transport/link/tls/connect_private_key", own("key")));
        values.push(("transport/link/tls/enable_mtls", json!(true)));
    }
    client_config("over_tls.json5", &run.endpoint, patient, &values)
}

/// An authority whose certificates are in a folder, one for a run and one for each of these clients.
fn certificates(dir: &Path, clients: &[&str]) -> Authority {
    let authority = Authority::new("authority");
    authority.write(dir, "authority.pem");
    for name in clients.iter().chain(&["run"]) {
        authority.sign(dir, name);
    }
    let other = Authority::new("another");
    other.write(dir, "another.pem");
    authority
}

#[test]
fn over_tls_only_who_trusts_the_authority_connects() {
    let dir = tempfile::tempdir().unwrap();
    certificates(dir.path(), &[]);
    let steered = ["--allow-control", "--control-wait", "0", "--speed", "10"];
    let mut run = secured("tls.json5", "tls/127.0.0.1", &asks(), &steered, |to| {
        for file in ["run.pem", "run.key"] {
            fs::copy(dir.path().join(file), to.join(file)).unwrap();
        }
    });
    let session = opened(over_tls(&run, dir.path(), "authority.pem", None, true));
    refused(over_tls(&run, dir.path(), "another.pem", None, false));
    let plain = run.endpoint.replace("tls/", "tcp/");
    let plain = format!("{{ mode: 'client', connect: {{ endpoints: ['{plain}'] }} }}");
    refused(Config::from_json5(&plain).unwrap());
    let watcher = Watcher::new(session.clone());
    assert_eq!(watcher.tokens(), ["sim"]);
    stop(&mut run, &session);
    let end = run.end();
    assert_eq!(end.code, 130, "{}", end.said);
    session.close().wait().unwrap();
}

#[test]
fn certificates_of_clients_say_who_steers() {
    let dir = tempfile::tempdir().unwrap();
    certificates(dir.path(), &["pilot", "watcher"]);
    let other = tempfile::tempdir().unwrap();
    Authority::new("authority").sign(other.path(), "pilot");
    fs::copy(dir.path().join("authority.pem"), other.path().join("authority.pem")).unwrap();
    let steered = ["--allow-control", "--speed", "10"];
    let run = secured("mutual_tls.json5", "tls/127.0.0.1", &asks(), &steered, |to| {
        for file in ["run.pem", "run.key", "authority.pem"] {
            fs::copy(dir.path().join(file), to.join(file)).unwrap();
        }
    });
    let as_one = |dir: &Path, name: Option<&str>, patient: bool| over_tls(&run, dir, "authority.pem", name, patient);
    let pilot = opened(as_one(dir.path(), Some("pilot"), true));
    refused(as_one(dir.path(), None, false));
    refused(as_one(other.path(), Some("pilot"), false));
    let watcher = opened(as_one(dir.path(), Some("watcher"), true));
    pilots_steer_and_watchers_watch(run, &pilot, watcher);
    pilot.close().wait().unwrap();
}

#[test]
fn a_run_that_anybody_may_control_from_elsewhere_says_so() {
    let text = channel(AMP, 1.0);
    let everywhere = "tcp/0.0.0.0";
    let control = ["--allow-control"];
    let anywhere = ["--allow-control", "--control-from-anywhere"];
    let warned = |run: Run| {
        let endpoint = run.endpoint.clone();
        let said = run.end().said;
        let warned = said.contains("warning: without users or access control");
        assert_eq!(said.contains("warning"), warned && said.contains(&endpoint), "{said}");
        warned
    };
    assert!(warned(Run::at(everywhere, &text, &anywhere, |_| {})));
    assert!(!warned(Run::at(everywhere, &text, &[], |_| {})));
    assert!(!warned(Run::start(&text, &control)));
    let run = secured("watchers.json5", everywhere, &text, &control, |_| {});
    assert!(!warned(run));
}

#[test]
fn a_run_that_anybody_might_control_from_elsewhere_does_not_begin() {
    let dir = tempfile::tempdir().unwrap();
    fs::write(dir.path().join("asks.ron"), channel(AMP, 1.0)).unwrap();
    fs::write(dir.path().join("zenoh.json5"), "{}").unwrap();
    let refused = |more: &[&str], environment: &[(&str, &str)], ways: &[&str]| {
        let mut run = rheotaxis(dir.path(), &["run", "asks.ron", "--quiet"]);
        run.args(["--out", "out", "--allow-control"]).args(more);
        let said = Ended::of(run.envs(environment.iter().copied())).with(1).err;
        // It may be told over several lines.
        let said = said.replace(['\n', '│'], " ");
        says(&said.split_whitespace().collect::<Vec<_>>().join(" "), &[ways, &["--control-from-anywhere"]].concat());
        assert!(!dir.path().join("out").exists());
    };
    let listens = "it listens on tcp/[::]:0";
    let scouts = "it connects to whoever answers by multicast";
    let file = ["--zenoh-config", "zenoh.json5"];
    refused(&file, &[], &[listens, scouts]);
    refused(&[], &[("ZENOH_CONFIG", "zenoh.json5")], &[listens, scouts]);
    let here = [&file[..], &["--zenoh-listen", "tcp/127.0.0.1:0"]].concat();
    refused(&here, &[], &[scouts]);
    let everywhere = ["--zenoh-listen", "tcp/0.0.0.0:0"];
    refused(&everywhere, &[], &["it listens on tcp/0.0.0.0:0"]);
}
