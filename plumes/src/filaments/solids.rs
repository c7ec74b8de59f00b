//! Solids that filaments may not be in: whoever ends a step inside is brought to the nearest free place.
//!
//! *Source*: mass conservation at a solid wall; the geometry is that of [`Obstacles`].
//!
//! *Parameters*: none.
//!
//! *Deviations*: brought out after the step rather than reflected at the moment of contact, so the path along a wall is
//! right to the length of a step. None is lost.

use super::store::Store;
use nalgebra::Vector3;
use world::obstacles::Obstacles;

/// The solids with boxes round them for the quick test.
#[derive(Clone, Debug, Default)]
pub(super) struct Solids {
    obstacles: Obstacles,
    boxes: Vec<(Vector3<f32>, Vector3<f32>)>,
}

impl Solids {
    pub(super) fn new(obstacles: Obstacles) -> Self {
        let boxes = (obstacles.0.iter())
            .map(|o| o.bounds())
            .map(|(low, high)| (low.map(|v| v as f32), high.map(|v| v as f32)))
            .collect();
        Self { obstacles, boxes }
    }

    /// Brings every filament of a store out of the solids; how many.
    pub(super) fn keep_out(&self, store: &mut Store) -> u64 {
        let mut brought = 0;
        for (low, high) in &self.boxes {
            for n in 0..store.len() {
                let p = Vector3::new(store.x[n], store.y[n], store.z[n]);
                if (0..3).any(|d| p[d] < low[d] || p[d] > high[d]) {
                    continue;
                }
                let out = self.obstacles.way_out(&p.map(f64::from));
                [store.x[n], store.y[n], store.z[n]] = [out.x as f32, out.y as f32, out.z as f32];
                brought += u64::from(out != p.map(f64::from));
            }
        }
        brought
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests_water::{Water, plume, pour, source};
    use nalgebra::Vector3;
    use std::path::Path;
    use world::obstacles::{BoxShape, CylinderShape, Obstacle, ObstacleSpec, Obstacles, ShapeSpec};
    use world::ranges::{Finite, HeadingDeg, Positive};
    use world::terrain::Terrain;

    fn solid(id: &str, shape: ShapeSpec, east_m: f64, heading_deg: f64) -> ObstacleSpec {
        ObstacleSpec {
            surface: Default::default(),
            id: id.into(),
            shape,
            east_m: Finite::new(east_m),
            north_m: Finite::new(0.0),
            base: Default::default(),
            heading_deg: HeadingDeg::new(heading_deg),
        }
    }

    /// Exact test 8: a cloud driven against a turned block and a pile; none is inside, none is lost.
    #[test]
    fn nobody_is_in_a_solid_and_nobody_is_lost() {
        let m = Positive::new;
        let bed = Terrain::Level { depth_m: 6.0 };
        let block = ShapeSpec::Box(BoxShape {
            size_m: (m(4.0), m(20.0), m(4.0)),
        });
        let pile = ShapeSpec::Cylinder(CylinderShape {
            radius_m: m(2.0),
            height_m: m(6.0),
        });
        let solids: Vec<Obstacle> = [
            solid("block", block, -60.0, 60.0),
            solid("pile", pile, -40.0, 90.0),
        ]
        .iter()
        .map(|s| Obstacle::build(s, &bed, Path::new(".")).unwrap())
        .collect();
        let water = Water(|_| 0.3, |_| (0.05, 0.002));
        let mut plume = plume(source(2.0, 20.0, 0.001, 0.03), &bed)
            .with_obstacles(Obstacles(solids.clone()))
            .unwrap();
        pour(&mut plume, 4000, -6.0, |k| {
            [
                -70.0,
                (k % 100) as f64 * 0.2 - 10.0,
                -0.1 - (k / 100) as f64 * 0.14,
            ]
        });
        for step in 0..300 {
            let t = f64::from(step) * 0.5;
            plume.drift(&water, t, t + 0.5);
            for f in plume.iter() {
                let p = Vector3::new(f[0], f[1], f[2]).map(f64::from);
                let inside = solids.iter().find(|o| o.contains(&p));
                assert!(inside.is_none(), "{p:?} is in {:?}", inside.map(|o| &o.id));
            }
        }
        assert_eq!(plume.left(), 0);
        assert_eq!(plume.len() as u64, plume.released());
    }

    #[test]
    fn a_source_in_a_solid_is_refused() {
        let bed = Terrain::Level { depth_m: 6.0 };
        let shape = ShapeSpec::Cylinder(CylinderShape {
            radius_m: Positive::new(2.0),
            height_m: Positive::new(6.0),
        });
        let pile =
            Obstacle::build(&solid("pile", shape, -90.0, 90.0), &bed, Path::new(".")).unwrap();
        let refused =
            plume(source(2.0, 5.0, 0.001, 0.03), &bed).with_obstacles(Obstacles(vec![pile]));
        assert_eq!(
            refused.unwrap_err().to_string(),
            "sources[0]: source \"s1\" stands inside obstacle \"pile\"; bring it outside"
        );
    }
}
