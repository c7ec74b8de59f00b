//! Dead reckoning: integrates compass and Doppler log, jumps at long-baseline fixes, and takes the flow from the
//! current profiler.
//!
//! *Source:* Pang 2009, section 4 (the REMUS dead-reckons on acoustic Doppler data; position updates from the long
//! baseline are its navigation fixes) and section 6 (flow from the profiler).
//!
//! *Parameters:* share of a fix that is taken over, `fix_gain`, 1 (a fix replaces the position, as it jumps in the
//! paper); time constant of the flow's low-pass filter, `flow_filter_s`, 10 s (not published); `layer_aware`, none in
//! the paper: an ADCP cell in another water layer than the vehicle is not used (`layers.rs`).
//!
//! *Deviations:* none known; the vehicle's own filter is not published. Between two readings each quantity is held;
//! the position is integrated by the trapezium rule. Flow = R · (ground velocity + water relative to the vehicle),
//! with R from the believed attitude: a heading error turns the flow, but does not add the vehicle's speed to it.

use super::layers::{LayerAwareSpec, LayerWatch};
use crate::handoff::{Attitude, Estimate, FlowEstimate, Readings};
use bevy_ecs::prelude::Component;
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::clock::Clock;
use world::math;
use world::ranges::{Fraction, NonNegative};
use world::units::Heading;

/// Parameters of dead reckoning.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct DeadReckoningSpec {
    /// Share of the distance to a fix by which the position jumps.
    #[default(Fraction::new(1.0))]
    pub fix_gain: Fraction,
    /// Time constant of the flow's low-pass filter, s.
    #[default(NonNegative::new(10.0))]
    pub flow_filter_s: NonNegative,
    /// Take the flow only from the vehicle's own water layer, which a CTD tells.
    pub layer_aware: Option<LayerAwareSpec>,
}

/// What the vehicle knows of its state at launch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// Position (east, north), m.
    pub position: Vector2<f64>,
    /// Heading.
    pub heading: Heading,
    /// Depth below the still surface, m.
    pub depth_m: f64,
}

/// State of dead reckoning.
#[derive(Component, Clone, Debug)]
pub struct DeadReckoning {
    fix_gain: f64,
    flow_filter_s: f64,
    dt_s: f64,
    position: Vector2<f64>,
    depth_m: f64,
    altitude_m: Option<f64>,
    attitude: Attitude,
    /// The same as a rotation.
    R_WB: UnitQuaternion<f64>,
    /// Newest ground velocity, and whether the log had bottom lock in its last report.
    v_ground_body: Vector3<f64>,
    locked: bool,
    /// Velocity over ground in the step before (east, north), m/s; `None` before the first step.
    v_before: Option<Vector2<f64>>,
    /// Flow (east, north), m/s, and when it was last measured, s.
    flow: Option<(Vector2<f64>, f64)>,
    layers: Option<Box<LayerWatch>>,
}

impl DeadReckoning {
    /// Dead reckoning that begins at `start` and steps by `dt_s`.
    pub fn new(spec: &DeadReckoningSpec, start: Start, dt_s: f64) -> Self {
        let attitude =
            Attitude { heading: start.heading, roll_rad: 0.0, pitch_rad: 0.0, rates_rad_s: Vector3::zeros() };
        Self {
            fix_gain: spec.fix_gain.get(),
            flow_filter_s: spec.flow_filter_s.get(),
            dt_s,
            position: start.position,
            depth_m: start.depth_m,
            altitude_m: None,
            attitude,
            R_WB: attitude.R_WB(),
            v_ground_body: Vector3::zeros(),
            locked: false,
            v_before: None,
            flow: None,
            layers: spec.layer_aware.as_ref().map(|layers| Box::new(LayerWatch::new(layers))),
        }
    }

    /// The estimate at the clock's time, after the readings of this step.
    pub fn step(&mut self, clock: &Clock, readings: &Readings) -> Estimate {
        self.take_in(readings);
        let R_WB = self.R_WB;
        let v_now = (R_WB * self.v_ground_body).xy();
        if let Some(v_before) = self.v_before.replace(v_now) {
            self.position += (v_before + v_now) * (0.5 * self.dt_s);
        }
        if let (Some(layers), Some(ctd)) = (&mut self.layers, readings.ctd) {
            let depth_m = self.depth_m + ctd.below_m;
            layers.take_in(clock.t_s(), depth_m, ctd.density_kg_m3);
            if layers.left_layer() {
                self.flow = None;
            }
        }
        let before = self.position;
        if let Some(fix) = readings.lbl {
            self.position += (fix.position - self.position) * self.fix_gain;
        }
        self.measure_flow(clock.t_s(), readings, &R_WB);
        assert!(
            self.position.iter().all(|v| v.is_finite()),
            "the believed position is not a finite number: a sensor delivered a broken reading in {readings:?}"
        );
        Estimate {
            t_s: clock.t_s(),
            position: self.position,
            depth_m: self.depth_m,
            altitude_m: self.altitude_m,
            attitude: self.attitude,
            v_ground_body: self.v_ground_body,
            flow: self.flow.map(|(velocity, measured_s)| FlowEstimate { velocity, age_s: clock.t_s() - measured_s }),
            fix_jump: self.position - before,
        }
    }

    fn take_in(&mut self, readings: &Readings) {
        if let Some(a) = readings.attitude {
            self.attitude = a;
            self.R_WB = self.attitude.R_WB();
        }
        if let Some(dvl) = readings.dvl {
            self.locked = dvl.valid;
            if dvl.valid {
                self.v_ground_body = dvl.v_body_m_s;
            }
        }
        if let Some(d) = readings.depth {
            self.depth_m = d.depth_m;
        }
        if let Some(a) = readings.altimeter.filter(|a| a.valid) {
            self.altitude_m = Some(a.altitude_m);
        }
    }

    /// Without bottom lock no flow is measured: a held ground velocity would show up as flow.
    fn measure_flow(&mut self, t_s: f64, readings: &Readings, R_WB: &UnitQuaternion<f64>) {
        let Some(adcp) = readings.adcp.filter(|a| a.valid && self.locked) else {
            return;
        };
        let cell_m = self.depth_m - (R_WB * Vector3::new(0.0, 0.0, adcp.above_m)).z;
        if self.layers.as_ref().is_some_and(|l| l.is_other(cell_m)) {
            return;
        }
        let measured = (R_WB * (self.v_ground_body + adcp.v_body_m_s)).xy();
        let filter_s = self.flow_filter_s;
        let believed = match self.flow {
            Some((before, since_s)) if filter_s > 0.0 => {
                let keep = math::exp(-(t_s - since_s) / filter_s);
                measured + (before - measured) * keep
            }
            _ => measured,
        };
        self.flow = Some((believed, t_s));
        self.layers.iter_mut().for_each(|layers| layers.measured());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handoff::{AdcpReading, AltimeterReading, Attitude, DepthReading, DvlReading, LblFix};
    use world::units::Heading;

    fn start() -> Start {
        Start { position: Vector2::new(150.0, -500.0), heading: Heading::from_deg(0.0), depth_m: 3.0 }
    }

    fn attitude(heading: Heading, roll_rad: f64, pitch_rad: f64) -> Attitude {
        Attitude { heading, roll_rad, pitch_rad, rates_rad_s: Vector3::zeros() }
    }

    fn dvl(v: Vector3<f64>) -> DvlReading {
        DvlReading { v_body_m_s: v, valid: true }
    }

    fn adcp(v: Vector3<f64>) -> AdcpReading {
        AdcpReading { v_body_m_s: v, above_m: 1.0, valid: true }
    }

    fn run(spec: &DeadReckoningSpec, steps: u64, dt_s: f64, said: impl Fn(&Clock) -> Readings) -> Vec<Estimate> {
        let mut e = DeadReckoning::new(spec, start(), dt_s);
        let mut clock = Clock::new(dt_s);
        let mut believed = Vec::new();
        for _ in 0..steps {
            believed.push(e.step(&clock, &said(&clock)));
            clock.advance();
        }
        believed
    }

    /// Circles with roll, nose-up pitch, sway and heave, against the integral in closed form.
    #[test]
    fn perfect_readings_reproduce_a_turning_path() {
        let (roll, pitch, turn_rad_s, dt_s) = (0.1, 0.3, 10_f64.to_radians(), 0.02);
        let v_B = Vector3::new(1.8, -0.2, 0.4);
        // Horizontal velocity along and left of the heading: pitch nose up lifts the surge and
        // turns the heave backward.
        let ((sr, cr), (sp, cp)) = (math::sin_cos(roll), math::sin_cos(pitch));
        let left = cr * v_B.y - sr * v_B.z;
        let along = cp * v_B.x - sp * (sr * v_B.y + cr * v_B.z);
        let believed = run(&DeadReckoningSpec::default(), 5000, dt_s, |c| Readings {
            attitude: Some(attitude(Heading::from_rad(turn_rad_s * c.t_s()), roll, pitch)),
            dvl: Some(dvl(v_B)),
            ..Default::default()
        });
        for e in believed {
            // Heading a: velocity = along · (sin a, cos a) + left · (−cos a, sin a).
            let (s, c) = math::sin_cos(turn_rad_s * e.t_s);
            let want = start().position
                + Vector2::new(along * (1.0 - c) - left * s, along * s + left * (1.0 - c)) / turn_rad_s;
            // Trapezium rule on a circle: chords are short by (turn · dt)²/12 of 2 × its radius 10.4 m.
            let bound = (turn_rad_s * dt_s).powi(2) / 12.0 * 25.0;
            assert!((e.position - want).norm() < bound, "{} s", e.t_s);
            assert_eq!(e.fix_jump_m(), 0.0);
        }
    }

    #[test]
    fn velocity_is_held_without_bottom_lock_but_no_flow_is_measured() {
        let lost = DvlReading { v_body_m_s: Vector3::zeros(), valid: false };
        let believed = run(&DeadReckoningSpec::default(), 101, 0.1, |c| Readings {
            dvl: Some(if c.t_s() < 5.0 { dvl(Vector3::new(2.0, 0.0, 0.0)) } else { lost }),
            adcp: Some(adcp(Vector3::new(-2.0, 0.0, 0.0))),
            ..Default::default()
        });
        let end = believed[100];
        assert!((end.position - start().position - Vector2::new(0.0, 20.0)).norm() < 1e-9);
        assert!((end.v_ground() - Vector2::new(0.0, 2.0)).norm() < 1e-12);
        assert!((end.flow.unwrap().age_s - 5.1).abs() < 1e-9);
    }

    #[test]
    fn flow_is_ground_plus_relative_velocity_low_passed() {
        let v_B = Vector3::new(1.9, 0.1, -0.2);
        let (heading, roll, pitch) = (Heading::from_deg(70.0), 0.05, 0.2);
        let R_WB = UnitQuaternion::from_euler_angles(roll, -pitch, heading.yaw());
        let flow_at = |t_s: f64| Vector3::new(0.1, if t_s < 0.5 { 0.0 } else { -0.12 }, 0.0);
        let believed = run(&DeadReckoningSpec::default(), 1001, 0.02, |c| Readings {
            attitude: Some(attitude(heading, roll, pitch)),
            dvl: Some(dvl(v_B)),
            adcp: (c.step.is_multiple_of(50)).then(|| adcp(R_WB.inverse() * flow_at(c.t_s()) - v_B)),
            ..Default::default()
        });
        assert!((believed[0].flow.unwrap().velocity - Vector2::new(0.1, 0.0)).norm() < 1e-12);
        for n in 1..20 {
            // A step of -0.12 m/s seen once a second through 10 s.
            let want = -0.12 * (1.0 - math::exp(-0.1 * n as f64));
            let got = believed[50 * n + 49].flow.unwrap();
            assert!((got.velocity - Vector2::new(0.1, want)).norm() < 1e-12, "{n}: {got:?}");
            assert!((got.age_s - 0.98).abs() < 1e-9);
        }
    }

    #[test]
    fn a_fix_moves_the_position_by_its_gain_and_says_so() {
        let fix = LblFix { position: start().position + Vector2::new(6.0, 8.0) };
        for gain in [1.0, 0.25] {
            let spec = DeadReckoningSpec { fix_gain: Fraction::new(gain), ..Default::default() };
            let e = run(&spec, 3, 0.1, |c| Readings { lbl: (c.step == 1).then_some(fix), ..Default::default() });
            assert!((e[1].fix_jump_m() - 10.0 * gain).abs() < 1e-9);
            assert!((e[1].position - start().position - Vector2::new(6.0, 8.0) * gain).norm() < 1e-9);
            assert_eq!((e[0].fix_jump_m(), e[2].fix_jump_m()), (0.0, 0.0));
        }
    }

    #[test]
    fn depth_and_altitude_are_held_between_pings() {
        let e = run(&DeadReckoningSpec::default(), 3, 0.1, |c| Readings {
            depth: (c.step == 1).then_some(DepthReading { depth_m: 4.5 }),
            altimeter: (c.step >= 1).then_some(AltimeterReading { altitude_m: 2.0, valid: c.step == 1 }),
            ..Default::default()
        });
        assert_eq!(e.iter().map(|e| e.depth_m).collect::<Vec<_>>(), [3.0, 4.5, 4.5]);
        assert_eq!(e.iter().map(|e| e.altitude_m).collect::<Vec<_>>(), [None, Some(2.0), Some(2.0)]);
    }
}
