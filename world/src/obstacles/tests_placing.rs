//! Height fields, and obstacles in places where they make no sense.

use super::testing::{LEVEL, block, built, from_file, ramp_of, standing};
use super::{Base, Obstacle, ObstacleSpec, Obstacles};
use crate::area::Area;
use crate::ranges::{Finite, NonNegative};
use crate::seeds::Stream;
use crate::units::Heading;
use nalgebra::{Vector2, Vector3};

fn area() -> Area {
    Area { centre: Vector2::zeros(), length_m: 80.0, width_m: 60.0, axis: Heading::from_deg(90.0) }
}

/// A cube of some edge at (10, -5).
fn cube(edge_m: f64) -> ObstacleSpec {
    standing(block([edge_m; 3]), [10.0, -5.0], 90.0)
}

/// A height field of a ramp, so many metres in a unit of its file.
fn reef(middle: &str, scale: f64, heading_deg: f64) -> (ObstacleSpec, Obstacle) {
    let (spec, built) = from_file("reef.asc", &ramp_of(middle), scale, heading_deg);
    (spec, built.expect("a sound field"))
}

#[test]
fn a_height_field_is_solid_below_its_heights() {
    let (_, ramp) = reef("22", 1.0, 90.0);
    let (low, high) = ramp.bounds();
    // Its lowest height stands on the bed, its skirt below it.
    assert!((low - Vector3::new(8.0, -6.5, -9.0)).norm() < 1e-9, "{low}");
    assert!((high - Vector3::new(12.0, -3.5, -4.0)).norm() < 1e-9, "{high}");
    let mut rng = Stream::new(2, "test", "points");
    for _ in 0..2000 {
        let p = low.zip_map(&high, |l, h| l + (h - l) * rng.uniform());
        let surface = -8.0 + (p.x - 8.0);
        if (p.z - surface).abs() > 1e-6 {
            assert_eq!(ramp.contains(&p), p.z < surface, "{p}");
        }
    }
    let hit = ramp.ray(&Vector3::new(10.0, -5.0, 0.0), &-Vector3::z(), 50.0);
    assert!((hit.expect("the reef below") - 6.0).abs() < 1e-9);
    assert_eq!(ramp.outline().len(), 4);
    // Turned, its east side points south; scaled, it is half as large in each direction.
    let (_, turned) = reef("22", 0.5, 180.0);
    assert!((turned.bounds().1.z + 6.0).abs() < 1e-9);
    assert!(turned.contains(&Vector3::new(10.0, -5.9, -6.5)));
    assert!(!turned.contains(&Vector3::new(10.0, -4.1, -6.5)));
}

#[test]
fn odd_sizes_and_places_are_noticed() {
    let on_bed = |spec: ObstacleSpec| {
        let built = built(&spec, &LEVEL);
        (spec, built)
    };
    let based = |base| on_bed(ObstacleSpec { base, ..cube(3.0) });
    for ((spec, obstacle), want) in [
        (on_bed(cube(3.0)), None),
        (
            on_bed(ObstacleSpec { east_m: Finite::new(500.0), ..cube(3.0) }),
            Some((false, "wholly outside the area", "")),
        ),
        (based(Base::Z(Finite::new(1.0))), Some((false, "wholly above the surface", ""))),
        (based(Base::Depth(NonNegative::new(20.0))), Some((false, "wholly under the bed", ""))),
        (reef("22", 1.0, 90.0), None),
        (reef("22", 1000.0, 90.0), Some((true, "5000 m wide in an area of 80 x 60 m", "scale: 0.001"))),
        (reef("22", 0.001, 90.0), Some((true, "only 5.00e-3 m wide", ""))),
        // A height that stands for a gap in some other way than by the format's number.
        (reef("222", 1.0, 90.0), Some((false, " m high in water of ", ""))),
    ] {
        let remarks = obstacle.remarks(&spec, &area(), &LEVEL);
        assert_eq!(remarks.len(), usize::from(want.is_some()), "{want:?}: {remarks:?}");
        for (remark, (wrong, problem, hint)) in remarks.iter().zip(want) {
            let told = remark.problem.contains(problem) && remark.hint.contains(hint);
            assert!(told && remark.wrong == wrong, "{remark:?}");
        }
    }
}

#[test]
fn copies_and_a_full_area_are_noticed() {
    let twin = ObstacleSpec { id: "twin".into(), ..cube(3.0) };
    assert!(cube(3.0).is_copy_of(&twin));
    assert!(!cube(3.0).is_copy_of(&ObstacleSpec { north_m: Finite::new(-5.5), ..twin }));
    for (edge_m, leaves_water) in [(30.0, true), (200.0, false)] {
        assert_eq!(Obstacles(vec![built(&cube(edge_m), &LEVEL)]).leave_water(&area(), &LEVEL), leaves_water);
    }
}
