//! Made-up pings over a flat bed with blocks on it, for tests.

use super::Waterfall;
use crate::testing::seen;
use nalgebra::{Vector2, Vector3};
use robots::handoff::SidescanPing;
use std::f64::consts::LN_10;
use world::math;
use world::seeds::Stream;

/// Samples on a side, over 20 m.
const SAMPLES: usize = 400;
const RANGE_M: f64 = 20.0;
/// Height of the sonar, m.
pub(super) const HEIGHT_M: f64 = 3.0;

/// A bed with blocks. Of each block: place along the track and to starboard (negative: port), size, height, m.
pub(super) struct Bed {
    pub(super) blocks: Vec<(Vector2<f64>, f64, f64)>,
    /// Bright patches without height: middle and size, m.
    pub(super) patches: Vec<(Vector2<f64>, f64)>,
    pub(super) seed: u64,
}

impl Bed {
    pub(super) fn bare(seed: u64) -> Self {
        Self { blocks: Vec::new(), patches: Vec::new(), seed }
    }

    /// Strength of the echo from slant range `r` at `along` on a side (sign), as a factor of the noise.
    fn strength(&self, along: f64, sign: f64, r: f64) -> f64 {
        if r <= HEIGHT_M {
            return 1e-3;
        }
        let ground = (r * r - HEIGHT_M * HEIGHT_M).sqrt();
        let sin = HEIGHT_M / r;
        let mut s = 2000.0 * sin * sin / (ground / r).max(0.1);
        for (at, size) in &self.patches {
            let inside = |d: f64| d.abs() < 0.5 * size;
            if inside(along - at.x) && inside(sign * ground - at.y) {
                s *= 30.0;
            }
        }
        for (at, size, high) in &self.blocks {
            let across = sign * at.y;
            if (along - at.x).abs() > 0.5 * size || across < 0.0 {
                continue;
            }
            let (near, far) = (across - 0.5 * size, across + 0.5 * size);
            let up = HEIGHT_M - high;
            let slant = |g: f64, h: f64| (g * g + h * h).sqrt();
            if r > slant(near, up) && r < slant(far, up) {
                // Rock, 17 dB above the sand, met at 45 degrees or less.
                s = 2000.0 * 50.0 * 0.2;
            } else if r >= slant(far, up) && ground < far * HEIGHT_M / up {
                s = 0.0;
            }
        }
        s + 1.0
    }
}

/// Flies north from the origin at 2 m/s and 10 pings a second for `length_m`.
pub(super) fn fly(bed: &Bed, length_m: f64) -> Waterfall {
    let mut w = Waterfall::default();
    let mut rng = Stream::new(bed.seed, "test", "sidescan");
    for k in 0..(length_m / 0.2) as u32 {
        let along = 0.2 * f64::from(k);
        let mut side = |sign: f64| -> std::sync::Arc<[f32]> {
            let level = |n: usize| {
                let r = (n as f64 + 0.5) / SAMPLES as f64 * RANGE_M;
                let power = bed.strength(along, sign, r) * rng.exponential(1.0);
                (10.0 / LN_10 * math::ln(power)) as f32
            };
            (0..SAMPLES).map(level).collect()
        };
        let ping =
            SidescanPing { p_BS: Vector3::zeros(), max_m: RANGE_M, port_db: side(-1.0), starboard_db: side(1.0) };
        let mut o = seen(0.1 * f64::from(k), Vector2::new(0.0, along), 0.0, None);
        o.estimate.altitude_m = Some(HEIGHT_M);
        w.push(&ping, &o.estimate);
    }
    w
}
