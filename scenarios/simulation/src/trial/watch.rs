//! What a run tells those who look at it.

use crate::control::Exchange;
use crate::frame::{Frame, PictureFrame, PingFrame, PlumeFrame, WaterFrame};
use std::sync::Arc;

/// An observer of a run: it records, publishes, sets the pace or shows progress. It can stop the run, and nothing
/// else that it does reaches the run.
pub trait Watch {
    /// Tells the completed share of the spin-up; `false` stops the run.
    fn spun_up(&mut self, _share: f64) -> bool {
        true
    }
    /// After the spin-up, if a cache was asked for it: whether it was there. Then no share was told.
    fn developed(&mut self, _kept: bool) {}
    /// A new frame.
    fn frame(&mut self, _frame: &Arc<Frame>) {}
    /// Whether it looks at pictures of the plume. Otherwise none are made for it.
    fn sees_plume(&self) -> bool {
        true
    }
    /// A new picture of the plume.
    fn plume(&mut self, _plume: &PlumeFrame) {}
    /// The flow may be looked at, as often as the plume; once only if it is steady. It is made when it is asked for.
    fn water(&mut self, _look: &dyn Fn() -> WaterFrame) {}
    /// A searcher outside this program was asked, and this came of it.
    fn consulted(&mut self, _told: &Exchange) {}
    /// A new picture by a robot's camera.
    fn picture(&mut self, _picture: &PictureFrame) {}
    /// A new ping of a robot's sidescan sonar.
    fn ping(&mut self, _ping: &PingFrame) {}
    /// After every tick; `false` stops the run.
    fn go_on(&mut self, _t_s: f64) -> bool {
        true
    }
}

/// An observer that does nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn sees_plume(&self) -> bool {
        false
    }
}
