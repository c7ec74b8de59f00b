//! Observations written by hand, for tests.

use super::{
    Attitude, Belief, BeliefGrid, Capabilities, ChemicalReading, Estimate, FlowEstimate, GuidanceStatus, Observation,
    Setpoint,
};
use nalgebra::{Vector2, Vector3};
use std::f64::consts::FRAC_PI_2;
use std::path::Path;
use std::sync::Arc;
use world::area::Area;
use world::obstacles::{Base, BoxShape, Obstacle, ObstacleSpec, ShapeSpec};
use world::ranges::{Finite, HeadingDeg, Positive};
use world::terrain::Terrain;
use world::units::Heading;

/// An area of 600 m north-south by 400 m east-west around the origin.
pub(crate) fn area() -> Area {
    Area { centre: Vector2::zeros(), length_m: 600.0, width_m: 400.0, axis: Heading::from_deg(0.0) }
}

/// A vehicle at 2 m/s over ground, with no chemical reading.
pub(crate) fn seen(t_s: f64, position: Vector2<f64>, heading_deg: f64, flow: Option<Vector2<f64>>) -> Observation {
    Observation {
        t_s,
        estimate: Estimate {
            t_s,
            position,
            depth_m: 3.0,
            altitude_m: Some(2.0),
            attitude: Attitude {
                heading: Heading::from_deg(heading_deg),
                roll_rad: 0.0,
                pitch_rad: 0.0,
                rates_rad_s: Vector3::zeros(),
            },
            v_ground_body: Vector3::new(2.0, 0.0, 0.0),
            flow: flow.map(|velocity| FlowEstimate { velocity, age_s: 0.0 }),
            fix_jump: Vector2::zeros(),
        },
        chemical: None,
        sides: None,
        guidance: GuidanceStatus::default(),
        area: area(),
        home: Vector2::new(10.0, -250.0),
        able: Capabilities::default(),
        belief: None,
        ranging: None,
        sidescan: None,
        told: None,
        picture: None,
        dvl: None,
        adcp: None,
        ctd: None,
        other: Vec::new(),
    }
}

/// The same with a chemical reading.
pub(crate) fn smelling(mut o: Observation, detected: bool) -> Observation {
    o.chemical = Some(ChemicalReading {
        volts: if detected { 1.0 } else { 0.0 },
        of_full_scale: if detected { 0.2 } else { 0.0 },
        detected,
    });
    o
}

/// A map with so much of the probability in one cell, and the rest in all others alike.
pub(crate) fn sure_of(grid: BeliefGrid, best: usize, most: f64) -> Belief {
    let mut p = vec![(1.0 - most) / (grid.len() - 1) as f64; grid.len()];
    p[best] = most;
    Belief {
        t_s: 0.0,
        updates: 1,
        informed: true,
        grid: Arc::new(grid),
        p: Arc::new(p),
        best,
        entropy_nat: 1.5,
        credible_95: 100.0,
        odour: None,
        outlook: None,
    }
}

/// Settings for property tests: the same cases in every run, and no files beside the sources.
pub(crate) fn fixed(cases: u32) -> proptest::test_runner::Config {
    proptest::test_runner::Config {
        cases,
        rng_seed: proptest::test_runner::RngSeed::Fixed(20_090_601),
        failure_persistence: None,
        ..Default::default()
    }
}

/// A block on the bed; its length lies along east.
pub(crate) fn block(bed: &Terrain, id: &str, at: [f64; 2], size_m: [f64; 3]) -> Obstacle {
    let [x, y, z] = size_m.map(Positive::new);
    let spec = ObstacleSpec {
        surface: Default::default(),
        id: id.into(),
        shape: ShapeSpec::Box(BoxShape { size_m: (x, y, z) }),
        east_m: Finite::new(at[0]),
        north_m: Finite::new(at[1]),
        base: Base::default(),
        heading_deg: HeadingDeg::new(90.0),
    };
    Obstacle::build(&spec, bed, Path::new(".")).expect("a legal block")
}

/// Moves a vehicle without inertia, which takes a commanded heading at once, in moving water. Gives its velocity over
/// ground.
pub(crate) fn steered(e: &mut Estimate, set: &Setpoint, flow: Vector2<f64>) -> Vector2<f64> {
    let v = set.heading.unit() * set.water_speed_m_s + flow;
    let right = set.heading.turned(FRAC_PI_2).unit();
    e.attitude.heading = set.heading;
    e.v_ground_body.x = v.dot(&set.heading.unit());
    e.v_ground_body.y = -v.dot(&right);
    v
}
