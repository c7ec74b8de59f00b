//! What a release consists of, and how much lighter than the water around it becomes as it mixes.
//!
//! *Source*: conservation of mass, salt and heat, with the volumes of `solute` and `seawater`. Volumes of mixing are
//! not additive: a release that is neutral at the nozzle need not stay neutral.
//!
//! *Parameters*: [`CompositionSpec`].
//!
//! *Deviations*: all liquids have the same heat capacity; no heat of dilution (for salt with alcohol, −0.9 kg/m³ more).

use super::seawater;
use super::solute::Solute;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::ranges::{Finite, NonNegative, Positive};

/// A solution that is released.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CompositionSpec {
    /// What is dissolved in it.
    pub solutes: Vec<DissolvedSpec>,
    /// A further solute, of which there is as much as makes the release as dense as the water around, if it is as warm
    /// as that.
    pub neutral_with: Option<Solute>,
    /// Practical salinity of the water that it is made with; 0 is fresh water.
    #[serde(with = "world::limits::salinity")]
    pub salinity: NonNegative,
    /// Temperature of the release, °C; a release that is warmer than the water around is lighter at once.
    #[serde(with = "world::limits::water_c")]
    pub temperature_c: Finite,
    /// Temperature of the water around, °C. Its salinity follows from its density.
    #[serde(with = "world::limits::water_c")]
    pub around_c: Finite,
}

/// A dissolved substance and how much of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DissolvedSpec {
    /// The substance.
    pub what: Solute,
    /// Grams of it in a litre of the release.
    #[serde(with = "world::limits::solute_g_l")]
    pub g_l: Positive,
}

impl Default for CompositionSpec {
    fn default() -> Self {
        Self {
            solutes: Vec::new(),
            neutral_with: None,
            salinity: NonNegative::new(0.0),
            temperature_c: Finite::new(20.0),
            around_c: Finite::new(20.0),
        }
    }
}

/// What is in a litre of release, g.
#[derive(Clone, Debug)]
pub(super) struct Litre {
    solutes: Vec<(Solute, f64)>,
    water_g: f64,
    salinity: f64,
    temperature_c: f64,
}

/// The water around.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ambient {
    pub(super) density_kg_m3: f64,
    salinity: f64,
    temperature_c: f64,
}

impl CompositionSpec {
    /// The release and the water around it, checked; errors name the field.
    pub(super) fn litre(&self, density_kg_m3: f64) -> Result<(Litre, Ambient), (String, String)> {
        let around_c = self.around_c.get();
        let salinity = seawater::salinity(density_kg_m3, around_c);
        let least = seawater::density(0.0, around_c);
        let most = seawater::density(42.0, around_c);
        if !(least - 1.0..=most + 1.0).contains(&density_kg_m3) {
            let problem = format!(
                "water of {around_c} degrees is {least:.1} to {most:.1} kg/m³ dense, but water.density_kg_m3 at the source is {density_kg_m3:.1}"
            );
            return Err(("around_c".into(), problem));
        }
        // Of the equation of state, so that no difference remains when everything is mixed.
        let density_kg_m3 = seawater::density(salinity, around_c);
        let around = Ambient { density_kg_m3, salinity, temperature_c: around_c };
        let mut litre = Litre {
            solutes: self.solutes.iter().map(|s| (s.what, s.g_l.get())).collect(),
            water_g: 0.0,
            salinity: self.salinity.get(),
            temperature_c: around_c,
        };
        for (n, spec) in self.solutes.iter().enumerate() {
            let most = spec.what.most_g_l();
            if spec.g_l.get() > most {
                let problem = format!(
                    "must be at most {most}, where the density of {:?} is known, got {}",
                    spec.what,
                    spec.g_l.get()
                );
                return Err((format!("solutes[{n}].g_l"), problem));
            }
            if self.solutes[..n].iter().any(|s| s.what == spec.what) || self.neutral_with == Some(spec.what) {
                let problem = format!("{:?} is given twice; give it once", spec.what);
                return Err((format!("solutes[{n}].what"), problem));
            }
        }
        if let Some(solute) = self.neutral_with {
            litre.make_neutral(solute, density_kg_m3)?;
        }
        // Weighed out beside the flume, it may be released warmer or colder.
        litre.temperature_c = self.temperature_c.get();
        if !litre.fill() {
            let problem =
                "the solutes alone fill more than a litre: their volumes must leave room for water".to_owned();
            return Err(("solutes".into(), problem));
        }
        Ok((litre, around))
    }
}

impl Litre {
    /// Fills the litre with water; whether there is room for any.
    fn fill(&mut self) -> bool {
        let density = seawater::density(self.salinity, self.temperature_c);
        self.water_g = density;
        for _ in 0..60 {
            let taken: f64 = self.dissolved_cm3(self.water_g, 1.0);
            self.water_g = density * (1.0 - 1e-3 * taken);
            if self.water_g <= 0.0 {
                return false;
            }
        }
        true
    }

    /// Volume of what is dissolved beside so much water, cm³; both are in `litres` of solution.
    fn dissolved_cm3(&self, water_g: f64, litres: f64) -> f64 {
        let of = |(solute, g): &(Solute, f64)| g * solute.volume_cm3_g(g / litres, water_g / litres);
        self.solutes.iter().map(of).sum()
    }

    /// Mass, g.
    fn mass_g(&self) -> f64 {
        self.water_g + self.solutes.iter().map(|s| s.1).sum::<f64>()
    }

    /// Adds as much of a solute as makes the litre as dense as the water around.
    fn make_neutral(&mut self, solute: Solute, density: f64) -> Result<(), (String, String)> {
        self.solutes.push((solute, 0.0));
        let last = self.solutes.len() - 1;
        let mut excess = |g: f64| {
            self.solutes[last].1 = g;
            if self.fill() { self.mass_g() - density } else { f64::NAN }
        };
        let (mut low, mut high) = (0.0, solute.most_g_l());
        let (at_none, at_most) = (excess(1e-9), excess(high));
        if !(at_none * at_most < 0.0) {
            let problem = format!(
                "no amount of {solute:?} up to {high} g/L makes the release neutral: it is heavier than the water around by {at_none:+.1} kg/m³ without it and by {at_most:+.1} kg/m³ with it"
            );
            return Err(("neutral_with".into(), problem));
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if excess(middle) * at_none > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        excess(0.5 * (low + high));
        Ok(())
    }

    /// Mass by which the litre is heavier than what it displaces, g, once it is mixed into `dilution` litres. Divided by
    /// the dilution, it is the excess of density in kg/m³.
    pub(super) fn excess_g(&self, around: &Ambient, dilution: f64) -> f64 {
        let added_g = (dilution - 1.0) * around.density_kg_m3;
        let water_g = self.water_g + added_g;
        let mixed = |a: f64, b: f64| (a * self.water_g + b * added_g) / water_g;
        let salinity = mixed(self.salinity, around.salinity);
        let temperature_c = mixed(self.temperature_c, around.temperature_c);
        let density = seawater::density(salinity, temperature_c);
        let mut litres = dilution;
        for _ in 0..40 {
            litres = water_g / density + 1e-3 * self.dissolved_cm3(water_g, litres);
        }
        self.mass_g() + added_g - litres * around.density_kg_m3
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn brine(alcohol: Solute) -> (Litre, Ambient) {
        let spec = CompositionSpec {
            solutes: vec![DissolvedSpec { what: Solute::SodiumChloride, g_l: Positive::new(47.0) }],
            neutral_with: Some(alcohol),
            ..CompositionSpec::default()
        };
        spec.litre(998.2).expect("legal")
    }

    /// 47 g/L of salt made neutral with alcohol, diluted: ours beside values that were worked out independently from the
    /// same handbooks. They are uncertain by 2 kg/m³ of D(ρ − ρ0).
    #[test]
    fn neutral_brine_is_light_once_it_is_mixed() {
        for (alcohol, g_l, want) in [
            (Solute::Propanol, 218.0, [-0.97, -1.31, -0.71, -0.36, -0.14, -0.069]),
            (Solute::Ethanol, 213.0, [-1.08, -1.01, -0.62, -0.34, -0.14, -0.072]),
        ] {
            let (litre, around) = brine(alcohol);
            assert!((litre.solutes[1].1 / g_l - 1.0).abs() < 0.02, "{litre:?}");
            assert!(litre.excess_g(&around, 1.0).abs() < 1e-6);
            for (d, want) in [2.0, 5.0, 10.0, 20.0, 50.0, 100.0].into_iter().zip(want) {
                let got = litre.excess_g(&around, d) / d;
                assert!((got - want).abs() * d < 1.0, "{alcohol:?} {d}: {got}");
            }
            let last = litre.excess_g(&around, 1e5);
            assert!((last + 7.0).abs() < 2.0, "{last}");
        }
    }

    #[test]
    fn fresh_and_warm_water_keep_their_deficit() {
        let fresh = CompositionSpec {
            around_c: Finite::new(10.0),
            temperature_c: Finite::new(10.0),
            ..CompositionSpec::default()
        };
        let (litre, around) = fresh.litre(1026.0).expect("legal");
        // Salt changes the density nearly in proportion: D(ρ − ρ0) stays within 3 %.
        for d in [1.0, 3.0, 100.0] {
            let got = litre.excess_g(&around, d);
            assert!((got / -26.3 - 1.0).abs() < 0.03, "{d}: {got}");
        }
        let warm = CompositionSpec {
            salinity: NonNegative::new(35.0),
            temperature_c: Finite::new(30.0),
            around_c: Finite::new(10.0),
            ..CompositionSpec::default()
        };
        let (litre, around) = warm.litre(1026.95).expect("legal");
        // At 10 degrees and a salinity of 35, water expands by 1.67e-4 a degree.
        let last = litre.excess_g(&around, 1e4);
        assert!((last / (-1.67e-4 * 20.0 * 1022.0) - 1.0).abs() < 0.03, "{last}");
    }

    #[test]
    fn what_cannot_be_made_is_refused() {
        use Solute::{Dye, Ethanol, Propanol, SodiumChloride};
        let of = |what, g_l| DissolvedSpec { what, g_l: Positive::new(g_l) };
        for (solutes, neutral_with, density, said) in [
            (vec![of(Propanol, 500.0)], None, 998.2, "solutes[0].g_l: must be at most 280"),
            (vec![of(Dye, 1.0), of(Dye, 1.0)], None, 998.2, "given twice"),
            (vec![], Some(SodiumChloride), 998.2, "no amount of"),
            (vec![], None, 1100.0, "around_c: "),
            (vec![of(Ethanol, 600.0), of(Propanol, 280.0)], None, 998.2, "more than a litre"),
        ] {
            let spec = CompositionSpec { solutes, neutral_with, ..Default::default() };
            let (field, problem) = spec.litre(density).expect_err(said);
            assert!(format!("{field}: {problem}").contains(said), "{field}: {problem}");
        }
    }
}
