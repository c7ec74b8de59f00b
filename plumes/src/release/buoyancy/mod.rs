//! Whether a release is lighter or heavier than the water around, and by how much once it mixes.
//!
//! *Source*: see `composition`; the flux of buoyancy of a release is constant only if its density deficit falls as its
//! dilution rises (Morton, Taylor & Turner 1956, Proc. R. Soc. A 234, 1).
//!
//! *Parameters*: [`BuoyancySpec`].
//!
//! *Deviations*: none.

mod composition;
mod curve;
mod seawater;
mod solute;

pub use composition::{CompositionSpec, DissolvedSpec};
pub use curve::Curve;
use curve::LiftByDilution;
pub use solute::Solute;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
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

impl BuoyancySpec {
    /// The buoyancy in water of a density; `None` if it is neutral.
    ///
    /// # Errors
    /// The field below `buoyancy` that is wrong, and what would be legal.
    pub fn curve(&self, density_kg_m3: f64) -> Result<Option<Curve>, (String, String)> {
        match self {
            Self::Neutral => Ok(None),
            Self::Excess(excess) => Ok(Some(Curve::constant(-GRAVITY_M_S2 * excess.get() / density_kg_m3))),
            Self::Composition(spec) => {
                let (litre, around) = spec.litre(density_kg_m3)?;
                let lift = |dilution| -GRAVITY_M_S2 * litre.excess_g(&around, dilution) / around.density_kg_m3;
                Ok(Some(Curve::of_a_sheet(&LiftByDilution::of(lift))))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::math;
    use world::ranges::Positive;

    #[test]
    fn an_excess_is_a_constant_flux() {
        let light = BuoyancySpec::Excess(Finite::new(-7.0));
        let curve = light.curve(998.2).unwrap().unwrap();
        for mixed in [0.0, 1e-9, 1.0, 30.0, 1e9] {
            assert_eq!(curve.at(mixed), 9.81 * 7.0 / 998.2);
        }
        assert!(!curve.changes());
        assert_eq!(BuoyancySpec::Neutral.curve(998.2), Ok(None));
    }

    /// What the paper's solution lifts comes with its mixing; what its warmth lifts is there from the start.
    #[test]
    fn warmth_lifts_at_once_and_mixing_later() {
        let solution = |temperature_c| {
            BuoyancySpec::Composition(CompositionSpec {
                solutes: vec![DissolvedSpec { what: Solute::SodiumChloride, g_l: Positive::new(47.0) }],
                neutral_with: Some(Solute::Propanol),
                temperature_c: Finite::new(temperature_c),
                ..CompositionSpec::default()
            })
        };
        let curve = |temperature_c| solution(temperature_c).curve(998.2).unwrap().unwrap();
        let (even, warm) = (curve(20.0), curve(22.0));
        assert!(even.at(0.0).abs() < 1e-6, "{}", even.at(0.0));
        assert!((even.at(1e6) / (9.81 * 7.0 / 998.2) - 1.0).abs() < 0.3, "{}", even.at(1e6));
        // 0.2 kg/m³ a kelvin, and nearly as much at every mixing.
        for mixed in [0.0, 1e-3, 0.1, 10.0, 1e5] {
            let more = (warm.at(mixed) - even.at(mixed)) * 998.2 / 9.81;
            assert!((0.3..0.9).contains(&more), "{mixed}: {more} kg/m³");
        }
    }

    #[test]
    fn a_composition_is_read_between_its_points() {
        let fresh = BuoyancySpec::Composition(CompositionSpec::default());
        let curve = fresh.curve(1020.0).unwrap().unwrap();
        let (a, b) = (curve.at(math::exp(1.0)), curve.at(math::exp(1.1)));
        let between = curve.at(math::exp(1.05));
        assert!((between - 0.5 * (a + b)).abs() < 1e-12 && a > 0.2);
        assert_eq!(curve.at(1e7), curve.at(1e9));
    }
}
