//! Replacement for live state if it is not built in: the same functions, which do nothing.

use super::{ListenOptions, LiveCounts, LiveError, LiveMeta, LiveOptions, News};
use rheotaxis::control::{Controller, Question, Response};
use rheotaxis::trial::Event;
use std::sync::Arc;
use std::time::Duration;

/// The session of a run, not built in (feature `live`).
#[derive(Clone, Debug, Default)]
pub struct LiveSession;

/// Whether the run goes on.
pub type Going = Arc<dyn Fn() -> bool + Send + Sync>;

/// Asks searchers outside, not built in (feature `live`).
#[derive(Debug)]
pub struct LiveAsk;

impl LiveAsk {
    /// Fails.
    ///
    /// # Errors
    /// Always.
    pub fn open(_options: &LiveOptions) -> Result<Self, LiveError> {
        Err(LiveError::Open { why: "built without the feature `live`".to_owned() })
    }

    /// Where clients connect: nowhere.
    pub fn endpoint(&self) -> &str {
        ""
    }

    /// Nothing.
    pub fn notices(&self) -> impl Iterator<Item = String> {
        std::iter::empty()
    }

    /// Fails.
    ///
    /// # Errors
    /// Always.
    pub fn controller(
        &self,
        _run: &str,
        _robot: &str,
        _times: [Duration; 2],
        _: Going,
    ) -> Result<LiveController, LiveError> {
        Err(LiveError::Open { why: "built without the feature `live`".to_owned() })
    }
}

/// The controllers of a robot: nobody, because live state is not built in (feature `live`).
pub struct LiveController;

impl LiveController {
    /// No key.
    pub fn key(&self) -> &str {
        "none (built without the feature `live`)"
    }
}

impl Controller for LiveController {
    fn answer(&mut self, _question: &Question) -> Response {
        Response::Absent
    }
}

/// Live state, not built in (feature `live`).
#[derive(Debug)]
pub struct Live;

impl Live {
    /// Checks only the run's id.
    ///
    /// # Errors
    /// If the run's id cannot be part of a key.
    pub fn start(options: &LiveOptions, _meta: LiveMeta) -> Result<Self, LiveError> {
        options.check()?;
        Ok(Self)
    }

    /// The same.
    ///
    /// # Errors
    /// As [`Live::start`].
    pub fn start_in(_session: &LiveSession, options: &LiveOptions, meta: LiveMeta) -> Result<Self, LiveError> {
        Self::start(options, meta)
    }

    /// Nothing.
    pub fn session(&self) -> LiveSession {
        LiveSession
    }

    /// Nobody.
    ///
    /// # Errors
    /// None.
    pub fn controller(&self, _robot: &str, _times: [Duration; 2], _going: Going) -> Result<LiveController, LiveError> {
        Ok(LiveController)
    }

    /// Where clients connect: nowhere.
    pub fn endpoint(&self) -> &str {
        "none (built without the feature `live`)"
    }

    /// A line for the user.
    pub fn notice(&self) -> Option<&str> {
        Some("built without the feature `live`: nothing is published")
    }

    /// None.
    pub fn warning(&self) -> Option<&str> {
        None
    }

    /// Does nothing.
    pub fn see(&self, _event: &Event) {}

    /// All zero.
    pub fn counts(&self) -> LiveCounts {
        LiveCounts::default()
    }

    /// Does nothing.
    pub fn end(&self, _digest: &str) {}

    /// Does nothing, because no subscriber can come.
    pub fn linger(&self, _time: Duration, _stop: impl Fn() -> bool) {}

    /// Does nothing.
    pub fn finish(self, _digest: &str) {}
}

/// What runs publish, not heard (feature `live`).
#[derive(Debug)]
pub struct Listener;

impl Listener {
    /// Says that it is not built in.
    ///
    /// # Errors
    /// Always.
    pub fn open(_options: &ListenOptions) -> Result<Self, LiveError> {
        Err(LiveError::Open { why: "built without the feature `live`".to_owned() })
    }

    /// Nowhere.
    pub fn place(&self) -> &str {
        "nowhere"
    }

    /// None.
    pub fn notice(&self) -> Option<&str> {
        None
    }

    /// Nothing.
    ///
    /// # Errors
    /// None.
    pub fn next(&mut self, _wait: Duration) -> Result<Option<News>, LiveError> {
        Ok(None)
    }
}
