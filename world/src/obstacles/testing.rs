//! Obstacles in few words.

use super::{Base, BoxShape, CylinderShape, HeightfieldShape, MeshShape, Obstacle, ObstacleSpec, ShapeSpec, Surface};
use crate::error::WorldError;
use crate::ranges::{Finite, HeadingDeg, Positive};
use crate::terrain::Terrain;
use std::path::Path;

pub(crate) const LEVEL: Terrain = Terrain::Level { depth_m: 8.0 };

pub(crate) fn block(size_m: [f64; 3]) -> ShapeSpec {
    let [x, y, z] = size_m.map(Positive::new);
    ShapeSpec::Box(BoxShape { size_m: (x, y, z) })
}

pub(crate) fn pillar(radius_m: f64, height_m: f64) -> ShapeSpec {
    ShapeSpec::Cylinder(CylinderShape { radius_m: Positive::new(radius_m), height_m: Positive::new(height_m) })
}

/// A shape on the bed at (east, north).
pub(crate) fn standing(shape: ShapeSpec, [east_m, north_m]: [f64; 2], heading_deg: f64) -> ObstacleSpec {
    ObstacleSpec {
        id: "reef".into(),
        shape,
        east_m: Finite::new(east_m),
        north_m: Finite::new(north_m),
        base: Base::OnBed,
        heading_deg: HeadingDeg::new(heading_deg),
        surface: Surface::default(),
    }
}

pub(crate) fn built(spec: &ObstacleSpec, bed: &Terrain) -> Obstacle {
    Obstacle::build(spec, bed, Path::new("")).expect("a sound obstacle")
}

/// An obstacle at (10, -5) whose shape is a file with this text: heights if it ends in .asc, else a mesh.
pub(super) fn from_file(
    file: &str,
    text: &str,
    scale: f64,
    heading_deg: f64,
) -> (ObstacleSpec, Result<Obstacle, WorldError>) {
    let dir = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(dir.path().join(file), text).expect("a written file");
    let (name, scale) = (file.to_owned(), Positive::new(scale));
    let shape = if file.ends_with(".asc") {
        ShapeSpec::Heightfield(HeightfieldShape { file: name, scale })
    } else {
        ShapeSpec::Mesh(MeshShape { file: name, scale })
    };
    let spec = standing(shape, [10.0, -5.0], heading_deg);
    let built = Obstacle::build(&spec, &LEVEL, dir.path());
    (spec, built)
}

/// Heights of a plane that rises from 20 in the west to 24 m in the east, 1 m apart; in the middle stands a given text.
pub(super) fn ramp_of(middle: &str) -> String {
    let rows = format!("20 21 {middle} 23 24\n").repeat(4);
    format!("ncols 5\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 1\n{rows}")
}
