//! Tian's subsumption planner: layers that control the vehicle, and suppress and inhibit each other.

mod ask;
mod compose;
mod eyes;
mod machine;
mod maintain;
mod plume;
mod plume_map;
mod spec;

pub use eyes::EyesSpec;
pub use machine::Subsumption;
pub use plume_map::PlumeMapSpec;
pub use spec::{GoHomeSpec, LayerSpec, MaintainSpec, SubsumptionSpec};

#[cfg(test)]
mod amp_tests;
#[cfg(test)]
mod compose_tests;
#[cfg(test)]
mod switch_tests;
#[cfg(test)]
mod testing;
