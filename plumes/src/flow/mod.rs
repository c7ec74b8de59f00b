//! The water: one file for each kind of flow, and their sum.

pub mod bed;
pub(crate) mod blockage;
pub mod catalogue;
pub mod channel;
pub mod coloured_noise;
mod cost;
mod current;
pub mod eddies;
pub mod free_water;
pub mod grid;
pub mod ground;
pub mod layered;
pub mod mixing;
pub mod number;
pub mod plane_current;
mod solenoidal;
#[cfg(test)]
pub(crate) mod tests;
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
