//! Obstacles of all shapes, compared with geometry.

use super::testing::{LEVEL, block, built, from_file, pillar, ramp_of, standing};
use super::{Base, MeshShape, Obstacle, ObstacleSpec, Obstacles, ShapeSpec};
use crate::ranges::{Finite, NonNegative, Positive};
use crate::seeds::Stream;
use crate::terrain::Terrain;
use crate::units::Heading;
use nalgebra::{Vector2, Vector3};
use std::path::Path;

const PLACE: [f64; 2] = [10.0, -5.0];

fn long_block(heading_deg: f64) -> ObstacleSpec {
    standing(block([2.0, 4.0, 3.0]), PLACE, heading_deg)
}

/// Some faces of a cube of edge 2 about its origin as OBJ text. Faces look outward unless they are turned.
fn cube(faces_shown: usize, turned: impl Fn(usize) -> bool) -> String {
    let mut text = String::new();
    for i in 0..8 {
        let c = |bit: usize| if i & bit == 0 { "-1" } else { "1" };
        text += &format!("v {} {} {}\n", c(1), c(2), c(4));
    }
    let faces = [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]];
    for (n, mut f) in faces.into_iter().take(faces_shown).enumerate() {
        if turned(n) {
            f.reverse();
        }
        text += &format!("f {} {} {} {}\n", f[0], f[1], f[2], f[3]);
    }
    text
}

#[test]
fn obstacles_stand_on_the_bed_or_where_they_are_told_to() {
    let slope = Terrain::Slope {
        middle: Vector2::zeros(),
        shoreward: Heading::from_deg(90.0).unit(),
        shallow_m: 4.0,
        deep_m: 8.0,
        run_m: 100.0,
    };
    // No gap is left at the deeper side.
    let deepest = slope.bed_z(9.0, -5.0);
    let deep = Base::Depth(NonNegative::new(3.0));
    let high = Base::Z(Finite::new(-1.0));
    for (name, spec, base, bed, low, high) in [
        ("turned east", long_block(90.0), Base::OnBed, &LEVEL, [9.0, -7.0, -8.0], [11.0, -3.0, -5.0]),
        ("on a slope", long_block(90.0), Base::OnBed, &slope, [9.0, -7.0, deepest], [11.0, -3.0, deepest + 3.0]),
        ("at a depth", long_block(0.0), deep, &LEVEL, [8.0, -6.0, -3.0], [12.0, -4.0, 0.0]),
        ("at a height", long_block(0.0), high, &LEVEL, [8.0, -6.0, -1.0], [12.0, -4.0, 2.0]),
        (
            "an upright cylinder",
            standing(pillar(0.5, 6.0), PLACE, 0.0),
            Base::OnBed,
            &LEVEL,
            [9.5, -5.5, -8.0],
            [10.5, -4.5, -2.0],
        ),
    ] {
        let (min, max) = built(&ObstacleSpec { base, ..spec }, bed).bounds();
        assert!((min - Vector3::from(low)).norm() < 1e-9, "{name}: {min}");
        assert!((max - Vector3::from(high)).norm() < 1e-9, "{name}: {max}");
    }
}

#[test]
fn distance_is_signed_and_rays_stop_at_the_surface() {
    let o = built(&long_block(90.0), &LEVEL);
    let middle = Vector3::new(10.0, -5.0, -6.5);
    assert!(o.contains(&middle) && (o.distance(&middle) + 1.0).abs() < 1e-9);
    let west = Vector3::new(4.0, -5.0, -6.5);
    assert!(!o.contains(&west) && (o.distance(&west) - 5.0).abs() < 1e-9);
    let east = Vector3::new(7.0, 0.0, 0.0);
    assert!((o.ray(&west, &east, 100.0).unwrap() - 5.0).abs() < 1e-9);
    assert_eq!(o.ray(&west, &east, 4.9), None);
    assert_eq!(o.ray(&west, &-east, 100.0), None);
    assert_eq!(o.ray(&middle, &east, 100.0), Some(0.0));
    let round = built(&standing(pillar(0.5, 6.0), PLACE, 0.0), &LEVEL);
    assert!((round.distance(&Vector3::new(12.0, -5.0, -4.0)) - 1.5).abs() < 1e-9);
    assert!(round.contains(&Vector3::new(10.3, -5.3, -2.1)));
}

/// The mesh of a cube gives the same answers as the box of the same size, whichever way its faces point.
#[test]
fn a_mesh_answers_as_the_box_it_shows() {
    let solid = built(&standing(block([1.0; 3]), PLACE, 30.0), &LEVEL);
    let mut rng = Stream::new(3, "test", "points");
    for inward in [false, true] {
        let o = from_file("cube.obj", &cube(6, |_| inward), 0.5, 30.0).1.expect("a closed cube");
        for _ in 0..2000 {
            let mut draw = || 2.0 * rng.uniform() - 1.0;
            let p = Vector3::new(10.0 + draw(), -5.0 + draw(), -7.5 + draw());
            let (got, want) = (o.distance(&p), solid.distance(&p));
            assert!((got - want).abs() < 1e-9, "{p:?}: {got} for {want}");
            let dir = Vector3::new(draw(), draw(), draw());
            let (got, want) = (o.ray(&p, &dir, 5.0), solid.ray(&p, &dir, 5.0));
            assert_eq!(got.is_some(), want.is_some(), "{p:?} {dir:?}");
            assert!((got.unwrap_or(0.0) - want.unwrap_or(0.0)).abs() < 1e-9);
        }
    }
}

#[test]
fn broken_shapes_are_refused_with_file_and_place() {
    let two_sides = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n";
    let far = "v 0 0 0\nv 9e9 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    for (file, text, said) in [
        ("lid.obj", &*cube(5, |_| false), ["lid.obj: edge (", "not closed"]),
        ("mixed.obj", &cube(6, |n| n == 0), ["mixed.obj: edge (", "twice in the same direction"]),
        ("flat.obj", two_sides, ["flat.obj", "encloses no volume"]),
        ("far.obj", far, ["far.obj", "farther than 100000 m"]),
        ("reef.asc", &ramp_of("inf"), ["reef.asc:6: ", "\"inf\""]),
    ] {
        let e = from_file(file, text, 1.0, 90.0).1.expect_err(file).to_string();
        assert!(said.iter().all(|part| e.contains(part)), "{e}");
    }
    let shape = ShapeSpec::Mesh(MeshShape { file: "nowhere.stl".into(), scale: Positive::new(1.0) });
    let missing = Obstacle::build(&standing(shape, PLACE, 0.0), &LEVEL, Path::new("/no"));
    let missing = missing.expect_err("no such file").to_string();
    assert!(missing.starts_with("/no/nowhere.stl: "), "{missing}");
}

#[test]
fn many_obstacles_answer_as_the_nearest() {
    let far = ObstacleSpec { east_m: Finite::new(20.0), ..long_block(90.0) };
    let all = Obstacles([far, long_block(90.0)].iter().map(|spec| built(spec, &LEVEL)).collect());
    let p = Vector3::new(4.0, -5.0, -6.5);
    assert!((all.distance(&p) - 5.0).abs() < 1e-9);
    assert!((all.ray(&p, &Vector3::x(), 100.0).unwrap() - 5.0).abs() < 1e-9);
    assert!(all.containing(&p).is_none());
    assert!(all.containing(&Vector3::new(20.0, -5.0, -6.5)).is_some());
}
