//! Somebody who forges the state of a run, shows tokens in its name and answers in the place of its controllers.

use super::kit::KEYS;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use zenoh::handlers::FifoChannelHandler;
use zenoh::liveliness::LivelinessToken;
use zenoh::pubsub::Subscriber;
use zenoh::query::{Query, QueryTarget, Queryable};
use zenoh::sample::{Locality, Sample, SampleKind};
use zenoh::{Config, Session, Wait};

/// What the controller of a robot could say.
const FORGED: &str = r#"{"steer": {"heading_rad": 1, "speed_m_s": 1.5}, "behaviour": "forged"}"#;
const BASE: &str = "rheotaxis/asks_1";

pub(super) struct Rogue {
    session: Session,
    asked: Arc<AtomicU64>,
    _answers: Queryable<()>,
    _token: LivelinessToken,
}

impl Rogue {
    /// One of zenoh's three kinds of node, at a run that listens. It has done its worst when this returns.
    pub(super) fn at(endpoint: &str, mode: &str) -> Self {
        let config = format!(
            r#"{{ mode: "{mode}", listen: {{ endpoints: [] }}, scouting: {{ multicast: {{ enabled: false }} }},
                 connect: {{ endpoints: ["{endpoint}"], timeout_ms: 20000, exit_on_failure: true }} }}"#
        );
        let config = Config::from_json5(&config).expect("legal");
        let session = zenoh::open(config).wait().expect("a session");
        let asked = Arc::new(AtomicU64::new(0));
        let count = Arc::clone(&asked);
        let answers = (session.declare_queryable("rheotaxis/**"))
            .complete(true)
            // Its own command below is not for itself.
            .allowed_origin(Locality::Remote)
            .callback(move |query: Query| {
                count.fetch_add(1, Ordering::SeqCst);
                let key = match query.key_expr().as_str() {
                    key if key.contains('*') => format!("{BASE}/clock"),
                    key => key.to_string(),
                };
                let _gone = query.reply(key, FORGED).wait();
            })
            .wait()
            .expect("a queryable");
        let token = format!("{BASE}/@live/{mode}");
        let token = session.liveliness().declare_token(token).wait();
        for key in KEYS {
            let key = format!("{BASE}/{key}");
            session.put(&key, FORGED).wait().expect("sent");
            session.delete(&key).wait().expect("sent");
        }
        let command = session.get(format!("{BASE}/rpc/stop")).wait();
        // The run takes what a session says in its order: once this is over, it has had all of it.
        while command.as_ref().expect("sent").recv().is_ok() {}
        Self {
            session,
            asked,
            _answers: answers,
            _token: token.expect("a token"),
        }
    }

    /// How often it was asked anything.
    pub(super) fn asked(&self) -> u64 {
        self.asked.load(Ordering::SeqCst)
    }

    pub(super) fn leave(self) {
        self.session.close().wait().expect("it closes");
    }
}

/// Hears all of a run.
pub(super) struct Watcher {
    session: Session,
    heard: Arc<Mutex<Vec<Sample>>>,
    there: Subscriber<FifoChannelHandler<Sample>>,
    _subscriber: Subscriber<()>,
}

impl Watcher {
    pub(super) fn new(session: Session) -> Self {
        let heard = Arc::new(Mutex::new(Vec::new()));
        let ear = Arc::clone(&heard);
        let subscriber = (session.declare_subscriber("rheotaxis/**"))
            .callback(move |sample| ear.lock().expect("sound").push(sample))
            .wait()
            .expect("a subscriber");
        let there = (session.liveliness()).declare_subscriber(format!("{BASE}/@live/sim"));
        let there = there.history(true).wait().expect("a subscriber");
        Self {
            session,
            heard,
            there,
            _subscriber: subscriber,
        }
    }

    /// Asks everybody for the state of the run: how many replies come, and how many of them are forged.
    pub(super) fn asks(&self) -> [usize; 2] {
        let replies = (self.session.get(format!("{BASE}/**")))
            .target(QueryTarget::All)
            .consolidation(zenoh::query::ConsolidationMode::None)
            .wait()
            .expect("sent");
        let replies: Vec<Sample> = (replies.into_iter())
            .filter_map(|reply| reply.into_result().ok())
            .collect();
        [replies.len(), replies.iter().filter(|s| forged(s)).count()]
    }

    /// Last chunks of the tokens that are there.
    pub(super) fn tokens(&self) -> Vec<String> {
        let tokens = self.session.liveliness().get(format!("{BASE}/@live/*"));
        let tokens = tokens.wait().expect("sent").into_iter();
        let mut names: Vec<String> = tokens
            .filter_map(|token| token.into_result().ok())
            .filter_map(|token| Some(token.key_expr().as_str().rsplit_once('/')?.1.to_string()))
            .collect();
        names.sort();
        names
    }

    /// Waits until the run has ended.
    pub(super) fn see_it_end(&self) {
        while let Ok(sample) = self.there.recv() {
            if sample.kind() == SampleKind::Delete {
                return;
            }
        }
    }

    /// How often the clock of the run was heard, and how much of all that was heard is forged.
    pub(super) fn heard(&self) -> [usize; 2] {
        let heard = self.heard.lock().expect("sound");
        let clock = (heard.iter())
            .filter(|sample| sample.key_expr().as_str().ends_with("/clock") && !forged(sample));
        [clock.count(), heard.iter().filter(|s| forged(s)).count()]
    }
}

/// The run itself deletes nothing.
fn forged(sample: &Sample) -> bool {
    sample.kind() == SampleKind::Delete || sample.payload().to_bytes() == FORGED.as_bytes()
}
