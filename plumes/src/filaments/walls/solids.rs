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
