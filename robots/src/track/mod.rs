//! Searchers of a gantry: the blue-crab tracker, one file per unit, a surge-cast, and a baseline.

pub mod acquire;
mod catalogue;
mod chemotaxis;
pub mod command;
pub mod crab;
pub mod data;
mod external;
mod spec;
mod surge_cast;
#[cfg(test)]
mod testing;

pub use catalogue::{GantryStrategies, GantryStrategySpec, READINGS, UNITS};
pub use chemotaxis::{Chemotaxis, ChemotaxisSpec};
pub use crab::CrabTracker;
pub use crab::advance::{AdvanceSpec, Gated, StepRule};
pub use crab::builder::SweepSpec;
pub use crab::decide::AtEnd;
pub use crab::history::{HistorySpec, Over};
pub use crab::pace::{Adaptive as AdaptivePace, Fixed as FixedPace, PaceSpec};
pub use crab::predictor::PredictorSpec;
pub use crab::rate::Count;
pub use crab::spec::CrabSpec;
pub use crab::steer::{Adaptive as AdaptiveContrast, ContrastSpec, Fixed as FixedContrast};
pub use crab::stop::{Experience, SpikeRate, StopSpec};
pub use crab::threshold::{HalfMean, Level, ThresholdSpec};
pub use external::{ExternalSpec, OnLate};
pub use spec::GantryStrategyParams;
pub use surge_cast::{SurgeCast, SurgeCastSpec};
