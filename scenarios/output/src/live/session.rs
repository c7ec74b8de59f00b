//! The thread that owns the zenoh session, and the handle that the run has.

use super::config::{Notices, Open, OpenedSession, endpoint, opened, plain};
use super::controller::{Going, LiveController};
use super::look_message;
use super::mailbox::{Mailbox, Rest, Work};
use super::map_message::MapGate;
use super::message::Message;
use super::ros2::{Door, RosCommands};
use super::tree::Tree;
use super::{LiveCounts, LiveError, LiveMeta, LiveOptions, message};
use crate::scene::ros_name;
use rheotaxis::frame::Frame;
use rheotaxis::topic::chunk;
use rheotaxis::trial::Event;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::sync::{Arc, Weak};
use std::time::Duration;

/// How long a finished run waits for zenoh to close its connections.
const PATIENCE: Duration = Duration::from_secs(2);

/// A run's live state. If it is dropped without [`Live::finish`] or [`Live::end`], subscribers learn that the run broke
/// off: the token disappears and no clock says `ended`.
#[derive(Debug)]
pub struct Live {
    mailbox: Arc<Mailbox>,
    gone: Receiver<()>,
    endpoint: String,
    notice: Option<String>,
    warning: Option<String>,
    session: LiveSession,
    run_id: String,
    ros_domain: Option<u32>,
}

/// The session of a run, which other runs may use as long as it publishes.
#[derive(Clone, Debug, Default)]
pub struct LiveSession(Weak<Open>);

/// What the thread reports when it is running: where clients connect, its session, and what the user is told.
type Up = Result<(String, LiveSession, Notices), LiveError>;

impl Live {
    /// Opens a zenoh session in its own thread and publishes what is known beforehand.
    ///
    /// # Errors
    /// If the port is busy, if the configuration cannot be used or lets others control the run against
    /// [`LiveOptions::control_from_anywhere`], or if zenoh does not start.
    pub fn start(options: &LiveOptions, meta: LiveMeta) -> Result<Self, LiveError> {
        options.check()?;
        let from_env = std::env::var_os("ZENOH_CONFIG").map(PathBuf::from);
        let asked = options.clone();
        let open = move || {
            let OpenedSession { session, told } = opened(&asked, from_env)?;
            Ok((Arc::new(Open(session)), told))
        };
        Self::publishing(options, meta, open)
    }

    /// The same in the session of another run, at the same port, or in one of its own if that is closed.
    ///
    /// # Errors
    /// As [`Live::start`].
    pub fn start_in(session: &LiveSession, options: &LiveOptions, meta: LiveMeta) -> Result<Self, LiveError> {
        match session.0.upgrade() {
            Some(open) => {
                options.check()?;
                Self::publishing(options, meta, move || Ok((open, Notices::default())))
            }
            None => Self::start(options, meta),
        }
    }

    /// The session, for other runs.
    pub fn session(&self) -> LiveSession {
        self.session.clone()
    }

    fn publishing(
        options: &LiveOptions,
        meta: LiveMeta,
        open: impl FnOnce() -> Result<(Arc<Open>, Notices), LiveError> + Send + 'static,
    ) -> Result<Self, LiveError> {
        let mailbox = Arc::new(Mailbox::new(options.state_period, options.plume_period));
        let (up, is_up) = sync_channel::<Up>(1);
        let (going, gone) = sync_channel::<()>(1);
        let thread = {
            let (mailbox, options) = (Arc::clone(&mailbox), options.clone());
            let meta = message::meta(&meta, &meta.topics);
            move || {
                publish(open, &options, meta, &mailbox, &up);
                // There may be nobody waiting any more.
                let _late = going.try_send(());
            }
        };
        std::thread::Builder::new()
            .name("live".to_owned())
            .spawn(thread)
            .map_err(|e| LiveError::Open { why: e.to_string() })?;
        let (endpoint, session, told) =
            is_up.recv().unwrap_or_else(|_| Err(LiveError::Open { why: "its thread broke off".to_owned() }))?;
        Ok(Self {
            mailbox,
            gone,
            endpoint,
            notice: told.notice,
            warning: told.warning,
            session,
            run_id: options.run_id.clone(),
            ros_domain: options.ros2.as_ref().map(|r| r.domain),
        })
    }

    /// Whoever controls a robot or gantry from another process. It waits for each answer as long as `deadline`, and for
    /// the first controller as long as `patience`, while `going` says that the run goes on.
    ///
    /// # Errors
    /// If the session is closed, or zenoh refuses.
    pub fn controller(
        &self,
        robot: &str,
        [deadline, patience]: [Duration; 2],
        going: Going,
    ) -> Result<LiveController, LiveError> {
        let open = self.session.0.upgrade().ok_or_else(|| LiveError::Open { why: "it is closed".to_owned() })?;
        let key = format!("rheotaxis/{}/ask/{}", self.run_id, chunk(robot));
        let ros = (self.ros_domain).map(|domain| RosCommands::listen(open.session(), domain, &ros_name(robot)));
        let ros = ros.transpose().map_err(|e| LiveError::Open { why: plain(&e) })?;
        LiveController::new(open, key, [deadline, patience], going, ros)
    }

    /// Where clients connect, as a zenoh endpoint.
    pub fn endpoint(&self) -> &str {
        &self.endpoint
    }

    /// A line for the user, if necessary: that a port other than the default one was taken.
    pub fn notice(&self) -> Option<&str> {
        self.notice.as_deref()
    }

    /// A warning for the user, if necessary: that anybody who comes from another machine can control the run, as
    /// [`LiveOptions::control_from_anywhere`] allows.
    pub fn warning(&self) -> Option<&str> {
        self.warning.as_deref()
    }

    /// Passes on what it publishes of a run; never waits.
    pub fn see(&self, event: &Event) {
        match event {
            Event::Frame(frame) => self.mailbox.put_frame(frame),
            Event::Plume(plume) => self.mailbox.put_plume(plume),
            Event::Water(water) => self.mailbox.put_water(water),
            Event::Picture(picture) => self.mailbox.put_picture(picture),
            Event::Ping(ping) => self.mailbox.put_ping(ping),
            Event::Exchange(_) | Event::SpinUp(_) | Event::SpinUpFromCache(_) | Event::Tick(_) => {}
        }
    }

    /// What happened to the states so far.
    pub fn counts(&self) -> LiveCounts {
        self.mailbox.done()
    }

    /// Publishes the last state, the digest and a clock that says `ended`, without waiting. Until this is dropped, late
    /// subscribers can still ask for all of it.
    pub fn end(&self, digest: &str) {
        self.mailbox.end(digest);
    }

    /// Waits, so that late subscribers find the run, until the time is over or `stop` returns true.
    pub fn linger(&self, time: Duration, stop: impl Fn() -> bool) {
        const STEP: Duration = Duration::from_millis(50);
        let mut left = time;
        // The thread sends nothing before it is told to close, so waiting for it is a pause.
        while !left.is_zero() && !stop() && self.gone.recv_timeout(left.min(STEP)) == Err(RecvTimeoutError::Timeout) {
            left = left.saturating_sub(STEP);
        }
    }

    /// [`Live::end`], then close. Waits at most 2 s for zenoh, whatever subscribers do.
    pub fn finish(self, digest: &str) {
        self.end(digest);
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        self.mailbox.close();
        // After that time the thread is abandoned; it holds nothing that the run needs.
        let _gone_or_left_behind = self.gone.recv_timeout(PATIENCE);
    }
}

/// Main function of the thread.
fn publish(
    open: impl FnOnce() -> Result<(Arc<Open>, Notices), LiveError>,
    options: &LiveOptions,
    meta: Vec<Message>,
    mailbox: &Mailbox,
    up: &SyncSender<Up>,
) {
    let (session, told) = match open() {
        Ok(opened) => opened,
        Err(e) => {
            let _nobody_waits = up.send(Err(e));
            return;
        }
    };
    let opened = Tree::grow(session.session(), options, meta).and_then(|tree| {
        let door = options.ros2.as_ref().map(|r| Door::open(session.session(), r));
        Ok((tree, door.transpose()?))
    });
    match opened {
        Err(e) => {
            let _nobody_waits = up.send(Err(LiveError::Open { why: plain(&e) }));
        }
        Ok((mut tree, mut ros)) => {
            let _nobody_waits = up.send(Ok((endpoint(session.session()), LiveSession(Arc::downgrade(&session)), told)));
            serve(&mut tree, &mut ros, mailbox, options.plume_period);
        }
    }
}

fn serve(tree: &mut Tree<'_>, ros: &mut Option<Door<'_>>, mailbox: &Mailbox, map_period: Duration) {
    let mut maps = MapGate::new(map_period);
    // A message that cannot be sent is lost, like one that did not fit into a queue; the run continues.
    let mut last = (0.0, 0);
    let mut newest: Option<Frame> = None;
    loop {
        match mailbox.next() {
            Work::Frame(frame) => {
                last = (frame.t_s, frame.step);
                for message in maps.due(&frame, false) {
                    drop(tree.say(message));
                }
                say_state(tree, ros, &frame, mailbox.counts());
                newest = Some(frame);
            }
            Work::Rest(rest) => say_rest(tree, ros, &rest),
            Work::End { frame, rest, digest } => {
                // The last map may have been held back when its state was sent.
                for message in (frame.as_ref().or(newest.as_ref())).map_or_else(Vec::new, |frame| maps.due(frame, true))
                {
                    drop(tree.say(message));
                }
                if let Some(frame) = frame {
                    last = (frame.t_s, frame.step);
                    say_state(tree, ros, &frame, mailbox.counts());
                }
                say_rest(tree, ros, &rest);
                drop(tree.say_for_good(message::digest(&digest)));
                drop(tree.say_last(message::clock(last.0, last.1, true, mailbox.counts())));
            }
            Work::Close => return,
        }
    }
}

fn say_state(tree: &Tree<'_>, ros: &mut Option<Door<'_>>, frame: &Frame, counts: LiveCounts) {
    if let Some(ros) = ros {
        ros.state(frame);
    }
    for message in message::state(frame) {
        drop(tree.say(message));
    }
    // Last, so that a subscriber that has the clock also has the state that belongs to it.
    drop(tree.say(message::clock(frame.t_s, frame.step, false, counts)));
}

fn say_rest(tree: &Tree<'_>, ros: &mut Option<Door<'_>>, rest: &Rest) {
    for newest in &rest.pictures {
        if let Some(picture) = look_message::picture(newest) {
            if let Some(ros) = ros {
                ros.picture(newest, &picture.payload);
            }
            drop(tree.say(picture));
        }
    }
    for ping in &rest.pings {
        drop(tree.say(look_message::ping(ping)));
    }
    if let Some(plume) = &rest.plume {
        if let Some(ros) = ros {
            ros.plume(plume);
        }
        drop(tree.say(message::plume(plume)));
    }
    if let Some(water) = &rest.water {
        drop(tree.say(message::water(water)));
    }
}
