//! The operating area: a rectangle at any heading, centred on the datum.

use crate::units::Heading;
use bevy_ecs::prelude::Resource;
use nalgebra::Vector2;

/// Rectangle of `length_m` along `axis` and `width_m` across it, centred at `centre` (east, north).
#[derive(Resource, Clone, Copy, Debug, PartialEq)]
pub struct Area {
    /// Centre (east, north), m.
    pub centre: Vector2<f64>,
    /// Extent along the axis, m.
    pub length_m: f64,
    /// Extent across the axis, m.
    pub width_m: f64,
    /// Direction of the long axis.
    pub axis: Heading,
}

impl Area {
    /// Unit vectors along the axis and to the right of it (east, north).
    fn axes(&self) -> [Vector2<f64>; 2] {
        let right = self.axis.turned(std::f64::consts::FRAC_PI_2);
        [self.axis.unit(), right.unit()]
    }

    /// Coordinates of a world point in the area: (distance along the axis, distance to the right of it), m.
    pub fn local(&self, p: Vector2<f64>) -> Vector2<f64> {
        let d = p - self.centre;
        self.axes().map(|axis| d.dot(&axis)).into()
    }

    /// World point (east, north) for the area's coordinates (along, across).
    pub fn world(&self, local: Vector2<f64>) -> Vector2<f64> {
        let [a, r] = self.axes();
        self.centre + a * local.x + r * local.y
    }

    /// Whether a point lies inside, edges included.
    pub fn contains(&self, p: Vector2<f64>) -> bool {
        self.edge_distance(p).0 >= 0.0
    }

    /// Its sides, for questions in every tick.
    pub fn sides(&self) -> Sides {
        Sides { axes: self.axes(), area: *self }
    }

    /// Signed distance to the nearest edge, m (positive inside), and that edge's outward normal (east, north).
    pub fn edge_distance(&self, p: Vector2<f64>) -> (f64, Vector2<f64>) {
        self.sides().edge_distance(p)
    }

    /// The four corners in world coordinates, in order round the rectangle.
    pub fn corners(&self) -> [Vector2<f64>; 4] {
        let (l, w) = (self.length_m / 2.0, self.width_m / 2.0);
        [(l, w), (l, -w), (-l, -w), (-l, w)].map(|(x, y)| self.world(Vector2::new(x, y)))
    }

    /// Axis-aligned bounds (min, max) in world coordinates.
    pub fn bounds(&self) -> (Vector2<f64>, Vector2<f64>) {
        let c = self.corners();
        let min = c.iter().fold(c[0], |m, p| m.inf(p));
        let max = c.iter().fold(c[0], |m, p| m.sup(p));
        (min, max)
    }
}

/// An area with the directions of its sides: its questions need no trigonometry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sides {
    area: Area,
    axes: [Vector2<f64>; 2],
}

impl Sides {
    /// The area.
    pub fn area(&self) -> &Area {
        &self.area
    }

    /// Signed distance to the nearest edge, m (positive inside), and that edge's outward normal (east, north).
    pub fn edge_distance(&self, p: Vector2<f64>) -> (f64, Vector2<f64>) {
        let Area { centre, length_m, width_m, .. } = self.area;
        let [x, y] = self.axes.map(|axis| (p - centre).dot(&axis));
        let (dx, dy) = (length_m / 2.0 - x.abs(), width_m / 2.0 - y.abs());
        let [a, r] = [self.axes[0] * x.signum(), self.axes[1] * y.signum()];
        if dx < 0.0 && dy < 0.0 {
            let out = a * -dx + r * -dy;
            let d = out.norm();
            (-d, out / d)
        } else if dx <= dy {
            (dx, a)
        } else {
            (dy, r)
        }
    }

    /// For each edge: the distance to it (m, positive inside) and its outward normal (east, north).
    pub fn edges(&self, p: Vector2<f64>) -> [(f64, Vector2<f64>); 4] {
        let [along, across] = self.axes;
        let [x, y] = self.axes.map(|axis| (p - self.area.centre).dot(&axis));
        let (l, w) = (self.area.length_m / 2.0, self.area.width_m / 2.0);
        [(l - x, along), (l + x, -along), (w - y, across), (w + y, -across)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn duck() -> Area {
        Area { centre: Vector2::zeros(), length_m: 1094.0, width_m: 367.0, axis: Heading::from_deg(340.0) }
    }

    #[test]
    fn local_and_world_are_inverse() {
        let a = duck();
        let p = Vector2::new(-242.0, 414.0);
        assert!((a.world(a.local(p)) - p).norm() < 1e-9);
        assert!(a.contains(p));
    }

    #[test]
    fn distance_is_signed_and_normal_points_out() {
        let a = duck();
        let inside = a.world(Vector2::new(540.0, 0.0));
        let (d, n) = a.edge_distance(inside);
        assert!((d - 7.0).abs() < 1e-9 && (n - a.axis.unit()).norm() < 1e-9);
        let outside = a.world(Vector2::new(550.0, 187.5));
        let (d, n) = a.edge_distance(outside);
        assert!((d + 5.0).abs() < 1e-9);
        assert!((a.edge_distance(outside - n * 5.001).0).abs() < 0.01);
    }
}
