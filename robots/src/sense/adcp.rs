//! Acoustic Doppler current profiler: velocity of the water relative to the vehicle, in the first cell beyond the
//! dead zone.
//!
//! *Source:* Pang 2009, section 6 (up- and down-looking ADCP on the REMUS, dead zone about 0.75 m, so that it may
//! measure another layer than the one that the vehicle is in); triangular weight of a depth cell and the side-lobe
//! limit: RD Instruments, ADCP Principles of Operation: A Practical Primer (1996).
//!
//! *Parameters:* `look` Up; rate `rate_hz` 1 Hz; dead zone `dead_zone_m` 0.75 m; cell `cell_m` 0.5 m; noise per axis
//! `noise_m_s` 0.02 m/s (typical of an ensemble of some pings in cells of half a metre at 1200 kHz); beams
//! `beam_angle_deg` 20° from the axis.
//!
//! *Deviations:* one cell; the spread of the four beams is not modelled, and the cell is sampled on the axis at three
//! heights. As for the Doppler log, the velocity is relative to the body's origin.

use super::on_board::{OnBoard, Sampler};
use super::sensor::{Fitting, Sensor, SensorParams, Surroundings};
use super::tools::EchoTarget;
use crate::error::{RobotError, require};
use crate::handoff::{AdcpReading, Readings};
use nalgebra::Vector3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::clock::Clock;
use world::fields::Flow;
use world::frames::Truth;
use world::math;
use world::ranges::{Finite, NonNegative, Positive};
use world::registry::Listed;

/// Direction in which the instrument looks along the body's z axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Look {
    /// To the surface.
    #[default]
    Up,
    /// To the bed.
    Down,
}

/// Parameters of the current profiler.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct AdcpSpec {
    /// Direction in which it looks.
    #[default(Look::Up)]
    pub look: Look,
    /// Readings per second, Hz.
    #[default(Positive::new(1.0))]
    pub rate_hz: Positive,
    /// Range without measurement, m.
    #[default(NonNegative::new(0.75))]
    pub dead_zone_m: NonNegative,
    /// Length of the cell beyond it, m.
    #[default(Positive::new(0.5))]
    pub cell_m: Positive,
    /// Standard deviation of the noise on each axis, m/s.
    #[serde(with = "world::limits::stream_m_s")]
    #[default(NonNegative::new(0.02))]
    pub noise_m_s: NonNegative,
    /// Angle between the beams and the axis, degrees, below 60.
    #[default(Finite::new(20.0))]
    pub beam_angle_deg: Finite,
}

impl Listed for AdcpSpec {
    const ENTRY: Entry = Entry {
        name: "adcp",
        what: "Water relative to the vehicle in the first cell beyond the dead zone, looking up or down.",
        source: "Pang 2009, section 6; RD Instruments, ADCP Principles of Operation (1996)",
    };
}

impl SensorParams for AdcpSpec {
    fn build(&self, on: &Fitting) -> Result<Box<dyn Sensor>, RobotError> {
        Ok(Box::new(Adcp::new(self, on.place("adcp")?, &on.robot)?))
    }
}

impl Sensor for Adcp {
    fn sense(&mut self, around: &Surroundings, readings: &mut Readings) {
        readings.adcp = self.read(around.clock, around.truth, around.flow, &around.below());
    }
}

/// A current profiler on a vehicle.
#[derive(Clone, Debug)]
pub struct Adcp {
    spec: AdcpSpec,
    at: Sampler,
    /// Axis in the body: up or down.
    axis_B: Vector3<f64>,
    /// Share of the distance to a boundary that the boundary's side-lobe echo leaves usable.
    usable: f64,
}

impl Adcp {
    /// A current profiler at `p_BS` (body axes, m) of the robot `on`.
    ///
    /// # Errors
    /// If the rate does not fit the step, or if the beam angle is out of range.
    pub fn new(spec: &AdcpSpec, p_BS: Vector3<f64>, on: &OnBoard) -> Result<Self, RobotError> {
        let angle = spec.beam_angle_deg.get();
        require(
            (0.0..60.0).contains(&angle),
            "sensors.adcp.beam_angle_deg",
            format!("must be from 0 to below 60 degrees, got {angle}"),
        )?;
        Ok(Self {
            at: Sampler::new("adcp", spec.rate_hz, p_BS, on)?,
            spec: spec.clone(),
            axis_B: match spec.look {
                Look::Up => Vector3::z(),
                Look::Down => -Vector3::z(),
            },
            usable: math::cos(angle.to_radians()),
        })
    }

    /// The reading of this step, if one is due.
    pub fn read(&mut self, clock: &Clock, truth: &Truth, flow: &dyn Flow, below: &EchoTarget) -> Option<AdcpReading> {
        if !self.at.due(clock) {
            return None;
        }
        // Drawn also if the cell is invalid, so that a lost cell does not change later numbers.
        let noise = super::tools::normal3(&mut self.at.rng, self.spec.noise_m_s.get());
        let p = self.at.place(truth);
        let axis = truth.pose.R_WB * self.axis_B;
        let (dead_zone_m, cell_m) = (self.spec.dead_zone_m.get(), self.spec.cell_m.get());
        let middle_m = dead_zone_m + cell_m / 2.0;
        let end_m = dead_zone_m + cell_m;
        let valid = water_along(below, &p, &axis).is_some_and(|way| end_m <= way * self.usable);
        let v_body_m_s = if valid {
            // The cell weighs ranges by a triangle that extends one cell length to either side of its middle: 1 : 2 :
            // 1 at the half cells has the same mean and nearly the same spread.
            let water: Vector3<f64> = [(-0.5, 0.25), (0.0, 0.5), (0.5, 0.25)]
                .map(|(cells, weight)| {
                    let at = p + axis * (middle_m + cells * cell_m);
                    flow.velocity(&at, clock.t_s()) * weight
                })
                .iter()
                .sum();
            assert!(
                water.iter().all(|v| v.is_finite()),
                "the flow at {p:?} is not a finite number: the water model or the vehicle's position broke before the \
                ADCP"
            );
            truth.pose.R_WB.inverse() * water - truth.v_WB_B + noise
        } else {
            Vector3::zeros()
        };
        Some(AdcpReading { v_body_m_s, above_m: self.at.p_BS.z + self.axis_B.z * middle_m, valid })
    }
}

/// Distance through the water along a beam axis to the surface or the bed, m; `None` out of the water or if the
/// vehicle lies on its side.
fn water_along(below: &EchoTarget, p: &Vector3<f64>, axis: &Vector3<f64>) -> Option<f64> {
    const LEAST_COS: f64 = 0.5;
    if p.z >= 0.0 {
        None
    } else if axis.z >= LEAST_COS {
        Some(-p.z / axis.z)
    } else {
        super::tools::range_down(below, p, axis)
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{BED, LOWER, TwoLayers, UPPER, assert_normal, at, bare, nose_up, run};
    use super::*;

    fn spec(look: Look, noise_m_s: f64) -> AdcpSpec {
        AdcpSpec { look, noise_m_s: NonNegative::new(noise_m_s), ..Default::default() }
    }

    fn read(truth: Truth, look: Look) -> AdcpReading {
        let mut a = Adcp::new(&spec(look, 0.0), Vector3::zeros(), &OnBoard::new("auv0", 1, 0.02)).unwrap();
        run(1, 0.02, |c| a.read(c, &truth, &TwoLayers, &bare(&BED)))[0]
    }

    /// Velocity of the water as the instrument finds it: relative velocity plus own velocity, in world axes.
    fn water(truth: Truth, look: Look) -> Vector3<f64> {
        let r = read(truth, look);
        assert!(r.valid, "{truth:?}");
        truth.pose.R_WB * (r.v_body_m_s + truth.v_WB_B)
    }

    fn sailing(z: f64) -> Truth {
        let mut t = at(3.0, 4.0, z);
        t.v_WB_B = Vector3::new(1.8, 0.2, -0.1);
        t
    }

    #[test]
    fn looking_up_it_reads_the_layer_beyond_its_dead_zone() {
        // The cell spans 0.75 to 1.25 m above: it is wholly above the interface at depths of up to 3.75 m.
        assert!((water(sailing(-3.6), Look::Up) - UPPER).norm() < 1e-12);
        assert!((water(sailing(-4.5), Look::Up) - LOWER).norm() < 1e-12);
        assert!((water(sailing(-3.6), Look::Down) - LOWER).norm() < 1e-12);
        // With the interface in its middle, it gives a value in between.
        let mixed = water(sailing(-3.99), Look::Up).y;
        assert!(mixed > LOWER.y && mixed < UPPER.y, "{mixed}");
    }

    #[test]
    fn the_cell_stands_where_it_says() {
        assert!((read(sailing(-4.0), Look::Up).above_m - 1.0).abs() < 1e-12);
        assert!((read(sailing(-4.0), Look::Down).above_m + 1.0).abs() < 1e-12);
        // Pitched by 45 degrees the cell is lower, 0.71 m above, and below the interface.
        assert!((water(nose_up(sailing(-4.0), 45.0), Look::Up) - LOWER).norm() < 1e-9);
    }

    #[test]
    fn cells_that_reach_surface_or_bed_are_invalid() {
        // Side lobes leave cos 20° of the distance: 1.25 m need 1.33 m.
        let valid = |z, look| read(sailing(z), look).valid;
        assert!(valid(-1.34, Look::Up) && !valid(-1.32, Look::Up));
        assert!(valid(-6.66, Look::Down) && !valid(-6.68, Look::Down));
        assert!(!valid(0.1, Look::Up) && !valid(0.1, Look::Down));
        assert!(!read(nose_up(sailing(-4.0), 80.0), Look::Up).valid);
        let r = read(sailing(-1.0), Look::Up);
        assert_eq!(r.v_body_m_s, Vector3::zeros());
    }

    #[test]
    fn reads_once_a_second_with_its_noise() {
        let mut a = Adcp::new(&spec(Look::Up, 0.02), Vector3::zeros(), &OnBoard::new("auv0", 1, 0.02)).unwrap();
        let t = sailing(-5.0);
        let v = run(100_000, 0.02, |c| a.read(c, &t, &TwoLayers, &bare(&BED)));
        assert_eq!(v.len(), 2000);
        let want = t.pose.R_WB.inverse() * LOWER - t.v_WB_B;
        for axis in 0..3 {
            let got: Vec<f64> = v.iter().map(|r| r.v_body_m_s[axis]).collect();
            assert_normal(&got, want[axis], 0.02);
        }
    }
}
