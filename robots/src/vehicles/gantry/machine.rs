//! A gantry: its frame and drives, what its controller knows, and what it reports.
//!
//! *Source:* Webster, Volyanskyy & Weissburg 2012, section 3, Figs. 5 and 6.
//!
//! *Parameters:* travel 2 m along and 1 m across the stream, 0.15 m/s (URDF); drives: [`CrabGantrySpec`].
//!
//! *Deviations:* a drive that gives up stops both axes until the next command, as a controller of coordinated axes
//! does. A target outside the travel is moved to its end.

use super::super::files::Files;
use super::super::urdf_parts::UrdfText;
use super::drive::Drive;
use super::frame::{self, Frame};
use super::spec::{CrabGantrySpec, GantrySpec};
use crate::error::{RobotError, require};
use crate::handoff::{Decision, GantryLayout, HeadGoal, JointReadings};
use bevy_ecs::prelude::Component;
use nalgebra::{Vector2, Vector3};
use world::frames::Pose;
use world::physics::{AxisDrive, AxisSpec, GantryBodySpec, JointState};
use world::ranges::Positive;
use world::seeds::Stream;

/// Name and text of the built-in URDF.
pub const CRAB_GANTRY: (&str, &str) = ("crab_gantry.urdf", include_str!("../../../urdf/crab_gantry.urdf"));
/// Greatest product of position gain and step: beyond it the loop begins to oscillate.
const MAX_GAIN_STEP: f64 = 0.5;

/// A gantry and the state of its drives; the joints belong to the physics.
#[derive(Component, Clone, Debug)]
pub struct Gantry {
    spec: CrabGantrySpec,
    frame: Frame,
    drives: [Drive; 2],
    homed: bool,
    latest: Option<u32>,
    blocked: bool,
    halted: bool,
}

impl Gantry {
    /// Builds the gantry that a scenario asks for; `files` gives the URDF and its meshes, if it names one.
    ///
    /// # Errors
    /// If the URDF cannot be read or lacks something, or if a drive cannot do what is asked of it.
    pub fn load(spec: &GantrySpec, files: &dyn Files) -> Result<Self, RobotError> {
        let GantrySpec::CrabGantry(spec) = spec;
        let mut frame = frame::read(&UrdfText::open(spec.urdf.as_deref(), files, CRAB_GANTRY)?)?;
        frame.change_probes(&spec.without, spec.span_m.map(Positive::get))?;
        require(
            spec.settle_m.get() >= spec.encoder_m.get(),
            "settle_m",
            format!(
                "must be at least encoder_m, {} m, got {}: the encoder cannot resolve less",
                spec.encoder_m.get(),
                spec.settle_m.get()
            ),
        )?;
        let [first, second] = &frame.slides;
        for (slide, mass_kg) in [(first, first.mass_kg + second.mass_kg), (second, second.mass_kg)] {
            let (a, effort_N) = (spec.acceleration_m_s2.get(), slide.limits.effort_N);
            require(
                a * mass_kg <= effort_N,
                "acceleration_m_s2",
                format!(
                    "must be at most {} m/s2, got {a}: joint \"{}\" has {effort_N} N for {mass_kg} kg",
                    effort_N / mass_kg,
                    slide.joint
                ),
            )?;
        }
        let drives = [Drive::new(first.limits), Drive::new(second.limits)];
        Ok(Self { spec: spec.clone(), frame, drives, homed: false, latest: None, blocked: false, halted: false })
    }

    /// Checks that the drives' loops can run at a step.
    ///
    /// # Errors
    /// If the position gain is too great for it.
    pub fn check_step(&self, dt_s: f64) -> Result<(), RobotError> {
        let most = MAX_GAIN_STEP / dt_s;
        let gain = self.spec.position_gain_per_s.get();
        let problem = format!("must be at most {most} 1/s at a step of {dt_s} s, got {gain}");
        require(gain <= most, "position_gain_per_s", problem)
    }

    /// The body for the physics, with its base at `base` (x up-stream, y to the left, z = 0 on the bed) and the head
    /// at `start_m` (forward, left).
    ///
    /// # Errors
    /// If the start lies outside the travel.
    pub fn body_spec(&self, id: &str, base: &Pose, start_m: Vector2<f64>) -> Result<GantryBodySpec, RobotError> {
        let travel_m = self.travel_m();
        for (k, [low, high]) in travel_m.into_iter().enumerate() {
            require(
                (low..=high).contains(&start_m[k]),
                format!("start.{}", ["forward_m", "left_m"][k]),
                format!("must be from {low} to {high} m, got {}", start_m[k]),
            )?;
        }
        let axis = |k: usize| {
            let slide = &self.frame.slides[k];
            let mut along_B = Vector3::zeros();
            along_B[slide.axis] = slide.sign;
            AxisSpec { along_B, travel_m: slide.limits.travel_m, mass_kg: slide.mass_kg, shapes: slide.shapes.clone() }
        };
        Ok(GantryBodySpec {
            id: id.into(),
            base: *base,
            base_shapes: self.frame.base_shapes.clone(),
            axes: [axis(0), axis(1)],
            start_m: self.joint_of(start_m),
        })
    }

    /// What a searcher may know of this machine.
    pub fn layout(&self, scan_hz: f64, range_v: [f64; 2]) -> GantryLayout {
        let mut max_speed_m_s = [0.0; 2];
        for slide in &self.frame.slides {
            max_speed_m_s[slide.axis] = slide.limits.speed_m_s;
        }
        GantryLayout { travel_m: self.travel_m(), max_speed_m_s, probes: self.frame.probes.clone(), range_v, scan_hz }
    }

    /// Names of the joints, in the order of the joint states.
    pub fn joint_names(&self) -> [&str; 2] {
        self.frame.slides.each_ref().map(|s| s.joint.as_str())
    }

    /// The drives' commands for the next step. A decision with a new number begins a move; number 0 is none.
    ///
    /// # Panics
    /// If a target or speed is not finite or a speed is negative.
    pub fn drive(
        &mut self,
        decision: &Decision<HeadGoal>,
        joints: &[JointState; 2],
        dt_s: f64,
        rng: &mut Stream,
    ) -> [AxisDrive; 2] {
        let spec = &self.spec;
        if !self.homed {
            self.homed = true;
            for (drive, joint) in self.drives.iter_mut().zip(joints) {
                drive.home(joint, spec);
            }
        }
        let HeadGoal { id, target_m: target, speed_m_s: speed } = decision.goal;
        assert!(
            target.iter().all(|v| v.is_finite()) && speed.iter().all(|v| v.is_finite() && *v >= 0.0),
            "a gantry cannot go to {target:?} m at {speed:?} m/s: its searcher must give finite places and speeds >= 0"
        );
        if decision.outcome.is_some() {
            if !self.halted {
                self.halted = true;
                self.drives.iter_mut().for_each(|d| d.halt(spec));
            }
        } else if id != 0 && self.latest != Some(id) {
            self.latest = Some(id);
            self.blocked = false;
            for (drive, slide) in self.drives.iter_mut().zip(&self.frame.slides) {
                let joint_m = target[slide.axis] * slide.sign;
                drive.go(joint_m, speed[slide.axis], spec, rng);
            }
        }
        if !self.blocked {
            let [a, b] = [0, 1].map(|k| self.drives[k].step(&joints[k], spec, dt_s));
            if let (Some(a), Some(b)) = (a, b) {
                return [a, b];
            }
            self.blocked = true;
            for (drive, joint) in self.drives.iter_mut().zip(joints) {
                drive.give_up(joint);
            }
        }
        self.drives.each_ref().map(|d| d.hold(spec))
    }

    /// What encoders and drives report.
    pub fn readings(&self, joints: &[JointState; 2]) -> JointReadings {
        let mut readings = JointReadings { arrived: !self.blocked, blocked: self.blocked, ..JointReadings::default() };
        for (k, slide) in self.frame.slides.iter().enumerate() {
            let (drive, joint) = (&self.drives[k], &joints[k]);
            readings.position_m[slide.axis] = slide.sign * drive.encoder(joint, &self.spec);
            readings.speed_m_s[slide.axis] = slide.sign * drive.encoder_speed(joint, &self.spec);
            readings.arrived &= drive.arrived(joint, &self.spec);
        }
        readings
    }

    /// True place of the head in the gantry's frame (forward, left), m.
    pub fn head_m(&self, joints: &[JointState; 2]) -> Vector2<f64> {
        let mut at = Vector2::zeros();
        for (slide, joint) in self.frame.slides.iter().zip(joints) {
            at[slide.axis] = slide.sign * joint.position_m;
        }
        at
    }

    /// True place of the head's reference point in the world, m.
    pub fn head_W(&self, base: &Pose, joints: &[JointState; 2]) -> Vector3<f64> {
        base.point(self.frame.head_B + self.head_m(joints).push(0.0))
    }

    /// True places of the probes' tips in the world, in the order of the layout, m.
    pub fn tips_W(&self, base: &Pose, joints: &[JointState; 2]) -> impl Iterator<Item = Vector3<f64>> {
        let head_B = self.frame.head_B + self.head_m(joints).push(0.0);
        self.frame.probes.iter().map(move |p| base.point(head_B + p.offset_m))
    }

    /// Travel (forward, left), m.
    fn travel_m(&self) -> [[f64; 2]; 2] {
        let mut travel_m = [[0.0; 2]; 2];
        for slide in &self.frame.slides {
            let [low, high] = slide.limits.travel_m;
            travel_m[slide.axis] = if slide.sign > 0.0 { [low, high] } else { [-high, -low] };
        }
        travel_m
    }

    fn joint_of(&self, place_m: Vector2<f64>) -> [f64; 2] {
        self.frame.slides.each_ref().map(|s| s.sign * place_m[s.axis])
    }
}
