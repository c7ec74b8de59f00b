//! The plume held to what is known of it: mass, spread, even dye, one water, the same bits on every way.

mod bands;
mod datum;
mod drift;
mod even;
mod even_obstacles;
mod even_quay;
mod evenness;
pub(super) mod flume;
mod images;
mod index;
mod kept;
mod mass;
mod mean;
mod mixed;
mod one_water;
mod round;
pub(super) mod water;
mod waves;
