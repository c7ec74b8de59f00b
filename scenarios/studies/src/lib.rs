//! Many runs: campaigns, the papers' figures reproduced, statistics of plumes, scores of pictures.
#![forbid(unsafe_code)]

pub mod arena;
pub mod campaign;
pub mod distribution;
pub mod draw;
mod fill;
pub mod identify;
pub mod reproduce;
pub mod score_vision;
pub mod segment;
mod shipped;
pub mod statistics;
pub mod trials;
