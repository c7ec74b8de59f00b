//! Parameters of a gantry.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::ranges::{NonNegative, Positive};

/// Which gantry.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum GantrySpec {
    /// The gantry of the blue-crab tracker, or another one with two level slides.
    #[default]
    CrabGantry(CrabGantrySpec),
}

/// A gantry: the URDF describes its frame, these numbers its drives. Travel, greatest speeds, greatest forces,
/// masses, shapes and probes are in the URDF. Of the drives, the paper gives only the speeds.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CrabGantrySpec {
    /// URDF file, relative to the scenario file; `None`: the built-in one, which `rheotaxis init --gantry` writes.
    pub urdf: Option<String>,
    /// Probes that are taken off, such as `"probe_centre"`.
    pub without: Vec<String>,
    /// Distance across the stream from the leftmost probe to the rightmost one, m; the others lie between in
    /// proportion. Without it, as the URDF has them.
    #[serde(with = "world::limits::span_m::<Option<Positive>>")]
    pub span_m: Option<Positive>,
    /// Acceleration and braking of each axis, m/s²: top speed within 0.3 s.
    #[default(Positive::new(0.5))]
    pub acceleration_m_s2: Positive,
    /// Standard deviation of the place where a move ends, drawn for each move and axis, m. Two of them are 0.1 mm,
    /// the order of the ± 0.05 to 0.2 mm that makers of belt-driven rodless units state as repeatability.
    #[default(NonNegative::new(5e-5))]
    pub repeatability_m: NonNegative,
    /// Lost motion between motor and carriage on reversal, m: 0 for a preloaded belt or screw.
    #[default(NonNegative::new(0.0))]
    pub backlash_m: NonNegative,
    /// One count of the encoder at the carriage, m: 8000 counts per turn of a belt pulley of 80 mm.
    #[default(Positive::new(1e-5))]
    pub encoder_m: Positive,
    /// Position loop: speed per metre of error, 1/s.
    #[default(Positive::new(10.0))]
    pub position_gain_per_s: Positive,
    /// Time constant of the speed loop, s.
    #[default(Positive::new(0.005))]
    pub response_s: Positive,
    /// A target counts as reached when the encoder is this close to it, m (CiA 402, object 6067h).
    #[default(Positive::new(2e-4))]
    pub settle_m: Positive,
    /// Greatest following error, m (CiA 402, object 6065h).
    #[default(Positive::new(0.005))]
    pub following_error_m: Positive,
    /// How long the following error may be greater before the drive stops and reports `blocked`, s (CiA 402, object
    /// 6066h).
    #[default(NonNegative::new(0.1))]
    pub following_time_s: NonNegative,
}
