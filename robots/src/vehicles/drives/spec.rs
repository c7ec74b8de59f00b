//! What a vehicle's file can say of its drives.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::ranges::{Finite, NonNegative, Positive};

/// A drive, on a link of the URDF.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "VehicleDriveSpec")]
pub enum DriveSpec {
    /// A propeller that pushes the hull along the axis of the link's joint, or the link's x axis if that is fixed.
    Thruster(ThrusterSpec),
    /// A fin that turns about the axis of the link's joint, or the link's y axis if that is fixed. At zero its chord is
    /// along x, or along the hull if it turns about x, and its lift along chord × axis: z for y.
    Fin(FinSpec),
    /// A pump that changes the volume of the hull at the link.
    BuoyancyEngine(BuoyancyEngineSpec),
    /// A mass, already part of the URDF's, that slides along the axis of the link's joint, or the link's x axis if
    /// that is fixed.
    MovingMass(MovingMassSpec),
}

/// A thruster. Its set-point is the input of its curve.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ThrusterSpec {
    /// Link.
    pub link: String,
    /// Thrust in still water by input.
    pub curve: CurveSpec,
    /// Time constant with which the input follows its set-point, s.
    #[serde(default = "zero")]
    pub lag_s: NonNegative,
    /// Speed of the water along the thrust at which full thrust has fallen to zero, m/s; `None`: thrust does not
    /// depend on the inflow.
    #[serde(default)]
    pub runs_free_m_s: Option<Positive>,
    /// Reaction torque about the axis, N m for each N of thrust; its sign is the sense of rotation.
    #[serde(default = "none")]
    pub torque_m: Finite,
    /// Electric power for each N of thrust at full thrust, W/N; at less it falls with the root of the thrust.
    #[serde(default = "watts")]
    pub power_w_n: NonNegative,
}

/// Thrust in still water by input.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum CurveSpec {
    /// The input is the thrust itself, N, from the first number (astern, negative or 0) to the second.
    Newtons((Finite, Finite)),
    /// Pairs of input and thrust (N), both not falling, straight lines between. Equal thrusts make a dead band.
    Table(Vec<(Finite, Finite)>),
    /// c_1 n|n| + c_2 n of the input n, from the third number to the fourth.
    Polynomial((Finite, Finite, Finite, Finite)),
}

/// A fin. Its set-point is its angle, rad, positive about its axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FinSpec {
    /// Link: its origin is the fin's centre of pressure.
    pub link: String,
    /// Plan area, m².
    pub area_m2: Positive,
    /// Lift slope, 1/rad.
    pub lift_slope: Positive,
    /// Drag coefficient without incidence.
    #[serde(default = "zero")]
    pub drag_0: NonNegative,
    /// Angle of attack at which the flow leaves the fin, degrees.
    #[serde(default = "stall")]
    pub stall_deg: Positive,
    /// Force coefficient across the plate beyond the stall.
    #[serde(default = "plate")]
    pub plate: NonNegative,
    /// Greatest deflection, degrees.
    #[serde(with = "world::limits::fin_deg")]
    pub limit_deg: Positive,
    /// Time constant with which the angle follows its set-point, s.
    #[serde(default = "zero")]
    pub lag_s: NonNegative,
}

/// A buoyancy engine. Its set-point is the volume it adds, m³.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BuoyancyEngineSpec {
    /// Link.
    pub link: String,
    /// Greatest volume added or taken away, m³.
    pub limit_m3: Positive,
    /// How fast it pumps, m³/s.
    pub rate_m3_s: Positive,
    /// Electric power while it pumps out, W.
    #[serde(default = "zero")]
    pub power_w: NonNegative,
}

/// A moving mass. Its set-point is its place along its axis, m.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MovingMassSpec {
    /// Link: where the mass is in the middle of its travel.
    pub link: String,
    /// Mass, kg.
    pub mass_kg: Positive,
    /// Greatest distance from the middle, m.
    pub travel_m: Positive,
    /// How fast it moves, m/s.
    pub rate_m_s: Positive,
    /// Electric power while it moves, W.
    #[serde(default = "zero")]
    pub power_w: NonNegative,
}

fn none() -> Finite {
    Finite::new(0.0)
}

fn zero() -> NonNegative {
    NonNegative::new(0.0)
}

/// A T200 at full thrust: 390 W for 51 N.
fn watts() -> NonNegative {
    NonNegative::new(7.6)
}

fn stall() -> Positive {
    Positive::new(20.0)
}

/// A flat plate across the stream (Hoerner 1965).
fn plate() -> NonNegative {
    NonNegative::new(1.98)
}
