//! What the vehicle believes. It is a type of its own so that nobody can confuse it with the truth.

use super::{AdcpReading, CtdReading, DvlReading};
use super::{Attitude, Belief, Capabilities, ChemicalReading, GuidanceStatus, RangeScan};
use super::{Picture, ReplyOutcome, SidescanPing};
use bevy_ecs::prelude::Component;
use nalgebra::{Vector2, Vector3};
use world::area::Area;
use world::units::Heading;

/// Believed flow at the vehicle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlowEstimate {
    /// Velocity over ground (east, north), m/s: where the water goes.
    pub velocity: Vector2<f64>,
    /// Age of the newest measurement in it, s.
    pub age_s: f64,
}

impl FlowEstimate {
    /// Where the water goes.
    pub fn heading(&self) -> Heading {
        Heading::from_vector(self.velocity)
    }

    /// Where the water comes from.
    pub fn up_flow(&self) -> Heading {
        self.heading().opposite()
    }
}

/// Believed state of vehicle and water.
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Time it holds for, s.
    pub t_s: f64,
    /// Horizontal position (east, north), m.
    pub position: Vector2<f64>,
    /// Depth below the still surface, m.
    pub depth_m: f64,
    /// Height above the bed, m; `None` until the altimeter has heard the bed.
    pub altitude_m: Option<f64>,
    /// Attitude and rates.
    pub attitude: Attitude,
    /// Velocity over ground in body axes (FLU), m/s.
    pub v_ground_body: Vector3<f64>,
    /// Flow at the vehicle; `None` until it has been measured.
    pub flow: Option<FlowEstimate>,
    /// How far a position fix moved the estimate (east, north), m, in the tick of the fix; otherwise zero.
    pub fix_jump: Vector2<f64>,
}

impl Estimate {
    /// Believed place of the origin of the body frame (ENU), m.
    pub fn p_WB(&self) -> Vector3<f64> {
        Vector3::new(self.position.x, self.position.y, -self.depth_m)
    }

    /// Length of the jump, m.
    pub fn fix_jump_m(&self) -> f64 {
        self.fix_jump.norm()
    }

    /// Believed velocity over ground (east, north), m/s.
    pub fn v_ground(&self) -> Vector2<f64> {
        let forward = self.attitude.heading.unit();
        let left = self.attitude.heading.turned(-std::f64::consts::FRAC_PI_2).unit();
        forward * self.v_ground_body.x + left * self.v_ground_body.y
    }
}

/// What a strategy sees in a tick.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// Time, s.
    pub t_s: f64,
    /// Believed state.
    pub estimate: Estimate,
    /// Chemical reading, if the sensor reported in this tick.
    pub chemical: Option<ChemicalReading>,
    /// Readings of the pair of chemical sensors aside (left, right), if it reported in this tick.
    pub sides: Option<[ChemicalReading; 2]>,
    /// The guidance's progress towards the last goal.
    pub guidance: GuidanceStatus,
    /// The operating area; the mission knows it beforehand.
    pub area: Area,
    /// Where the vehicle was launched (its own first position); Go-Home leads there.
    pub home: Vector2<f64>,
    /// What the vehicle can do.
    pub able: Capabilities,
    /// Belief about the source's place, if the robot keeps a map of it.
    pub belief: Option<Belief>,
    /// Bottom track, as the Doppler log reported it in this tick.
    pub dvl: Option<DvlReading>,
    /// Water track, as the current profiler reported it in this tick.
    pub adcp: Option<AdcpReading>,
    /// Density, as the CTD reported it in this tick.
    pub ctd: Option<CtdReading>,
    /// Forward ranging, if the sensor reported in this tick.
    pub ranging: Option<RangeScan>,
    /// Sidescan sonar, if it reported in this tick.
    pub sidescan: Option<SidescanPing>,
    /// Camera, if it gave a picture in this tick.
    pub picture: Option<Picture>,
    /// Numbers of other instruments in this tick, by name.
    pub other: Vec<(&'static str, f64)>,
    /// What a searcher outside this program was heard to say in this tick, if it was asked.
    pub told: Option<ReplyOutcome>,
}

/// Whether the chemical sensor reported a detection in this tick.
pub fn detects(seen: &Observation) -> bool {
    seen.chemical.is_some_and(|c| c.detected)
}
