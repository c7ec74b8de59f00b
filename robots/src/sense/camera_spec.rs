//! Parameters of a camera, of its sensor and of its lamp. What they mean for a picture is said in the crate `eyes`.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::ranges::{Finite, Fraction, NonNegative, Positive};

/// Parameters of a camera.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct CameraSpec {
    /// Most pictures per second, Hz; a picture is taken only on request.
    #[default(Positive::new(1.0))]
    pub rate_hz: Positive,
    /// Pixels side by side, at most 4096.
    #[default(640)]
    pub width: u32,
    /// Pixels one above the other, at most 4096.
    #[default(480)]
    pub height: u32,
    /// Full horizontal angle of view in the water, °, less than 170.
    #[default(Positive::new(60.0))]
    pub view_deg: Positive,
    /// To the left of the mount's x axis, °.
    #[default(Finite::new(0.0))]
    pub pan_deg: Finite,
    /// Down from the mount's x axis, °: 90 looks straight down.
    #[default(Finite::new(20.0))]
    pub tilt_deg: Finite,
    /// Exposure and noise.
    pub sensor: SensorSpec,
    /// A lamp beside it.
    pub lamp: Option<LampSpec>,
}

/// A lamp that shines in the camera's direction.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LampSpec {
    /// Luminous intensity on its axis, cd.
    #[default(Positive::new(2000.0))]
    pub candela: Positive,
    /// Angle from its axis at which half of that intensity is left, °.
    #[default(Positive::new(30.0))]
    pub half_deg: Positive,
    /// Its place to the right of the camera, m.
    #[default(Finite::new(0.2))]
    pub right_m: Finite,
    /// Its place below the camera, m.
    #[default(Finite::new(0.0))]
    pub down_m: Finite,
}

/// Parameters of the sensor.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct SensorSpec {
    /// Exposure, s; automatic without it.
    pub exposure_s: Option<Positive>,
    /// Mean of the picture that the automatic exposure aims for, as a share of full scale, before the transfer curve.
    #[default(Fraction::new(0.2))]
    pub target: Fraction,
    /// Longest automatic exposure, s.
    #[default(Positive::new(1.0 / 30.0))]
    pub max_exposure_s: Positive,
    /// Greatest automatic gain.
    #[default(Positive::new(16.0))]
    pub max_gain: Positive,
    /// Focal length over aperture.
    #[default(Positive::new(2.0))]
    pub f_number: Positive,
    /// Electrons of a pixel and colour for 1 lx s.
    #[default(Positive::new(10_000.0))]
    pub electrons_per_lux_s: Positive,
    /// Electrons at full scale.
    #[default(Positive::new(10_000.0))]
    pub full_well_e: Positive,
    /// Standard deviation of the reading noise, electrons.
    #[default(NonNegative::new(5.0))]
    pub read_noise_e: NonNegative,
    /// Greatest factor by which red and blue are multiplied to reach green's mean; 1: none.
    #[default(Positive::new(4.0))]
    pub white_balance: Positive,
    /// Factor on a colour's distance from grey.
    #[default(NonNegative::new(1.7))]
    pub saturation: NonNegative,
}
