//! One octave of small eddies: how strong it is at each height, how long its patterns live, and its velocity.
//!
//! *Source*, *Parameters*, *Deviations*: see the folder's head.

use super::super::overlapping;
use super::table::{LONGEST, Table};
use crate::flow::channel::Channel;
use crate::simd::f32x4::Pair;
use std::f64::consts::{PI, SQRT_2, TAU};
use world::math;
use world::seeds::Stream;

/// Cells from bed to surface in which strengths are linear.
const LEVELS: usize = 256;

/// Wave numbers from k to 2k.
#[derive(Clone, Debug)]
pub(crate) struct Octave {
    /// Half of the squared middle wave number, 1/m².
    half_k2: f32,
    /// Sides of the box in a metre, and its reciprocal.
    per_m: f32,
    side_m: f32,
    depth_m: f32,
    /// Root of the mean square of each component at the levels from the bed up, m/s.
    strength: Vec<f32>,
    /// Half of a pattern's life, s.
    period_s: f64,
}

/// A pattern at a time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Life {
    /// Its number among all of its octave.
    pub(crate) number: u32,
    /// Time since it began, s.
    pub(crate) age_s: f32,
    weight: f32,
    /// Where in the box its origin lies, in sides.
    begin: [f32; 3],
}

/// A height among the levels.
pub(super) struct Level {
    cell: usize,
    part: f32,
}

impl Octave {
    pub(super) fn new(channel: &Channel, k: f64) -> Self {
        let middle = SQRT_2 * k;
        let depth = channel.depth_m;
        let of = |n: usize| {
            let height = depth * n as f64 / LEVELS as f64;
            let walls = math::tanh(middle * height) * math::tanh(middle * (depth - height));
            (variance(channel, height, k).sqrt() * walls) as f32
        };
        // 1/(k u_k) with u_k² = kE: 1/(1.5^½ ε^⅓ k^⅔), with the depth mean of ε^⅓.
        let cubic = channel.mean_of(|z| math::cbrt(channel.dissipation(z)));
        let turn_over_s = 1.0 / (1.5_f64.sqrt() * cubic * math::powf(middle, 2.0 / 3.0));
        Self {
            half_k2: (0.5 * middle * middle) as f32,
            per_m: (k / (TAU * LONGEST)) as f32,
            side_m: (TAU * LONGEST / k) as f32,
            depth_m: depth as f32,
            strength: (0..=LEVELS).map(of).collect(),
            period_s: PI * PI / 8.0 * turn_over_s,
        }
    }

    /// The two patterns at a time: that with an even number, then that with an odd one. `stream` draws for a number.
    pub(super) fn lives(&self, t_s: f64, stream: impl Fn(u64) -> Stream) -> [Life; 2] {
        let of = |(number, weight): (f64, f64)| {
            let number = (number + 1.0) as u64;
            let mut rng = stream(number);
            Life {
                number: number as u32,
                age_s: (t_s - (number as f64 - 1.0) * self.period_s) as f32,
                weight: weight as f32,
                begin: std::array::from_fn(|_| rng.uniform() as f32),
            }
        };
        let [old, new] = overlapping(t_s.max(0.0) / self.period_s).map(of);
        if new.number.is_multiple_of(2) { [new, old] } else { [old, new] }
    }

    /// Part of the octave that is left in the mean over a kernel.
    pub(super) fn kept(&self, size_m: f32) -> f32 {
        let kept = math::exp(f64::from(-self.half_k2 * size_m * size_m)) as f32;
        // Not felt.
        if kept < 0.01 { 0.0 } else { kept }
    }

    /// Part that moves a marker with a kernel of this size: all or nothing.
    pub(super) fn marked(&self, size_m: f32) -> f32 {
        f32::from(2.0 * self.half_k2 * size_m * size_m < 4.0)
    }

    /// Where in the box a pattern's coordinates (m) are, in sides.
    #[inline(always)]
    fn in_table(&self, life: &Life, label: [f32; 3]) -> [f32; 3] {
        std::array::from_fn(|d| label[d] * self.per_m + life.begin[d])
    }

    /// Asks the processor for what a [velocity](Self::velocity) there reads.
    #[inline(always)]
    pub(super) fn fetch_soon(&self, table: &Table, life: &Life, label: [f32; 3]) {
        table.fetch_soon(self.in_table(life, label));
    }

    /// Velocity of a pattern at a height where its coordinates are `label` (m), m/s: the curl of its strength times its
    /// potential.
    ///
    /// # Safety
    /// The machine must have the instructions of `P`.
    #[inline(always)]
    pub(super) unsafe fn velocity<P: Pair>(
        &self,
        table: &Table,
        life: &Life,
        level: &Level,
        label: [f32; 3],
    ) -> [f32; 3] {
        // SAFETY: as the caller promises.
        let (v, a) = unsafe { table.interpolate::<P>(self.in_table(life, label)) };
        let (low, high) = (self.strength[level.cell], self.strength[level.cell + 1]);
        let strength = level.between(&self.strength);
        // The potential is that of a side of 1; its strength changes upwards only.
        let slope = (high - low) * (LEVELS as f32 / self.depth_m) * self.side_m;
        [
            life.weight * (strength * v[0] - slope * a[1]),
            life.weight * (strength * v[1] + slope * a[0]),
            life.weight * strength * v[2],
        ]
    }
}

/// A height (m, negative) among the levels of water of a depth.
#[inline]
pub(super) fn level(z: f32, depth_m: f32) -> Level {
    let at = (1.0 + z / depth_m).clamp(0.0, 1.0) * LEVELS as f32;
    let cell = (at as usize).min(LEVELS - 1);
    Level { cell, part: at - cell as f32 }
}

impl Level {
    /// What is linear between the levels.
    #[inline]
    pub(super) fn between(&self, levels: &[f32]) -> f32 {
        let (low, high) = (levels[self.cell], levels[self.cell + 1]);
        low + self.part * (high - low)
    }
}

/// Mean square of one component of the eddies with wave numbers from k to 2k at a height above the bed, m²/s².
pub(super) fn variance(channel: &Channel, height_m: f64, k: f64) -> f64 {
    const N: usize = 16;
    let epsilon = channel.dissipation(height_m);
    let nu = channel.viscosity_m2_s;
    let eta = (nu * nu * nu / epsilon).sqrt().sqrt();
    let energy = |k: f64| {
        let x = k * eta;
        1.5 * math::powf(epsilon, 2.0 / 3.0) * math::powf(k, -5.0 / 3.0) * math::exp(-2.25 * math::powf(x, 4.0 / 3.0))
    };
    let step = math::ln(2.0) / N as f64;
    let all: f64 = (0..N).map(|n| k * math::exp((n as f64 + 0.5) * step)).map(|k| k * energy(k) * step).sum();
    2.0 / 3.0 * all
}

/// Shear of the mean at the levels, 1/s.
pub(super) fn shear(channel: &Channel) -> Vec<f32> {
    let cell = channel.depth_m / LEVELS as f64;
    let of = |n: usize| {
        let height = n as f64 * cell;
        let (low, high) = ((height - 0.5 * cell).max(0.0), height + 0.5 * cell);
        ((channel.speed(high) - channel.speed(low)) / (high - low)) as f32
    };
    (0..=LEVELS).map(of).collect()
}
