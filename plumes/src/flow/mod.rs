//! The water: one file for each kind of flow, and their sum.

pub mod bed;
pub(crate) mod blockage;
pub mod catalogue;
pub mod channel;
pub mod coloured_noise;
mod cost;
pub mod eddies;
mod flume;
pub mod grid;
pub mod ground;
pub mod layered;
pub mod meander;
pub mod mixing;
pub mod number;
mod solenoidal;
#[cfg(test)]
mod tests_sample;
#[cfg(test)]
mod tests_sea;
#[cfg(test)]
pub(crate) mod tests_water;
pub mod tide;
pub mod uniform;
pub mod water;
pub mod waves;

pub use blockage::{BlockageSpec, ObstacleFlow, SolutionReport};
pub use catalogue::{CurrentParams, CurrentSlot, CurrentSpec, Currents, OPTIONS, PlaneCurrent};
pub use grid::{FlowGrid, GridSample, GridShape};
pub use water::{Water, WaterSpec};
