//! A vehicle that is a folder: `vehicle.ron` and a URDF, the user's own or one of those that come with the program.

mod blocks;
mod doubts;
mod driven_hull;
mod fitted;
mod hull_blocks;
mod hydrodynamics_spec;
mod load;
mod plant;
mod shipped;
mod spec;
mod vehicle_source;

pub(super) use driven_hull::DrivenHull;
pub use hydrodynamics_spec::{Axes, Block, HydrodynamicsSpec, Row, Rows, TermsSpec};
pub use shipped::{SHIPPED, ShippedVehicle};
pub use spec::VehicleFile;
pub(super) use vehicle_source::{VehicleSource, urdf_of};
