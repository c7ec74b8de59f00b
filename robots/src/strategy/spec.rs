//! What a scenario can say about the strategy.

use super::about::About;
use super::setting::Setting;
use crate::error::RobotError;
pub use crate::searcher::Strategy;
use world::area::Area;
use world::cost::{Cost, Times};
use world::registry::{Choice, Spec};

/// Strategies, which decide what a robot does from launch to the end of its mission. Their rows stand in the catalogue,
/// for some hold another.
#[derive(Clone, Copy, Debug)]
pub enum Strategies {}

/// A strategy that is chosen by name.
pub type StrategySpec = Choice<Strategies>;

/// Parameters of a strategy, and what they tell before it is built.
pub trait StrategyParams: Spec {
    /// Builds the strategy.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if fields contradict each other.
    fn build(&self, setting: &Setting) -> Result<Box<dyn Strategy>, RobotError>;

    /// Checks that a planner can hold the strategy's room, without building any of it.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if it cannot.
    fn check(&self, _setting: &Setting) -> Result<(), RobotError> {
        Ok(())
    }

    /// What it tells of itself.
    fn about(&self) -> About {
        About::default()
    }

    /// Its memory and time; paths below `strategy`.
    fn cost(&self, _area: &Area, _depth_m: f64, _obstacles: usize, _times: &Times) -> Cost {
        Cost::default()
    }
}
