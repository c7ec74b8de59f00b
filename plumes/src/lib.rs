//! What drifts: flow, stratification, filament plumes. The truth; knows no robot.

pub mod error;
pub mod filaments;
pub mod flow;
mod quad;
pub mod release;
