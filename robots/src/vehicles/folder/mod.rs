//! A vehicle that is a folder: `vehicle.ron` and a URDF, the user's own or one of those that come with the program.

mod blocks;
mod described;
mod doubts;
mod fitted;
mod given;
mod hydrodynamics_spec;
mod load;
mod plant;
mod shipped;
mod spec;

pub use described::Described;
pub use hydrodynamics_spec::{Axes, Block, HydrodynamicsSpec, Row, Rows};
pub use shipped::{SHIPPED, Shipped};
pub(super) use shipped::{of_folder, shipped, urdf_of};
pub use spec::VehicleFile;
