//! What a scenario can set for the autopilot.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::ranges::{NonNegative, Positive};

/// Gains and limits; the defaults are for the REMUS 100. The gains of the fins hold at `design_speed_m_s` through the
/// water. At other speeds they are scaled with the dynamic pressure.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct AutopilotSpec {
    /// Commanded turn rate per heading error, 1/s.
    #[default(Positive::new(0.5))]
    pub heading_gain_1_s: Positive,
    /// Greatest commanded turn rate, deg/s.
    #[default(Positive::new(10.0))]
    pub heading_rate_deg_s: Positive,
    /// Rudder per turn rate in a steady turn, s.
    #[default(NonNegative::new(1.4))]
    pub rudder_per_rate_s: NonNegative,
    /// Rudder per error in turn rate, s.
    #[default(Positive::new(0.6))]
    pub rate_gain_s: Positive,
    /// Rudder per integrated heading error, 1/s.
    #[default(NonNegative::new(0.02))]
    pub heading_integral_1_s: NonNegative,
    /// Greatest rudder angle that the integral may contribute, deg. A straight leg of the REMUS needs 0.3 deg.
    #[default(Positive::new(2.0))]
    pub heading_trim_limit_deg: Positive,
    /// Commanded pitch per error in depth or altitude, deg/m.
    #[default(Positive::new(6.0))]
    pub depth_gain_deg_m: Positive,
    /// Commanded pitch per integrated error in depth or altitude, deg/(m s).
    #[default(NonNegative::new(0.2))]
    pub depth_integral_deg_m_s: NonNegative,
    /// Greatest commanded pitch, deg.
    #[default(Positive::new(15.0))]
    pub pitch_limit_deg: Positive,
    /// Stern plane per commanded pitch in a steady dive: what balances the hull's righting moment.
    #[default(NonNegative::new(0.42))]
    pub stern_per_pitch: NonNegative,
    /// Stern plane per error in pitch.
    #[default(Positive::new(1.0))]
    pub pitch_gain: Positive,
    /// Stern plane per pitch rate, s.
    #[default(NonNegative::new(0.3))]
    pub pitch_rate_gain_s: NonNegative,
    /// Propeller speed per speed through the water in steady motion, rpm s/m.
    #[default(Positive::new(597.2))]
    pub rpm_per_speed: Positive,
    /// Propeller speed per integrated error in speed, rpm/m.
    #[default(NonNegative::new(30.0))]
    pub speed_integral_rpm_m: NonNegative,
    /// Speed through the water at which the gains hold, m/s.
    #[serde(with = "world::limits::vehicle_m_s")]
    #[default(Positive::new(2.0))]
    pub design_speed_m_s: Positive,
    /// Greatest deflection of rudder and stern plane, deg.
    #[serde(with = "world::limits::fin_deg")]
    #[default(Positive::new(15.0))]
    pub fin_limit_deg: Positive,
    /// Greatest propeller speed, rpm.
    #[serde(with = "world::limits::rpm_limit")]
    #[default(Positive::new(1525.0))]
    pub rpm_limit: Positive,
}

/// Autopilots that a scenario can set up.
pub const CATALOGUE: &[Entry] = &[
    Entry {
        name: "autopilot",
        what: "Heading by rudder, depth or altitude by pitch and stern plane, water speed by propeller; set up by \
            `autopilot: (...)`.",
        source: "Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control, 2nd ed. 2021, ch. 15; limits: \
            Pang 2009, section 6",
    },
    Entry {
        name: "helm",
        what: "Of a kinematic vehicle: heading, depth or altitude, and speed by their rates; it has no parameters but \
            the vehicle's limits.",
        source: "Dubins 1957; Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control, 2nd ed. 2021, ch. 9",
    },
];
