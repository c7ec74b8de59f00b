//! What a map expects on ways ahead.

use crate::handoff::{WAYS, WaysAhead};
use crate::map::mapper::Mapper;
use crate::map::testing::{build, every};
use crate::map::watch::MapObservation;
use crate::map::workings::CellsSpec;
use nalgebra::{Vector2, Vector3};
use world::math;
use world::ranges::NonNegative;
use world::units::Heading;

/// The middle of a cell of 2.5 × 4 m.
const HERE: (f64, f64) = (71.25, 50.0);

fn look(detected: Option<bool>, t_s: f64) -> MapObservation {
    let flow = Some(Vector2::new(0.5, 0.02));
    MapObservation { t_s, p_W: Vector3::new(HERE.0, HERE.1, -1.0), detected, flow, fixed: false }
}

/// After so long in a steady flow that nothing changes from one second to the next.
fn settled(mapper: &mut dyn Mapper) {
    for second in 0..700 {
        mapper.step(&look(None, f64::from(second)));
    }
}

fn ways(length_m: f64) -> WaysAhead {
    let from = Vector2::new(HERE.0, HERE.1);
    WaysAhead { number: 1, from, z_m: -1.0, heading: Heading::from_deg(90.0), radius_m: 10.0, length_m }
}

/// Three points in one cell: c = ε + (1 − ε)(1 − γ³). An update with a detection there weighs by ε + (1 − ε)(1 − γ).
#[test]
fn it_is_what_a_detection_there_then_says() {
    let spec = CellsSpec::default();
    let mut mapper = build(&every(&spec, 1)[0]);
    assert_eq!(mapper.outlook(&ways(0.3)), None, "no flow is known");
    settled(&mut *mapper);
    let outlook = mapper.outlook(&ways(0.3)).expect("a flow is known");
    let before = mapper.belief().p.clone();
    mapper.step(&look(Some(true), 700.0));
    let after = mapper.belief().p.clone();
    let e = spec.false_detection.get();
    let likelihood = |c: f64| e + (1.0 - e) * (1.0 - math::cbrt((1.0 - (c - e) / (1.0 - e)).max(0.0)));
    let best = mapper.belief().best;
    for (way, chances) in outlook.chances.iter().enumerate() {
        for cell in 0..before.len() {
            let learned = after[cell] / before[cell] * before[best] / after[best];
            let expected = likelihood(chances[cell]) / likelihood(chances[best]);
            assert!((learned - expected).abs() < 1e-6, "way {way}, cell {cell}: {learned} {expected}");
        }
    }
}

/// Going on down-flow says something of what lies up-flow of the way; every map that looks ahead answers.
#[test]
fn maps_that_say_so_look_ahead_and_others_do_not() {
    let doubtful = |change: &dyn Fn(&mut CellsSpec)| {
        let mut spec = CellsSpec::default();
        change(&mut spec);
        spec
    };
    for spec in [
        CellsSpec::default(),
        doubtful(&|s| s.doubt.flow_m_s = NonNegative::new(0.05)),
        doubtful(&|s| s.grid.places = 3),
    ] {
        for map in every(&spec, 50) {
            let mut mapper = build(&map);
            settled(&mut *mapper);
            let outlook = mapper.outlook(&ways(20.0));
            assert_eq!(outlook.is_some(), map.looks_ahead(), "{}", map.name());
            let Some(outlook) = outlook else { continue };
            let grid = &mapper.belief().grid;
            assert!(outlook.chances.len() == WAYS && outlook.chances.iter().all(|c| c.len() == grid.len()));
            assert!(outlook.chances.iter().all(|c| c.iter().all(|v| (0.0..=1.0).contains(v))));
            let chance = |x: f64, y: f64| outlook.chances[0][grid.cell(&Vector3::new(x, y, -1.0)).expect("inside")];
            assert!(chance(60.0, 49.0) > 0.2, "up-flow: {}", chance(60.0, 49.0));
            assert!(chance(99.0, 50.0) < 0.01 && chance(60.0, 90.0) < 0.01, "down-flow and aside");
        }
    }
}
