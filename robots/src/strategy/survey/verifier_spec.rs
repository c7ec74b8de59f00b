//! Parameters of the fuzzy colour extractor, of the clusters of its colour patterns, and of the verification of a
//! source by a picture.

use crate::error::{RobotError, require};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::ranges::{Fraction, NonNegative, Positive};

/// Most passes of both kinds together.
const MOST_PASSES: u32 = 60;

/// The parameters of Tian et al. 2013, section 5, with their values as defaults. Levels are of 8 bits, 0 to 255.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ColourSpec {
    /// Differences below this are wholly Zero (α₁), levels.
    #[default(NonNegative::new(35.0))]
    pub alpha1: NonNegative,
    /// Differences from this on are wholly Negative or Positive (α₂), levels.
    #[default(Positive::new(200.0))]
    pub alpha2: Positive,
    /// Width of the output set Matched (ρ_M), levels; Unmatched begins at ρ_U = 255 − ρ_M.
    #[default(Positive::new(20.0))]
    pub rho_m: Positive,
    /// A pixel is extracted if its difference Δρ_F is below this (ε), levels.
    #[default(Positive::new(80.0))]
    pub epsilon: Positive,
    /// Passes towards RED, whose union is the plume.
    #[default(3)]
    pub plume_passes: u8,
    /// Passes towards DARK-BLUE on the rest, whose union is the source.
    #[default(4)]
    pub source_passes: u8,
    /// How much farther from its reference than the nearest pattern a colour pattern may be (δ₁), levels.
    #[default(NonNegative::new(40.0))]
    pub delta1: NonNegative,
    /// How far from the nearest pattern a colour pattern may be, by the shortest way over the others (δ₂), levels.
    #[default(NonNegative::new(45.0))]
    pub delta2: NonNegative,
    /// What joins two patterns in the graph of the shortest ways.
    pub edges: Edges,
    /// Whether pixels of dropped plume patterns return to the picture before the search for the source; in the paper
    /// they stay taken.
    pub give_back: bool,
    /// Whether slow changes over the picture are first removed and each colour is brought to the whole range of
    /// levels; the paper's passes see the unchanged picture.
    pub dehaze: bool,
}

impl ColourSpec {
    /// The paper's parameters with what hazy pictures need: dehazed, and dropped patterns given back.
    pub fn for_haze() -> Self {
        Self { give_back: true, dehaze: true, ..Self::default() }
    }
}

/// Length of the edge between two colour patterns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Edges {
    /// The distance of the two colours.
    #[default]
    Colours,
    /// The difference of their distances to the reference colour.
    Reference,
}

impl ColourSpec {
    /// Checks that the parameters agree.
    ///
    /// # Errors
    /// Names the field below `path` and its legal range.
    pub fn check(&self, path: &str) -> Result<(), RobotError> {
        match self.fault() {
            None => Ok(()),
            Some((field, problem)) => Err(RobotError::invalid(format!("{path}.{field}"), problem)),
        }
    }

    /// The first field that contradicts the others, and what would be legal.
    pub fn fault(&self) -> Option<(&'static str, String)> {
        let (a1, a2) = (self.alpha1.get(), self.alpha2.get());
        let (rho_m, epsilon) = (self.rho_m.get(), self.epsilon.get());
        let passes = u32::from(self.plume_passes) + u32::from(self.source_passes);
        let faults = [
            (a1 >= a2, "alpha1", format!("must be below alpha2 ({a2}), got {a1}")),
            (a2 > 255.0, "alpha2", format!("must be at most 255, got {a2}")),
            (rho_m >= 255.0, "rho_m", format!("must be below 255, got {rho_m}")),
            (epsilon > 255.0, "epsilon", format!("must be at most 255, got {epsilon}")),
            (
                !(1..=MOST_PASSES).contains(&passes),
                "plume_passes",
                format!("must be, with source_passes, from 1 to {MOST_PASSES}, got {passes}"),
            ),
        ];
        faults.into_iter().find(|(wrong, ..)| *wrong).map(|(_, field, problem)| (field, problem))
    }
}

/// When a picture verifies a source.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct VerifierSpec {
    /// The extractor. If not given: the paper's with `give_back` and `dehaze`. If given: fields that it does not name
    /// have the paper's values.
    #[default(ColourSpec::for_haze())]
    pub colours: ColourSpec,
    /// Least share of the picture that must have the dye's colours.
    #[default(Positive::new(0.0022))]
    pub least_dye: Positive,
    /// Least difference between the dye's mean share of red in the light (R, G, B sum to 1) and that of the rest of
    /// the picture.
    #[default(Positive::new(0.022))]
    pub least_redness: Positive,
    /// Least mean share of red in the dye's light as it was recorded. Grey has a third, and water takes red first.
    #[default(Fraction::new(0.35))]
    pub least_red: Fraction,
    /// By how much the share of green less that of blue may be greater in the dye than in the background: rhodamine
    /// takes green out of the light.
    #[default(Fraction::new(0.005))]
    pub most_yellow: Fraction,
    /// Greatest part of the dye's redness that may come within a hundredth of the picture's diagonal at its edge: dye
    /// thins out, things end. Does not count in pictures with a diagonal of less than 400 pixels.
    #[default(Fraction::new(0.5))]
    pub most_edge: Fraction,
    /// With at most this part of its redness at its edge, dye may have any red hue: so soft are no things, and much dye
    /// in front of something dark glows orange.
    #[default(Fraction::new(0.15))]
    pub soft_edge: Fraction,
    /// Least share of the picture that the source's patch must fill.
    #[default(Positive::new(0.0022))]
    pub least_source: Positive,
    /// Least contrast by which the patch must be darker than its surroundings: 1 is black.
    #[default(Positive::new(0.0825))]
    pub least_contrast: Positive,
    /// Greatest share of the picture that the dye may fill: dye that is everywhere cannot be told from its
    /// background.
    #[default(Fraction::new(0.7))]
    pub most_dye: Fraction,
    /// Greatest share that the patch may fill.
    #[default(Fraction::new(0.3))]
    pub most_source: Fraction,
    /// Greatest distance from the patch to the nearest dye, as a share of the picture's diagonal.
    #[default(Fraction::new(0.1))]
    pub reach: Fraction,
}

impl VerifierSpec {
    /// Checks that the parameters agree.
    ///
    /// # Errors
    /// Names the field below `path` and its legal range.
    pub fn check(&self, path: &str) -> Result<(), RobotError> {
        self.colours.check(&format!("{path}.colours"))?;
        let most = [
            ("least_dye", self.least_dye, self.most_dye, "most_dye, "),
            ("least_redness", self.least_redness, Fraction::new(1.0), ""),
            ("least_source", self.least_source, self.most_source, "most_source, "),
            ("least_contrast", self.least_contrast, Fraction::new(1.0), ""),
        ];
        for (field, least, most, name) in most {
            let (least, most) = (least.get(), most.get());
            require(
                least <= most,
                format!("{path}.{field}"),
                format!("must be above 0 and at most {name}{most}, got {least}"),
            )?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_verifier_that_could_never_verify_is_refused_with_its_field() {
        assert!(VerifierSpec::default().check("v").is_ok());
        let of = |change: &dyn Fn(&mut VerifierSpec)| {
            let mut spec = VerifierSpec::default();
            change(&mut spec);
            spec.check("v").unwrap_err().to_string()
        };
        for (said, wanted) in [
            (
                of(&|s| s.colours.alpha1 = NonNegative::new(200.0)),
                "v.colours.alpha1: must be below alpha2 (200), got 200",
            ),
            (of(&|s| s.colours.alpha2 = Positive::new(256.0)), "v.colours.alpha2: must be at most 255"),
            (of(&|s| s.colours.rho_m = Positive::new(255.0)), "v.colours.rho_m: must be below 255"),
            (of(&|s| s.colours.epsilon = Positive::new(300.0)), "v.colours.epsilon: must be at most 255"),
            (of(&|s| s.colours.plume_passes = 57), "from 1 to 60, got 61"),
            (
                of(&|s| s.least_contrast = Positive::new(1.5)),
                "v.least_contrast: must be above 0 and at most 1, got 1.5",
            ),
        ] {
            assert!(said.contains(wanted), "{said}");
        }
    }
}
