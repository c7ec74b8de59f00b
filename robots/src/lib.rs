//! What searches: vehicles, sensors, estimation, behaviours, guidance. Never sees the truth.
//!
//! Knows no plume: water and chemistry reach it through `world::fields` and its own sensors.
#![forbid(unsafe_code)]

pub mod actuate;
pub mod behave;
pub mod declare;
pub mod error;
pub mod estimate;
pub mod guide;
pub mod handoff;
pub mod map;
pub mod plan;
pub mod sense;
pub mod strategy;
pub mod survey;
pub mod track;
pub mod vehicles;
pub mod vision;
