//! Shared by the mappers' tests: the paper's area, all mappers, eq. 1 and 2 written out, and a small plume.

use super::bayesian::BayesianSpec;
use super::catalogue::MapSpec;
use super::hmm::HmmSpec;
use super::kernel::flow_history::FlowHistory;
use super::mapper::Mapper;
use super::particle_filter::ParticleFilterSpec;
use super::pomdp::PomdpSpec;
use super::spec::TrajectorySpec;
use super::watch::MapObservation;
use super::workings::CellsSpec;
use crate::handoff::BeliefGrid;
use nalgebra::{Vector2, Vector3};
use world::area::Area;
use world::math;
use world::seeds::Stream;
use world::units::Heading;

/// 100 × 100 m with its corner at the origin, axis to the east.
pub(crate) fn paper_area() -> Area {
    Area { centre: Vector2::new(50.0, 50.0), length_m: 100.0, width_m: 100.0, axis: Heading::from_deg(90.0) }
}

/// The paper's grid with cells as given.
pub(crate) fn grid(n: [usize; 3]) -> BeliefGrid {
    BeliefGrid::over(&paper_area(), 0.0, 10.0, n)
}

/// All mappers with these parameters, the particle filter with so many particles.
pub(crate) fn every(spec: &CellsSpec, particles: u32) -> [MapSpec; 4] {
    let (grid, trajectory, doubt) = (spec.grid.clone(), spec.trajectory.clone(), spec.doubt.clone());
    let hmm =
        HmmSpec { grid: grid.clone(), trajectory: trajectory.clone(), doubt: doubt.clone(), ..HmmSpec::default() };
    [
        MapSpec::new(PomdpSpec(spec.clone())),
        MapSpec::new(BayesianSpec(spec.clone())),
        MapSpec::new(hmm),
        MapSpec::new(ParticleFilterSpec { grid, trajectory, doubt, particles, ..ParticleFilterSpec::default() }),
    ]
}

pub(crate) fn build(spec: &MapSpec) -> Box<dyn Mapper> {
    spec.build(&paper_area(), Stream::new(3, "auv0", "map")).expect("legal")
}

/// A history of a flow given as a function of time, in steps of 0.5 s.
pub(crate) fn history(spec: &TrajectorySpec, upto_s: f64, flow: impl Fn(f64) -> [f64; 2]) -> FlowHistory {
    let mut h = spec.history(spec.release_period_s.get());
    let steps = (upto_s / 0.5).round() as u32;
    for n in 0..=steps {
        let t = f64::from(n) * 0.5;
        h.record(t, Some(flow(t)));
    }
    h
}

/// p of eq. 1, at most 1, for each release and each cell, as the paper writes it; plane maps.
pub(crate) fn p_by_hand(grid: &BeliefGrid, spec: &TrajectorySpec, history: &FlowHistory, at: usize) -> Vec<Vec<f64>> {
    let [sx, sy, _] = spec.sigmas();
    let place = |i: usize| grid.local_centre(i);
    let c_j = place(at);
    let one = |age: f64, s: [f64; 2], i: usize| {
        let c_i = place(i);
        let (dx, dy) = (c_j[0] - c_i[0] - s[0], c_j[1] - c_i[1] - s[1]);
        let peak = grid.cell_m[0] * grid.cell_m[1] / (std::f64::consts::TAU * age * sx * sy);
        let p = peak * math::exp(-dx * dx / (2.0 * age * sx * sx)) * math::exp(-dy * dy / (2.0 * age * sy * sy));
        p.min(1.0)
    };
    history.releases().map(|(age, s)| (0..grid.len()).map(|i| one(age, s, i)).collect()).collect()
}

/// Puffs from a point in a uniform flow with noise, and a vehicle that criss-crosses the plume.
pub(crate) struct ToyPlume {
    /// Source, m.
    pub source: Vector2<f64>,
    /// Flow at a time, m/s.
    pub flow: fn(f64) -> Vector2<f64>,
    puffs: Vec<Vector2<f64>>,
    rng: Stream,
}

impl ToyPlume {
    /// A plume that has developed for two minutes.
    pub(crate) fn new(source: Vector2<f64>, flow: fn(f64) -> Vector2<f64>, seed: u64) -> Self {
        let mut new = Self { source, flow, puffs: Vec::new(), rng: Stream::new(seed, "toy", "plume") };
        for n in 0..120 {
            new.drift(f64::from(n) - 120.0);
        }
        new
    }

    /// The plume from (20, 40) in a slow flow.
    pub(crate) fn slow() -> Self {
        Self::new([20.0, 40.0].into(), |_| [0.6, 0.05].into(), 4)
    }

    /// One second: one puff more; all puffs move with the flow and spread by 0.5 m/√s.
    pub(crate) fn drift(&mut self, t_s: f64) {
        self.puffs.push(self.source);
        let u = (self.flow)(t_s);
        for p in &mut self.puffs {
            *p += u + Vector2::new(self.rng.normal(), self.rng.normal()) * 0.5;
        }
        self.puffs.retain(|p| p.norm() < 300.0);
    }

    /// Whether a puff is in the same cell of 2.5 × 4 m as the vehicle, and is noticed.
    pub(crate) fn smell(&mut self, p: Vector2<f64>) -> bool {
        let same =
            |q: &Vector2<f64>| (q.x / 2.5).floor() == (p.x / 2.5).floor() && (q.y / 4.0).floor() == (p.y / 4.0).floor();
        let near = self.puffs.iter().filter(|q| same(q)).count();
        (0..near).any(|_| self.rng.uniform() < 0.9)
    }

    /// The observation after `t_s` seconds of a zig-zag that goes up the area and back.
    pub(crate) fn seen(&mut self, t_s: f64) -> MapObservation {
        self.drift(t_s);
        let triangle = |x: f64| 1.0 - 2.0 * (x.rem_euclid(1.0) - 0.5).abs();
        let p = Vector2::new(95.0 - 90.0 * triangle(t_s / 500.0), 12.0 + 76.0 * triangle(t_s / 60.0));
        MapObservation {
            t_s,
            p_W: Vector3::new(p.x, p.y, -1.0),
            detected: Some(self.smell(p)),
            flow: Some((self.flow)(t_s)),
            fixed: false,
        }
    }
}
