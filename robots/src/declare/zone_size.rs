//! Size of a source identification zone: fixed, or growing with the scatter of the points across the flow.
//!
//! *Source*: Tian et al. 2013, section 3: fixed sizes ε_T, ε_F; section 6 names adaptive sizes as future work. The
//! robust scale is the median absolute deviation (Hampel 1974, J. Am. Stat. Assoc. 69, 383).
//!
//! *Parameters*: of `Adaptive`: share of the scattered points that the zone holds, `coverage`, 0.95; number of newest
//! points considered, `look_back`, 12; bounds of the radius, `least_m`, 2 (half of ε_T = 4 m) and `most_m`, 15 (the
//! vehicle's turning radius: the vehicle's own cloverleaf separates places farther apart than that).
//!
//! *Deviations*: the papers give no rule for adapting. Ours: on the way to the source the last detection points move
//! along the flow and scatter across it, because of the plume's width and of navigation. When they scatter no more
//! along the flow than across it, there is no headway any more. So the zone is a circle that would hold `coverage` of
//! points scattered normally in both directions as they are across the flow: r = σ √(-2 ln(1 - coverage)). Here σ =
//! 1.4826 times the median absolute deviation of y_flow, and at least the error of a navigation fix along an axis.

use crate::error::{RobotError, require};
use crate::handoff::Lcdp;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::num::NonZeroUsize;
use world::math;
use world::ranges::{Fraction, Positive};
use world::units::Heading;

/// Inverse of the median absolute deviation of a normal distribution of scale 1.
const MAD_TO_SCALE: f64 = 1.482_602_218_505_602;

/// The size of a zone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum ZoneSize {
    /// ε, m, in the meaning of the rule: a diagonal for `SizT`, a radius for `SizF`.
    Fixed(Positive),
    /// Follows the scatter of the points.
    Adaptive(AdaptiveSize),
}

/// Parameters of a size that follows the scatter of the points.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AdaptiveSize {
    /// Share of the points scattered around the source that the zone is to hold, 0 < coverage < 1.
    #[default(Fraction::new(0.95))]
    pub coverage: Fraction,
    /// Number of newest points from which the scatter is estimated.
    #[default(NonZeroUsize::new(12).expect("12 is not zero"))]
    pub look_back: NonZeroUsize,
    /// Least radius, m.
    #[default(Positive::new(2.0))]
    pub least_m: Positive,
    /// Greatest radius, m.
    #[default(Positive::new(15.0))]
    pub most_m: Positive,
}

impl AdaptiveSize {
    /// Radius of the zone, m, from points in order of time; `fix_m` is the error of a navigation fix along an axis,
    /// m.
    pub fn radius_m(&self, points: &[Lcdp], up_flow: Heading, fix_m: f64) -> f64 {
        let newest = points.len().saturating_sub(self.look_back.get());
        let across: Vec<f64> = (points[newest..].iter()).map(|p| p.in_flow(up_flow).y).collect();
        let scale_m = robust_scale(across).max(fix_m);
        let radius_m = scale_m * (-2.0 * math::ln(1.0 - self.coverage.get())).sqrt();
        radius_m.clamp(self.least_m.get(), self.most_m.get())
    }
}

impl ZoneSize {
    /// The radius that a rule compares with, m: `Fixed` unchanged, or the adaptive one.
    pub(super) fn radius_m(&self, points: &[Lcdp], up_flow: Heading, fix_m: f64) -> f64 {
        match self {
            Self::Fixed(eps_m) => eps_m.get(),
            Self::Adaptive(a) => a.radius_m(points, up_flow, fix_m),
        }
    }

    /// The diagonal that a rule compares with, m: `Fixed` unchanged, or twice the adaptive radius.
    pub(super) fn diagonal_m(&self, points: &[Lcdp], up_flow: Heading, fix_m: f64) -> f64 {
        match self {
            Self::Fixed(eps_m) => eps_m.get(),
            Self::Adaptive(a) => 2.0 * a.radius_m(points, up_flow, fix_m),
        }
    }

    /// # Errors
    /// [`RobotError::Invalid`] if the bounds contradict each other.
    pub(super) fn check(&self, field: &str) -> Result<(), RobotError> {
        let Self::Adaptive(a) = self else {
            return Ok(());
        };
        let must =
            |holds: bool, name: &str, problem: String| require(holds, format!("{field}.Adaptive.{name}"), problem);
        let coverage = a.coverage.get();
        must(
            coverage > 0.0 && coverage < 1.0,
            "coverage",
            format!("must be > 0 and < 1, got {coverage}: no circle holds nothing, or all"),
        )?;
        must(
            a.most_m.get() >= a.least_m.get(),
            "most_m",
            format!("must be >= least_m = {}, got {}", a.least_m.get(), a.most_m.get()),
        )?;
        Ok(())
    }
}

/// 1.4826 times the median absolute deviation from the median; zero without values.
fn robust_scale(values: Vec<f64>) -> f64 {
    let Some(middle) = median(values.clone()) else {
        return 0.0;
    };
    let off = values.into_iter().map(|v| (v - middle).abs()).collect();
    median(off).map_or(0.0, |m| m * MAD_TO_SCALE)
}

fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let n = values.len();
    (n > 0).then(|| (values[(n - 1) / 2] + values[n / 2]) / 2.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declare::testing::{list, n};

    /// Points far apart along the flow: that does not count.
    fn across(easts: &[f64]) -> Vec<Lcdp> {
        let places: Vec<_> = easts.iter().enumerate().map(|(k, east)| (*east, 40.0 * k as f64)).collect();
        list(&places)
    }

    #[test]
    fn by_hand() {
        let a = AdaptiveSize::default();
        let north = Heading::from_deg(0.0);
        // Median 2, deviations 2 1 0 1 98: median 1, so sigma = 1.4826; times sqrt(-2 ln 0.05) = 2.4477.
        let r = a.radius_m(&across(&[0.0, 1.0, 2.0, 3.0, 100.0]), north, 0.0);
        assert!((r - 1.482_602_2 * 2.447_746_8).abs() < 1e-6, "{r}");
        // The error of a fix, 5 m, is the greater one.
        let r = a.radius_m(&across(&[0.0, 1.0, 2.0, 3.0, 100.0]), north, 5.0);
        assert!((r - 5.0 * 2.447_746_8).abs() < 1e-6, "{r}");
        // Bounds: nothing scattered, everything scattered; no point at all.
        assert_eq!(a.radius_m(&across(&[7.0; 6]), north, 0.0), 2.0);
        assert_eq!(a.radius_m(&across(&[0.0, 50.0, 100.0]), north, 0.0), 15.0);
        assert_eq!(a.radius_m(&[], north, 0.0), 2.0);
    }

    #[test]
    fn looks_at_the_newest_points_only() {
        let a = AdaptiveSize { look_back: n(3), ..AdaptiveSize::default() };
        let north = Heading::from_deg(0.0);
        let old = a.radius_m(&across(&[-30.0, 60.0, 0.0, 1.0, 2.0]), north, 0.0);
        let new = a.radius_m(&across(&[0.0, 1.0, 2.0]), north, 0.0);
        assert_eq!(old, new);
        // Turned by a quarter the scatter across is the 40 m steps.
        assert_eq!(a.radius_m(&across(&[0.0, 1.0, 2.0]), Heading::from_deg(90.0), 0.0), 15.0);
    }

    #[test]
    fn bounds_that_contradict_each_other_are_refused() {
        let with = |change: fn(&mut AdaptiveSize)| {
            let mut a = AdaptiveSize::default();
            change(&mut a);
            ZoneSize::Adaptive(a).check("declare.SizF.size")
        };
        assert!(with(|_| ()).is_ok());
        assert!(with(|a| a.coverage = Fraction::new(1.0)).is_err());
        assert!(with(|a| a.coverage = Fraction::new(0.0)).is_err());
        let e = with(|a| a.most_m = Positive::new(1.0)).expect_err("1 < 2");
        assert!(e.to_string().contains("declare.SizF.size.Adaptive.most_m"), "{e}");
    }
}
