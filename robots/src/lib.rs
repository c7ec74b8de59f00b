//! What searches: vehicles, sensors, estimation, behaviours, guidance. Never sees the truth.
//!
//! Knows no plume: water and chemistry reach it through `world::fields` and its own sensors.

pub mod handoff;
