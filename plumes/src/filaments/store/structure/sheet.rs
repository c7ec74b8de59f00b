//! Structure of the dye that is finer than a filament: how much of it is left, and how large it is, at a sheet's time.
//!
//! *Source*: stirring without mixing leaves the dye as it was released in a share C/C0 of the volume over which it is
//! spread: variance C(C0 − C). Molecules that diffuse out of the sheets lower C0 to the mean of the concentration over
//! the sheet's mass, C0·m (Villermaux 2019, Annu. Rev. Fluid Mech. 51, 245), so C(C0·m − C) is left. One point has a
//! gamma law (Villermaux & Duplat 2003, Phys. Rev. Lett. 91, 184501; in boundary layers arXiv:2601.20470), here
//! bounded by what was released: a beta law. A probe averages over a way across the sheets: variance and integral scale
//! of a record with an exponential correlation (Taylor 1921, Proc. Lond. Math. Soc. 20, 196).
//!
//! *Parameters*: `share` of that variance which is there (1: all of it); the way over which a probe averages.
//!
//! *Deviations*: sheets do not overlap, so late in the mixing, at the edges of a plume, too much is left.

use world::math;

/// A thread's dye in sheets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sheet {
    /// Its thickness without diffusion, m.
    pub(crate) thickness_m: f64,
    /// Its own time τ, the integral of diffusivity over squared thickness.
    pub(crate) mixed: f64,
}

/// What is left of the structure where a probe averages: relative variance, and integral scale (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fluctuation {
    pub(crate) variance: f64,
    pub(crate) scale_m: f64,
}

impl Sheet {
    /// Mean concentration over the mass of the sheet, as a share of that at release.
    pub(crate) fn mean_share(&self) -> f64 {
        // Both terms cancel for old sheets: there the series.
        let spread = (8.0 * self.mixed).sqrt();
        if spread < 1e-9 {
            return 1.0;
        }
        let x = 1.0 / spread;
        if x < 0.02 {
            return x / std::f64::consts::PI.sqrt() * (1.0 - x * x / 6.0);
        }
        math::erf(x) - (1.0 - math::exp(-x * x)) / (x * std::f64::consts::PI.sqrt())
    }

    /// The structure where the dye is `dilution` times thinner than released, as a probe sees it that averages over a
    /// way (m), if this share of the variance is there.
    pub(crate) fn seen(&self, dilution: f64, share: f64, across_m: f64) -> Fluctuation {
        let left = self.mean_share();
        // A sheet's correlation, integrated over distance: half of (∫c)²/∫c².
        let scale_m = 0.5 * self.thickness_m / left;
        let averaged = averaged(across_m / scale_m);
        Fluctuation { variance: (share * averaged * (left * dilution - 1.0)).max(0.0), scale_m: scale_m / averaged }
    }
}

/// Variance that remains after averaging over so many integral scales of an exponential correlation.
fn averaged(scales: f64) -> f64 {
    if scales < 1e-4 {
        return 1.0 - scales / 3.0;
    }
    2.0 * (scales - 1.0 + math::exp(-scales)) / (scales * scales)
}
