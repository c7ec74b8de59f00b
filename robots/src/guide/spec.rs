//! What a scenario can set for the guidance.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::ranges::Positive;

/// Speed of a REMUS in a turn, m/s: at full ahead it slows down to 1.9 m/s in its trial.
const TURNING_M_S: f64 = 2.0;

/// Guidance parameters; the defaults are Pang 2009, section 4 and Table 4, or the choice stated at the field.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct GuidanceSpec {
    /// Greatest rate of the commanded heading, °/s (section 4: 10).
    #[default(Positive::new(10.0))]
    pub heading_rate_deg_s: Positive,
    /// Greatest speed through the water, m/s (section 4: 2); of a vehicle that the water does not carry, over ground.
    #[serde(with = "world::limits::vehicle_m_s")]
    #[default(Positive::new(2.0))]
    pub water_speed_limit_m_s: Positive,
    /// R of eq. 6: a point, or the end of a line, counts as reached within this distance, m (Table 4: 10).
    #[default(Positive::new(10.0))]
    pub arrive_m: Positive,
    /// K of eq. 8, degrees of heading per metre off the line (Table 4: 5.0).
    #[default(Positive::new(5.0))]
    pub line_gain_deg_m: Positive,
    /// Greatest angle to the line while approaching it, ° (eq. 8: 45).
    #[default(Positive::new(45.0))]
    pub line_capture_deg: Positive,
    /// A line is entered within this distance of its start, m (section 4.2: R = 10).
    #[default(Positive::new(10.0))]
    pub line_start_m: Positive,
    /// θ of section 4.2: a line is entered within this angle of its direction, ° (Fig. 3: 15).
    #[default(Positive::new(15.0))]
    pub line_start_angle_deg: Positive,
    /// R_L of eq. 10: a line ends when the vehicle has overshot its end by more than this, m (not printed; R taken).
    #[default(Positive::new(10.0))]
    pub line_overshoot_m: Positive,
    /// R_m of section 4.3, m (not printed; the 11.5 m that 2 m/s at 10 °/s give, with a margin).
    #[serde(with = "world::limits::turn_m")]
    #[default(Positive::new(15.0))]
    pub turn_radius_m: Positive,
    /// A Dubins path is planned again when the vehicle is farther from it than this, m (not printed; just under the
    /// 10 m of a navigation fix, so that a fix causes a new path and noise does not).
    #[default(Positive::new(8.0))]
    pub replan_m: Positive,
    /// The cage changes the command from this distance to the edge on, m (eq. 12: 5).
    #[default(Positive::new(5.0))]
    pub cage_m: Positive,
    /// The mission is aborted farther outside the area than this, m (section 4.4: 30).
    #[default(Positive::new(30.0))]
    pub abort_outside_m: Positive,
}

impl GuidanceSpec {
    /// Turn, rad, of a vehicle that is so far to the left of its way (eq. 8 of Pang 2009).
    pub(super) fn turn_to_line(&self, off_m: f64) -> f64 {
        let capture_rad = self.line_capture_deg.get().to_radians();
        (self.line_gain_deg_m.get().to_radians() * off_m).clamp(-capture_rad, capture_rad)
    }

    /// Radius of the tightest turn of a REMUS that follows the commanded heading, m: that of its speed and rate, or the
    /// planned one if that is less.
    pub fn tightest_turn_m(&self) -> f64 {
        let rate_rad_s = self.heading_rate_deg_s.get().to_radians();
        (self.water_speed_limit_m_s.get().min(TURNING_M_S) / rate_rad_s).min(self.turn_radius_m.get())
    }
}
