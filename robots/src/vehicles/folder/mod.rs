//! A vehicle that is a folder: `vehicle.ron` and a URDF, the user's own or one of those that come with the program.

mod blocks;
mod doubts;
mod fitted;
mod folder_vehicle;
mod hull_blocks;
mod hydrodynamics_spec;
mod load;
mod plant;
mod shipped;
mod spec;

pub use folder_vehicle::FolderVehicle;
pub use hydrodynamics_spec::{Axes, Block, HydrodynamicsSpec, Row, Rows};
pub use shipped::{SHIPPED, ShippedVehicle};
pub(super) use shipped::{of_folder, shipped, urdf_of};
pub use spec::VehicleFile;
