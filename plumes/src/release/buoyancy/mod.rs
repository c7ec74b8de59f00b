//! Whether a release is lighter or heavier than the water around, and by how much once it mixes.
//!
//! *Source*: see `composition`; the flux of buoyancy of a release is constant only if its density deficit falls as its
//! dilution rises (Morton, Taylor & Turner 1956, Proc. R. Soc. A 234, 1).
//!
//! *Parameters*: [`BuoyancySpec`].
//!
//! *Deviations*: none.

mod composition;
mod seawater;
mod solute;

pub use composition::{CompositionSpec, DissolvedSpec};
pub use solute::Solute;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::math;
use world::ranges::Finite;
use world::units::GRAVITY_M_S2;

/// Buoyancy of a release.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum BuoyancySpec {
    /// As dense as the water around, whatever it is mixed with.
    #[default]
    Neutral,
    /// Heavier (or, if negative, lighter) than the water around by so many kg/m³ at the source; the excess falls as the
    /// dilution rises.
    Excess(#[serde(with = "world::limits::excess_kg_m3")] Finite),
    /// A solution, whose excess follows from what it consists of.
    Composition(CompositionSpec),
}

/// Buoyant acceleration of the released volume at every dilution, m/s², upwards: g·D(ρ0 − ρ)/ρ0.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// At dilutions exp(n·[`Self::STEP`]).
    lifts: Vec<f64>,
}

impl Curve {
    /// Distance of the dilutions in the table, as a logarithm.
    const STEP: f64 = 0.05;
    /// Number of them: up to a dilution of a million.
    const COUNT: usize = 278;

    /// At a dilution of at least 1.
    pub fn at(&self, dilution: f64) -> f64 {
        let last = self.lifts.len() - 1;
        let at = (math::ln(dilution.max(1.0)) / Self::STEP).min(last as f64);
        let n = (at as usize).min(last.saturating_sub(1));
        let (low, high) = (self.lifts[n], self.lifts[(n + 1).min(last)]);
        low + (high - low) * (at - n as f64)
    }
}

impl BuoyancySpec {
    /// The buoyancy in water of a density; `None` if it is neutral.
    ///
    /// # Errors
    /// The field below `buoyancy` that is wrong, and what would be legal.
    pub fn curve(&self, density_kg_m3: f64) -> Result<Option<Curve>, (String, String)> {
        match self {
            Self::Neutral => Ok(None),
            Self::Excess(excess) => Ok(Some(Curve { lifts: vec![-GRAVITY_M_S2 * excess.get() / density_kg_m3] })),
            Self::Composition(spec) => {
                let (litre, around) = spec.litre(density_kg_m3)?;
                let lift = |n: usize| {
                    let dilution = math::exp(n as f64 * Curve::STEP);
                    -GRAVITY_M_S2 * litre.excess_g(&around, dilution) / around.density_kg_m3
                };
                Ok(Some(Curve { lifts: (0..Curve::COUNT).map(lift).collect() }))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_excess_is_a_constant_flux() {
        let light = BuoyancySpec::Excess(Finite::new(-7.0));
        let curve = light.curve(998.2).unwrap().unwrap();
        for dilution in [0.5, 1.0, 30.0, 1e9] {
            assert_eq!(curve.at(dilution), 9.81 * 7.0 / 998.2);
        }
        assert_eq!(BuoyancySpec::Neutral.curve(998.2), Ok(None));
    }

    #[test]
    fn a_composition_is_read_between_its_points() {
        let fresh = BuoyancySpec::Composition(CompositionSpec::default());
        let curve = fresh.curve(1020.0).unwrap().unwrap();
        let (a, b) = (curve.at(math::exp(1.0)), curve.at(math::exp(1.05)));
        let between = curve.at(math::exp(1.025));
        assert!((between - 0.5 * (a + b)).abs() < 1e-12 && a > 0.2);
        assert_eq!(curve.at(1e7), curve.at(1e9));
    }
}
