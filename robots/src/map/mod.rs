//! Mappers turn detections, and their absence, into a belief about the source's place.
//!
//! All mappers share one back-trajectory (`flow_history`, `releases`, `kernel`); each mapper's file says how it uses
//! that.

mod bayesian;
mod catalogue;
mod cost;
mod credible;
mod hmm;
mod kernel;
mod log_belief;
mod mapper;
mod over_cells;
mod particle_filter;
mod pomdp;
mod spec;
mod watch;
mod workings;

pub use bayesian::BayesianSpec;
pub use catalogue::{MapSpec, Maps};
pub use doubt::evidence::{DoubtSpec, Repeats};
pub use hmm::{Hmm, HmmSpec};
pub use mapper::{MapParams, Mapper};
pub use particle_filter::{ParticleFilter, ParticleFilterSpec};
pub use pomdp::PomdpSpec;
pub use spec::{GridSpec, TrajectorySpec};
pub use watch::MapObservation;
pub use workings::CellsSpec;

mod doubt;
#[cfg(test)]
mod testing;
#[cfg(test)]
mod tests;
