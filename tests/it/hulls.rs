//! Vehicles of folders: trajectories of reference, what holds for any hull, what is refused.

mod kit;
mod physics;
mod trajectories;
