//! The fan of rays of a sidescan sonar to one side: the echo from each slant range.
//!
//! *Source:* energy from a surface element dA at range r under grazing angle γ: μ sin² γ dA / r⁴ (Urick 1983,
//! sections 8.2 and 8.11); seen from the sonar the element fills the solid angle dΩ = dA sin γ / r² = Θ dψ. With the
//! gain r³ of the time-varied amplifier and over a sample of length δr: μ sin γ r dψ / δr, which on a level bed is μ
//! sin² ψ / cos ψ, Lambert's law with the area Θ r δr / cos ψ of a pulse on the bed.
//!
//! *Parameters:* see [`crate::sense::SidescanSpec`]. There is one ray for each sample that the bed reaches. Where an
//! obstacle is near, there are more above (steps of [`ABOVE`]), and three side by side across the beam.
//!
//! *Deviations:* a ray's energy is spread over the samples that its part of the surface covers, as if the surface
//! were plane there: edges are sharp to a sample. The beam is Gaussian in the vertical with a floor of −40 dB; along
//! the track it has sharp edges.

use crate::sense::tools::EchoTarget;
use nalgebra::{UnitQuaternion, Vector3};
use std::f64::consts::{FRAC_PI_2, LN_10};
use world::math;
use world::obstacles::{Obstacle, Obstacles};
use world::terrain::Terrain;

/// Rays above the farthest ray to the bed: from this angle below the horizontal upwards (negative), in steps of, rad.
const ABOVE: (f64, f64) = (-0.5, 0.005);
/// Rays across the beam where an obstacle is near, as shares of its width.
const ACROSS: [f64; 3] = [-1.0 / 3.0, 0.0, 1.0 / 3.0];
/// Least share of the two-way power that the beam passes.
const LEAST: f64 = 1e-4;
/// Greatest number of samples that a ray's part of a surface covers.
const WIDEST: f64 = 20.0;

/// A fan to one side.
#[derive(Clone, Debug)]
pub(super) struct Fan {
    /// Greatest range, m.
    pub(super) range_m: f64,
    /// Number of samples over the range.
    pub(super) samples: usize,
    /// Width along the track, rad.
    pub(super) beam_rad: f64,
    /// Half the width in the vertical, rad.
    pub(super) half_aperture_rad: f64,
    /// Axis below the horizontal, rad.
    pub(super) tilt_rad: f64,
    /// Backscatter of the bed at 90°, as a factor.
    pub(super) bed: f64,
}

/// Directions of a fan.
struct Axes {
    side: Vector3<f64>,
    down: Vector3<f64>,
    ahead: Vector3<f64>,
}

impl Fan {
    /// Adds the strength of each sample's echo, as backscatter strength, to `echo`.
    pub(super) fn sound(
        &self,
        from: &Vector3<f64>,
        R_WB: &UnitQuaternion<f64>,
        port: bool,
        target: &EchoTarget,
        echo: &mut [f64],
    ) {
        let EchoTarget { terrain, obstacles } = target;
        let axes = axes(R_WB, port);
        let near = self.near(from, &axes, obstacles);
        let (height, tilt) = self.bed_below(from, &axes, terrain);
        let sample_m = self.range_m / self.samples as f64;
        let across: &[f64] = if near.is_empty() { &[0.0] } else { &ACROSS };
        let share = 1.0 / across.len() as f64;
        let mut ray = |angle: f64, width: f64| {
            for part in across {
                self.ray(from, R_WB, &axes, (angle, width, share), part * self.beam_rad, &near, terrain, echo);
            }
        };
        // The cells of angle that the samples cut out of a plane bed, and those above it.
        let mut upper = FRAC_PI_2 - tilt;
        let first = (height / sample_m).floor() as usize;
        for k in first..self.samples {
            let far = (k + 1) as f64 * sample_m;
            let lower = math::asin((height / far).min(1.0)) - tilt;
            if upper > lower {
                ray(0.5 * (upper + lower), upper - lower);
            }
            upper = lower;
        }
        let (top, step) = ABOVE;
        if !near.is_empty() {
            let n = ((upper - top) / step).ceil().max(1.0);
            let width = (upper - top) / n;
            for k in 0..n as u32 {
                ray(upper - (f64::from(k) + 0.5) * width, width);
            }
        }
    }

    /// Distance within the plane of the fan to the plane of the bed below, m, and the angle by which it rises to the
    /// side, rad.
    fn bed_below(&self, from: &Vector3<f64>, axes: &Axes, terrain: &Terrain) -> (f64, f64) {
        let Some(height) = terrain.ray(from, &axes.down, self.range_m) else {
            return (self.range_m, 0.0);
        };
        let foot = from + axes.down * height;
        let normal = terrain.normal(foot.x, foot.y);
        let (up, aside) = (-normal.dot(&axes.down), -normal.dot(&axes.side));
        let tilt = math::atan2(aside, up);
        (height * math::cos(tilt), tilt)
    }

    /// The obstacles that the fan may meet.
    fn near<'a>(&self, from: &Vector3<f64>, axes: &Axes, obstacles: &'a Obstacles) -> Vec<&'a Obstacle> {
        let half = 0.5 * self.beam_rad * self.range_m;
        let meets = |o: &&Obstacle| {
            let (middle, r) = o.ball();
            let to = middle - from;
            to.norm() < self.range_m + r && to.dot(&axes.ahead).abs() < half + r && to.dot(&axes.side) > -r
        };
        obstacles.0.iter().filter(meets).collect()
    }

    /// One ray at `angle` below the horizontal; it represents a cell of `width` and a share of the beam.
    #[allow(clippy::too_many_arguments, reason = "a ray is all of these")]
    fn ray(
        &self,
        from: &Vector3<f64>,
        R_WB: &UnitQuaternion<f64>,
        axes: &Axes,
        (angle, width, share): (f64, f64, f64),
        ahead: f64,
        near: &[&Obstacle],
        terrain: &Terrain,
        echo: &mut [f64],
    ) {
        let (s, c) = math::sin_cos(angle);
        let across = axes.side * c + axes.down * s;
        let dir = (across + axes.ahead * ahead).normalize();
        let bed = terrain.ray(from, &dir, self.range_m);
        let solid = (near.iter())
            .filter_map(|o| {
                let (way, normal) = o.cast(from, &dir, bed.unwrap_or(self.range_m))?;
                Some((way, normal, o.surface.backscatter_db.get()))
            })
            .min_by(|a, b| a.0.total_cmp(&b.0));
        let (way, normal, strength) = match (solid, bed) {
            (Some((way, normal, db)), _) => (way, normal, from_db(db)),
            (None, Some(way)) => {
                let p = from + dir * way;
                (way, terrain.normal(p.x, p.y), self.bed)
            }
            (None, None) => return,
        };
        let grazing = -dir.dot(&normal);
        if grazing <= 0.0 || way <= 0.0 {
            return;
        }
        let along = axes.down * c - axes.side * s;
        let sample_m = self.range_m / self.samples as f64;
        let energy = strength * grazing * way * width * share * self.beam(R_WB, &dir) / sample_m;
        let spread = (way * normal.dot(&along) / grazing * width).abs();
        let half = 0.5 * spread.min(WIDEST * sample_m) / sample_m;
        deposit(echo, way / sample_m - half, way / sample_m + half, energy);
    }

    /// Share of the two-way power that the beam passes.
    fn beam(&self, R_WB: &UnitQuaternion<f64>, dir: &Vector3<f64>) -> f64 {
        let below = math::asin((-R_WB.inverse_transform_vector(dir).z).clamp(-1.0, 1.0));
        let off = (below - self.tilt_rad) / self.half_aperture_rad;
        // Half the power one way, a quarter both ways, at the aperture's edge.
        math::exp(-std::f64::consts::LN_2 * 2.0 * off * off).max(LEAST)
    }
}

/// Spreads an energy evenly from `lo` to `hi`, in samples.
fn deposit(echo: &mut [f64], lo: f64, hi: f64, energy: f64) {
    let first = lo.max(0.0) as usize;
    if hi - lo < 1e-6 {
        if let Some(sample) = echo.get_mut(first) {
            *sample += energy;
        }
        return;
    }
    for k in first..echo.len().min(hi.ceil().max(0.0) as usize) {
        let part = (hi.min((k + 1) as f64) - lo.max(k as f64)).max(0.0);
        echo[k] += energy * part / (hi - lo);
    }
}

/// Level to the side, across the nose.
fn axes(R_WB: &UnitQuaternion<f64>, port: bool) -> Axes {
    let ahead = R_WB * Vector3::x();
    let level = Vector3::z().cross(&ahead);
    // A vehicle that stands on its tail has no level side: then use its own.
    let left = if level.norm() > 1e-6 { level.normalize() } else { R_WB * Vector3::y() };
    Axes { side: if port { left } else { -left }, down: left.cross(&ahead), ahead }
}

pub(super) fn from_db(db: f64) -> f64 {
    math::exp(db / 10.0 * LN_10)
}
