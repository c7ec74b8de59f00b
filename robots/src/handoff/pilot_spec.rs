//! What a vehicle's file can say of who steers it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::ranges::Positive;

/// Who steers a vehicle of a folder. Gains follow from the vehicle's own mass, damping and drives.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum PilotSpec {
    /// Fins and a propeller: heading by rudder, depth by pitch, speed by the propeller.
    Torpedo(TorpedoSpec),
    /// Thrusters, as many directions as they can push in: station keeping and motion sideways where they can, heading
    /// and speed alone for a craft on the surface.
    Thrusters(ThrustersSpec),
    /// Buoyancy engine and moving mass: a sawtooth between two depths, heading by a fin.
    Glider(GliderSpec),
}

/// A torpedo.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TorpedoSpec {
    /// Speed through the water at which the gains hold, m/s.
    #[serde(with = "world::limits::vehicle_m_s")]
    #[default(Positive::new(1.5))]
    pub design_speed_m_s: Positive,
    /// Greatest commanded turn rate, degrees/s.
    #[default(Positive::new(10.0))]
    pub heading_rate_deg_s: Positive,
    /// Radius of its tightest turn, m, for searchers and guidance; without it, that of design speed and turn rate.
    /// `rheotaxis vehicle trials` measures it.
    #[serde(with = "world::limits::turn_m::<Option<Positive>>")]
    pub turn_radius_m: Option<Positive>,
    /// Greatest commanded pitch, degrees.
    #[default(Positive::new(15.0))]
    pub pitch_limit_deg: Positive,
    /// Natural frequency of the closed pitch loop, rad/s.
    #[default(Positive::new(1.7))]
    pub pitch_rad_s: Positive,
    /// Natural frequency of the closed heading loop, rad/s.
    #[default(Positive::new(0.5))]
    pub heading_rad_s: Positive,
}

impl TorpedoSpec {
    /// Least speed through the water at which it is steered, m/s: fins have a quarter of their force at half the design
    /// speed.
    pub fn least_speed_m_s(&self) -> f64 {
        0.5 * self.design_speed_m_s.get()
    }
}

/// A vehicle with thrusters only.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ThrustersSpec {
    /// Greatest commanded speed ahead, m/s.
    #[serde(with = "world::limits::vehicle_m_s")]
    #[default(Positive::new(1.0))]
    pub speed_m_s: Positive,
    /// Greatest commanded speed sideways, m/s.
    #[serde(with = "world::limits::vehicle_m_s")]
    #[default(Positive::new(0.5))]
    pub sideways_m_s: Positive,
    /// Greatest commanded speed up and down, m/s.
    #[serde(with = "world::limits::vehicle_m_s")]
    #[default(Positive::new(0.4))]
    pub climb_m_s: Positive,
    /// Greatest commanded turn rate, degrees/s.
    #[serde(with = "world::limits::turn_deg_s")]
    #[default(Positive::new(30.0))]
    pub turn_deg_s: Positive,
    /// Time constant with which speeds approach what is commanded, s.
    #[default(Positive::new(1.0))]
    pub speed_lag_s: Positive,
    /// Natural frequency of the loops of place, depth and attitude, rad/s.
    #[default(Positive::new(0.8))]
    pub loop_rad_s: Positive,
}

/// A glider.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct GliderSpec {
    /// Depth at which it turns down, m.
    #[default(Positive::new(5.0))]
    pub shallow_m: Positive,
    /// Depth at which it turns up, m.
    #[default(Positive::new(100.0))]
    pub deep_m: Positive,
    /// It turns up at this altitude above the bed, too, m.
    #[default(Positive::new(8.0))]
    pub altitude_m: Positive,
    /// Pitch of the glide, degrees.
    #[default(Positive::new(25.0))]
    pub pitch_deg: Positive,
    /// Share of the buoyancy engine's volume that is used.
    #[default(Positive::new(1.0))]
    pub volume_share: Positive,
    /// Greatest commanded turn rate, degrees/s.
    #[default(Positive::new(3.0))]
    pub heading_rate_deg_s: Positive,
    /// Radius of its tightest turn, m, for searchers and guidance; without it, that of glide and turn rate.
    /// `rheotaxis vehicle trials` measures it.
    #[serde(with = "world::limits::turn_m::<Option<Positive>>")]
    pub turn_radius_m: Option<Positive>,
}
