//! The cascade below the eddies of the grid: octaves of small eddies that move with the rest of the water.
//!
//! *Source*: kinematic simulation as a sub-grid model (Flohr & Vassilicos 2000, J. Fluid Mech. 407, 315), with E(k) =
//! 1.5 ε^⅔ k^(−5/3) exp(−2.25 (kη)^(4/3)) (Pao 1965, Phys. Fluids 8, 1063; constant: Sreenivasan 1995, Phys. Fluids 7,
//! 2778). Small eddies are swept along by the large ones; a field that is not is too weak a stirrer (Thomson & Devenish
//! 2005, J. Fluid Mech. 526, 277). Here they are a function of coordinates that move with the mean flow and the eddies
//! of the grid: each filament remembers, for each pattern, where it was in it when the pattern began.
//!
//! *Parameters*: [`SmallSpec`]. ε(z) and η(z) are the channel's.
//!
//! *Deviations*: an octave has two patterns at a time, which overlap with the weights sin and cos as those of the grid
//! do, and live for the turn-over time 1/(k u_k), with u_k² = kE and the depth mean of ε^⅓. A pattern is drawn out by
//! the mean shear since it began, and by nothing else. Towards bed and surface each octave falls as tanh(kz), by its
//! potential, so that its velocity stays free of divergence. A filament is moved by each octave's mean over its kernel,
//! exp(−k²R²/2) of it, as long as it grows; eddies smaller than itself make it grow. Once it has reached the size at
//! which it stops growing, it is a marker: the octaves whose waves are longer than about its circumference, kR < 2,
//! move it as the water at its centre. Shorter ones, which its kernel would hide, do not; they would spread it by less
//! than a twentieth of what all eddies do. The velocity of the water at a place, as instruments see it, excludes these
//! octaves: they are known only where filaments are.

mod octave;
mod table;
#[cfg(test)]
pub(crate) mod tests;

use crate::error::PlumeError;
use crate::flow::channel::Channel;
use crate::simd::f32x4::Pair;
use nalgebra::Vector2;
pub(crate) use octave::{Life, Octave};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::cost::{Cost, Part};
use world::math;
use world::ranges::Positive;
use world::seeds::{Seed, Stream};

/// The small eddies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SmallSpec {
    /// Length of the shortest waves, m. Each halving from the grid's shortest wave down is one octave.
    #[serde(with = "world::limits::eddy_m")]
    pub finest_m: Positive,
}

/// Most octaves.
pub(crate) const MOST_OCTAVES: usize = 8;

/// What the table of all octaves needs, once in a process.
pub(super) fn cost() -> Cost {
    let nodes = table::COUNT as f64;
    let part =
        Part::new("finest_m", format!("{nodes:.1e} nodes of small eddies")).holds(nodes * 40.0).takes(nodes * 1e-6);
    Cost::single(part)
}

/// The part of each octave that moves a filament.
pub(crate) type Weights = [f32; MOST_OCTAVES];

/// The octaves of a channel.
#[derive(Clone, Debug)]
pub struct Small {
    octaves: Vec<Octave>,
    along: Vector2<f32>,
    depth_m: f32,
    /// Shear of the mean at the levels of the octaves, 1/s.
    shear: Vec<f32>,
    seed: Seed,
    /// Greatest wave number, 1/m.
    pub(crate) k_f: f64,
}

impl SmallSpec {
    /// The octaves from a wave number of the grid's shortest waves on, checked.
    ///
    /// # Errors
    /// If it is not below the grid's shortest wave, or too far below it.
    pub(super) fn build(&self, field: &str, channel: &Channel, k_c: f64, seed: Seed) -> Result<Small, PlumeError> {
        let longest_m = std::f64::consts::TAU / k_c;
        let finest_m = self.finest_m.get();
        let count = math::ln(longest_m / finest_m) / std::f64::consts::LN_2;
        let least = longest_m / f64::from(1_u32 << MOST_OCTAVES);
        if !(least..=longest_m / 2.0).contains(&finest_m) {
            let problem = format!(
                "must be from {least:.2e} to {:.2e}, an octave or more below the grid's shortest wave of {longest_m:.3} m, got {finest_m}",
                longest_m / 2.0
            );
            return Err(PlumeError::new(format!("{field}.finest_m"), problem));
        }
        let count = (count - 1e-9).ceil() as i32;
        let octaves = (0..count).map(|n| Octave::new(channel, k_c * 2.0_f64.powi(n)));
        Ok(Small {
            octaves: octaves.collect(),
            along: channel.along.map(|v| v as f32),
            depth_m: channel.depth_m as f32,
            shear: octave::shear(channel),
            seed,
            k_f: k_c * 2.0_f64.powi(count),
        })
    }
}

impl Small {
    /// Draws what all octaves share.
    pub(super) fn draw() {
        table::table();
    }

    /// Number of patterns that each filament has coordinates in: two for each octave.
    pub(crate) fn patterns(&self) -> usize {
        2 * self.octaves.len()
    }

    /// The patterns at a time, two for each octave: the even one and the odd one.
    pub(crate) fn lives(&self, t_s: f64) -> Vec<Life> {
        let of = |(n, octave): (usize, &Octave)| {
            octave.lives(t_s, |life| Stream::new(self.seed, "eddies", &format!("octave {n} pattern {life}")))
        };
        self.octaves.iter().enumerate().flat_map(of).collect()
    }

    /// The part of each octave that moves a filament of a size, m.
    #[inline(always)]
    pub(crate) fn weights(&self, size_m: f32, grown: bool) -> Weights {
        let mut weights = [0.0; MOST_OCTAVES];
        for (weight, octave) in weights.iter_mut().zip(&self.octaves) {
            *weight = if grown { octave.marked(size_m) } else { octave.kept(size_m) };
        }
        weights
    }

    /// Asks the processor for what a [velocity](Self::velocity) there reads.
    #[inline(always)]
    pub(crate) fn fetch_soon(&self, lives: &[Life], weights: &Weights, labels: &[[f32; 3]]) {
        let table = table::table();
        for (n, (octave, weight)) in self.octaves.iter().zip(weights).enumerate() {
            if *weight != 0.0 {
                for (life, label) in lives[2 * n..2 * n + 2].iter().zip(&labels[2 * n..]) {
                    octave.fetch_soon(table, life, *label);
                }
            }
        }
    }

    /// Velocity (east, north, up) at a height where the coordinates in the patterns are `labels`, m/s.
    ///
    /// # Safety
    /// The machine must have the instructions of `P`.
    #[inline(always)]
    pub(crate) unsafe fn velocity<P: Pair>(
        &self,
        lives: &[Life],
        z: f32,
        weights: &Weights,
        labels: &[[f32; 3]],
    ) -> [f32; 3] {
        let table = table::table();
        let mut sum = [0.0_f32; 3];
        let level = octave::level(z, self.depth_m);
        let shear = level.between(&self.shear);
        for (n, (octave, weight)) in self.octaves.iter().zip(weights).enumerate() {
            if *weight == 0.0 {
                continue;
            }
            for (life, label) in lives[2 * n..2 * n + 2].iter().zip(&labels[2 * n..]) {
                // SAFETY: as the caller promises.
                let v = unsafe { octave.velocity::<P>(table, life, &level, *label) };
                let drawn_out = shear * life.age_s * v[2];
                let by = [v[0] + drawn_out * self.along.x, v[1] + drawn_out * self.along.y, v[2]];
                for d in 0..3 {
                    sum[d] += weight * by[d];
                }
            }
        }
        sum
    }
}
