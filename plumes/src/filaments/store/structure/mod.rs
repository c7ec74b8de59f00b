//! Structure below a filament: what a probe meets where filaments give the mean.
//!
//! *Source*: see `sheet`. The law of one point is a beta law between nothing and what was released, of which the gamma
//! law is the limit far from the source.
//!
//! *Parameters*: `share` of the variance that stirring makes and mixing leaves, of a release.
//!
//! *Deviations*: a pattern belongs to the filament that contributes most and moves with it; where another contributes
//! more, another pattern begins, independent of the first. It is a lattice of normal values, linear between them and of
//! even variance, so its correlation is the same in all directions, though a sheet is thin in one. A relative variance
//! below 1e-4 is left out.

mod beta;
mod sheet;
#[cfg(test)]
mod tests;

use crate::noise;
use beta::Beta;
pub(crate) use sheet::Sheet;
use world::math;

/// Integral scale of the pattern, in cells of its lattice; the test of its correlation holds it to 15 %.
const SCALE_CELLS: f64 = 0.66;

/// The structure of a release.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Structure {
    pub(crate) share: f64,
    /// Concentration at release, kg/m³.
    pub(crate) released_kg_m3: f64,
    pub(crate) key: u64,
}

/// Where a probe is in a filament.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PlaceInFilament {
    /// The filament's number in the order of release.
    pub(crate) number: u32,
    /// From its middle: east, north, up, m.
    pub(crate) away_m: [f32; 3],
    pub(crate) sheet: Sheet,
}

impl Structure {
    /// Concentration where the mean is `mean_kg_m3` (above zero), as a probe is given it that averages over a way (m).
    pub(crate) fn sensed(&self, mean_kg_m3: f64, place: &PlaceInFilament, across_m: f64) -> f64 {
        let mean = mean_kg_m3 / self.released_kg_m3;
        let seen = place.sheet.seen(1.0 / mean, self.share, across_m);
        let variance = seen.variance;
        if variance < 1e-4 {
            return mean_kg_m3;
        }
        // Its bound: what was released, or where that is far away, thirty deviations and thirty variances.
        let mean = mean.max(1.0 / (1.0 + 30.0 * (variance.sqrt() + variance)));
        // Values that are all or nothing are the limit of parameters that vanish.
        let both = ((1.0 - mean) / (mean * variance) - 1.0).max(1e-2);
        let z = self.normal(place, seen.scale_m / SCALE_CELLS);
        let below = 0.5 * (1.0 + math::erf(z * std::f64::consts::FRAC_1_SQRT_2));
        mean_kg_m3 / mean * Beta::new(mean * both, (1.0 - mean) * both).quantile(below)
    }

    /// Standard normal value of the filament's pattern, whose lattice has cells of this size (m).
    fn normal(&self, place: &PlaceInFilament, cell_m: f64) -> f64 {
        let at = place.away_m.map(|away| f64::from(away) / cell_m);
        let low = at.map(f64::floor);
        let part = [0, 1, 2].map(|d| at[d] - low[d]);
        let (mut sum, mut squares) = (0.0, 0.0);
        for corner in 0..8_u64 {
            let (mut weight, mut packed) = (1.0, 0);
            for d in 0..3 {
                let up = corner >> d & 1;
                weight *= if up == 1 { part[d] } else { 1.0 - part[d] };
                let number = (low[d] as i64).wrapping_add_unsigned(up);
                packed = packed << 21 | (number & 0x1f_ffff).cast_unsigned();
            }
            let [value, _] = noise::level_normals(place.number, noise::step_key(self.key, packed));
            sum += weight * f64::from(value);
            squares += weight * weight;
        }
        sum / squares.sqrt()
    }
}
