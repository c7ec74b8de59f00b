//! Obstacles of all shapes, compared with geometry.

use super::{Base, BoxShape, CylinderShape, MeshShape, Obstacle, ObstacleSpec, Obstacles, ShapeSpec};
use crate::error::WorldError;
use crate::ranges::{Finite, HeadingDeg, NonNegative, Positive};
use crate::seeds::Stream;
use crate::terrain::Terrain;
use crate::units::Heading;
use nalgebra::{Vector2, Vector3};
use std::path::Path;

const LEVEL: Terrain = Terrain::Level { depth_m: 8.0 };

fn spec(shape: ShapeSpec, base: Base, heading_deg: f64) -> ObstacleSpec {
    ObstacleSpec {
        surface: Default::default(),
        id: "pile".into(),
        shape,
        east_m: Finite::new(10.0),
        north_m: Finite::new(-5.0),
        base,
        heading_deg: HeadingDeg::new(heading_deg),
    }
}

fn block(base: Base, heading_deg: f64) -> ObstacleSpec {
    let size_m = [2.0, 4.0, 3.0].map(Positive::new);
    let size_m = (size_m[0], size_m[1], size_m[2]);
    spec(ShapeSpec::Box(BoxShape { size_m }), base, heading_deg)
}

fn built(spec: &ObstacleSpec) -> Obstacle {
    Obstacle::build(spec, &LEVEL, Path::new("")).expect("a sound obstacle")
}

fn corner_points() -> (String, [[usize; 4]; 6]) {
    let mut points = String::new();
    for i in 0..8 {
        let c = |bit: usize| if i & bit == 0 { "-1" } else { "1" };
        points += &format!("v {} {} {}\n", c(1), c(2), c(4));
    }
    let faces = [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]];
    (points, faces)
}

/// A cube of edge 2 about its origin as OBJ text, with its faces outward or inward.
fn cube(faces_shown: usize, outward: bool) -> String {
    let (mut text, faces) = corner_points();
    for mut f in faces.into_iter().take(faces_shown) {
        if !outward {
            f.reverse();
        }
        text += &format!("f {} {} {} {}\n", f[0], f[1], f[2], f[3]);
    }
    text
}

fn mesh(text: &str) -> Result<Obstacle, WorldError> {
    let dir = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(dir.path().join("cube.obj"), text).expect("a written file");
    let shape = ShapeSpec::Mesh(MeshShape { file: "cube.obj".into(), scale: Positive::new(0.5) });
    Obstacle::build(&spec(shape, Base::OnBed, 30.0), &LEVEL, dir.path())
}

#[test]
fn a_block_stands_on_the_bed_and_turns_with_its_heading() {
    let o = built(&block(Base::OnBed, 90.0));
    let (min, max) = o.bounds();
    assert!((min - Vector3::new(9.0, -7.0, -8.0)).norm() < 1e-9);
    assert!((max - Vector3::new(11.0, -3.0, -5.0)).norm() < 1e-9);
    let (min, _) = built(&block(Base::Depth(NonNegative::new(3.0)), 0.0)).bounds();
    assert!((min - Vector3::new(8.0, -6.0, -3.0)).norm() < 1e-9);
    let (min, _) = built(&block(Base::Z(Finite::new(-1.0)), 0.0)).bounds();
    assert!((min.z + 1.0).abs() < 1e-9);
}

#[test]
fn no_gap_is_left_on_a_slope() {
    let slope = Terrain::Slope {
        middle: Vector2::zeros(),
        shoreward: Heading::from_deg(90.0).unit(),
        shallow_m: 4.0,
        deep_m: 8.0,
        run_m: 100.0,
    };
    let o = Obstacle::build(&block(Base::OnBed, 90.0), &slope, Path::new("")).unwrap();
    let deepest = slope.bed_z(9.0, -5.0);
    assert!((o.bounds().0.z - deepest).abs() < 1e-9);
}

#[test]
fn distance_is_signed_and_rays_stop_at_the_surface() {
    let o = built(&block(Base::OnBed, 90.0));
    let middle = Vector3::new(10.0, -5.0, -6.5);
    assert!(o.contains(&middle) && (o.distance(&middle) + 1.0).abs() < 1e-9);
    let west = Vector3::new(4.0, -5.0, -6.5);
    assert!(!o.contains(&west) && (o.distance(&west) - 5.0).abs() < 1e-9);
    let east = Vector3::new(7.0, 0.0, 0.0);
    assert!((o.ray(&west, &east, 100.0).unwrap() - 5.0).abs() < 1e-9);
    assert_eq!(o.ray(&west, &east, 4.9), None);
    assert_eq!(o.ray(&west, &-east, 100.0), None);
    assert_eq!(o.ray(&middle, &east, 100.0), Some(0.0));
}

#[test]
fn a_cylinder_stands_upright() {
    let o = built(&spec(
        ShapeSpec::Cylinder(CylinderShape { radius_m: Positive::new(0.5), height_m: Positive::new(6.0) }),
        Base::OnBed,
        0.0,
    ));
    let (min, max) = o.bounds();
    assert!((min - Vector3::new(9.5, -5.5, -8.0)).norm() < 1e-6);
    assert!((max - Vector3::new(10.5, -4.5, -2.0)).norm() < 1e-6);
    assert!((o.distance(&Vector3::new(12.0, -5.0, -4.0)) - 1.5).abs() < 1e-9);
    assert!(o.contains(&Vector3::new(10.3, -5.3, -2.1)));
}

/// The mesh of a cube gives the same answers as the box of the same size, whichever way its faces point.
#[test]
fn a_mesh_answers_as_the_box_it_shows() {
    let one = Positive::new(1.0);
    let shape = ShapeSpec::Box(BoxShape { size_m: (one, one, one) });
    let solid = built(&spec(shape, Base::OnBed, 30.0));
    let mut rng = Stream::new(3, "test", "points");
    for outward in [true, false] {
        let o = mesh(&cube(6, outward)).expect("a closed cube");
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
fn broken_meshes_are_refused_with_file_and_place() {
    let hole = mesh(&cube(5, true)).expect_err("a cube without its lid").to_string();
    assert!(hole.contains("cube.obj: edge (") && hole.contains("not closed"), "{hole}");
    let (points, faces) = corner_points();
    let mut text = points;
    for (i, mut f) in faces.into_iter().enumerate() {
        if i == 0 {
            f.reverse();
        }
        text += &format!("f {} {} {} {}\n", f[0], f[1], f[2], f[3]);
    }
    let mixed = mesh(&text).expect_err("one face turned").to_string();
    assert!(mixed.contains("twice in the same direction"), "{mixed}");
    let shape = ShapeSpec::Mesh(MeshShape { file: "nowhere.stl".into(), scale: Positive::new(1.0) });
    let flat = mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n").expect_err("two sides");
    assert!(flat.to_string().contains("encloses no volume"), "{flat}");
    let missing = Obstacle::build(&spec(shape, Base::OnBed, 0.0), &LEVEL, Path::new("/no"))
        .expect_err("no such file")
        .to_string();
    assert!(missing.starts_with("/no/nowhere.stl: No such file"), "{missing}");
}

#[test]
fn many_obstacles_answer_as_the_nearest() {
    let mut far = block(Base::OnBed, 90.0);
    far.east_m = Finite::new(20.0);
    let all = Obstacles(vec![built(&far), built(&block(Base::OnBed, 90.0))]);
    let p = Vector3::new(4.0, -5.0, -6.5);
    assert!((all.distance(&p) - 5.0).abs() < 1e-9);
    assert!((all.ray(&p, &Vector3::x(), 100.0).unwrap() - 5.0).abs() < 1e-9);
    assert!(all.containing(&p).is_none());
    assert!(all.containing(&Vector3::new(20.0, -5.0, -6.5)).is_some());
}
