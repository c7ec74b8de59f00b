//! What `vehicle.ron` in a vehicle's folder can say.
//!
//! The folder holds `vehicle.ron`, the URDF that it names, and the meshes that the URDF names. The URDF gives links,
//! shapes, mass and inertia, and where drives and instruments sit. This file gives everything else.

use super::hydrodynamics_spec::HydrodynamicsSpec;
use crate::handoff::PilotSpec;
use crate::vehicles::drives::DriveSpec;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A vehicle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VehicleFile {
    /// Name for tables and pictures.
    pub name: String,
    /// What it is, in one sentence.
    #[serde(default)]
    pub what: String,
    /// Where its numbers come from.
    #[serde(default)]
    pub source: String,
    /// URDF file, relative to the folder.
    pub urdf: String,
    /// What the water does to its hull.
    pub hydrodynamics: HydrodynamicsSpec,
    /// Thrusters, fins and what else moves it, each on a link of the URDF. At most 16.
    pub drives: Vec<DriveSpec>,
    /// Who steers it.
    pub autopilot: PilotSpec,
}
