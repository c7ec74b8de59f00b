//! Absorption and scattering of light by the water for each colour: from the visibility, or given directly.
//!
//! *Source:* visibility from the beam attenuation at 530 nm, V = 4.8/c for a black thing seen on a level line:
//! Davies-Colley 1988, Limnol. Oceanogr. 33, 616; Zaneveld & Pegau 2003, Opt. Express 11, 2997; Hou, Lee & Weidemann
//! 2007, Opt. Express 15, 2791. The water of that attenuation: `waters.rs`. Daylight decreases with depth by Kirk
//! 1984, Limnol. Oceanogr. 29, 350: K_d = √(a² + (0.425 μ - 0.190) a b) / μ, where μ is the cosine of the light's
//! slant in the water.
//!
//! *Parameters:* `visibility_m` V 8 m; `absorption_per_m` a and `scattering_per_m` b (1/m) of red, green and blue,
//! which replace those of the visibility.
//!
//! *Deviations:* c at 530 nm stands for that of the eye's sensitivity (Zaneveld & Pegau: 0.9 c(532) + 0.081/m). K_d
//! compared with Jerlov 1976, Marine Optics, table XXVII: within 20 % from type III to 9C at 495 nm and above (one
//! value, 5C at 565 nm, 13 %); at 425 nm a third less in types 1C and 3C (his first edition of 1968 has a third less
//! there too), and up to two thirds more in the clear types IB and II.

use super::bands::{GREEN, Spectrum, each, spread};
use super::waters;
use robots::error::{RobotError, require};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::ranges::{NonNegative, Positive};

/// c·V of a black thing at the range where it is just visible.
const CONTRAST: f64 = 4.8;

/// Parameters of the water's clarity.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct ClaritySpec {
    /// Distance at which a dark thing is just visible on a level line, m.
    #[serde(with = "world::limits::visibility_m")]
    #[default(Positive::new(8.0))]
    pub visibility_m: Positive,
    /// Absorption of red, green and blue, 1/m, instead of that from the visibility.
    #[serde(with = "world::limits::loss_per_m::<Option<(Positive, Positive, Positive)>>")]
    pub absorption_per_m: Option<(Positive, Positive, Positive)>,
    /// Scattering of red, green and blue, 1/m, instead of that from the visibility.
    #[serde(with = "world::limits::loss_per_m::<Option<(NonNegative, NonNegative, NonNegative)>>")]
    pub scattering_per_m: Option<(NonNegative, NonNegative, NonNegative)>,
}

/// Inherent optical properties of the water, 1/m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clarity {
    /// Absorption a.
    pub absorption: Spectrum,
    /// Scattering b.
    pub scattering: Spectrum,
    /// Beam attenuation c = a + b.
    pub attenuation: Spectrum,
}

impl Clarity {
    /// The water of a specification.
    ///
    /// # Errors
    /// If the visibility is better than pure sea water allows.
    pub fn new(spec: &ClaritySpec) -> Result<Self, RobotError> {
        let (pure_a, pure_b) = waters::pure();
        let least = pure_a[GREEN] + pure_b[GREEN];
        let c = CONTRAST / spec.visibility_m.get();
        require(
            c >= least,
            "optics.clarity.visibility_m",
            format!("must be at most {:.1}, that of pure sea water, got {}", CONTRAST / least, spec.visibility_m.get()),
        )?;
        let (a, b) = waters::of_attenuation(c);
        let absorption = spec.absorption_per_m.map_or(a, spread);
        let scattering = spec.scattering_per_m.map_or(b, spread);
        Ok(Self { absorption, scattering, attenuation: each(|i| absorption[i] + scattering[i]) })
    }

    /// Distance at which a dark thing is just visible on a level line, m.
    pub fn visibility_m(&self) -> f64 {
        CONTRAST / self.attenuation[GREEN]
    }

    /// Attenuation of daylight with depth, 1/m, for light whose slant has the cosine `mu`.
    pub fn down(&self, mu: f64) -> Spectrum {
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
        Clarity::new(&ClaritySpec { visibility_m: Positive::new(visibility_m), ..ClaritySpec::default() })
    }

    #[test]
    fn daylight_falls_off_as_jerlov_has_it() {
        // Jerlov 1976, table XXVII, between its steps of 25 nm: at 495, 530, 565, 600 and 635 nm, 1/m.
        let table = [
            (2, [0.115, 0.117, 0.137, 0.295, 0.403]),
            (3, [0.146, 0.128, 0.138, 0.300, 0.402]),
            (4, [0.234, 0.198, 0.202, 0.330, 0.424]),
            (5, [0.374, 0.308, 0.32, 0.400, 0.504]),
            (6, [0.606, 0.484, 0.460, 0.480, 0.576]),
            (7, [1.04, 0.75, 0.60, 0.60, 0.694]),
        ];
        for (k, jerlov) in table {
            let (name, a, b) = waters::TYPES[k];
            let c = a[GREEN] + b[GREEN];
            let down = water(CONTRAST / c).unwrap().down(0.85);
            for (i, want) in jerlov.into_iter().enumerate() {
                let ratio = down[2 + i] / want;
                assert!((0.8..1.2).contains(&ratio), "{name} {i}: {ratio}");
            }
        }
    }

    #[test]
    fn colours_given_take_the_place_of_the_table() {
        let m = Positive::new;
        let w =
            Clarity::new(&ClaritySpec { absorption_per_m: Some((m(0.3), m(0.1), m(0.2))), ..ClaritySpec::default() })
                .unwrap();
        assert_eq!([w.absorption[1], w.absorption[3], w.absorption[5]], [0.2, 0.1, 0.3]);
        assert_eq!(w.scattering, water(8.0).unwrap().scattering);
    }

    #[test]
    fn water_clearer_than_water_is_refused() {
        let e = water(110.0).unwrap_err().to_string();
        assert_eq!(e, "optics.clarity.visibility_m: must be at most 105.2, that of pure sea water, got 110");
    }
}
