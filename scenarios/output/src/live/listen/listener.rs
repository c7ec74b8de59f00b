//! Hears runs: subscribes before it asks for what was said earlier, so that nothing falls between the two.
//!
//! Messages and answers come over one connection in the order in which they were sent. An answer is left out where a
//! newer message of its key came before it. A run's last message is a clock that says `ended`.

use super::super::config::plain;
use super::super::{ListenOptions, LiveError, News, Said, Topic, topics};
use super::key::{Wanted, parts};
use super::reach::reached;
use super::said::said;
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::time::{Duration, Instant};
use zenoh::sample::{Sample, SampleKind};
use zenoh::{Session, Wait};

/// How many messages wait for a slow reader. Beyond that zenoh holds the connection back, and the run sends less.
const WAITING: usize = 10_000;

/// Longest wait for the answers of a run.
const ANSWERS: Duration = Duration::from_secs(60);

/// How long the last messages of a run may take that is gone: its token may overtake them.
const LATE: Duration = Duration::from_secs(5);

/// What the threads of zenoh pass on.
enum Event {
    /// The session is open.
    Open(Session),
    /// It cannot be opened.
    Failed(LiveError),
    /// A run's token.
    Token(String, SampleKind),
    /// A message of a run.
    Message(Message),
    /// An answer of a run.
    Answer(Message),
    /// A run has answered.
    Answered(String),
}

struct Message {
    run: String,
    said: Said,
    /// Whether it was asked for; the last clock is heard in any case.
    wanted: bool,
}

impl Message {
    fn new(sample: &Sample, wanted: &Wanted, topics: &[Topic]) -> Self {
        let key = sample.key_expr();
        Self {
            run: parts(key.as_str()).map_or(String::new(), |(run, _)| run.to_owned()),
            said: said(sample, topics),
            wanted: wanted.all.intersects(key),
        }
    }

    fn is_last(&self) -> bool {
        self.said.topic == Some("clock") && self.said.message["ended"] == true
    }
}

/// What is known of a run.
#[derive(Default)]
struct Known {
    begun: bool,
    asked: bool,
    ended: bool,
    over: bool,
    gone: Option<Instant>,
    /// Keys of the messages heard so far.
    heard: BTreeSet<String>,
}

/// Hears what runs publish, until dropped.
pub struct Listener {
    events: Option<Receiver<Event>>,
    sender: SyncSender<Event>,
    session: Option<Session>,
    wanted: Arc<Wanted>,
    topics: Arc<[Topic]>,
    runs: BTreeMap<String, Known>,
    ready: VecDeque<News>,
    place: String,
}

impl Listener {
    /// Begins to connect, and goes on with that until a run is there.
    ///
    /// # Errors
    /// If key, run, endpoint or configuration cannot be used.
    pub fn start(options: &ListenOptions) -> Result<Self, LiveError> {
        let topics: Arc<[Topic]> = topics().into();
        let wanted = Arc::new(Wanted::new(options, &topics)?);
        let (config, place) =
            reached(options, std::env::var_os("ZENOH_CONFIG").map(PathBuf::from))?;
        let (sender, events) = sync_channel(WAITING);
        let listener = Self {
            events: Some(events),
            sender: sender.clone(),
            session: None,
            wanted: Arc::clone(&wanted),
            topics: Arc::clone(&topics),
            runs: BTreeMap::new(),
            ready: VecDeque::new(),
            place,
        };
        // Of a thread of its own, because a client waits here for its run.
        let open = move || {
            let session = zenoh::open(config).wait();
            let opened = session.and_then(|session| {
                let _nobody_waits = sender.send(Event::Open(session.clone()));
                subscribe(&session, &sender, &wanted, &topics)
            });
            if let Err(e) = opened {
                let _nobody_waits = sender.send(Event::Failed(LiveError::Open { why: plain(&e) }));
            }
        };
        std::thread::Builder::new()
            .name("listen".to_owned())
            .spawn(open)
            .map_err(|e| LiveError::Open { why: e.to_string() })?;
        Ok(listener)
    }

    /// Where it connects, in words.
    #[must_use]
    pub fn place(&self) -> &str {
        &self.place
    }

    /// The key expression that it hears.
    #[must_use]
    pub fn key(&self) -> &str {
        self.wanted.all.as_str()
    }

    /// The next thing heard; `None` if there is nothing for that time.
    ///
    /// # Errors
    /// If zenoh does not start, or does not let it listen.
    pub fn next(&mut self, wait: Duration) -> Result<Option<News>, LiveError> {
        while self.ready.is_empty() {
            let Some(events) = &self.events else { break };
            match events.recv_timeout(wait) {
                Ok(event) => self.take(event)?,
                // It holds a sender itself.
                Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => {
                    self.miss();
                    break;
                }
            }
        }
        Ok(self.ready.pop_front())
    }

    fn take(&mut self, event: Event) -> Result<(), LiveError> {
        match event {
            Event::Open(session) => self.session = Some(session),
            Event::Failed(error) => return Err(error),
            Event::Token(run, SampleKind::Put) => return self.come(run),
            Event::Token(run, SampleKind::Delete) => {
                if let Some(known) = self.runs.get_mut(&run) {
                    known.gone = Some(now());
                }
            }
            Event::Message(message) => {
                let known = self.runs.entry(message.run.clone()).or_default();
                known.heard.insert(message.said.key.clone());
                known.gone = known.gone.map(|_| now());
                self.hear(message);
            }
            Event::Answer(message) => {
                let known = self.runs.entry(message.run.clone()).or_default();
                if !known.heard.contains(&message.said.key) {
                    self.hear(message);
                }
            }
            Event::Answered(run) => {
                self.runs.entry(run.clone()).or_default().asked = false;
                self.settle(&run);
            }
        }
        Ok(())
    }

    /// A run's token is there: asks for all that the run has said so far.
    fn come(&mut self, run: String) -> Result<(), LiveError> {
        let known = self.runs.entry(run.clone()).or_default();
        if known.gone.is_some() {
            // Another one with the same id.
            *known = Known::default();
        }
        if known.begun {
            return Ok(());
        }
        (known.begun, known.asked) = (true, true);
        self.ready.push_back(News::Begun(run.clone()));
        let answered = Answered(run.clone(), self.sender.clone());
        let (wanted, topics) = (Arc::clone(&self.wanted), Arc::clone(&self.topics));
        let hear = move |reply: zenoh::query::Reply| {
            if let Ok(sample) = reply.result() {
                let message = Message::new(sample, &wanted, &topics);
                let _gone = answered.1.send(Event::Answer(message));
            }
        };
        let Some(session) = &self.session else {
            return Ok(());
        };
        // Not the key that is wanted: that may be one of the control plane, whose queries are commands.
        let get = session.get(format!("rheotaxis/{run}/**")).timeout(ANSWERS);
        get.callback(hear)
            .wait()
            .map_err(|e| LiveError::Open { why: plain(&e) })
    }

    fn hear(&mut self, message: Message) {
        let last = message.is_last();
        if message.wanted {
            self.ready.push_back(News::Said(message.said));
        }
        if last {
            self.runs.entry(message.run.clone()).or_default().ended = true;
            self.settle(&message.run);
        }
    }

    /// Says that a run has ended, once all its answers are there.
    fn settle(&mut self, run: &str) {
        if let Some(known) = self.runs.get_mut(run)
            && known.ended
            && !known.asked
            && !known.over
        {
            known.over = true;
            self.ready.push_back(News::Ended(run.to_owned()));
        }
    }

    /// Says of runs that have been gone for long that they did not end.
    fn miss(&mut self) {
        let now = now();
        for (run, known) in &mut self.runs {
            if !known.over && known.gone.is_some_and(|gone| now - gone >= LATE) {
                known.over = true;
                self.ready.push_back(News::Gone(run.clone()));
            }
        }
    }
}

impl Drop for Listener {
    fn drop(&mut self) {
        // Frees threads of zenoh that wait for room before the session waits for them.
        self.events = None;
        if let Some(session) = self.session.take() {
            // Explicitly, because a session that is closed when statics are dropped panics.
            let _closed = session.close().wait();
        }
    }
}

/// Says that a run has answered when zenoh drops it, with the last answer or without any.
struct Answered(String, SyncSender<Event>);

impl Drop for Answered {
    fn drop(&mut self) {
        let _gone = self.1.send(Event::Answered(self.0.clone()));
    }
}

fn subscribe(
    session: &Session,
    events: &SyncSender<Event>,
    wanted: &Arc<Wanted>,
    topics: &Arc<[Topic]>,
) -> zenoh::Result<()> {
    // Clocks come through a subscriber of their own, which is there whatever is wanted.
    for (keys, clocks) in [(&wanted.all, false), (&wanted.clocks, true)] {
        let (events, wanted, topics) = (events.clone(), Arc::clone(wanted), Arc::clone(topics));
        let hear = move |sample: Sample| {
            if clocks || !wanted.clocks.includes(sample.key_expr()) {
                let _gone = events.send(Event::Message(Message::new(&sample, &wanted, &topics)));
            }
        };
        let subscriber = session.declare_subscriber(keys).callback(hear);
        subscriber.background().wait()?;
    }
    let events = events.clone();
    let token = move |sample: Sample| {
        if let Some((run, _)) = parts(sample.key_expr().as_str()) {
            let _gone = events.send(Event::Token(run.to_owned(), sample.kind()));
        }
    };
    let tokens = session.liveliness().declare_subscriber(&wanted.tokens);
    tokens.history(true).callback(token).background().wait()
}

#[expect(
    clippy::disallowed_methods,
    reason = "a listener is no part of a run, and waits as long as people do"
)]
fn now() -> Instant {
    Instant::now()
}
