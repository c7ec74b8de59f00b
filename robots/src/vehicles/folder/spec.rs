//! What `vehicle.ron` in a vehicle's folder can say.
//!
//! The folder holds `vehicle.ron`, the URDF that it names, and the meshes that the URDF names. The URDF gives links,
//! shapes, mass and inertia, and where drives and instruments sit. This file gives everything else.

use super::hydrodynamics_spec::HydrodynamicsSpec;
use crate::error::ensure;
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
    #[serde(default)]
    pub drives: Vec<DriveSpec>,
    /// Who steers it; a vehicle with terms of its own has the autopilot of the scenario.
    #[serde(default)]
    pub autopilot: Option<PilotSpec>,
}

impl VehicleFile {
    /// Refuses what does not count beside terms of a vehicle's own.
    pub(in crate::vehicles) fn has_only_terms(&self) -> Result<(), String> {
        let h = &self.hydrodynamics;
        let blocks = [&h.added_mass, &h.linear_damping, &h.quadratic_damping, &h.forward_damping];
        let given = blocks.into_iter().any(Option::is_some)
            || h.from_urdf
            || h.floats
            || h.volume_m3.is_some()
            || h.centre_of_buoyancy_m.is_some()
            || !self.drives.is_empty()
            || self.autopilot.is_some();
        ensure(!given, || {
            "blocks, from_urdf, floats, volume and centre of buoyancy, drives and autopilot: must be left out, because \
             hydrodynamics.terms has its own"
                .into()
        })
    }
}
