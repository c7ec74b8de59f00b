//! What the instruments reported in this tick; `None` if one did not report.

mod fault;

use super::{Picture, SidescanPing};
use bevy_ecs::prelude::Component;
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use std::sync::Arc;
use world::units::Heading;

/// Chemical sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChemicalReading {
    /// Output, V.
    pub volts: f64,
    /// The output as a share of full scale, 0–1.
    pub of_full_scale: f64,
    /// Above the detection threshold.
    pub detected: bool,
}

/// Doppler log on bottom track.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DvlReading {
    /// Velocity over ground in body axes (FLU), m/s.
    pub v_body_m_s: Vector3<f64>,
    /// False if bottom lock was lost: the velocity must then not be used.
    pub valid: bool,
}

/// One ADCP cell: water relative to the vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AdcpReading {
    /// Water velocity relative to the vehicle, in body axes (FLU), m/s.
    pub v_body_m_s: Vector3<f64>,
    /// Height of the cell's middle above the vehicle (negative: below), m.
    pub above_m: f64,
    /// False if the cell reaches beyond the surface or the bed.
    pub valid: bool,
}

/// Attitude, as read or believed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attitude {
    /// Heading.
    pub heading: Heading,
    /// Roll, right side down positive, rad.
    pub roll_rad: f64,
    /// Pitch, nose *up* positive, rad.
    pub pitch_rad: f64,
    /// Angular rates in body axes (FLU), rad/s.
    pub rates_rad_s: Vector3<f64>,
}

impl Attitude {
    /// Rotation from body axes (FLU) to world axes (ENU), as believed. A rotation about FLU's y is positive nose
    /// down.
    pub fn R_WB(&self) -> UnitQuaternion<f64> {
        UnitQuaternion::from_euler_angles(self.roll_rad, -self.pitch_rad, self.heading.yaw())
    }
}

/// Pressure sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DepthReading {
    /// Depth below the still surface, m.
    pub depth_m: f64,
}

/// Conductivity, temperature and depth, reduced to what gives the density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CtdReading {
    /// Density of the water, kg/m³.
    pub density_kg_m3: f64,
    /// How far the instrument is below the body's origin, m.
    pub below_m: f64,
}

/// Echo sounder looking down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AltimeterReading {
    /// Height above the bed, m.
    pub altitude_m: f64,
    /// False beyond its range.
    pub valid: bool,
}

/// Long-baseline position fix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LblFix {
    /// Position (east, north), m.
    pub position: Vector2<f64>,
}

/// One beam of the forward ranging.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    /// Direction in body axes (FLU), unit vector.
    pub dir_B: Vector3<f64>,
    /// Distance to what reflected the sound, m; `None` if nothing did within the range.
    pub echo_m: Option<f64>,
}

/// One ping of the forward ranging, without beams that dropped out.
#[derive(Clone, Debug, PartialEq)]
pub struct RangeScan {
    /// Place of the instrument in body axes (FLU), m.
    pub p_BS: Vector3<f64>,
    /// Its range, m.
    pub max_m: f64,
    /// Its beams.
    pub beams: Arc<[Beam]>,
}

impl RangeScan {
    /// The echoes in body axes (FLU), m.
    pub fn echoes_B(&self) -> impl Iterator<Item = Vector3<f64>> {
        let echo = |b: &Beam| Some(self.p_BS + b.dir_B * b.echo_m?);
        self.beams.iter().filter_map(echo)
    }
}

/// All readings of one tick.
#[derive(Component, Clone, Debug, Default, PartialEq)]
pub struct Readings {
    /// Chemical sensor.
    pub chemical: Option<ChemicalReading>,
    /// A pair of chemical sensors aside: the left one and the right one.
    pub sides: Option<[ChemicalReading; 2]>,
    /// Bottom track.
    pub dvl: Option<DvlReading>,
    /// Water track, the cell used for the flow.
    pub adcp: Option<AdcpReading>,
    /// Compass and inertial unit.
    pub attitude: Option<Attitude>,
    /// Depth.
    pub depth: Option<DepthReading>,
    /// Density at the vehicle.
    pub ctd: Option<CtdReading>,
    /// Altitude.
    pub altimeter: Option<AltimeterReading>,
    /// Position fix.
    pub lbl: Option<LblFix>,
    /// Forward ranging.
    pub ranging: Option<RangeScan>,
    /// Sidescan sonar.
    pub sidescan: Option<SidescanPing>,
    /// Camera.
    pub picture: Option<Picture>,
    /// Readings of other instruments, by name.
    pub other: Vec<(&'static str, f64)>,
}
