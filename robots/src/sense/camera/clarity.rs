//! How the water takes up and scatters light of each colour: from how far one can see in it, or as given.
//!
//! *Source:* visibility from the beam attenuation, V = 4/c for a dark thing seen on a level line: Duntley 1963, J. Opt. Soc. Am. 53,
//! 214. Pure water: absorption Pope & Fry 1997, Appl. Opt. 36, 8710; scattering of sea water Morel 1974 (Mobley 1994, Light and
//! Water, section 3.8). What is in it: yellow matter and pigments fall off as e^(-0.014 λ/nm) (Bricaud, Morel & Prieur 1981, Limnol.
//! Oceanogr. 26, 43), particles scatter as 1/λ; their shares go with the murkiness through those that Petzold 1972 measured in
//! the Tongue of the Ocean, off California and in San Diego harbour (Mobley 1994, table 3.10). Daylight falls off with depth by Kirk 1984,
//! Limnol. Oceanogr. 29, 350: K_d = √(a² + (0.425 μ - 0.190) a b) / μ, μ the cosine of the light's slant in the water.
//!
//! *Parameters:* `visibility_m` V 8 m; `absorption_per_m` a and `scattering_per_m` b (1/m) by colour in place of what it gives.
//!
//! *Deviations:* one scale of murkiness in place of water types: the tables of Jerlov (1976, Marine Optics, table XXVII) and of
//! Solonenko & Mobley 2015, Appl. Opt. 54, 5392, are not put in. Daylight in water of 8 m visibility falls off between Jerlov's
//! coastal types 3 and 5 in all three colours.

use super::bands::{Rgb, WAVELENGTH_NM, each, plain};
use crate::error::RobotError;
use serde::{Deserialize, Serialize};
use world::math;
use world::ranges::{NonNegative, Positive};

/// Absorption of pure water at the bands, 1/m.
const PURE_ABSORPTION: Rgb = [0.2644, 0.0474, 0.00979];
/// c·V of a dark thing at the range where it is just seen.
const CONTRAST: f64 = 4.0;

/// Petzold's waters, clear ocean, coast and harbour: absorption and scattering at 514 nm, 1/m, with those of pure sea water.
const MEASURED: [(f64, f64); 3] = [(0.114, 0.037), (0.179, 0.219), (0.366, 1.824)];
const MEASURED_NM: f64 = 514.0;
const PURE_THERE: (f64, f64) = (0.040, 0.0025);
/// How fast the absorption of yellow matter and pigments falls off, 1/nm.
const SLOPE: f64 = 0.014;

/// Share of scattering in the green attenuation `added` (1/m) to that of pure water: between the measured waters in the
/// logarithm of what is added, beyond them as in the last.
fn scattered(added: f64) -> f64 {
    let points = MEASURED.map(|(a, b)| {
        let a = (a - PURE_THERE.0) * math::exp(SLOPE * (MEASURED_NM - WAVELENGTH_NM[1]));
        let b = (b - PURE_THERE.1) * MEASURED_NM / WAVELENGTH_NM[1];
        (math::ln(a + b), b / (a + b))
    });
    let at = math::ln(added.max(f64::MIN_POSITIVE));
    let between = |(x0, y0): (f64, f64), (x1, y1): (f64, f64)| {
        y0 + (y1 - y0) * ((at - x0) / (x1 - x0)).clamp(0.0, 1.0)
    };
    if at < points[1].0 {
        between(points[0], points[1])
    } else {
        between(points[1], points[2])
    }
}

/// What a scenario may say of the water's clarity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ClaritySpec {
    /// How far a dark thing is seen on a level line, m.
    pub visibility_m: Positive,
    /// Absorption of red, green and blue, 1/m, in place of that of the visibility.
    pub absorption_per_m: Option<(Positive, Positive, Positive)>,
    /// Scattering of red, green and blue, 1/m, in place of that of the visibility.
    pub scattering_per_m: Option<(NonNegative, NonNegative, NonNegative)>,
}

impl Default for ClaritySpec {
    fn default() -> Self {
        Self {
            visibility_m: Positive::new(8.0),
            absorption_per_m: None,
            scattering_per_m: None,
        }
    }
}

/// Inherent optical properties of the water, 1/m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clarity {
    /// Absorption a.
    pub absorption: Rgb,
    /// Scattering b.
    pub scattering: Rgb,
    /// Beam attenuation c = a + b.
    pub attenuation: Rgb,
}

impl Clarity {
    /// The water of a specification.
    ///
    /// # Errors
    /// When the visibility is better than pure sea water allows.
    pub fn new(spec: &ClaritySpec) -> Result<Self, RobotError> {
        let pure_b = each(|i| 16.06 * 4.72e-4 * math::powf(400.0 / WAVELENGTH_NM[i], 4.32));
        let pure_c = PURE_ABSORPTION[1] + pure_b[1];
        let added = CONTRAST / spec.visibility_m.get() - pure_c;
        if added < 0.0 {
            return Err(RobotError::Invalid {
                field: "optics.clarity.visibility_m".into(),
                problem: format!(
                    "must be at most {:.1}, that of pure sea water, got {}",
                    CONTRAST / pure_c,
                    spec.visibility_m.get()
                ),
            });
        }
        let share = scattered(added);
        let (scatters, absorbs) = (added * share, added * (1.0 - share));
        let absorption = spec.absorption_per_m.map_or_else(
            || {
                each(|i| {
                    let slope = math::exp(-SLOPE * (WAVELENGTH_NM[i] - WAVELENGTH_NM[1]));
                    PURE_ABSORPTION[i] + absorbs * slope
                })
            },
            plain,
        );
        let scattering = spec.scattering_per_m.map_or_else(
            || each(|i| pure_b[i] + scatters * WAVELENGTH_NM[1] / WAVELENGTH_NM[i]),
            plain,
        );
        Ok(Self {
            absorption,
            scattering,
            attenuation: each(|i| absorption[i] + scattering[i]),
        })
    }

    /// How far a dark thing is seen on a level line, m.
    #[must_use]
    pub fn visibility_m(&self) -> f64 {
        CONTRAST / self.attenuation[1]
    }

    /// Attenuation of daylight with depth, 1/m, for light that falls with slant cosine `mu`.
    #[must_use]
    pub fn down(&self, mu: f64) -> Rgb {
        each(|i| {
            let (a, b) = (self.absorption[i], self.scattering[i]);
            (a * a + (0.425 * mu - 0.190).max(0.0) * a * b).sqrt() / mu
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn water(visibility_m: f64) -> Result<Clarity, RobotError> {
        Clarity::new(&ClaritySpec {
            visibility_m: Positive::new(visibility_m),
            ..ClaritySpec::default()
        })
    }

    #[test]
    fn the_visibility_asked_for_comes_back() {
        for v in [0.5, 3.0, 8.0, 30.0, 60.0] {
            let w = water(v).unwrap();
            assert!((w.visibility_m() - v).abs() < 1e-12 * v);
            assert!(
                w.absorption
                    .iter()
                    .zip(PURE_ABSORPTION)
                    .all(|(a, p)| *a > p)
            );
        }
    }

    #[test]
    fn daylight_falls_off_as_jerlov_has_it() {
        // Jerlov 1976, table XXVII, coastal types 3 and 5 at 600, 550 and 450 nm.
        let k = water(8.0).unwrap().down(0.85);
        for (k, (low, high)) in k
            .into_iter()
            .zip([(0.33, 0.40), (0.19, 0.30), (0.39, 0.56)])
        {
            assert!(low < k && k < high, "{k}: {low} to {high}");
        }
    }

    #[test]
    fn the_measured_waters_lie_on_the_scale() {
        for (a, b) in MEASURED {
            let a = (a - PURE_THERE.0) * math::exp(SLOPE * (MEASURED_NM - 540.0));
            let b = (b - PURE_THERE.1) * MEASURED_NM / 540.0;
            assert!((scattered(a + b) - b / (a + b)).abs() < 1e-12);
        }
        assert_eq!(scattered(10.0), scattered(100.0));
    }

    #[test]
    fn water_clearer_than_water_is_refused() {
        let e = water(90.0).unwrap_err().to_string();
        assert_eq!(
            e,
            "optics.clarity.visibility_m: must be at most 80.9, that of pure sea water, got 90"
        );
    }
}
