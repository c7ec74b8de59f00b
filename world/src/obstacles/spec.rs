//! Obstacles as a scenario file gives them.

use super::Surface;
use crate::ranges::{Finite, HeadingDeg, NonNegative, Positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One obstacle of a scenario. Obstacles that overlap form one solid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ObstacleSpec {
    /// Name, unique in the scenario.
    #[schemars(extend("pattern" = "^[a-z0-9_]+$"))]
    pub id: String,
    /// Its shape.
    pub shape: ShapeSpec,
    /// East of the datum (down-stream in a flume), m.
    #[serde(with = "crate::limits::place_m")]
    pub east_m: Finite,
    /// North of the datum (to the left in a flume), m.
    #[serde(with = "crate::limits::place_m")]
    pub north_m: Finite,
    /// Height of its lowest point; on the bed by default.
    #[serde(default)]
    pub base: Base,
    /// Direction of its own x axis; by default 90°, so that its x points east and its y north.
    #[serde(default = "east")]
    pub heading_deg: HeadingDeg,
    /// How its surface looks and sounds; grey rock by default.
    #[serde(default)]
    pub surface: Surface,
}

fn east() -> HeadingDeg {
    HeadingDeg::new(90.0)
}

/// A shape in its own axes: x forward, y left, z up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum ShapeSpec {
    /// A block.
    Box(BoxShape),
    /// An upright cylinder.
    Cylinder(CylinderShape),
    /// A closed surface from a file.
    Mesh(MeshShape),
    /// Heights on a grid from a file: a reef, a mound, a dredged slope.
    Heightfield(HeightfieldShape),
}

/// A block, centred on its place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoxShape {
    /// Length along x, width along y and height, m.
    #[serde(with = "crate::limits::solid_m::<(Positive, Positive, Positive)>")]
    pub size_m: (Positive, Positive, Positive),
}

/// An upright cylinder, centred on its place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CylinderShape {
    /// Radius, m.
    #[serde(with = "crate::limits::solid_m")]
    pub radius_m: Positive,
    /// Height, m.
    #[serde(with = "crate::limits::solid_m")]
    pub height_m: Positive,
}

/// A closed surface from an STL or OBJ file. Its origin stands at the obstacle's place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshShape {
    /// Path, relative to the scenario file.
    pub file: String,
    /// Metres in one unit of the file.
    #[serde(default = "one", with = "crate::limits::scale")]
    pub scale: Positive,
}

/// Heights on a regular grid from an Esri ASCII grid file (.asc). Its centre stands at the obstacle's place and its
/// lowest height at the obstacle's base. Below that it is solid for another metre (times the scale).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HeightfieldShape {
    /// Path, relative to the scenario file.
    pub file: String,
    /// Metres in one unit of the file, for `cellsize` and heights alike.
    #[serde(default = "one", with = "crate::limits::scale")]
    pub scale: Positive,
}

fn one() -> Positive {
    Positive::new(1.0)
}

/// Where the lowest point of an obstacle stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Base {
    /// On the bed: at the lowest point of the bed under the obstacle, so that no gap is left on a slope.
    #[default]
    OnBed,
    /// At a depth below the still surface, m.
    Depth(NonNegative),
    /// At a height in world coordinates, m.
    Z(Finite),
}
