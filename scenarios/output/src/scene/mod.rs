//! What is known before a run: the bed, solid things, sources, layers of the water, and the machines with their shapes,
//! joints, drives and sensors. Recordings, live state and ROS 2 show the same scene.
//!
//! [`Scene::from_scenario`] makes it from a scenario; [`Scene::document`] writes it as the JSON text that viewers read
//! (`docs/interfaces.md`); [`Scene::markers`] and [`frames`] write it for ROS 2.

mod bed;
mod document;
pub mod frames;
mod machine;
mod mesh;
mod place;
mod sensors;

pub use bed::Bed;
pub use machine::Machine;
#[cfg(feature = "live")]
pub(crate) use machine::ros_name;
pub use mesh::{MOST_TRIANGLES, Mesh};
pub use place::{Scene, Solid};
pub use sensors::SensorPlace;
