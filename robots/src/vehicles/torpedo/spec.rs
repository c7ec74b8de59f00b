//! What `vehicle.ron` can say of a torpedo-shaped hull with terms of its own.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::ranges::{Fraction, NonNegative, Positive};

/// A torpedo-shaped hull: a prolate spheroid with rudder, stern plane and propeller at its tail, each on the link of
/// that name (`rudder`, `stern_plane`, `propeller`). The origin of the body's link is the middle of the hull. Lift, drag
/// and fins are those of Fossen 2021 for the REMUS 100; the autopilot is that of the scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TorpedoHullSpec {
    /// Length, m.
    #[serde(with = "world::limits::solid_m")]
    pub length_m: Positive,
    /// Diameter, m; less than the length.
    #[serde(with = "world::limits::solid_m")]
    pub diameter_m: Positive,
    /// Centre of gravity below the middle of the hull, m. With it and with mass and inertia of a spheroid that displaces
    /// its own weight, the URDF must agree within 1 %.
    pub centre_of_gravity_below_m: Positive,
    /// Added inertia in roll, as a share of the inertia in roll.
    pub added_roll: NonNegative,
    /// Time constant T_1 of linear damping in surge, s.
    pub surge_s: Positive,
    /// Time constant T_2 of linear damping in sway and heave, s.
    pub sway_s: Positive,
    /// Damping ratio ζ_4 of the swing in roll.
    pub roll_damping: Fraction,
    /// Damping ratio ζ_5 of the swing in pitch.
    pub pitch_damping: Fraction,
    /// Drag coefficient without incidence, on the frontal area.
    pub frontal_drag: Positive,
    /// Reference area of lift and induced drag, as a share of length times diameter.
    pub area_share: Positive,
    /// Span efficiency e of the hull: the induced drag is C_L²/(π e AR).
    pub span_efficiency: Positive,
    /// Cross-flow drag coefficient.
    pub cross_flow: NonNegative,
    /// Rudder and stern plane.
    pub fins: TorpedoFinsSpec,
    /// The propeller.
    pub propeller: TorpedoPropellerSpec,
    /// With the quirks of the published code, to compare with its trajectories: among others, the current is turned by yaw
    /// only, cross-flow drags in sway only, and fins do not feel the incidence of the water.
    #[serde(default)]
    pub published: bool,
}

/// Rudder and stern plane of a torpedo-shaped hull, two fins each.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TorpedoFinsSpec {
    /// Area of one fin, m².
    pub area_m2: Positive,
    /// Lift slope of the rudder, 1/rad.
    pub rudder_slope: Positive,
    /// Lift slope of the stern plane, 1/rad.
    pub stern_slope: Positive,
    /// Greatest deflection, degrees.
    #[serde(with = "world::limits::fin_deg")]
    pub limit_deg: Positive,
    /// Time constant with which they follow, s.
    pub lag_s: Positive,
    /// Least speed through the water at which they steer, m/s.
    #[serde(with = "world::limits::vehicle_m_s")]
    pub least_speed_m_s: Positive,
}

/// Propeller of a torpedo-shaped hull, by linear open-water curves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TorpedoPropellerSpec {
    /// Diameter, m.
    #[serde(with = "world::limits::solid_m")]
    pub diameter_m: Positive,
    /// Share of the thrust that reaches the hull, 1 − t.
    pub thrust_share: Fraction,
    /// Share of the speed that reaches the propeller, 1 − w.
    pub wake_share: Fraction,
    /// Share of the shaft's torque that rolls the hull.
    pub torque_share: Positive,
    /// Thrust coefficient K_T at rest, and at the advance ratio `advance_ratio`.
    pub thrust: (Positive, NonNegative),
    /// Torque coefficient K_Q at rest, and at the advance ratio `advance_ratio`.
    pub torque: (Positive, NonNegative),
    /// Advance ratio of the second coefficients.
    pub advance_ratio: Positive,
    /// Greatest speed, rpm.
    #[serde(with = "world::limits::rpm_limit")]
    pub limit_rpm: Positive,
    /// Time constant with which it follows, s.
    pub lag_s: Positive,
    /// Share of the electric power that reaches the shaft.
    pub shaft_share: Positive,
}
