//! Obstacles as filaments meet them, with bounding boxes for a quick test.
//!
//! *Source*: the geometry is that of [`Obstacles`].
//!
//! *Parameters*: none.
//!
//! *Deviations*: none.

use nalgebra::{Vector2, Vector3};
use world::obstacles::{Obstacle, Obstacles};

/// The solids, asked in coordinates from the datum of the filaments.
#[derive(Clone, Debug, Default)]
pub(crate) struct Solids {
    obstacles: Obstacles,
    /// Where the datum of all points here lies in the world, m.
    datum: Vector3<f64>,
    boxes: Vec<[Vector3<f64>; 2]>,
}

impl Solids {
    pub(crate) fn new(obstacles: Obstacles, datum: Vector2<f64>) -> Self {
        let datum = datum.push(0.0);
        let bounds = |o: &Obstacle| <[_; 2]>::from(o.bounds()).map(|p| p - datum);
        let boxes = obstacles.0.iter().map(bounds).collect();
        Self { obstacles, datum, boxes }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.boxes.is_empty()
    }

    /// Obstacles whose boxes overlap another box.
    fn meeting(&self, low: Vector3<f64>, high: Vector3<f64>) -> impl Iterator<Item = &Obstacle> + '_ {
        let met = move |b: &[Vector3<f64>; 2]| (0..3).all(|d| low[d] <= b[1][d] && high[d] >= b[0][d]);
        let all = self.boxes.iter().zip(&self.obstacles.0);
        all.filter(move |(b, _)| met(b)).map(|(_, o)| o)
    }

    /// Whether a point lies within a reach (m) of an obstacle's box.
    pub(crate) fn near(&self, p: [f32; 3], reach: f64) -> bool {
        let p = Vector3::from(p.map(f64::from));
        let reach = Vector3::repeat(reach);
        self.meeting(p - reach, p + reach).next().is_some()
    }

    /// Whether the way from one point to another passes an obstacle's box.
    pub(crate) fn by(&self, from: [f32; 3], to: [f32; 3]) -> bool {
        let [a, b] = [from, to].map(|p| Vector3::from(p.map(f64::from)));
        self.meeting(a.inf(&b), a.sup(&b)).next().is_some()
    }

    /// Distance along a unit vector to the first surface, at most `most` (m).
    pub(crate) fn ray(&self, from: &Vector3<f64>, along: &Vector3<f64>, most: f64) -> Option<f64> {
        let to = from + along * most;
        let hits = self.meeting(from.inf(&to), from.sup(&to));
        let from = from + self.datum;
        hits.filter_map(|o| o.ray(&from, along, most)).min_by(f64::total_cmp)
    }

    /// Whether one point is visible from another; obstacles that contain the first point do not count.
    pub(crate) fn sees(&self, from: &Vector3<f64>, to: &Vector3<f64>) -> bool {
        let way = to - from;
        let far = way.norm();
        let eye = from + self.datum;
        far == 0.0
            || self.meeting(from.inf(to), from.sup(to)).all(|o| o.contains(&eye) || o.ray(&eye, &way, far).is_none())
    }

    /// The obstacle that contains a point.
    pub(crate) fn containing(&self, p: &Vector3<f64>) -> Option<&Obstacle> {
        let at = p + self.datum;
        self.meeting(*p, *p).find(|o| o.contains(&at))
    }

    /// The nearest free point; see [`Obstacles::way_out`].
    pub(crate) fn way_out(&self, p: &Vector3<f64>) -> Vector3<f64> {
        self.obstacles.way_out(&(p + self.datum)) - self.datum
    }
}

#[cfg(test)]
mod tests {
    use crate::filaments::tests::water::{Given, plume, pour, source};
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

    /// Exact test 8: a cloud is driven against a turned block and a pile; no filament is inside, and none is lost.
    #[test]
    fn nobody_is_in_a_solid_and_nobody_is_lost() {
        let m = Positive::new;
        let bed = Terrain::Level { depth_m: 6.0 };
        let block = ShapeSpec::Box(BoxShape { size_m: (m(4.0), m(20.0), m(4.0)) });
        let pile = ShapeSpec::Cylinder(CylinderShape { radius_m: m(2.0), height_m: m(6.0) });
        let solids: Vec<Obstacle> = [solid("block", block, -60.0, 60.0), solid("pile", pile, -40.0, 90.0)]
            .iter()
            .map(|s| Obstacle::build(s, &bed, Path::new(".")).unwrap())
            .collect();
        let water = Given(|_| 0.3, |_| (0.05, 0.002));
        let mut plume = plume(source(2.0, 20.0, 0.001, 0.03), &bed).with_obstacles(Obstacles(solids.clone())).unwrap();
        pour(&mut plume, 4000, -6.0, |k| [-70.0, (k % 100) as f64 * 0.2 - 10.0, -0.1 - (k / 100) as f64 * 0.14]);
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
        let shape = ShapeSpec::Cylinder(CylinderShape { radius_m: Positive::new(2.0), height_m: Positive::new(6.0) });
        let pile = Obstacle::build(&solid("pile", shape, -90.0, 90.0), &bed, Path::new(".")).unwrap();
        let refused = plume(source(2.0, 5.0, 0.001, 0.03), &bed).with_obstacles(Obstacles(vec![pile]));
        assert_eq!(
            refused.unwrap_err().to_string(),
            "sources[0]: source \"s1\" stands inside obstacle \"pile\"; bring it outside"
        );
    }
}
