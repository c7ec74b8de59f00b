//! What exists and how time passes: space, terrain, rigid bodies, clock, seeds, recording.
//!
//! Knows no plume and no robot. World frame: ENU (x east, y north, z up), z = 0 at the still
//! surface; in a flume x runs down-stream, y left, z up. Body frame: FLU (REP 103). SI units, radians.
#![forbid(unsafe_code)]

pub mod area;
pub mod bits;
pub mod catalogue;
pub mod clock;
mod convert;
pub mod cost;
pub mod digest;
pub mod encoding;
pub mod error;
pub mod fields;
pub mod files;
pub mod frames;
pub mod limits;
pub mod math;
pub mod obstacles;
pub mod physics;
pub mod ranges;
pub mod registry;
pub mod seeds;
pub mod spelling;
pub mod stage;
pub mod terrain;
pub mod units;
pub mod voxels;
