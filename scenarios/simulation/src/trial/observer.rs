//! What a run tells those who look at it.

use crate::control::Exchange;
use crate::frame::{Frame, PictureFrame, PingFrame, PlumeFrame, WaterFrame};
use std::sync::Arc;

/// One thing that happens in a run. Clones share what is large.
#[derive(Clone, Debug)]
pub enum Event {
    /// This share of the spin-up is done.
    SpinUp(f64),
    /// The spin-up is over, and a cache was asked for it: whether it was there. Then no share was told.
    SpinUpFromCache(bool),
    /// A new frame.
    Frame(Arc<Frame>),
    /// The plume. It is made for those who [want it](Wants::plume).
    Plume(Arc<PlumeFrame>),
    /// The flow, as often as the plume; once only if it is steady. It is made for those who [want it](Wants::water).
    Water(Arc<WaterFrame>),
    /// A searcher outside this program was asked, and this came of it.
    Exchange(Arc<Exchange>),
    /// A picture by a robot's camera.
    Picture(Arc<PictureFrame>),
    /// A ping of a robot's sidescan sonar.
    Ping(Arc<PingFrame>),
    /// A tick is over, at this time of the mission, s.
    Tick(f64),
}

/// What is made only for observers that ask for it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wants {
    /// The plume.
    pub plume: bool,
    /// The flow.
    pub water: bool,
}

impl Wants {
    /// What either of two observers wants.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self { plume: self.plume || other.plume, water: self.water || other.water }
    }
}

/// Whoever observes a run: it records, publishes, sets the pace or shows progress. It can stop the run, and nothing
/// else that it does reaches the run.
pub trait Observer {
    /// Sees what happens, in the order in which it happens.
    fn see(&mut self, event: &Event);
    /// Whether the run goes on. It is asked after each [`Event::SpinUp`] and each [`Event::Tick`].
    fn goes_on(&mut self) -> bool {
        true
    }
    /// A turn of the run begins or ends: between turns the ocean makes its step, and other lanes have theirs.
    fn turn(&mut self, _begins: bool) {}
    /// What it wants to see beside what is made anyway.
    fn wants(&self) -> Wants {
        Wants::default()
    }
}

/// An observer that does nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwatched;

impl Observer for Unwatched {
    fn see(&mut self, _event: &Event) {}
}
