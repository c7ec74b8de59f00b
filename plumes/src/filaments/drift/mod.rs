//! How filaments move in a step.

pub(super) mod drift_band;
pub(super) mod evenness;
pub(super) mod kernel;
pub(super) mod longest_step;
pub(super) mod pollock;
pub(super) mod series;
pub(super) mod small_eddies;
