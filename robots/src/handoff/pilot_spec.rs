//! What a vehicle's file can say of who steers it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
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
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct TorpedoSpec {
    /// Speed through the water at which the gains hold, m/s.
    #[serde(with = "world::limits::vehicle_m_s")]
    pub design_speed_m_s: Positive,
    /// Greatest commanded turn rate, degrees/s.
    pub heading_rate_deg_s: Positive,
    /// Radius of its tightest turn, m, for searchers and guidance; without it, that of design speed and turn rate.
    /// `rheotaxis vehicle trials` measures it.
    #[serde(with = "world::limits::turn_m::<Option<Positive>>")]
    pub turn_radius_m: Option<Positive>,
    /// Greatest commanded pitch, degrees.
    pub pitch_limit_deg: Positive,
    /// Natural frequency of the closed pitch loop, rad/s.
    pub pitch_rad_s: Positive,
    /// Natural frequency of the closed heading loop, rad/s.
    pub heading_rad_s: Positive,
}

impl Default for TorpedoSpec {
    fn default() -> Self {
        Self {
            design_speed_m_s: Positive::new(1.5),
            heading_rate_deg_s: Positive::new(10.0),
            turn_radius_m: None,
            pitch_limit_deg: Positive::new(15.0),
            pitch_rad_s: Positive::new(1.7),
            heading_rad_s: Positive::new(0.5),
        }
    }
}

impl TorpedoSpec {
    /// Least speed through the water at which it is steered, m/s: fins have a quarter of their force at half the design
    /// speed.
    #[must_use]
    pub fn least_speed_m_s(&self) -> f64 {
        0.5 * self.design_speed_m_s.get()
    }
}

/// A vehicle with thrusters only.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ThrustersSpec {
    /// Greatest commanded speed ahead, m/s.
    #[serde(with = "world::limits::vehicle_m_s")]
    pub speed_m_s: Positive,
    /// Greatest commanded speed sideways, m/s.
    #[serde(with = "world::limits::vehicle_m_s")]
    pub sideways_m_s: Positive,
    /// Greatest commanded speed up and down, m/s.
    #[serde(with = "world::limits::vehicle_m_s")]
    pub climb_m_s: Positive,
    /// Greatest commanded turn rate, degrees/s.
    #[serde(with = "world::limits::turn_deg_s")]
    pub turn_deg_s: Positive,
    /// Time constant with which speeds approach what is commanded, s.
    pub speed_lag_s: Positive,
    /// Natural frequency of the loops of place, depth and attitude, rad/s.
    pub loop_rad_s: Positive,
}

impl Default for ThrustersSpec {
    fn default() -> Self {
        Self {
            speed_m_s: Positive::new(1.0),
            sideways_m_s: Positive::new(0.5),
            climb_m_s: Positive::new(0.4),
            turn_deg_s: Positive::new(30.0),
            speed_lag_s: Positive::new(1.0),
            loop_rad_s: Positive::new(0.8),
        }
    }
}

/// A glider.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct GliderSpec {
    /// Depth at which it turns down, m.
    pub shallow_m: Positive,
    /// Depth at which it turns up, m.
    pub deep_m: Positive,
    /// It turns up at this altitude above the bed, too, m.
    pub altitude_m: Positive,
    /// Pitch of the glide, degrees.
    pub pitch_deg: Positive,
    /// Share of the buoyancy engine's volume that is used.
    pub volume_share: Positive,
    /// Greatest commanded turn rate, degrees/s.
    pub heading_rate_deg_s: Positive,
    /// Radius of its tightest turn, m, for searchers and guidance; without it, that of glide and turn rate.
    /// `rheotaxis vehicle trials` measures it.
    #[serde(with = "world::limits::turn_m::<Option<Positive>>")]
    pub turn_radius_m: Option<Positive>,
}

impl Default for GliderSpec {
    fn default() -> Self {
        Self {
            shallow_m: Positive::new(5.0),
            deep_m: Positive::new(100.0),
            altitude_m: Positive::new(8.0),
            pitch_deg: Positive::new(25.0),
            volume_share: Positive::new(1.0),
            heading_rate_deg_s: Positive::new(3.0),
            turn_radius_m: None,
        }
    }
}
