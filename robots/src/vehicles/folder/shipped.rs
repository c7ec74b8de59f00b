//! The folders of vehicles that are in the program itself.

use super::VehicleFile;
use crate::error::RobotError;
use crate::vehicles::files::Files;
use std::path::{Path, PathBuf};

/// A vehicle that comes with the program.
#[derive(Clone, Copy, Debug)]
pub struct ShippedVehicle {
    /// Name of its folder.
    pub folder: &'static str,
    /// Its `vehicle.ron`.
    pub file: &'static str,
    /// Name and text of its URDF.
    pub urdf: (&'static str, &'static str),
}

macro_rules! shipped {
    ($($folder:literal),*) => {
        &[$(ShippedVehicle {
            folder: $folder,
            file: include_str!(concat!("../../../vehicles/", $folder, "/vehicle.ron")),
            urdf: (
                concat!($folder, ".urdf"),
                include_str!(concat!("../../../vehicles/", $folder, "/", $folder, ".urdf")),
            ),
        }),*]
    };
}

/// All of them.
pub const SHIPPED: &[ShippedVehicle] =
    shipped!["remus100", "bluerov2", "bluerov2_heavy", "lauv", "glider", "surface_craft"];

impl ShippedVehicle {
    /// The one of a name.
    pub fn named(folder: &str) -> Option<&'static Self> {
        SHIPPED.iter().find(|s| s.folder == folder)
    }

    /// What its `vehicle.ron` says.
    ///
    /// # Errors
    /// Its first mistake; a test makes sure that there is none.
    pub fn read(&self) -> Result<VehicleFile, RobotError> {
        BuiltIn.vehicle(self.folder, self.file)
    }
}

/// Their folders as files.
pub(super) struct BuiltIn;

impl Files for BuiltIn {
    fn path(&self, name: &Path) -> PathBuf {
        Path::new("built-in").join(name)
    }

    fn bytes(&self, name: &Path, _: u64) -> Result<Vec<u8>, String> {
        let all =
            SHIPPED.iter().flat_map(|s| [("vehicle.ron", s.file), s.urdf].map(|(file, text)| (s.folder, file, text)));
        all.into_iter()
            .find(|(folder, file, _)| name == Path::new(folder).join(file))
            .map(|(_, _, text)| text.into())
            .ok_or_else(|| "there is no such file".into())
    }
}
