//! How much of a hull is under water near the surface.
//!
//! *Source:* hydrostatics of a hull cut into parts, each wet in proportion to how much of its height is below z = 0:
//! slices of a prolate spheroid for a torpedo, small boxes of the collision shapes for any other hull.
//!
//! *Parameters:* length and diameter, or the boxes.
//!
//! *Deviations:* the wetted share of a part is taken as linear in its draught (an error of at most 6 % of a round
//! slice), and boxes stay upright when the hull heels; no waves at the surface.

use super::axes::flip;
use nalgebra::Vector3;
use world::frames::Pose;
use world::physics::Shape;

/// Slices along a spheroid.
const SLICES: usize = 10;
/// Boxes along the longest side of a hull.
const BOXES: usize = 20;

/// A hull's shape where it comes out of the water.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::vehicles) enum Envelope {
    /// A prolate spheroid along x, round its origin: length and diameter, m.
    Spheroid(f64, f64),
    /// Small boxes of equal volume.
    Boxes(Boxes),
}

/// Small boxes that fill a hull.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::vehicles) struct Boxes {
    /// Their middles, m, FLU.
    at: Vec<Vector3<f64>>,
    /// Half their height, m.
    half_m: f64,
    /// No part is farther than this from the origin, m.
    reach_m: f64,
    /// Middle of all, m, FLU.
    middle: Vector3<f64>,
}

impl Envelope {
    /// Share of the volume under water, and its middle (m, FRD) from the middle of the whole. The origin is at height
    /// `z_m`; `up` is the world's z axis in body axes (FLU).
    pub(super) fn wet(&self, z_m: f64, up: &Vector3<f64>) -> (f64, Vector3<f64>) {
        match self {
            Self::Spheroid(length_m, diameter_m) => {
                let (share, x) = spheroid(*length_m, *diameter_m, z_m, up.x);
                (share, Vector3::new(x, 0.0, 0.0))
            }
            Self::Boxes(boxes) => boxes.wet(z_m, up),
        }
    }
}

impl Boxes {
    fn wet(&self, z_m: f64, up: &Vector3<f64>) -> (f64, Vector3<f64>) {
        if z_m + self.reach_m <= 0.0 {
            return (1.0, Vector3::zeros());
        }
        let (mut wet, mut at) = (0.0, Vector3::zeros());
        for p in &self.at {
            let z = z_m + up.dot(p);
            let share = ((self.half_m - z) / (2.0 * self.half_m)).clamp(0.0, 1.0);
            wet += share;
            at += p * share;
        }
        if wet == 0.0 {
            return (0.0, Vector3::zeros());
        }
        (wet / self.at.len() as f64, flip(at / wet - self.middle))
    }
}

/// Fills shapes, given in body axes (FLU), with boxes. Empty shapes give one box at the origin.
pub(in crate::vehicles) fn cells_of(shapes: &[(Pose, Shape)]) -> Envelope {
    let (mut low, mut high) = (Vector3::repeat(f64::MAX), Vector3::repeat(f64::MIN));
    for (pose, shape) in shapes {
        let reach = Vector3::repeat(shape.reach_m());
        low = low.inf(&(pose.p_WB - reach));
        high = high.sup(&(pose.p_WB + reach));
    }
    // Twice: the spheres round long shapes are far larger than the shapes.
    let mut at = filled(shapes, &low, &high);
    for half in [at.1, at.1] {
        let (mut tight_low, mut tight_high) = (high, low);
        for p in &at.0 {
            tight_low = tight_low.inf(&(p - Vector3::repeat(2.0 * half)));
            tight_high = tight_high.sup(&(p + Vector3::repeat(2.0 * half)));
        }
        if !at.0.is_empty() {
            at = filled(shapes, &tight_low, &tight_high);
        }
    }
    let (mut at, half_m) = at;
    if at.is_empty() {
        at.push(Vector3::zeros());
    }
    let middle = at.iter().sum::<Vector3<f64>>() / at.len() as f64;
    let reach_m = at.iter().map(|p| p.norm()).fold(0.0, f64::max) + half_m;
    Envelope::Boxes(Boxes { at, half_m, reach_m, middle })
}

/// Middles of the boxes within shapes, on a grid between two corners, and half their side.
fn filled(shapes: &[(Pose, Shape)], low: &Vector3<f64>, high: &Vector3<f64>) -> (Vec<Vector3<f64>>, f64) {
    let inside: Vec<_> = shapes.iter().map(|(pose, s)| (pose, s.inside())).collect();
    let size = high - low;
    let side = (size.max() / BOXES as f64).max(1e-3);
    let n = size.map(|s| ((s / side).round() as usize).max(1));
    // Centred, so that a hull alike on both sides is filled alike on both sides.
    let from = (low + high) / 2.0 - n.map(|n| n as f64 * side / 2.0);
    let mut at = Vec::new();
    for i in 0..n.x {
        for j in 0..n.y {
            for k in 0..n.z {
                let p = from + Vector3::new(i as f64 + 0.5, j as f64 + 0.5, k as f64 + 0.5) * side;
                if (inside.iter()).any(|(pose, within)| within(&(pose.R_WB.inverse() * (p - pose.p_WB)))) {
                    at.push(p);
                }
            }
        }
    }
    (at, side / 2.0)
}

/// Share of the volume under water, and its middle along the hull (m), for a hull whose centre is at height `z_m` and
/// whose nose points up with sine `climb`.
fn spheroid(length_m: f64, diameter_m: f64, z_m: f64, climb: f64) -> (f64, f64) {
    let half = length_m / 2.0;
    if z_m + half * climb.abs() + diameter_m / 2.0 <= 0.0 {
        return (1.0, 0.0);
    }
    let (mut all, mut wet, mut at) = (0.0, 0.0, 0.0);
    for i in 0..SLICES {
        let s = (i as f64 + 0.5) / SLICES as f64 * 2.0 - 1.0;
        let volume = 1.0 - s * s;
        let radius = diameter_m / 2.0 * volume.sqrt();
        let z = z_m + s * half * climb;
        let share = ((radius - z) / (2.0 * radius)).clamp(0.0, 1.0);
        all += volume;
        wet += volume * share;
        at += volume * share * s * half;
    }
    let middle = if wet > 0.0 { at / wet } else { 0.0 };
    (wet / all, middle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::UnitQuaternion;

    #[test]
    fn deep_is_wet_and_high_is_dry() {
        assert_eq!(spheroid(1.6, 0.19, -1.0, 1.0), (1.0, 0.0));
        assert_eq!(spheroid(1.6, 0.19, 0.2, 0.0), (0.0, 0.0));
        let (half, middle) = spheroid(1.6, 0.19, 0.0, 0.0);
        assert!((half - 0.5).abs() < 1e-12 && middle.abs() < 1e-12);
    }

    #[test]
    fn the_high_end_dries_first() {
        let (share, middle) = spheroid(1.6, 0.19, 0.0, 0.5);
        assert!(middle < -0.1 && share > 0.4 && share < 0.6);
    }

    fn float(y: f64) -> (Pose, Shape) {
        let pose = Pose { p_WB: Vector3::new(0.0, y, 0.0), R_WB: UnitQuaternion::identity() };
        let size_m = Vector3::new(2.0, 0.2, 0.3);
        (pose, Shape::Box { size_m })
    }

    /// A craft on two floats: half under when level, and buoyancy moves to the side that is pressed down.
    #[test]
    fn two_floats_are_filled_and_right_themselves() {
        let craft = cells_of(&[float(0.4), float(-0.4)]);
        let Envelope::Boxes(boxes) = &craft else { panic!("boxes") };
        assert!(boxes.at.len() > 20 && boxes.middle.norm() < 1e-12);
        let level = Vector3::z();
        assert_eq!(craft.wet(-3.0, &level), (1.0, Vector3::zeros()));
        assert_eq!(craft.wet(3.0, &level).0, 0.0);
        let (share, at) = craft.wet(0.0, &level);
        assert!((share - 0.5).abs() < 0.02, "{share}");
        assert!(at.xy().norm() < 1e-12);
        // Rolled to port, its left side (+y in FLU, -y in FRD) is down.
        let rolled = UnitQuaternion::from_euler_angles(-0.1, 0.0, 0.0).inverse() * Vector3::z();
        let (_, at) = craft.wet(0.0, &rolled);
        assert!(at.y < -0.05, "{at}");
    }
}
