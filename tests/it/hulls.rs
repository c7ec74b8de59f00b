//! Vehicles of folders: trajectories of reference, what holds for any hull, what is refused, instruments aboard.

mod aboard;
mod energy;
mod inspect;
mod kit;
mod page;
mod physics;
mod refused;
mod trajectories;
