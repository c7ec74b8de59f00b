//! Searchers of a gantry: the blue-crab tracker, one file per unit, and a baseline.

pub mod acquire;
pub mod advance;
pub mod builder;
mod catalogue;
mod chemotaxis;
#[cfg(test)]
mod closed_loop_tests;
pub mod command;
mod crab;
mod crab_spec;
pub mod data;
pub mod decide;
mod external;
pub mod history;
pub mod pace;
pub mod predictor;
pub mod rate;
mod spec;
pub mod spikes;
pub mod steer;
pub mod stop;
#[cfg(test)]
mod testing;
pub mod threshold;

pub use advance::{AdvanceSpec, Gated, StepFrom, StepRule};
pub use builder::{Best, SweepSpec};
pub use catalogue::{GantryStrategies, GantryStrategySpec, READINGS, UNITS};
pub use chemotaxis::{Chemotaxis, ChemotaxisSpec};
pub use crab::CrabTracker;
pub use crab_spec::CrabSpec;
pub use decide::AtEnd;
pub use external::{ExternalSpec, OnLate};
pub use history::{HistorySpec, Over, Since};
pub use pace::{Adaptive as AdaptivePace, Fixed as FixedPace, PaceSpec};
pub use predictor::{Mean, PredictorSpec, Trend};
pub use rate::Count;
pub use spec::GantryStrategyParams;
pub use steer::{Adaptive as AdaptiveContrast, ContrastSpec, Fixed as FixedContrast, Peak};
pub use stop::{Experience, SpikeRate, StopSpec};
pub use threshold::{Averaged, HalfMean, Level, ThresholdSpec};
