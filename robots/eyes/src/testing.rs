//! Observations written by hand, for tests.

use nalgebra::{Vector2, Vector3};
use robots::handoff::{Attitude, Capabilities, ChemicalReading, Estimate, FlowEstimate, GuidanceStatus, Observation};
use std::path::Path;
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
    let volts = f64::from(u8::from(detected));
    o.chemical = Some(ChemicalReading { volts, of_full_scale: 0.2 * volts, detected });
    o
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
