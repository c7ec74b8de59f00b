//! What a run hands to those who record, publish and draw: frames, pictures, pings.

mod frames;

pub(crate) use frames::{close_frame, open_frame};

use crate::frame::{Frame, PictureFrame, PingFrame};
use bevy_ecs::prelude::Resource;
use world::clock::Every;

/// Whether a run makes frames.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Frames {
    /// Somebody may look.
    Made,
    /// Nobody will take them.
    Unmade,
}

/// What waits for the trial, which takes it after the tick; and how often frames are made. It holds the truth.
#[derive(Resource, Debug)]
pub struct Outbox {
    /// The frame of this step while it is made; `None` in steps without a frame. Systems of
    /// [`add_to_frame`](crate::machines::Systems::add_to_frame) write into it.
    pub open: Option<Frame>,
    /// The newest frame.
    pub(crate) frame: Option<Frame>,
    /// The time at which the plume is to be pictured, if it is, s.
    pub(crate) plume_due: Option<f64>,
    /// Most filaments in such a picture.
    pub(crate) plume_points: usize,
    /// Pictures by cameras since the trial last took them.
    pub(crate) pictures: Vec<PictureFrame>,
    /// Pings of sidescan sonars since the trial last took them.
    pub(crate) pings: Vec<PingFrame>,
    frame_every: Every,
    plume_every: Every,
}

impl Outbox {
    /// Empty, with the periods of frames and of pictures of the plume, and the most filaments in such a picture.
    pub fn new(frame_every: Every, plume_every: Every, plume_points: usize) -> Self {
        Self {
            open: None,
            frame: None,
            plume_due: None,
            plume_points,
            pictures: Vec::new(),
            pings: Vec::new(),
            frame_every,
            plume_every,
        }
    }

    /// Whether nothing waits for the trial.
    pub(crate) fn is_empty(&self) -> bool {
        self.frame.is_none() && self.plume_due.is_none() && self.pictures.is_empty() && self.pings.is_empty()
    }
}
