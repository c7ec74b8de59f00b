//! What drifts: flow, stratification, filament plumes. This is the truth; it knows no robot.

pub mod error;
pub mod filaments;
pub mod flow;
mod logarithm;
mod noise;
pub mod release;
mod simd;
