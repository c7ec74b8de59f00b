//! Parameters of a kinematic vehicle.

use crate::handoff::{RateLimits, TurnLimit};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::ranges::{NonNegative, Positive};

/// A vehicle without dynamics: heading, speed and depth follow what is asked within limits. It has the hull, the mass
/// and the instruments' places of the REMUS 100, or those of a URDF. Instruments, navigation, guidance and strategies
/// are those of every robot; of the autopilot, only the limits of fins and propeller count, for tables of `OpenLoop`.
/// The defaults are the limits of Pang 2009, section 6 (2 m/s and 10 degrees/s), and a REMUS's fastest dive.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct KinematicSpec {
    /// What its speed is relative to.
    #[default(Moves::ThroughWater)]
    pub moves: Moves,
    /// Greatest speed ahead, m/s.
    #[serde(with = "world::limits::vehicle_m_s")]
    #[default(Positive::new(2.0))]
    pub max_speed_m_s: Positive,
    /// How tightly it turns. The guidance asks for no faster turn than its own `heading_rate_deg_s`.
    #[default(TurnSpec::Rate(RateSpec { deg_s: Positive::new(10.0) }))]
    pub turn: TurnSpec,
    /// Greatest speed up and down, m/s.
    #[serde(with = "world::limits::vehicle_m_s")]
    #[default(Positive::new(0.5))]
    pub climb_m_s: Positive,
    /// Time constant with which heading, speed and depth approach what is asked, s; 0 for none.
    #[serde(with = "world::limits::response_s")]
    #[default(NonNegative::new(0.0))]
    pub lag_s: NonNegative,
    /// URDF file with hull, mass and places of the instruments, relative to the scenario file; `None`: the built-in
    /// one of the REMUS 100.
    pub urdf: Option<String>,
}

/// What the speed of a kinematic vehicle is relative to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Moves {
    /// The water, which carries the vehicle along.
    #[default]
    ThroughWater,
    /// The ground: the water does not carry the vehicle, and the guidance does not compensate for it.
    OverGround,
}

/// How tightly a kinematic vehicle turns.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum TurnSpec {
    /// At a bounded rate, even at rest.
    Rate(RateSpec),
    /// On circles of a least radius, as the vehicle of Dubins.
    Radius(RadiusSpec),
}

/// A bounded turn rate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RateSpec {
    /// Greatest turn rate, degrees/s.
    #[serde(with = "world::limits::turn_deg_s")]
    pub deg_s: Positive,
}

/// A bounded curvature.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RadiusSpec {
    /// Least turning radius, m, of the path along its own speed.
    #[serde(with = "world::limits::radius_m")]
    pub radius_m: Positive,
}

impl KinematicSpec {
    /// The limits of its motion.
    pub fn limits(&self) -> RateLimits {
        RateLimits {
            speed_m_s: self.max_speed_m_s.get(),
            turn: match &self.turn {
                TurnSpec::Rate(rate) => TurnLimit::Rate(rate.deg_s.get().to_radians()),
                TurnSpec::Radius(radius) => TurnLimit::Radius(radius.radius_m.get()),
            },
            climb_m_s: self.climb_m_s.get(),
            lag_s: self.lag_s.get(),
        }
    }
}
