//! Parameters common to all mappers: the grid, and the model of how dye travels.

use super::kernel::flow_history::FlowHistory;
use crate::error::{RobotError, require};
use crate::handoff::BeliefGrid;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::area::Area;
use world::limits::shown;
use world::math;
use world::ranges::{Fraction, NonNegative, Positive};

/// Most cells of a map: a million take 8 MB per table.
const MOST_CELLS: f64 = 1e6;
/// Most places within a cell along an axis.
const MOST_PLACES: u32 = 9;
/// Most releases a look-back may hold.
const MOST_RELEASES: f64 = 100_000.0;

/// The cells over the operating area.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "MapGridSpec")]
#[serde(deny_unknown_fields, default)]
pub struct GridSpec {
    /// Cells along the area's axis.
    #[default(40)]
    pub along: u32,
    /// Cells across the area's axis.
    #[default(25)]
    pub across: u32,
    /// Cells from bottom to top; 1 for a map of the plane.
    #[default(1)]
    pub vertical: u32,
    /// Upper edge of the map, m below the surface.
    #[default(NonNegative::new(0.0))]
    pub top_depth_m: NonNegative,
    /// Lower edge of the map, m below the surface; must be given for a map of space.
    pub bottom_depth_m: Option<Positive>,
    /// Places within a cell, along each horizontal axis, at which a source is considered; an odd number from 1 to 9. 1:
    /// only the middle, as in the papers. The vehicle's place is taken to the nearest of them, too.
    #[default(1)]
    pub places: u32,
}

impl GridSpec {
    /// The grid over an area.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if there are no or too many cells, or if a map of space lacks its depths.
    pub fn build(&self, area: &Area) -> Result<BeliefGrid, RobotError> {
        let n = [self.along, self.across, self.vertical];
        for (name, count) in ["along", "across", "vertical"].into_iter().zip(n) {
            must(count != 0, format!("grid.{name}"), "must be at least 1, got 0")?;
        }
        let problem = format!("must be odd and from 1 to {MOST_PLACES}, got {}", self.places);
        must(!self.places.is_multiple_of(2) && self.places <= MOST_PLACES, "grid.places", problem)?;
        let cells = self.cells() * f64::from(self.places * self.places);
        let got = if cells < 1e12 { format!("{cells}") } else { shown(cells) };
        let what = if self.places == 1 { "cells" } else { "places" };
        must(cells <= MOST_CELLS, "grid", format!("must have at most {MOST_CELLS} {what}, got {got}"))?;
        let top = self.top_depth_m.get();
        let bottom = match self.bottom_depth_m {
            Some(b) if b.get() > top => b.get(),
            Some(b) => {
                return Err(invalid(
                    "grid.bottom_depth_m",
                    &format!("must be greater than top_depth_m, {top}, got {}", b.get()),
                ));
            }
            None if self.vertical > 1 => {
                return Err(invalid("grid.bottom_depth_m", "must be given when vertical is more than 1"));
            }
            None => top + 1.0,
        };
        Ok(BeliefGrid::over(area, top, bottom, n.map(|c| c as usize)))
    }
}

/// Model of how dye travels from a source to the sensor.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TrajectorySpec {
    /// Chance of detecting dye that is there, μ.
    #[default(Fraction::new(0.9))]
    pub mu: Fraction,
    /// Spread of dye in one second along the area's axis, σx, m/√s.
    #[serde(with = "world::limits::spread_m_rts")]
    #[default(Positive::new(0.5))]
    pub sigma_x_m_rts: Positive,
    /// The same across the axis, σy, m/√s.
    #[serde(with = "world::limits::spread_m_rts")]
    #[default(Positive::new(0.5))]
    pub sigma_y_m_rts: Positive,
    /// The same in the vertical, σz, m/√s; not used in a map of the plane.
    #[serde(with = "world::limits::spread_m_rts")]
    #[default(Positive::new(0.05))]
    pub sigma_z_m_rts: Positive,
    /// Horizontal size of a release, to which dye of age 0 is met round its middle: a standard deviation, m; 0, as in the
    /// papers: it is a point.
    #[default(NonNegative::new(0.0))]
    pub initial_m: NonNegative,
    /// Standard deviation, in each horizontal axis, of the flow along the way from the flow at the vehicle, u′, m/s;
    /// 0: the flow is the same everywhere, as in the papers.
    #[serde(with = "world::limits::stream_m_s")]
    #[default(NonNegative::new(0.0))]
    pub flow_error_m_s: NonNegative,
    /// Time for which a deviation lasts along a way, T, s.
    #[serde(with = "world::limits::lasting_s")]
    #[default(Positive::new(100.0))]
    pub flow_error_s: Positive,
    /// Look-back h, s: older releases are not considered.
    #[serde(with = "world::limits::lasting_s")]
    #[default(Positive::new(600.0))]
    pub lookback_s: Positive,
    /// Time between two releases, the papers' time unit, s.
    #[serde(with = "world::limits::lasting_s")]
    #[default(Positive::new(1.0))]
    pub release_period_s: Positive,
    /// Neighbouring releases are merged while their places differ by less than this share of their spread (root mean
    /// square); 0: never.
    #[default(Fraction::new(0.3))]
    pub merge: Fraction,
    /// Releases before the mission count as well, in the mean flow measured since. Otherwise the source is taken to
    /// have begun with the mission, as in the papers.
    #[default(true)]
    pub steady_before: bool,
}

impl TrajectorySpec {
    /// Checks the look-back.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if the look-back holds less than one release or too many.
    pub fn check(&self) -> Result<(), RobotError> {
        let (h, unit) = (self.lookback_s.get(), self.release_period_s.get());
        let releases = h / unit;
        must(
            (1.0..=MOST_RELEASES).contains(&releases),
            "trajectory.lookback_s",
            format!("must hold from 1 to {MOST_RELEASES} releases, {unit} s apart, got {releases}"),
        )
    }

    /// Checks that a look-back in steps of `period_s`, given as `field`, can be remembered.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] with the least legal step.
    pub(super) fn holds(&self, field: &str, period_s: f64) -> Result<(), RobotError> {
        let h = self.lookback_s.get();
        let problem = format!(
            "must be at least {} to look back {h} s in {MOST_RELEASES} steps, got {}",
            shown(h / MOST_RELEASES),
            shown(period_s)
        );
        must(h / period_s <= MOST_RELEASES, field, problem)
    }

    /// An empty history of the flow, with a mark every `period_s`.
    pub(super) fn history(&self, period_s: f64) -> FlowHistory {
        FlowHistory::new(period_s, self.lookback_s.get(), self.steady_before)
    }

    /// Variance along each horizontal axis that the flow's error alone causes at an age: 2 u′² T (Δt − T (1 −
    /// e^(−Δt/T))), m² (Taylor 1921, Proc. London Math. Soc. 20, 196: dispersion by a velocity that lasts T).
    pub fn strayed_m2(&self, age_s: f64) -> f64 {
        let (u, t) = (self.flow_error_m_s.get(), self.flow_error_s.get());
        if u == 0.0 {
            return 0.0;
        }
        2.0 * u * u * t * (age_s - t * (1.0 - math::exp(-age_s / t)))
    }

    /// Horizontal variance of a release at an age besides that of σx or σy, m².
    pub(super) fn beside_m2(&self, age_s: f64) -> f64 {
        let size = self.initial_m.get();
        self.strayed_m2(age_s) + size * size
    }

    /// Standard deviation along each axis at an age, m.
    pub(super) fn spread_m(&self, age_s: f64) -> [f64; 3] {
        let (root, strayed) = (age_s.sqrt(), self.beside_m2(age_s));
        let [x, y, z] = self.sigmas().map(|s| s * root);
        if strayed == 0.0 {
            return [x, y, z];
        }
        [(x * x + strayed).sqrt(), (y * y + strayed).sqrt(), z]
    }

    /// σx, σy, σz, m/√s.
    pub fn sigmas(&self) -> [f64; 3] {
        [self.sigma_x_m_rts, self.sigma_y_m_rts, self.sigma_z_m_rts].map(Positive::get)
    }
}

/// What must hold for a field of a mapper.
pub(super) fn must(holds: bool, field: impl std::fmt::Display, problem: impl Into<String>) -> Result<(), RobotError> {
    require(holds, format!("map.{field}"), problem)
}

/// A setup error of a mapper.
pub(super) fn invalid(field: &str, problem: &str) -> RobotError {
    RobotError::invalid(format!("map.{field}"), problem)
}
