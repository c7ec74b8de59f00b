//! Opens the folder of a vehicle: a user's own, or one of those that are in the program itself.

use super::VehicleFile;
use super::folder_vehicle::FolderVehicle;
use crate::error::RobotError;
use crate::vehicles::files::Files;
use crate::vehicles::urdf_parts::UrdfText;
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
pub const SHIPPED: &[ShippedVehicle] = shipped!["bluerov2", "bluerov2_heavy", "lauv", "glider", "surface_craft"];

impl ShippedVehicle {
    /// The one of a name.
    pub fn named(folder: &str) -> Option<&'static Self> {
        SHIPPED.iter().find(|s| s.folder == folder)
    }
}

/// A shipped vehicle's folder as files, read by the reader of others.
pub(in crate::vehicles) struct BuiltIn<'a> {
    pub(in crate::vehicles) shipped: &'static ShippedVehicle,
    pub(in crate::vehicles) reader: &'a dyn Files,
}

impl Files for BuiltIn<'_> {
    fn path(&self, name: &Path) -> PathBuf {
        Path::new("built-in").join(name)
    }

    fn bytes(&self, name: &Path, _: u64) -> Result<Vec<u8>, String> {
        let folder = Path::new(self.shipped.folder);
        [("vehicle.ron", self.shipped.file), self.shipped.urdf]
            .into_iter()
            .find(|(file, _)| name == folder.join(file))
            .map(|(_, text)| text.into())
            .ok_or_else(|| "there is no such file".into())
    }

    fn vehicle(&self, path: &str, text: &str) -> Result<VehicleFile, RobotError> {
        self.reader.vehicle(path, text)
    }
}

/// Longest `vehicle.ron`, bytes.
const LONGEST: u64 = 1 << 20;

/// What a folder's `vehicle.ron` says.
fn file_of(folder: &Path, files: &dyn Files) -> Result<VehicleFile, RobotError> {
    let name = folder.join("vehicle.ron");
    let path = files.path(&name).display().to_string();
    let text = (files.text(&name, LONGEST)).map_err(|problem| RobotError::File { path: path.clone(), problem })?;
    files.vehicle(&path, &text)
}

/// The vehicle of a folder.
pub(in crate::vehicles) fn of_folder(folder: &str, files: &dyn Files) -> Result<FolderVehicle, RobotError> {
    let folder = Path::new(folder);
    FolderVehicle::load(folder, &file_of(folder, files)?, files)
}

/// One that comes with the program.
pub(in crate::vehicles) fn shipped(name: &str, files: &dyn Files) -> Result<FolderVehicle, RobotError> {
    of_folder(name, &built_in(name, files)?)
}

/// The files of one that comes with the program.
fn built_in<'a>(name: &str, reader: &'a dyn Files) -> Result<BuiltIn<'a>, RobotError> {
    let Some(shipped) = ShippedVehicle::named(name) else {
        let names: Vec<&str> = SHIPPED.iter().map(|s| s.folder).collect();
        return Err(RobotError::invalid(
            "vehicle",
            format!("no vehicle \"{name}\" comes with the program; there are {}", names.join(", ")),
        ));
    };
    Ok(BuiltIn { shipped, reader })
}

/// What `read` makes of the URDF and the file of a vehicle of a folder: one that comes with the program, or a user's
/// own.
pub(in crate::vehicles) fn urdf_of<T>(
    folder: &str,
    comes_with: bool,
    files: &dyn Files,
    read: impl FnOnce(&UrdfText, &VehicleFile) -> Result<T, RobotError>,
) -> Result<T, RobotError> {
    let own = comes_with.then(|| built_in(folder, files)).transpose()?;
    let files = own.as_ref().map_or(files, |own| own as &dyn Files);
    let folder = Path::new(folder);
    let file = file_of(folder, files)?;
    let urdf = folder.join(&file.urdf);
    read(&UrdfText::open_at(&urdf, files)?, &file)
}
