//! A session that asks searchers outside in many runs, without publishing these runs.

use super::config::{Open, OpenedSession, endpoint, opened, plain};
use super::controller::{Going, LiveController};
use super::{LiveError, LiveOptions};
use rheotaxis::topic::chunk;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;
use zenoh::Wait;
use zenoh::liveliness::LivelinessToken;

/// Asks searchers outside.
#[derive(Debug)]
pub struct LiveAsk {
    // Before the session, which must outlive it.
    _alive: LivelinessToken,
    open: Arc<Open>,
    endpoint: String,
}

impl LiveAsk {
    /// Opens a session. Controllers see by the token of a run, `rheotaxis/<run_id>/@live/sim`, that somebody asks.
    ///
    /// # Errors
    /// As [`Live::start`](super::Live::start).
    pub fn open(options: &LiveOptions) -> Result<Self, LiveError> {
        options.check()?;
        let from_env = std::env::var_os("ZENOH_CONFIG").map(PathBuf::from);
        let OpenedSession { session, .. } = opened(options, from_env)?;
        let token = session.liveliness().declare_token(format!("rheotaxis/{}/@live/sim", options.run_id));
        let alive = token.wait().map_err(|e| LiveError::Open { why: plain(&e) })?;
        let endpoint = endpoint(&session);
        Ok(Self { _alive: alive, open: Arc::new(Open(session)), endpoint })
    }

    /// Where clients connect, as a zenoh endpoint.
    pub fn endpoint(&self) -> &str {
        &self.endpoint
    }

    /// Whoever decides for a robot of a run: as [`Live::controller`](super::Live::controller).
    ///
    /// # Errors
    /// If zenoh refuses.
    pub fn controller(
        &self,
        run: &str,
        robot: &str,
        times: [Duration; 2],
        going: Going,
    ) -> Result<LiveController, LiveError> {
        let key = format!("rheotaxis/{}/ask/{}", chunk(run), chunk(robot));
        LiveController::new(Arc::clone(&self.open), key, times, going, None)
    }
}
