//! Whether obstacles make sense where they stand.
//!
//! *Source*: none; these are placements that a scenario's author most likely did not intend.
//!
//! *Parameters*: none.
//!
//! *Deviations*: obstacles may overlap, as piles and the quay on them do. They then form one solid for hull, ranging,
//! filaments, voxels and water alike.

use super::{Obstacle, ObstacleSpec, Obstacles, ShapeSpec};
use crate::area::Area;
use crate::terrain::Terrain;
use nalgebra::{Vector2, Vector3};

/// If a surface from a file is this many times wider than the area's diagonal, its unit was not the metre.
const TOO_WIDE: f64 = 5.0;
/// A surface narrower than this was not meant in metres either, m.
const TOO_NARROW_M: f64 = 0.02;
/// Number of points along, across and upwards at which open water is searched.
const LOOKS: [usize; 3] = [64, 64, 8];

/// Something suspicious about an obstacle.
#[derive(Clone, Debug, PartialEq)]
pub struct Remark {
    /// Whether a run with it makes no sense.
    pub wrong: bool,
    /// The problem.
    pub problem: String,
    /// How to solve it.
    pub hint: String,
}

/// How many times higher than the water is deep a body may be.
const TOO_HIGH: f64 = 5.0;

fn remark(wrong: bool, problem: String, hint: &str) -> Remark {
    Remark { wrong, problem, hint: hint.into() }
}

impl Obstacle {
    /// What is suspicious about its size and place.
    pub fn remarks(&self, spec: &ObstacleSpec, area: &Area, terrain: &Terrain) -> Vec<Remark> {
        let (low, high) = self.bounds();
        let id = &self.id;
        let wide = (high - low).max();
        if matches!(spec.shape, ShapeSpec::Mesh(_) | ShapeSpec::Heightfield(_)) {
            let diagonal = Vector2::new(area.length_m, area.width_m).norm();
            if wide > TOO_WIDE * diagonal {
                let problem = format!(
                    "obstacle \"{id}\" is {wide:.0} m wide in an area of {:.0} x {:.0} m",
                    area.length_m, area.width_m
                );
                let thousandth = wide / 1000.0 <= TOO_WIDE * diagonal;
                let hint = if thousandth {
                    "if the file is in millimetres, give scale: 0.001"
                } else {
                    "give scale: metres in one unit of the file"
                };
                return vec![remark(true, problem, hint)];
            }
            if wide < TOO_NARROW_M {
                let problem = format!("obstacle \"{id}\" is only {wide:.2e} m wide");
                return vec![remark(
                    true,
                    problem,
                    "give scale: metres in one unit of the file; 1000 if it is in kilometres",
                )];
            }
        }
        let mut found = Vec::new();
        let (least, most) = area.bounds();
        if low.x > most.x || high.x < least.x || low.y > most.y || high.y < least.y {
            found.push(remark(
                false,
                format!("obstacle \"{id}\" lies wholly outside the area"),
                "bring it inside, or make the area larger",
            ));
        } else if low.z >= 0.0 {
            found.push(remark(
                false,
                format!("obstacle \"{id}\" stands wholly above the surface, from {:.2} m on", low.z),
                "give base: Depth(m below the surface)",
            ));
        } else {
            let beds = [(low.x, low.y), (low.x, high.y), (high.x, low.y), (high.x, high.y)];
            let deepest = beds.map(|(x, y)| terrain.bed_z(x, y)).into_iter().fold(f64::INFINITY, f64::min);
            if high.z <= deepest {
                found.push(remark(
                    false,
                    format!(
                        "obstacle \"{id}\" lies wholly under the bed: its top is {:.2} m below the surface",
                        -high.z
                    ),
                    "give a smaller depth in base",
                ));
            }
            let (high_m, depth_m) = (high.z - low.z, -deepest);
            if high_m > TOO_HIGH * depth_m {
                let problem = format!("obstacle \"{id}\" is {high_m:.0} m high in water of {depth_m:.1} m");
                let hint = "look at its scale, and at heights in a file that stand for gaps";
                found.push(remark(false, problem, hint));
            }
        }
        found
    }
}

impl ObstacleSpec {
    /// Whether it differs from another obstacle only in its name.
    pub fn is_copy_of(&self, other: &Self) -> bool {
        let renamed = Self { id: other.id.clone(), ..self.clone() };
        renamed == *other
    }

    /// The file with its shape, as the scenario names it.
    pub fn file(&self) -> Option<&str> {
        match &self.shape {
            ShapeSpec::Mesh(m) => Some(&m.file),
            ShapeSpec::Heightfield(h) => Some(&h.file),
            ShapeSpec::Box(_) | ShapeSpec::Cylinder(_) => None,
        }
    }
}

impl Obstacles {
    /// The obstacles whose ids are not among `ids`.
    pub fn without(&self, ids: &[String]) -> Self {
        let stays = |o: &&Obstacle| !ids.contains(&o.id);
        Self(self.0.iter().filter(stays).cloned().collect())
    }

    /// Whether the obstacles leave open water in the area, tested on a dense grid of points.
    pub fn leave_water(&self, area: &Area, terrain: &Terrain) -> bool {
        let part = |n: usize, d: usize| (n as f64 + 0.5) / LOOKS[d] as f64;
        (0..LOOKS[0]).any(|i| {
            (0..LOOKS[1]).any(|j| {
                let local = Vector2::new((part(i, 0) - 0.5) * area.length_m, (part(j, 1) - 0.5) * area.width_m);
                let p = area.world(local);
                let bed = terrain.bed_z(p.x, p.y);
                (0..LOOKS[2]).any(|k| self.containing(&Vector3::new(p.x, p.y, bed * part(k, 2))).is_none())
            })
        })
    }
}
