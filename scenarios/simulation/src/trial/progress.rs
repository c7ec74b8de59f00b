//! How far a run has come, beside the state of its world.

use crate::control::Exchange;
use crate::frame::Frame;
use nalgebra::Vector3;
use std::sync::Arc;

/// How far a run has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RunPhase {
    Assembled,
    SpunUp,
    /// An observer stopped it.
    Stopped,
    Ended,
}

/// What a run has come to, beside the state of its world.
pub(crate) struct Progress {
    pub(super) phase: RunPhase,
    /// The sources of its ocean (ENU), m.
    pub(super) sources: Vec<Vector3<f64>>,
    pub(super) flow_sums: Vec<Vector3<f64>>,
    pub(super) flow_samples: u32,
    pub(super) frame: Option<Arc<Frame>>,
    pub(super) water_shown: bool,
    /// Time of the ocean at which the mission began, s.
    pub(super) began_s: f64,
    /// The first part of a tick is done, and these questions are not answered yet: so far, nobody is there.
    pub(super) open: Option<Vec<Exchange>>,
}

impl Progress {
    /// Before the spin-up, with these sources.
    pub(crate) fn new(sources: Vec<Vector3<f64>>) -> Self {
        Self {
            phase: RunPhase::Assembled,
            flow_sums: vec![Vector3::zeros(); sources.len()],
            sources,
            flow_samples: 0,
            frame: None,
            water_shown: false,
            began_s: 0.0,
            open: None,
        }
    }
}
