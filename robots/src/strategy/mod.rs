//! Strategies: compositions of behaviours.

mod amp;
mod catalogue;
mod open_loop;
mod spec;

pub use amp::{AfterDeclaration, Amp, AmpSpec, Detections, StartAt};
pub use catalogue::CATALOGUE;
pub use open_loop::{OpenLoop, OpenLoopSpec};
pub use spec::{Strategy, StrategySpec, VerticalSpec};
