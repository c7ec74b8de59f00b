//! Hears runs: it subscribes before it asks for what was published earlier, so that nothing falls between the two.
//!
//! Messages and answers of a run come over one connection in the order in which they were sent. An answer is left out
//! where a message of its key came before it. The last message of a run is a clock that says `ended`.

use super::super::config::plain;
use super::super::{ListenOptions, LiveError, News};
use super::key::{expression, unknown};
use super::reach::reached;
use super::readable::readable;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::time::Duration;
use zenoh::bytes::ZBytes;
use zenoh::key_expr::{OwnedKeyExpr, keyexpr};
use zenoh::query::{ConsolidationMode, Reply};
use zenoh::sample::{Sample, SampleKind};
use zenoh::{Session, Wait};

/// How many messages wait for a slow reader. Beyond that zenoh holds the connection back, and the run sends less.
const WAITING: usize = 1000;

/// Longest wait for the answers of a run.
const ANSWERS: Duration = Duration::from_secs(60);

/// How long nothing may come of a run whose token is gone: the token may overtake the last messages.
const SILENCE: Duration = Duration::from_secs(3);

/// What the threads of zenoh pass on.
enum Event {
    /// A run came or went.
    Token(Sample),
    /// A run publishes.
    Message(Sample),
    /// A run answers with what it published before.
    Answer(Sample),
    /// A run has answered.
    Answered(String),
}

/// What is known of a run.
#[derive(Default)]
struct RunState {
    /// Keys of the messages heard so far.
    heard: BTreeSet<String>,
    /// What runs have answered, by key: a run keeps a message before it sends it, so the next one may be the same.
    answers: BTreeMap<String, ZBytes>,
    asked: bool,
    answered: bool,
    ended: bool,
    /// Nothing has come for so long since its token went.
    silent: Option<Duration>,
    over: bool,
}

/// Hears what runs publish, until dropped.
pub struct Listener {
    // First, so that threads of zenoh which wait for room are free when the session is closed.
    events: Receiver<Event>,
    sender: SyncSender<Event>,
    session: Session,
    wanted: OwnedKeyExpr,
    schemas: bool,
    place: String,
    notice: Option<String>,
    runs: BTreeMap<String, RunState>,
    ready: VecDeque<News>,
}

impl Listener {
    /// Opens a session that connects to runs as they come.
    ///
    /// # Errors
    /// If key, endpoint or configuration cannot be used. [`LiveError::NoSession`] if there is no run yet, and the
    /// configuration says `mode: "client"`.
    pub fn open(options: &ListenOptions) -> Result<Self, LiveError> {
        let wanted = expression(options.key.as_deref().unwrap_or("**"))?;
        let from_env = std::env::var_os("ZENOH_CONFIG").map(PathBuf::from);
        let (config, place) = reached(options, from_env)?;
        let notice = (options.key.as_deref().filter(|_| !options.topics.is_empty()))
            .and_then(|key| unknown(key, &wanted, &options.topics));
        let (sender, events) = sync_channel(WAITING);
        let session = zenoh::open(config).wait();
        let session = session.map_err(|e| LiveError::NoSession { why: plain(&e) })?;
        subscribe(&session, &wanted, &sender).map_err(failed)?;
        Ok(Self {
            events,
            sender,
            session,
            wanted,
            schemas: options.key.is_some(),
            place,
            notice,
            runs: BTreeMap::new(),
            ready: VecDeque::new(),
        })
    }

    /// Where it looks for runs, in words.
    pub fn place(&self) -> &str {
        &self.place
    }

    /// A line for the user, if necessary: that no topic has the key.
    pub fn notice(&self) -> Option<&str> {
        self.notice.as_deref()
    }

    /// The next thing heard; `None` if there is none yet. It waits so long at most.
    ///
    /// # Errors
    /// If the session is closed.
    pub fn next(&mut self, wait: Duration) -> Result<Option<News>, LiveError> {
        if self.ready.is_empty() {
            match self.events.recv_timeout(wait) {
                Ok(event) => self.take(event)?,
                // It holds a sender itself.
                Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => self.miss(wait),
            }
        }
        Ok(self.ready.pop_front())
    }

    fn take(&mut self, event: Event) -> Result<(), LiveError> {
        match event {
            Event::Token(sample) => {
                let Some(run) = run(sample.key_expr()).filter(|run| self.wants(run)) else {
                    return Ok(());
                };
                match sample.kind() {
                    SampleKind::Put => return self.ask(run),
                    SampleKind::Delete => {
                        let known = self.runs.entry(run.to_owned()).or_default();
                        known.silent = Some(Duration::ZERO);
                    }
                }
            }
            Event::Message(sample) => self.hear(&sample, false),
            Event::Answer(sample) => self.hear(&sample, true),
            Event::Answered(run) => {
                self.runs.entry(run.clone()).or_default().answered = true;
                self.settle(&run);
            }
        }
        Ok(())
    }

    /// Whether any key of a run is wanted.
    fn wants(&self, run: &str) -> bool {
        let all = OwnedKeyExpr::new(format!("rheotaxis/{run}/**"));
        all.is_ok_and(|all| self.wanted.intersects(&all))
    }

    /// A run is there: asks for all that it has published so far.
    fn ask(&mut self, run: &str) -> Result<(), LiveError> {
        let known = self.runs.entry(run.to_owned()).or_default();
        if known.silent.is_some() {
            // Another one with the same id.
            *known = RunState::default();
        }
        if known.asked {
            return Ok(());
        }
        known.asked = true;
        self.ready.push_back(News::Begun(run.to_owned()));
        let answers = Answers(run.to_owned(), self.sender.clone());
        let answer = move |reply: Reply| answers.take(reply);
        // Not the key that is wanted: queries to the keys of the control plane are commands.
        let get = self.session.get(format!("rheotaxis/{run}/**"));
        let get = get.consolidation(ConsolidationMode::None).timeout(ANSWERS);
        get.callback(answer).wait().map_err(failed)
    }

    fn hear(&mut self, sample: &Sample, answer: bool) {
        let key = sample.key_expr();
        let Some(run) = run(key) else { return };
        let known = self.runs.entry(run.to_owned()).or_default();
        if answer && known.heard.contains(key.as_str()) {
            return;
        }
        if answer {
            (known.answers).insert(key.as_str().to_owned(), sample.payload().clone());
        } else {
            known.heard.insert(key.as_str().to_owned());
            if known.answers.remove(key.as_str()).as_ref() == Some(sample.payload()) {
                return;
            }
        }
        let line = readable(sample);
        let clock = is_clock(key);
        known.ended |= clock && line["message"]["ended"] == true;
        let schema = key.as_str().contains("/meta/schema/");
        if self.wanted.intersects(key) && (self.schemas || !schema) {
            self.ready.push_back(News::Message(line));
        }
        self.settle(run);
    }

    /// Says that a run has ended, once all its answers are there.
    fn settle(&mut self, run: &str) {
        if let Some(known) = self.runs.get_mut(run)
            && known.ended
            && known.answered
            && !known.over
        {
            known.over = true;
            self.ready.push_back(News::Ended(run.to_owned()));
        }
    }

    /// Nothing has come for so long: gives up runs that are gone.
    fn miss(&mut self, wait: Duration) {
        for (run, known) in &mut self.runs {
            known.silent = known.silent.map(|silent| silent + wait);
            if known.asked && !known.over && known.silent > Some(SILENCE) {
                known.over = true;
                // Its last answers may have been lost with its connection.
                let end = if known.ended { News::Ended } else { News::Gone };
                self.ready.push_back(end(run.clone()));
            }
        }
    }
}

/// Passes on the answers of a run. zenoh drops it after the last one, or where there are none.
struct Answers(String, SyncSender<Event>);

impl Answers {
    fn take(&self, reply: Reply) {
        if let Ok(sample) = reply.into_result() {
            let _gone = self.1.send(Event::Answer(sample));
        }
    }
}

impl Drop for Answers {
    fn drop(&mut self) {
        let _gone = self.1.send(Event::Answered(self.0.clone()));
    }
}

/// The run that a key belongs to.
fn run(key: &keyexpr) -> Option<&str> {
    let below = key.as_str().strip_prefix("rheotaxis/")?;
    below.split_once('/').map(|(run, _)| run)
}

fn is_clock(key: &keyexpr) -> bool {
    let mut chunks = key.as_str().split('/').skip(2);
    (chunks.next(), chunks.next()) == (Some("clock"), None)
}

fn failed(error: zenoh::Error) -> LiveError {
    LiveError::Open { why: plain(&error) }
}

fn subscribe(session: &Session, wanted: &OwnedKeyExpr, events: &SyncSender<Event>) -> zenoh::Result<()> {
    // Clocks have a subscriber of their own, because they say that a run has ended.
    let hear = |clocks: bool| {
        let events = events.clone();
        move |sample: Sample| {
            if clocks == is_clock(sample.key_expr()) {
                let _gone = events.send(Event::Message(sample));
            }
        }
    };
    let others = session.declare_subscriber(wanted).callback(hear(false));
    others.background().wait()?;
    let clocks = session.declare_subscriber("rheotaxis/*/clock");
    clocks.callback(hear(true)).background().wait()?;
    let tokens = session.liveliness().declare_subscriber("rheotaxis/*/@live/sim");
    let events = events.clone();
    let token = move |sample: Sample| {
        let _gone = events.send(Event::Token(sample));
    };
    tokens.history(true).callback(token).background().wait()
}
