//! Surface waves: the sum of wave trains and a wind sea. Hulls and instruments feel orbits, the plume drift and mixing.
//!
//! *Source*: linear superposition of the waves of `airy`. For filaments, the Lagrangian mean of Andrews & McIntyre
//! 1978, J. Fluid Mech. 89, 609: mean places move with the current plus Stokes' drift, and a particle is at its mean
//! place plus the displacement by the orbit. Vertical mixing under waves K_z = 0.028 H²/T e^(2kz), attributed to Ichiye
//! from dye (1967, Phys. Fluids 10(9), S270): a secondary source, see (6).
//!
//! *Parameters*: `trains` (regular waves: `height_m` from trough to crest, `period_s`, `heading_deg` of their travel,
//! `phase_deg` at the area's centre at time zero, drawn if absent), `spectrum` (file `spectrum`), `stokes` drift on or off
//! (on), `mixing` Ichiye's coefficient (0.028; 0 omits it).
//!
//! *Deviations*: (1) the plume's grid of currents is evaluated every few seconds and would alias waves of seconds, so
//! it leaves the orbits out. Filaments are stored at their mean places and moved by the current and Stokes' drift. A
//! fixed source releases at p − ξ(p, t), and a question for the concentration at p is answered for p − ξ(p, t), with ξ
//! the displacement by the orbit: first order in the steepness. So dye moves past a fixed probe with the waves, and a
//! probe near the surface is in the air in a trough. (2) Drift sums over waves one by one; two of the same period in
//! different directions would add a standing part. No undertow returns the drift. (3) For the mixing, H² is 16
//! variances and T the period of a train or of the spectrum's peak. (4) Over a bed that is not level, the waves are
//! those of the depth at the area's centre: there is no shoaling and no refraction, and elsewhere at the bed the water
//! is not quite tangent to it. Obstacles do not bend or shelter waves. (5) Waves do not thicken the bed's boundary
//! layer. (6) The paper of 1967 was not available; form and coefficient are as oil-spill models give them. A
//! coefficient twice as large makes the layer of dye that waves alone have mixed √2 times as thick and its middle
//! weaker by the same factor. Under the sea of 0.35 m and 2.6 s of dalian_bay, K_z is 13 cm²/s at the surface and 2.2
//! cm²/s at 1.5 m, and σ_z grows by 0.9 m in the half hour to 350 m; with twice the coefficient, by 1.2 m. Stirring by
//! the wind is not included: by Sundby 1983, Deep-Sea Res. 30, 645, K = 76 + 2.26 U² cm²/s for U in m/s, a wind of 7
//! m/s has 190 cm²/s.

use nalgebra::{Vector2, Vector3};
use world::fields::WaterSample;

use super::airy::Airy;

/// Levels of the profile, which is linear between them.
pub(super) const LEVELS: usize = 1024;

/// The waves, ready to be evaluated.
#[derive(Clone, Debug)]
pub struct Waves {
    pub(super) waves: Vec<Airy>,
    pub(super) depth: f64,
    // Stokes' drift (east, north) and K_z at evenly spaced heights from bed to surface.
    pub(super) profile: Vec<(Vector2<f64>, f64)>,
}

impl Waves {
    /// Orbital velocity at a place (ENU, m), m/s.
    pub fn velocity(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
        self.waves.iter().map(|w| w.velocity(p, t_s)).sum()
    }

    /// Adds orbital velocity, its gradient and rate of change to those of the rest of the water.
    pub(crate) fn add_to(&self, sample: &mut WaterSample, p: &Vector3<f64>, t_s: f64) {
        for w in &self.waves {
            w.add_to(sample, p, t_s);
        }
    }

    /// Displacement of the water whose mean place is `p`, m; at the surface, its height is the surface's.
    pub fn displacement(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
        self.waves.iter().map(|w| w.displacement(p, t_s)).sum()
    }

    /// Head of the waves' pressure at a place, m of water.
    pub fn head(&self, p: &Vector3<f64>, t_s: f64) -> f64 {
        self.waves.iter().map(|w| w.head(p, t_s)).sum()
    }

    /// Stokes' drift (east, north) at a height, m/s; zero if it is off.
    pub fn drift(&self, z: f64) -> Vector2<f64> {
        let (n, part) = self.level(z);
        self.profile[n].0.lerp(&self.profile[n + 1].0, part)
    }

    /// Vertical diffusivity by waves at a height, m²/s.
    pub fn vertical(&self, z: f64) -> f64 {
        let (n, part) = self.level(z);
        self.profile[n].1 + (self.profile[n + 1].1 - self.profile[n].1) * part
    }

    /// Variance of the surface, m².
    pub fn variance(&self) -> f64 {
        self.waves.iter().map(Airy::variance).sum()
    }

    fn level(&self, z: f64) -> (usize, f64) {
        let at = (z / self.depth + 1.0).clamp(0.0, 1.0) * (LEVELS - 1) as f64;
        let n = (at as usize).min(LEVELS - 2);
        (n, at - n as f64)
    }
}
