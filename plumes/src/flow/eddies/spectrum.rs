//! The spectrum of the eddies, and what of it is resolved.
//!
//! *Source*: von Kármán 1948, Proc. Natl. Acad. Sci. 34, 530: E(k) ∝ (k/k_e)⁴/(1 + (k/k_e)²)^(17/6), k_e = 0.747/L, L
//! the longitudinal integral scale (Pope 2000, Turbulent Flows, section 6.5.3); viscous end exp(−2.25 (kη)^(4/3)), Pao
//! 1965, Phys. Fluids 8, 1063, η = (ν³/ε)^¼. Integral scale of open channels L = H(z/H)^½, at most 0.77 H: Nezu &
//! Nakagawa 1993, ch. 4. Diffusivity of the eddies beyond a wave number k_c: 0.444 ε^⅓ k_c^(−4/3), the eddy viscosity
//! that passes on ε (Lilly 1967, Proc. IBM Sci. Comp. Symp., 195, with Kolmogorov's 1.5), over a turbulent Schmidt
//! number of 0.7 (Launder 1978, in: Turbulence, ed. Bradshaw).
//!
//! *Parameters*: all follow from the channel; k_c from the spacing of the eddies' grid, four cells a wave.
//!
//! *Deviations*: one L (depth mean, 0.62 H) and one η (mid-depth ε) for the whole depth. Near bed and surface the
//! sub-grid diffusivity is at most Elder's, so that it vanishes at both. In x the eddies are longer by [`ELONGATION`].

use crate::flow::channel::Channel;
use crate::flow::mixing::parabolic;
use world::math;

/// How much longer eddies are along the stream than isotropic ones. With one spectrum for three potentials u′ : v′ : w′ of
/// 2.30 : 1.63 : 1.27 needs at least 1.11; √2 leaves all three potentials alive.
pub(super) const ELONGATION: f64 = std::f64::consts::SQRT_2;

/// Depth mean of Nezu & Nakagawa's L/H.
const SCALE: f64 = 0.62;

/// Shape of the eddies in the channel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spectrum {
    /// Wave number of the energy, 1/m.
    k_e: f64,
    /// Kolmogorov's length, m.
    eta: f64,
    /// Greatest resolved wave number, 1/m.
    pub k_c: f64,
}

impl Spectrum {
    /// Of a channel whose eddies are resolved down to the wave length `shortest_m`.
    pub fn new(channel: &Channel, shortest_m: f64) -> Self {
        let nu = channel.viscosity_m2_s;
        let epsilon = channel.dissipation(0.5 * channel.depth_m);
        Self {
            k_e: 0.747 * ELONGATION / (SCALE * channel.depth_m),
            eta: (nu * nu * nu / epsilon).sqrt().sqrt(),
            k_c: std::f64::consts::TAU / shortest_m,
        }
    }

    /// E(k), any unit.
    pub fn energy(&self, k: f64) -> f64 {
        let x2 = (k / self.k_e) * (k / self.k_e);
        x2 * x2 * math::powf(1.0 + x2, -17.0 / 6.0) * math::exp(-2.25 * math::powf(k * self.eta, 4.0 / 3.0))
    }

    /// Part of the energy at wave numbers up to k_c.
    pub fn resolved(&self) -> f64 {
        // In ln k, from well below the energy to well beyond the viscous end.
        const N: usize = 2000;
        let (low, high) = (math::ln(0.01 * self.k_e), math::ln(10.0 / self.eta));
        let (mut below, mut all) = (0.0, 0.0);
        for n in 0..N {
            let k = math::exp(low + (high - low) * (n as f64 + 0.5) / N as f64);
            let e = k * self.energy(k);
            all += e;
            below += if k <= self.k_c { e } else { 0.0 };
        }
        below / all
    }

    /// Diffusivity of the eddies beyond a wave number, at a height above the bed, m²/s.
    pub fn beyond(channel: &Channel, height_m: f64, k_c: f64) -> f64 {
        let epsilon = channel.dissipation(height_m);
        let inertial = 0.444 / 0.7 * math::powf(epsilon, 1.0 / 3.0) * math::powf(k_c, -4.0 / 3.0);
        inertial.min(parabolic(channel.u_star_m_s, height_m, channel.depth_m))
    }
}
