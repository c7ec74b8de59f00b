//! A session that asks searchers outside in many runs, without publishing these runs.

use super::config::{Notices, Open, OpenedSession, endpoint, opened, plain};
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
    told: Notices,
}

impl LiveAsk {
    /// Opens a session. Controllers see by the token of a run, `rheotaxis/<run_id>/@live/sim`, that somebody asks.
    ///
    /// # Errors
    /// As [`Live::start`](super::Live::start).
    pub fn open(options: &LiveOptions) -> Result<Self, LiveError> {
        options.check()?;
        let from_env = std::env::var_os("ZENOH_CONFIG").map(PathBuf::from);
        let OpenedSession { session, told } = opened(options, from_env)?;
        let token = session.liveliness().declare_token(format!("rheotaxis/{}/@live/sim", options.run_id));
        let alive = token.wait().map_err(|e| LiveError::Open { why: plain(&e) })?;
        let endpoint = endpoint(&session);
        Ok(Self { _alive: alive, open: Arc::new(Open(session)), endpoint, told })
    }

    /// Where clients connect, as a zenoh endpoint.
    pub fn endpoint(&self) -> &str {
        &self.endpoint
    }

    /// What the user has to know: that another port was taken, that anybody may answer.
    pub fn notices(&self) -> impl Iterator<Item = String> {
        let warning = self.told.warning.as_ref().map(|warning| format!("warning: {warning}"));
        self.told.notice.clone().into_iter().chain(warning)
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
