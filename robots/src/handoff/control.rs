//! What an autopilot knows of its vehicle: plain numbers, all in body axes FLU about the body's origin.

use super::{PilotSpec, RateLimits};
use nalgebra::{Matrix6, Vector3, Vector6};
use smart_default::SmartDefault;

/// Most drives that a vehicle of a folder has.
pub const MOST_DRIVES: usize = 16;

/// How a vehicle is steered, and what its autopilot knows of it.
#[derive(Clone, Debug, PartialEq)]
pub enum Control {
    /// Rudder, stern plane and propeller, with the gains of the scenario.
    Fins,
    /// Rates, within limits.
    Rates(RateLimits),
    /// Several drives.
    Drives(Box<Plant>),
}

/// A vehicle of a folder, as its autopilot knows it.
#[derive(Clone, Debug, PartialEq)]
pub struct Plant {
    /// M_RB + M_A.
    pub mass: Matrix6<f64>,
    /// D, D_q and D_u: the water's force is −D ν − D_q |ν|∘ν − |u| D_u ν.
    pub damping: [Matrix6<f64>; 3],
    /// Weight times the distance of the centre of gravity below that of buoyancy, N m: the moment at 1 rad of roll or
    /// pitch.
    pub righting_n_m: f64,
    /// Weight less buoyancy in the water of the damping, N.
    pub heavy_n: f64,
    /// Volume, m³.
    pub volume_m3: f64,
    /// Directions (surge, sway, heave, roll, pitch, yaw) in which its thrusters push, each without the others.
    pub pushes: [bool; 6],
    /// Its drives, in the order of its file.
    pub drives: Vec<PlantDrive>,
    /// Greatest speed ahead through the water, m/s.
    pub top_speed_m_s: f64,
    /// What steers it.
    pub pilot: PilotSpec,
}

impl Plant {
    /// C(ν)ν of a velocity through the water and an angular velocity.
    pub fn coriolis(&self, v: &Vector3<f64>, w: &Vector3<f64>) -> Vector6<f64> {
        let momentum = self.mass * Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z);
        let l = momentum.fixed_rows::<3>(0).into_owned();
        let h = momentum.fixed_rows::<3>(3).into_owned();
        let (force, moment) = (w.cross(&l), v.cross(&l) + w.cross(&h));
        Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
    }
}

/// A drive, as an autopilot knows it.
#[derive(Clone, Debug, PartialEq)]
pub struct PlantDrive {
    /// Least and greatest set-point.
    pub limits: [f64; 2],
    /// Set-point at which it does nothing.
    pub idle: f64,
    /// What it is.
    pub does: DriveEffect,
}

/// What a drive does.
#[derive(Clone, Debug, PartialEq)]
pub enum DriveEffect {
    /// Pushes: force and moment for each N of thrust, and its curve in still water.
    Pushes(Vector6<f64>, ThrustTable),
    /// Lifts: force and moment at 1 m/s ahead, 1 rad of deflection and a density of 1 kg/m³.
    Lifts(Vector6<f64>),
    /// Changes the volume at a place, m.
    Swells(Vector3<f64>),
    /// Moves a mass, kg, in a direction.
    Shifts(Vector3<f64>, f64),
}

/// Thrust in still water by input: pairs of input and thrust (N), both not falling.
#[derive(Clone, Debug, PartialEq)]
pub struct ThrustTable(pub Vec<(f64, f64)>);

impl ThrustTable {
    /// Least and greatest input.
    pub fn inputs(&self) -> [f64; 2] {
        [self.0[0].0, self.0[self.0.len() - 1].0]
    }

    /// Least and greatest thrust, N.
    pub fn thrusts_n(&self) -> [f64; 2] {
        [self.0[0].1, self.0[self.0.len() - 1].1]
    }

    /// Thrust, N, of an input.
    pub fn thrust_n(&self, input: f64) -> f64 {
        between(&self.0, input, |p| *p)
    }

    /// The input that gives a thrust, N: in a dead band its middle.
    pub fn input(&self, thrust_n: f64) -> f64 {
        let mut same = self.0.iter().filter(|(_, n)| *n == thrust_n);
        if let Some(first) = same.next() {
            let last = same.next_back().unwrap_or(first);
            return (first.0 + last.0) / 2.0;
        }
        between(&self.0, thrust_n, |(i, n)| (*n, *i))
    }
}

/// Straight lines between points; the ends hold beyond them.
fn between(points: &[(f64, f64)], x: f64, as_xy: impl Fn(&(f64, f64)) -> (f64, f64)) -> f64 {
    let above = points.partition_point(|p| as_xy(p).0 < x);
    if above == 0 {
        return as_xy(&points[0]).1;
    }
    let (x_0, y_0) = as_xy(&points[above - 1]);
    let Some((x_1, y_1)) = points.get(above).map(as_xy) else {
        return y_0;
    };
    y_0 + (y_1 - y_0) * (x - x_0) / (x_1 - x_0)
}

/// Set-points of a vehicle's drives, in the order of its file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriveCommand {
    set: [f64; MOST_DRIVES],
    n: usize,
}

impl DriveCommand {
    /// From at most [`MOST_DRIVES`] set-points.
    pub fn new(set_points: &[f64]) -> Self {
        let mut set = [0.0; MOST_DRIVES];
        set[..set_points.len()].copy_from_slice(set_points);
        Self { set, n: set_points.len() }
    }

    /// The set-points.
    pub fn all(&self) -> &[f64] {
        &self.set[..self.n]
    }

    /// The same with another set-point of one drive.
    #[must_use]
    pub fn with(self, place: usize, value: f64) -> Self {
        let mut set = self.set;
        set[place] = value;
        Self { set, ..self }
    }
}

/// A drive that can fail, in the order of its vehicle's set-points.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedDrive {
    /// Its name: the link of a folder's vehicle.
    pub name: String,
    /// Unit in which a scenario gives its set-points.
    pub unit: DriveUnit,
    /// Set-point at which it does nothing.
    pub idle: f64,
}

impl NamedDrive {
    /// Those of a vehicle with a rudder, a stern plane and a propeller.
    pub fn fins() -> Vec<Self> {
        let named = |(name, unit): (&str, DriveUnit)| Self { name: name.to_string(), unit, idle: 0.0 };
        [("rudder", DriveUnit::Fin), ("stern_plane", DriveUnit::Fin), ("propeller", DriveUnit::Rpm)].map(named).to_vec()
    }
}

/// Unit in which a scenario gives the set-points of a drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DriveUnit {
    /// Degrees; the set-point itself is in rad.
    Fin,
    /// Revolutions per minute.
    Rpm,
    /// That of the drive itself: the input of a thruster's curve, m³ of a buoyancy engine, m of a moving mass.
    Own,
}

/// What a vehicle can do, for searchers that can use it. By default those of a REMUS 100, for observations made by hand.
#[derive(Clone, Copy, Debug, SmartDefault, PartialEq)]
pub struct Capabilities {
    /// Least speed through the water at which it can be steered, m/s; 0 for one that hovers.
    #[default(0.8)]
    pub least_speed_m_s: f64,
    /// Greatest speed ahead, m/s.
    #[default(2.5)]
    pub top_speed_m_s: f64,
    /// Radius of its tightest turn, m; 0 for one that turns on the spot.
    #[default(11.5)]
    pub turning_radius_m: f64,
    /// Holds its place, within its speeds.
    pub hovers: bool,
    /// Moves sideways, with its heading held.
    pub sideways: bool,
    /// Chooses its depth; false for a craft on the surface.
    #[default(true)]
    pub dives: bool,
    /// Holds a depth; false for a glider, which goes up and down between two.
    #[default(true)]
    pub holds_depth: bool,
}
