//! Parameters of adding up the pictures of a place.

use crate::error::{RobotError, require};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::ranges::Positive;

/// How the pictures of a place are added up to one answer.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AddUpSpec {
    /// A source may be as far as this from the told place, m: the error of that place and of the navigation, from 0.5
    /// to 20.
    #[default(Positive::new(3.0))]
    pub within_m: Positive,
    /// Side of the cells of the ground, m, from 0.05 to 0.25.
    #[default(Positive::new(0.1))]
    pub cell_m: Positive,
    /// Largest shift of a picture against those before it that overlap is searched for, m, at most 3.
    #[default(Positive::new(1.0))]
    pub shift_m: Positive,
    /// Standard deviation of the bed's brightness from cell to cell, as a share of its mean; from 0.01 to 1. The
    /// clearness of the water is read from how much of it the pictures show.
    #[default(Positive::new(0.18))]
    pub bed_texture: Positive,
    /// Verified from this natural logarithm of the Bayes factor on: 4.6 is a hundred to one. At least 1.
    #[default(Positive::new(4.6))]
    pub verify_at: Positive,
    /// Rejected from this natural logarithm of the Bayes factor against a source on: 3 is twenty to one. At least 1.
    #[default(Positive::new(3.0))]
    pub reject_at: Positive,
    /// The vehicle goes as high as this share of the bed's contrast arrives, for a wide picture; from 0.05 to 0.95.
    #[default(Positive::new(0.3))]
    pub contrast_left: Positive,
    /// No line is planned lower than this above the bed, m; at least 0.5 and at most the camera's `altitude_m`.
    #[default(Positive::new(1.4))]
    pub least_altitude_m: Positive,
    /// Height above bed or body that the vehicle keeps, m: lines are raised by as much as the altimeter has shown less
    /// of it. From 0.2 to `least_altitude_m`.
    #[default(Positive::new(0.6))]
    pub clearance_m: Positive,
    /// Most lines flown over a place, from 1 to 32.
    #[default(8)]
    pub most_lines: u32,
}

impl AddUpSpec {
    /// Checks the ranges; `altitude_m` is the greatest altitude of the lines.
    ///
    /// # Errors
    /// Names the field below `path` and its legal range.
    pub fn check(&self, path: &str, altitude_m: f64) -> Result<(), RobotError> {
        let ranges = [
            ("within_m", self.within_m, 0.5, 20.0),
            ("cell_m", self.cell_m, 0.05, 0.25),
            ("shift_m", self.shift_m, 1e-3, 3.0),
            ("bed_texture", self.bed_texture, 0.01, 1.0),
            ("verify_at", self.verify_at, 1.0, 20.0),
            ("reject_at", self.reject_at, 1.0, 20.0),
            ("contrast_left", self.contrast_left, 0.05, 0.95),
        ];
        let must = |holds: bool, field: &str, problem: String| require(holds, format!("{path}.{field}"), problem);
        for (field, value, least, most) in ranges {
            let value = value.get();
            must((least..=most).contains(&value), field, format!("must be from {least} to {most}, got {value}"))?;
        }
        let least = self.least_altitude_m.get();
        let range = format!("must be from 0.5 to the camera's altitude_m, {altitude_m}");
        must((0.5..=altitude_m).contains(&least), "least_altitude_m", format!("{range}, got {least}"))?;
        let clearance = self.clearance_m.get();
        let range = format!("must be from 0.2 to least_altitude_m, {least}");
        must((0.2..=least).contains(&clearance), "clearance_m", format!("{range}, got {clearance}"))?;
        let range = "must be from 1 to 32";
        must((1..=32).contains(&self.most_lines), "most_lines", format!("{range}, got {}", self.most_lines))?;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_out_of_range_is_named_with_its_range() {
        let of = |change: &dyn Fn(&mut AddUpSpec)| {
            let mut spec = AddUpSpec::default();
            change(&mut spec);
            spec.check("a", 2.5).unwrap_err().to_string()
        };
        assert!(AddUpSpec::default().check("a", 2.5).is_ok());
        let m = Positive::new;
        for (said, told) in [
            (of(&|s| s.within_m = m(30.0)), "a.within_m: must be from 0.5 to 20, got 30"),
            (of(&|s| s.cell_m = m(0.5)), "a.cell_m: must be from 0.05 to 0.25, got 0.5"),
            (of(&|s| s.bed_texture = m(2.0)), "a.bed_texture: must be from 0.01 to 1, got 2"),
            (of(&|s| s.verify_at = m(0.5)), "a.verify_at: must be from 1 to 20, got 0.5"),
            (
                of(&|s| s.least_altitude_m = m(3.0)),
                "a.least_altitude_m: must be from 0.5 to the camera's altitude_m, 2.5, got 3",
            ),
            (of(&|s| s.clearance_m = m(2.0)), "a.clearance_m: must be from 0.2 to least_altitude_m, 1.4, got 2"),
            (of(&|s| s.most_lines = 0), "a.most_lines: must be from 1 to 32, got 0"),
        ] {
            assert_eq!(said, told);
        }
    }
}
