//! Opens the folder of a vehicle: a user's own, or one of those that come with the program.

use super::VehicleFile;
use super::hydrodynamics_spec::TermsSpec;
use super::shipped::{BuiltIn, SHIPPED, ShippedVehicle};
use crate::error::RobotError;
use crate::vehicles::files::Files;
use crate::vehicles::spec::{ParameterSet, RemusSpec, VehicleSpec};
use crate::vehicles::urdf_parts::UrdfText;
use std::path::Path;

/// Longest `vehicle.ron`, bytes.
const LONGEST: u64 = 1 << 20;
/// Folder of the REMUS 100.
const REMUS: &str = "remus100";

/// What a vehicle is built from.
pub(in crate::vehicles) struct VehicleSource<'a> {
    /// What its `vehicle.ron` says.
    pub(in crate::vehicles) file: VehicleFile,
    /// Its URDF.
    pub(in crate::vehicles) urdf: UrdfText<'a>,
    /// Path of its `vehicle.ron`, for messages.
    path: String,
}

impl<'a> VehicleSource<'a> {
    /// The vehicle that a scenario asks for.
    pub(in crate::vehicles) fn new(spec: &VehicleSpec, files: &'a dyn Files) -> Result<Self, RobotError> {
        match spec {
            VehicleSpec::Remus100(remus) => Self::remus(remus, files),
            VehicleSpec::Shipped(name) if ShippedVehicle::named(name).is_none() => {
                let names: Vec<&str> = SHIPPED.iter().map(|s| s.folder).collect();
                Err(RobotError::invalid(
                    "vehicle",
                    format!("no vehicle \"{name}\" comes with the program; there are {}", names.join(", ")),
                ))
            }
            VehicleSpec::Shipped(name) => Self::folder(Path::new(name), &BuiltIn),
            VehicleSpec::File(folder) => Self::folder(Path::new(folder), files),
            VehicleSpec::Kinematic(_) => Err(RobotError::invalid("vehicle", "a kinematic vehicle has no folder")),
        }
    }

    /// That of a folder.
    fn folder(folder: &Path, files: &'a dyn Files) -> Result<Self, RobotError> {
        let name = folder.join("vehicle.ron");
        let path = files.path(&name).display().to_string();
        let file = match files.text(&name, LONGEST) {
            Ok(text) => files.vehicle(&path, &text)?,
            Err(problem) => return Err(RobotError::File { path, problem }),
        };
        Self::in_folder(folder, file, files)
    }

    /// That of a file, as if it stood in a folder.
    pub(in crate::vehicles) fn in_folder(
        folder: &Path,
        file: VehicleFile,
        files: &'a dyn Files,
    ) -> Result<Self, RobotError> {
        let path = files.path(&folder.join("vehicle.ron")).display().to_string();
        let urdf = UrdfText::open_at(&folder.join(&file.urdf), files)?;
        Ok(Self { file, urdf, path })
    }

    /// The REMUS of the program, with the terms and the URDF that a scenario asks for.
    fn remus(spec: &RemusSpec, files: &'a dyn Files) -> Result<Self, RobotError> {
        let mut source = Self::folder(Path::new(REMUS), &BuiltIn)?;
        if let TermsSpec::Torpedo(hull) = &mut source.file.hydrodynamics.terms {
            hull.published = spec.parameters == ParameterSet::Reference;
        }
        Ok(Self { urdf: urdf_of(spec.urdf.as_deref(), files)?, ..source })
    }

    /// A problem in its `vehicle.ron`.
    pub(in crate::vehicles) fn wrong(&self, problem: String) -> RobotError {
        RobotError::File { path: self.path.clone(), problem }
    }
}

/// The URDF that a scenario names, or that of the REMUS 100.
pub(in crate::vehicles) fn urdf_of<'a>(name: Option<&str>, files: &'a dyn Files) -> Result<UrdfText<'a>, RobotError> {
    match name {
        Some(name) => UrdfText::open_at(Path::new(name), files),
        None => UrdfText::open_at(&Path::new(REMUS).join("remus100.urdf"), &BuiltIn),
    }
}
