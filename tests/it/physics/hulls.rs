//! Vehicles of folders: trajectories of reference, what holds for any hull, what is refused, instruments aboard,
//! what hulls can do and what scenarios refuse them.

mod aboard;
mod axes;
mod catalogue;
mod energy;
mod heights;
mod inspect;
mod kit;
mod page;
mod physics;
mod refused;
mod thrust;
mod trajectories;
