//! Searchers: vehicles, sensors, estimation, mapping, planning, behaviours, guidance. A searcher never sees the
//! truth.
//!
//! This crate does not know the crate `plumes`: water and chemistry reach a searcher only through `world::fields` and
//! its sensors. It opens no files; see [`vehicles::Files`].
#![forbid(unsafe_code)]

pub mod actuate;
pub mod behave;
pub mod declare;
pub mod error;
pub mod estimate;
pub mod faults;
pub mod guide;
pub mod handoff;
pub mod map;
pub mod memory;
pub mod places;
pub mod plan;
pub mod policy;
pub mod searcher;
pub mod sense;
pub mod strategy;
pub mod track;
pub mod vehicles;
