//! How clear the water is, by the pictures alone: how much of the bed's unevenness is left at the heights they were
//! taken from.
//!
//! *Source*: a thing's contrast over the way r is its own times D(r) = e^(-c r)/(e^(-c r) + β (1 - e^(-c r))), where c
//! is the beam attenuation and β the radiance of endless water over that of the bed (Duntley 1963, J. Opt. Soc. Am. 53,
//! 214); V = 4.8/c (Zaneveld & Pegau 2003, Opt. Express 11, 2997).
//!
//! *Parameters*: `bed_texture` standard deviation of the bed's brightness from cell to cell; β [`VEIL`].
//!
//! *Deviations*: one c for all colours, and one β for all waters: over sand by daylight it is 0.3 to 0.5. A bed
//! smoother than assumed makes the water look murkier. c is found on a grid by least squares over the pictures; each
//! counts by its own uncertainty, and one that is far off counts as if it were three standard deviations off.

use super::ground::Patch;
use world::math;

/// c·V of a dark thing that is just visible.
const CONTRAST: f64 = 4.8;
/// Radiance of endless water over that of the bed, both seen from above.
const VEIL: f64 = 0.4;
/// Standard deviation of a measured D, as a share of it and by itself.
const OF_D: (f64, f64) = (0.2, 0.02);
/// The grid of c, 1/m: first value, factor, number.
const RATES: (f64, f64, i32) = (0.06, 1.05, 95);
/// A picture farther off than this many standard deviations counts as if it were that far off.
const FAR: f64 = 3.0;

/// The water as the pictures show it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeenClarity {
    /// Beam attenuation c, 1/m.
    pub attenuation_per_m: f64,
}

impl SeenClarity {
    /// Share of a thing's contrast that arrives over a way of `way_m`.
    pub fn left(&self, way_m: f64) -> f64 {
        let e = math::exp(-self.attenuation_per_m * way_m);
        e / (e + VEIL * (1.0 - e))
    }

    /// Distance at which a dark thing is just visible, m.
    pub fn visibility_m(&self) -> f64 {
        CONTRAST / self.attenuation_per_m
    }

    /// The greatest height in `range_m` at which at least `least` of the contrast arrives; the lowest if there is none.
    pub fn height_m(&self, least: f64, range_m: (f64, f64)) -> f64 {
        let (low, high) = range_m;
        let steps = 64;
        (0..=steps)
            .map(|k| high + (low - high) * f64::from(k) / f64::from(steps))
            .find(|h| self.left(*h) >= least)
            .unwrap_or(low)
    }

    /// By the pictures of a place; `None` without any.
    pub(super) fn from_patches<'a>(patches: impl Iterator<Item = &'a Patch> + Clone, bed_texture: f64) -> Option<Self> {
        patches.clone().next()?;
        let off = |v: f64| (v * v).min(FAR * FAR);
        let mut best: Option<(f64, Self)> = None;
        for k in 0..RATES.2 {
            let water = Self { attenuation_per_m: RATES.0 * math::powf(RATES.1, f64::from(k)) };
            let mut cost = 0.0;
            for p in patches.clone() {
                let left = water.left(p.height_m);
                let [texture, noise] = p.texture.map(|t| t / bed_texture);
                cost += off((texture.min(1.0) - left) / (OF_D.0 * left + OF_D.1 + 0.5 * noise));
            }
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, water));
            }
        }
        best.map(|(_, water)| water)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contrast_falls_with_the_way_and_the_height_follows_it() {
        let at = |attenuation_per_m| SeenClarity { attenuation_per_m };
        let water = at(1.2);
        assert_eq!(water.visibility_m(), 4.0);
        assert_eq!(water.left(0.0), 1.0);
        let e = math::exp(-1.2);
        assert!((water.left(1.0) - e / (e + VEIL * (1.0 - e))).abs() < 1e-12);
        let range = (1.4, 2.5);
        let h = water.height_m(0.3, range);
        assert!(water.left(h) >= 0.3 && water.left(h + 0.02) < 0.3, "{h}");
        // Clear water: as high as allowed; murky: as low as allowed.
        assert_eq!(at(0.2).height_m(0.3, range), 2.5);
        assert_eq!(at(4.0).height_m(0.3, range), 1.4);
        assert_eq!(at(1.2).height_m(0.3, (2.0, 2.0)), 2.0);
    }

    #[test]
    fn without_pictures_nothing_is_known() {
        assert_eq!(SeenClarity::from_patches([].iter(), 0.2), None);
    }
}
