//! What a scenario can say about the strategy.

use super::setting::Setting;
use super::wishes::Wishes;
use crate::error::RobotError;
use crate::handoff::{ExchangeTiming, Need};
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

    /// Whether it looks for a source: it then needs a chemical sensor, a flow estimate, and something to find.
    fn searches(&self) -> bool {
        true
    }

    /// The instruments that it needs beside those of a search and of its [`wishes`](Self::wishes); paths below
    /// `strategy`.
    fn needs(&self) -> Vec<Need> {
        Vec::new()
    }

    /// The heights and speeds that it will command. Who commands any needs instruments to hold them.
    fn wishes(&self) -> Wishes {
        Wishes::default()
    }

    /// Most declarations of it that can remain at the end; those that it rejects itself do not remain.
    fn declares_at_most(&self) -> usize {
        usize::from(self.searches())
    }

    /// If a searcher outside this program decides: how often it is asked.
    fn consulted(&self) -> Option<ExchangeTiming> {
        None
    }

    /// Whether its decisions name subregions.
    fn has_regions(&self) -> bool {
        false
    }

    /// Whether its decisions name layers.
    fn has_layers(&self) -> bool {
        false
    }

    /// Its memory and time; paths below `strategy`.
    fn cost(&self, _area: &Area, _depth_m: f64, _obstacles: usize, _times: &Times) -> Cost {
        Cost::default()
    }
}
