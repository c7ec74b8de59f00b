//! Shared by the tracker's tests: a machine, records written by hand, a head that follows commands, a plume of puffs.

use super::data::{Sample, Spike};
use crate::handoff::{
    Behaviour, Decision, GantryLayout, GantryObservation, GantryReadings, HeadGoal, JointReadings, MAX_PROBES, Outcome,
    ProbeMount, ProbeScan,
};
use crate::searcher::Strategy;
use nalgebra::{Vector2, Vector3};
use world::math;
use world::seeds::Stream;

/// The paper's machine and head: heights above the bed.
pub(super) fn layout() -> GantryLayout {
    let probe =
        |name: &str, left: f64, up: f64| ProbeMount { name: name.into(), offset_m: Vector3::new(0.0, left, up) };
    GantryLayout {
        travel_m: [[0.0, 2.0], [-0.5, 0.5]],
        max_speed_m_s: [0.15, 0.15],
        probes: vec![probe("left", 0.0625, 0.075), probe("right", -0.0625, 0.075), probe("centre", 0.0, 0.125)],
        range_v: [-5.0, 5.0],
        scan_hz: 20.0,
    }
}

/// A scan of the three probes, V.
pub(super) fn scan(t_s: f64, volts: [f64; 3]) -> ProbeScan {
    let mut all = [f64::NAN; MAX_PROBES];
    all[..3].copy_from_slice(&volts);
    ProbeScan { t_s, volts: all, count: 3 }
}

/// A sample of the three probes, V above clean water, of a head at rest at the origin.
pub(super) fn sample(t_s: f64, above: [f64; 3]) -> Sample {
    let mut above_v = [0.0; MAX_PROBES];
    above_v[..3].copy_from_slice(&above);
    Sample { t_s, head_m: Vector2::zeros(), speed_m_s: Vector2::zeros(), above_v, count: 3 }
}

/// A spike at the origin.
pub(super) fn spike(t_s: f64, probe: usize, magnitude_v: f64) -> Spike {
    Spike { t_s, probe, magnitude_v, place_m: Vector2::zeros() }
}

/// Length of a tick, s.
const DT_S: f64 = 0.01;

/// A head that moves to its target at the commanded speeds.
pub(super) struct Rig {
    strategy: Box<dyn Strategy<HeadGoal>>,
    layout: GantryLayout,
    joints: JointReadings,
    decision: Option<Decision<HeadGoal>>,
    tick: u64,
    rng: Stream,
    noise: Stream,
    /// First decision of each command: time, s, behaviour, target, m, and the head's place, m.
    pub(super) log: Vec<(f64, Behaviour, Vector2<f64>, Vector2<f64>)>,
}

impl Rig {
    pub(super) fn new(strategy: Box<dyn Strategy<HeadGoal>>, start_m: Vector2<f64>, seed: u64) -> Self {
        Self {
            strategy,
            layout: layout(),
            joints: JointReadings { position_m: start_m, ..Default::default() },
            decision: None,
            tick: 0,
            rng: Stream::new(seed, "rig", "strategy"),
            noise: Stream::new(seed, "rig", "noise"),
            log: Vec::new(),
        }
    }

    pub(super) fn head_m(&self) -> Vector2<f64> {
        self.joints.position_m
    }

    pub(super) fn stopped(&self) -> Option<bool> {
        let outcome = self.decision.as_ref().and_then(|d| d.outcome);
        outcome.map(|o| o == Outcome::Completed)
    }

    /// When and where the first sweep had ended.
    pub(super) fn swept(&self) -> Option<(f64, Vector2<f64>)> {
        let first = self.log.iter().find(|l| l.1 == Behaviour::ToBest)?;
        Some((first.0, first.3))
    }

    /// Runs until the searcher stops, at most `seconds`; `above_v(t, tip)` is a probe's noiseless signal, V above the
    /// bottom.
    pub(super) fn run(&mut self, seconds: f64, mut above_v: impl FnMut(f64, Vector3<f64>) -> f64) {
        let end = self.tick + (seconds / DT_S).round() as u64;
        while self.tick < end && self.stopped().is_none() {
            self.tick(&mut above_v);
        }
    }

    fn tick(&mut self, above_v: &mut impl FnMut(f64, Vector3<f64>) -> f64) {
        let t_s = self.tick as f64 * DT_S;
        let scanned = self.tick.is_multiple_of(5).then(|| {
            let head = self.joints.position_m.push(0.0);
            let mut volts = [f64::NAN; MAX_PROBES];
            for (v, p) in volts.iter_mut().zip(&self.layout.probes) {
                let clean = above_v(t_s, head + p.offset_m) + 0.004 * self.noise.normal();
                *v = (clean.clamp(0.0, 10.0) * 409.5).round() / 409.5 - 5.0;
            }
            ProbeScan { t_s, volts, count: self.layout.probes.len() }
        });
        let seen =
            GantryObservation { t_s, readings: GantryReadings { scan: scanned, joints: self.joints }, told: None };
        let d = self.strategy.step(&seen, &mut self.rng);
        let travel = self.layout.travel_m;
        let HeadGoal { id, target_m, speed_m_s } = d.goal;
        for (v, [least, greatest]) in target_m.iter().zip(travel) {
            assert!((least..=greatest).contains(v), "target {target_m:?}");
        }
        assert!(speed_m_s.iter().all(|v| *v > 0.0 && *v <= 0.15));
        let w = &self.strategy.shown();
        let numbers = [w.spike_hz, w.magnitude_v, w.contrast, w.predicted_v.unwrap_or(0.0)];
        assert!(numbers.iter().chain(&w.threshold_v).all(|v| v.is_finite()));
        assert!(w.contrast.abs() <= 1.0 && w.magnitude_v >= 0.0);
        if self.decision.as_ref().is_none_or(|before| before.goal.id != id) {
            let at = self.joints.position_m;
            self.log.push((t_s, d.behaviour, target_m, at));
        }
        let before = self.joints.position_m;
        let mut to = before;
        for i in 0..2 {
            let most = speed_m_s[i] * DT_S;
            to[i] += (target_m[i] - to[i]).clamp(-most, most);
        }
        self.joints = JointReadings {
            position_m: to,
            speed_m_s: (to - before) / DT_S,
            arrived: (target_m - to).norm() < 1e-6,
            blocked: false,
        };
        self.decision = Some(d);
        self.tick += 1;
    }
}

/// Speed of the water, m/s; puffs per second; source (forward, left, up), m.
const DRIFT_M_S: f64 = 0.05;
const PUFFS_HZ: f64 = 12.0;
pub(super) const SOURCE_M: Vector3<f64> = Vector3::new(1.34, 0.03, 0.038);

/// A plume of puffs that drift down-stream, meander together and apart, and grow.
///
/// Spread by the eddy diffusivities of an open channel of 20 cm at 5 cm/s, 8.3e-5 m²/s across and 3.7e-5 up; half of
/// the variance is shared by neighbours (e-fold in a second); the release is that of a 4.2 mm nozzle, a puff for each
/// 4.2 mm of water.
pub(super) struct Puffs {
    /// Of each puff: normal numbers along, across, up.
    wander: Vec<Vector3<f64>>,
    /// Release of the first, s.
    first_s: f64,
}

impl Puffs {
    pub(super) fn new(seed: u64, seconds: f64) -> Self {
        let mut rng = Stream::new(seed, "puffs", "wander");
        let first_s = -60.0;
        let n = ((seconds - first_s) * PUFFS_HZ) as usize;
        let keep = math::exp(-1.0 / PUFFS_HZ);
        let fresh = (1.0 - keep * keep).sqrt();
        let mut normal = || Vector3::new(rng.normal(), rng.normal(), rng.normal());
        let mut shared = normal();
        let wander = (0..n).map(|_| {
            shared = shared * keep + normal() * fresh;
            (shared + normal()) * 0.5f64.sqrt()
        });
        Self { wander: wander.collect(), first_s }
    }

    /// A probe's signal at a place, V above clean water: 10 V for a tenth of the source's concentration.
    pub(super) fn above_v(&self, t_s: f64, p: Vector3<f64>) -> f64 {
        const NOZZLE_M2: f64 = 1.385e-5;
        let about_s = (SOURCE_M.x - p.x) / DRIFT_M_S;
        let index = |age: f64| ((t_s - age - self.first_s) * PUFFS_HZ).clamp(0.0, 1e9) as usize;
        let end = index((about_s - 3.0).max(0.0)).min(self.wander.len());
        let begin = index(about_s + 3.0).min(end);
        let mut c = 0.0;
        for i in begin..end {
            let age = t_s - (self.first_s + i as f64 / PUFFS_HZ);
            if age <= 0.0 {
                continue;
            }
            let spread = |k: f64| (2.0 * k * age).sqrt();
            let w = self.wander[i];
            let mut at = SOURCE_M + Vector3::new(-DRIFT_M_S * age, 0.0, 0.0);
            at += Vector3::new(spread(1e-5) * w.x, spread(8.3e-5) * w.y, spread(3.7e-5) * w.z);
            at.z = at.z.abs();
            let s2 = 4e-6 + 2.0 * 3e-6 * age;
            let r2 = (p - at).norm_squared();
            if r2 < 16.0 * s2 {
                let volume = math::powf(std::f64::consts::TAU * s2, 1.5);
                let released = NOZZLE_M2 * DRIFT_M_S / PUFFS_HZ;
                c += released / volume * math::exp(-r2 / (2.0 * s2));
            }
        }
        100.0 * c
    }
}
