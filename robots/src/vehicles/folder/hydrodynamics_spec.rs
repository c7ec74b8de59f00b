//! The hydrodynamic part of `vehicle.ron`.

use crate::vehicles::torpedo::TorpedoHullSpec;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::ranges::{Finite, Positive};

/// What still and moving water does to a hull.
///
/// Forces and moments, at the origin of the body's link, are −D ν − D_q |ν|∘ν − |u| D_u ν, for a velocity ν = (surge,
/// sway, heave, roll, pitch, yaw) there, relative to the water. Therefore, damping that resists has positive numbers on
/// its diagonal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HydrodynamicsSpec {
    /// Terms of the equation of motion: the blocks of this struct, or a kind with numbers of its own.
    #[serde(default)]
    pub terms: TermsSpec,
    /// Axes of the blocks: FLU (forward, left, up) as the URDF, or FRD (forward, right, down) as most printed tables.
    /// The places of this file are always FLU.
    #[serde(default)]
    pub axes: Axes,
    /// Take the blocks, the volume and the centre of buoyancy from the URDF's extensions, where they are not given
    /// here: `<hydrodynamic_model>` of uuv_simulator, or the Hydrodynamics plugin of gz-sim.
    #[serde(default)]
    pub from_urdf: bool,
    /// Displaced volume, m³.
    #[serde(default)]
    pub volume_m3: Option<Positive>,
    /// Centre of buoyancy from the body's origin, m.
    #[serde(default)]
    pub centre_of_buoyancy_m: Option<(Finite, Finite, Finite)>,
    /// Added mass, kg, kg m, kg m²; symmetric.
    #[serde(default)]
    pub added_mass: Option<Block>,
    /// Linear damping D, N s/m, N s, N m s.
    #[serde(default)]
    pub linear_damping: Option<Block>,
    /// Quadratic damping D_q: columns times |ν_j| ν_j.
    #[serde(default)]
    pub quadratic_damping: Option<Block>,
    /// Damping D_u, times the speed ahead or astern, |u|.
    #[serde(default)]
    pub forward_damping: Option<Block>,
    /// Density of the water for which the damping holds, kg/m³; in other water it is proportional to the density.
    #[serde(default = "sea")]
    pub density_kg_m3: Positive,
    /// Gravity, m/s².
    #[serde(default = "gravity")]
    pub gravity_m_s2: Positive,
    /// It floats: the blocks hold at the draught at which it floats at rest, not for a hull all under water.
    #[serde(default)]
    pub floats: bool,
}

/// Terms of a hull's equation of motion.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "HullTermsSpec")]
pub enum TermsSpec {
    /// Blocks of added mass and damping, and the drives of the file.
    #[default]
    Blocks,
    /// Those of a torpedo with rudder, stern plane and propeller, as of the REMUS 100. Of this struct only density (that
    /// of the water for which it is ballasted) and gravity count beside them, and the file has no drives and no autopilot.
    Torpedo(Box<TorpedoHullSpec>),
}

/// Axes in which blocks are given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Axes {
    /// Forward, left, up.
    #[default]
    Flu,
    /// Forward, right, down.
    Frd,
}

/// A matrix of six by six.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Block {
    /// Only a diagonal: six numbers.
    Diagonal(Row),
    /// Six rows of six numbers, each in parentheses.
    Full(Box<Rows>),
}

/// Six rows.
pub type Rows = (Row, Row, Row, Row, Row, Row);

/// Six numbers: surge, sway, heave, roll, pitch, yaw.
pub type Row = (Finite, Finite, Finite, Finite, Finite, Finite);

fn sea() -> Positive {
    Positive::new(world::units::SEA_WATER_KG_M3)
}

fn gravity() -> Positive {
    Positive::new(9.80665)
}
