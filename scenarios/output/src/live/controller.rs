//! A searcher in another process, asked in lock-step: each question is a query, and its reply is the answer.
//!
//! The run asks `rheotaxis/<run>/ask/<robot>` with the question as JSON
//! ([`question_json`](rheotaxis::control::question_json)) and waits. A controller declares a queryable there and replies
//! with JSON that [`read_answer`] reads. Only controllers of other sessions are asked, and only the first reply counts.
#![allow(
    clippy::disallowed_methods,
    reason = "a run waits for a controller as long as it was told to; what came of it is recorded"
)]

use super::LiveError;
use super::config::{Open, plain};
use super::ros2::RosCommands;
use rheotaxis::control::{Controller, Question, Response, question_json, read_answer};
use std::sync::Arc;
use std::time::Duration;
use zenoh::Wait;
use zenoh::key_expr::OwnedKeyExpr;
use zenoh::qos::CongestionControl;
use zenoh::query::{ConsolidationMode, Querier, QueryTarget};
use zenoh::sample::Locality;

/// Longest wait before a run looks again whether it should end.
const NAP: Duration = Duration::from_millis(50);
/// After a reply has failed to come, whoever was to give it may take this long to be known as gone.
const FAREWELL: Duration = Duration::from_secs(5);

/// Whether the run goes on.
pub type Going = Arc<dyn Fn() -> bool + Send + Sync>;

/// The controllers of a robot, wherever they are.
pub struct LiveController {
    querier: Querier<'static>,
    key: String,
    /// How long it still waits for the first controller.
    patience: Duration,
    going: Going,
    /// Commands of ROS nodes, heard while no controller is there.
    ros: Option<RosCommands>,
    // The session lives as long as somebody may be asked.
    _open: Arc<Open>,
}

impl LiveController {
    pub(super) fn new(
        open: Arc<Open>,
        key: String,
        [deadline, patience]: [Duration; 2],
        going: Going,
        ros: Option<RosCommands>,
    ) -> Result<Self, LiveError> {
        let why = |e: zenoh::Error| LiveError::Open { why: plain(&e) };
        let querier = open
            .session()
            .declare_querier(OwnedKeyExpr::new(key.clone()).map_err(why)?)
            // Not the run's own queryable, which answers for the kept state.
            .allowed_destination(Locality::Remote)
            .target(QueryTarget::All)
            .consolidation(ConsolidationMode::None)
            .congestion_control(CongestionControl::Block)
            .express(true)
            .timeout(deadline)
            .wait()
            .map_err(why)?;
        Ok(Self { querier, key, patience, going, ros, _open: open })
    }

    /// The key at which a controller answers.
    pub fn key(&self) -> &str {
        &self.key
    }

    fn is_there(&self) -> bool {
        self.querier.matching_status().wait().is_ok_and(|status| status.matching())
    }

    /// Waits until somebody is there, or for so long.
    fn wait_until_there(&self, mut most: Duration) -> bool {
        while !self.is_there() && !self.ros.as_ref().is_some_and(RosCommands::any) {
            if most.is_zero() || !(self.going)() {
                return false;
            }
            let nap = most.min(NAP);
            std::thread::sleep(nap);
            most -= nap;
        }
        true
    }

    /// The stream of replies has ended without one.
    fn silent(&self) -> Response {
        let mut left = FAREWELL;
        while !left.is_zero() {
            if !self.is_there() {
                return Response::Gone;
            }
            std::thread::sleep(NAP);
            left = left.saturating_sub(NAP);
        }
        Response::Nonsense("it gave no reply".to_string())
    }
}

impl Controller for LiveController {
    fn answer(&mut self, question: &Question) -> Response {
        let patience = std::mem::take(&mut self.patience);
        if !self.wait_until_there(patience) {
            return Response::Absent;
        }
        if !self.is_there()
            && let Some(ros) = &mut self.ros
        {
            return ros.answer(question, &*self.going);
        }
        let asked = question_json(question).to_string();
        let Ok(replies) = self.querier.get().payload(asked).wait() else {
            return Response::Gone;
        };
        loop {
            match replies.recv_timeout(NAP) {
                Ok(Some(reply)) => {
                    return match reply.result() {
                        Ok(sample) => {
                            let text = sample.payload().to_bytes();
                            read_answer(&text, question.number, question.t_s)
                                .map_or_else(Response::Nonsense, Response::Answer)
                        }
                        Err(error) => {
                            let said = error.payload().to_bytes();
                            let said = String::from_utf8_lossy(&said);
                            match said.as_ref() {
                                "Timeout" => Response::Late,
                                said => {
                                    let said: String = said.chars().take(200).collect();
                                    Response::Nonsense(format!("it replied with an error: {said}"))
                                }
                            }
                        }
                    };
                }
                Ok(None) if (self.going)() => {}
                Ok(None) => return Response::Late,
                Err(_) => return self.silent(),
            }
        }
    }
}
