//! Somebody who forges the state of a run, shows tokens in its name and answers in the place of its controllers.

use super::kit::{KEYS, patience_ms};
use crate::waits::until;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex};
use zenoh::handlers::FifoChannelHandler;
use zenoh::liveliness::LivelinessToken;
use zenoh::pubsub::Subscriber;
use zenoh::query::{Query, QueryTarget, Queryable, Reply};
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
        let timeout_ms = patience_ms();
        let config = format!(
            r#"{{ mode: "{mode}", listen: {{ endpoints: [] }}, scouting: {{ multicast: {{ enabled: false }} }},
                 connect: {{ endpoints: ["{endpoint}"], timeout_ms: {timeout_ms}, exit_on_failure: true }} }}"#
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
        Self { session, asked, _answers: answers, _token: token.expect("a token") }
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
    gone: Arc<AtomicBool>,
    _subscribers: [Subscriber<()>; 2],
}

impl Watcher {
    pub(super) fn new(session: Session) -> Self {
        let heard = Arc::new(Mutex::new(Vec::new()));
        let ear = Arc::clone(&heard);
        let subscriber = (session.declare_subscriber("rheotaxis/**"))
            .callback(move |sample| ear.lock().expect("sound").push(sample))
            .wait()
            .expect("a subscriber");
        let gone = Arc::new(AtomicBool::new(false));
        let seen = Arc::clone(&gone);
        let there = (session.liveliness()).declare_subscriber(format!("{BASE}/@live/sim"));
        let there = (there.history(true))
            .callback(move |token| seen.store(token.kind() == SampleKind::Delete, Ordering::SeqCst))
            .wait()
            .expect("a subscriber");
        Self { session, heard, gone, _subscribers: [subscriber, there] }
    }

    /// Asks everybody for the state of the run: how many replies come, and how many of them are forged.
    pub(super) fn asks(&self) -> [usize; 2] {
        let replies = samples(self.question());
        [replies.len(), replies.iter().filter(|s| forged(s)).count()]
    }

    fn question(&self) -> FifoChannelHandler<Reply> {
        (self.session.get(format!("{BASE}/**")))
            .target(QueryTarget::All)
            .consolidation(zenoh::query::ConsolidationMode::None)
            .wait()
            .expect("sent")
    }

    fn question_for_tokens(&self) -> FifoChannelHandler<Reply> {
        let tokens = self.session.liveliness().get(format!("{BASE}/@live/*"));
        tokens.wait().expect("sent")
    }

    /// Asks for the state of the run and for tokens, and does not wait for replies.
    pub(super) fn questions(&self) -> [FifoChannelHandler<Reply>; 2] {
        [self.question(), self.question_for_tokens()]
    }

    /// Last chunks of the tokens that are there, one of which is the run's.
    ///
    /// A question that is sent while the subscriber's tokens are on their way comes back empty: zenoh takes its reply
    /// for
    /// something that the session knows already. So it is asked again.
    pub(super) fn tokens(&self) -> Vec<String> {
        until("there are tokens", || {
            let tokens = samples(self.question_for_tokens());
            let mut names: Vec<String> = (tokens.iter())
                .filter_map(|token| Some(token.key_expr().as_str().rsplit_once('/')?.1.to_string()))
                .collect();
            names.sort();
            (!names.is_empty()).then_some(names)
        })
    }

    /// Waits until the run has ended.
    pub(super) fn see_it_end(&self) {
        until("the run's token goes", || self.gone.load(Ordering::SeqCst).then_some(()));
    }

    /// Waits until the clock of the run was heard so often, and so many forged messages.
    pub(super) fn hears(&self, clocks: usize, forged: usize) {
        let heard = until("the run is heard", || {
            let heard = self.heard();
            (heard[0] >= clocks && heard[1] >= forged).then_some(heard)
        });
        assert_eq!(heard[1], forged, "{heard:?}");
    }

    /// How often the clock of the run was heard, and how much of all that was heard is forged.
    pub(super) fn heard(&self) -> [usize; 2] {
        let heard = self.heard.lock().expect("sound");
        let clock = (heard.iter()).filter(|sample| sample.key_expr().as_str().ends_with("/clock") && !forged(sample));
        [clock.count(), heard.iter().filter(|s| forged(s)).count()]
    }
}

/// What came in reply, once no more can come.
pub(super) fn samples(replies: FifoChannelHandler<Reply>) -> Vec<Sample> {
    (replies.into_iter()).filter_map(|reply| reply.into_result().ok()).collect()
}

/// The run itself deletes nothing.
fn forged(sample: &Sample) -> bool {
    sample.kind() == SampleKind::Delete || sample.payload().to_bytes() == FORGED.as_bytes()
}
