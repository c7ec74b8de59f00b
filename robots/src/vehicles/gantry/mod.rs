//! A two-axis gantry that carries a head of probes: its URDF and its drives.

mod drive;
mod frame;
mod machine;
mod spec;
#[cfg(test)]
mod test_drive;
#[cfg(test)]
mod test_frame;

pub use machine::{CRAB_GANTRY, Gantry};
pub use spec::{CrabGantrySpec, GantrySpec};
