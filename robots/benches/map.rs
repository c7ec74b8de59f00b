//! An update of each source map, 600 s of look-back. `cargo bench -p rheotaxis-robots --bench map`
//!
//! The flow crosses the area in the look-back, so that every release counts: 0.17 m/s over 100 m.

use divan::Bencher;
use nalgebra::{Vector2, Vector3};
use robots::handoff::WaysAhead;
use robots::map::{
    BayesianSpec, CellsSpec, GridSpec, HmmSpec, MapObservation, MapSpec, Mapper, ParticleFilterSpec, PomdpSpec,
    TrajectorySpec,
};
use world::area::Area;
use world::math;
use world::ranges::{Fraction, Positive};
use world::seeds::Stream;
use world::units::Heading;

fn main() {
    divan::main();
}

const PLANE: [u32; 3] = [40, 25, 1];
const SPACE: [u32; 3] = [100, 100, 20];

fn area() -> Area {
    Area { centre: Vector2::new(50.0, 50.0), length_m: 100.0, width_m: 100.0, axis: Heading::from_deg(90.0) }
}

fn grid([along, across, vertical]: [u32; 3]) -> GridSpec {
    GridSpec { along, across, vertical, bottom_depth_m: Some(Positive::new(10.0)), ..GridSpec::default() }
}

/// A vehicle that goes to and fro near the down-flow end, and smells something every 50 s.
struct Cruise {
    mapper: Box<dyn Mapper>,
    flow: Vector2<f64>,
    t_s: f64,
    step_s: f64,
}

impl Cruise {
    fn new(spec: &MapSpec, flow: [f64; 2], step_s: f64) -> Self {
        let mapper = spec.build(&area(), Stream::new(1, "auv0", "map")).expect("mapper");
        let mut new = Self { mapper, flow: Vector2::new(flow[0], flow[1]), t_s: 0.0, step_s };
        // Fills the look-back with flow alone.
        while new.t_s < 700.0 {
            new.go(None);
        }
        new
    }

    fn go(&mut self, detected: Option<bool>) {
        self.t_s += self.step_s;
        self.mapper.step(&MapObservation {
            t_s: self.t_s,
            p_W: Vector3::new(85.0, 50.0 + 40.0 * math::sin(self.t_s / 30.0), -5.0),
            detected,
            flow: Some(self.flow),
            fixed: false,
        });
    }

    fn update(&mut self) {
        let detected = ((self.t_s / self.step_s) as u64).is_multiple_of(50);
        self.go(Some(detected));
    }
}

fn trajectory(merge: f64) -> TrajectorySpec {
    TrajectorySpec { merge: Fraction::new(merge), ..TrajectorySpec::default() }
}

fn pomdp(n: [u32; 3], merge: f64) -> MapSpec {
    MapSpec::new(PomdpSpec(CellsSpec { grid: grid(n), trajectory: trajectory(merge), ..CellsSpec::default() }))
}

const ALONG: [f64; 2] = [0.17, 0.0];
const SLANTING: [f64; 2] = [0.14, 0.10];
const FAST: [f64; 2] = [1.0, 0.0];

fn run(bencher: Bencher, spec: &MapSpec, flow: [f64; 2], step_s: f64) {
    let mut cruise = Cruise::new(spec, flow, step_s);
    bencher.bench_local(|| cruise.update());
}

#[divan::bench(args = [ALONG, SLANTING, FAST])]
fn pomdp_plane(bencher: Bencher, flow: [f64; 2]) {
    run(bencher, &pomdp(PLANE, 0.3), flow, 1.0);
}

/// No releases taken together.
#[divan::bench]
fn pomdp_plane_unmerged(bencher: Bencher) {
    run(bencher, &pomdp(PLANE, 0.0), ALONG, 1.0);
}

#[divan::bench]
fn bayesian_plane(bencher: Bencher) {
    let spec = CellsSpec { grid: grid(PLANE), ..CellsSpec::default() };
    run(bencher, &MapSpec::new(BayesianSpec(spec)), ALONG, 1.0);
}

fn hmm(n: [u32; 3], step_s: f64) -> MapSpec {
    MapSpec::new(HmmSpec { grid: grid(n), step_s: Positive::new(step_s), ..HmmSpec::default() })
}

#[divan::bench(args = [1.0, 5.0])]
fn hmm_plane(bencher: Bencher, step_s: f64) {
    run(bencher, &hmm(PLANE, step_s), ALONG, step_s);
}

#[divan::bench]
fn particles_plane(bencher: Bencher) {
    let spec = ParticleFilterSpec { grid: grid(PLANE), ..ParticleFilterSpec::default() };
    run(bencher, &MapSpec::new(spec), ALONG, 1.0);
}

#[divan::bench(args = [ALONG, SLANTING], sample_count = 30)]
fn pomdp_space(bencher: Bencher, flow: [f64; 2]) {
    run(bencher, &pomdp(SPACE, 0.3), flow, 1.0);
}

#[divan::bench(args = [1.0, 5.0], sample_count = 10)]
fn hmm_space(bencher: Bencher, step_s: f64) {
    run(bencher, &hmm(SPACE, step_s), ALONG, step_s);
}

/// What the map expects on seven ways of three points each.
#[divan::bench]
fn pomdp_outlook(bencher: Bencher) {
    let mut cruise = Cruise::new(&pomdp(PLANE, 0.3), ALONG, 1.0);
    let (from, heading) = (Vector2::new(60.0, 50.0), Heading::from_deg(270.0));
    let ways = WaysAhead { number: 1, from, z_m: -5.0, heading, radius_m: 11.5, length_m: 48.0 };
    bencher.bench_local(|| cruise.mapper.outlook(&ways));
}
