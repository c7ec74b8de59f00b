//! The water: one file for each kind of flow, and their sum.

pub mod bed;
pub(crate) mod blockage;
pub mod catalogue;
pub mod channel;
pub mod coloured_noise;
mod cost;
mod current;
pub mod eddies;
mod flume;
pub mod free_water;
pub mod grid;
pub mod ground;
pub mod layered;
pub mod meander;
pub mod mixing;
pub mod number;
pub mod open_channel;
mod plane_current;
mod solenoidal;
#[cfg(test)]
pub(crate) mod tests_kit;
#[cfg(test)]
mod tests_sample;
#[cfg(test)]
mod tests_sea;
#[cfg(test)]
pub(crate) mod tests_water;
pub mod tide;
pub mod uniform;
pub mod water;
mod water_spec;
pub mod waves;

pub use blockage::{BlockageSpec, ObstacleFlow, SolutionReport};
pub use catalogue::{CurrentSpec, Currents, OPTIONS};
pub use current::{CurrentParams, CurrentSlot};
pub use free_water::FreeWater;
pub use grid::{CurrentScales, FlowGrid, GridSample, GridShape, InterfaceScale};
pub use plane_current::PlaneCurrent;
pub use water::Water;
pub use water_spec::WaterSpec;
