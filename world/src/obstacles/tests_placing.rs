//! Height fields, and obstacles in places where they make no sense.

use super::{Base, BoxShape, HeightfieldShape, MeshShape, Obstacle, ObstacleSpec, Obstacles, ShapeSpec};
use crate::area::Area;
use crate::error::WorldError;
use crate::ranges::{Finite, HeadingDeg, NonNegative, Positive};
use crate::seeds::Stream;
use crate::terrain::Terrain;
use crate::units::Heading;
use nalgebra::{Vector2, Vector3};

const LEVEL: Terrain = Terrain::Level { depth_m: 8.0 };

fn area() -> Area {
    Area { centre: Vector2::zeros(), length_m: 80.0, width_m: 60.0, axis: Heading::from_deg(90.0) }
}

fn spec(shape: ShapeSpec, base: Base, heading_deg: f64) -> ObstacleSpec {
    ObstacleSpec {
        surface: Default::default(),
        id: "reef".into(),
        shape,
        east_m: Finite::new(10.0),
        north_m: Finite::new(-5.0),
        base,
        heading_deg: HeadingDeg::new(heading_deg),
    }
}

fn block(size: f64) -> ShapeSpec {
    let m = Positive::new(size);
    ShapeSpec::Box(BoxShape { size_m: (m, m, m) })
}

fn field(text: &str, scale: f64, heading_deg: f64) -> (ObstacleSpec, Result<Obstacle, WorldError>) {
    let dir = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(dir.path().join("reef.asc"), text).expect("a written file");
    let shape = ShapeSpec::Heightfield(HeightfieldShape { file: "reef.asc".into(), scale: Positive::new(scale) });
    let spec = spec(shape, Base::OnBed, heading_deg);
    let built = Obstacle::build(&spec, &LEVEL, dir.path());
    (spec, built)
}

/// Heights of a plane that rises from 0 in the west to 4 m in the east, 1 m apart.
fn ramp() -> String {
    let mut text = "ncols 5\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 1\n".to_owned();
    for _ in 0..4 {
        text += "20 21 22 23 24\n";
    }
    text
}

#[test]
fn a_height_field_is_solid_below_its_heights() {
    let (spec, built) = field(&ramp(), 1.0, 90.0);
    let reef = built.expect("a sound field");
    let (low, high) = reef.bounds();
    // Its lowest height stands on the bed, its skirt below it.
    assert!((low - Vector3::new(8.0, -6.5, -9.0)).norm() < 1e-9, "{low}");
    assert!((high - Vector3::new(12.0, -3.5, -4.0)).norm() < 1e-9, "{high}");
    let mut rng = Stream::new(2, "test", "points");
    for _ in 0..2000 {
        let p = low.zip_map(&high, |l, h| l + (h - l) * rng.uniform());
        let surface = -8.0 + (p.x - 8.0);
        if (p.z - surface).abs() > 1e-6 {
            assert_eq!(reef.contains(&p), p.z < surface, "{p}");
        }
    }
    let hit = reef.ray(&Vector3::new(10.0, -5.0, 0.0), &-Vector3::z(), 50.0);
    assert!((hit.expect("the reef below") - 6.0).abs() < 1e-9);
    assert_eq!(reef.outline().len(), 4);
    assert!(reef.remarks(&spec, &area(), &LEVEL).is_empty());
    // Turned, its east side points south; scaled, it is half as large in each direction.
    let (_, turned) = field(&ramp(), 0.5, 180.0);
    let turned = turned.unwrap();
    assert!((turned.bounds().1.z + 6.0).abs() < 1e-9);
    assert!(turned.contains(&Vector3::new(10.0, -5.9, -6.5)));
    assert!(!turned.contains(&Vector3::new(10.0, -4.1, -6.5)));
}

#[test]
fn broken_fields_are_refused_with_file_and_place() {
    let e = field(&ramp().replace("22", "inf"), 1.0, 90.0).1.unwrap_err().to_string();
    assert!(e.ends_with("reef.asc:6: height \"inf\" is not a finite number"), "{e}");
}

#[test]
fn a_wrong_scale_is_noticed() {
    let says = |scale: f64| {
        let (spec, built) = field(&ramp(), scale, 90.0);
        built.unwrap().remarks(&spec, &area(), &LEVEL)
    };
    assert!(says(1.0).is_empty());
    let large = &says(1000.0)[0];
    assert!(large.wrong && large.problem == "obstacle \"reef\" is 5000 m wide in an area of 80 x 60 m", "{large:?}");
    assert_eq!(large.hint, "if the file is in millimetres, give scale: 0.001");
    let small = &says(0.001)[0];
    assert!(small.wrong && small.problem.contains("only 5.00e-3 m wide"), "{small:?}");
}

#[test]
fn a_body_far_higher_than_the_water_is_deep_is_noticed() {
    // A height that stands for a gap in some other way than by the format's number.
    let (spec, built) = field(&ramp().replace("22", "222"), 1.0, 90.0);
    let remarks = built.unwrap().remarks(&spec, &area(), &LEVEL);
    let [remark] = &remarks[..] else {
        panic!("one remark: {remarks:?}");
    };
    assert!(!remark.wrong && remark.problem.contains(" m high in water of "), "{remark:?}");
}

#[test]
fn odd_places_are_noticed() {
    let says = |base: Base, east_m: f64| {
        let mut spec = spec(block(3.0), base, 90.0);
        spec.east_m = Finite::new(east_m);
        let built = Obstacle::build(&spec, &LEVEL, std::path::Path::new("")).unwrap();
        let remarks = built.remarks(&spec, &area(), &LEVEL);
        remarks.first().map(|r| (r.wrong, r.problem.clone()))
    };
    assert_eq!(says(Base::OnBed, 10.0), None);
    let outside = says(Base::OnBed, 500.0).unwrap();
    assert_eq!(outside, (false, "obstacle \"reef\" lies wholly outside the area".into()));
    assert!(says(Base::Z(Finite::new(1.0)), 0.0).unwrap().1.contains("wholly above the surface"));
    assert!(says(Base::Depth(NonNegative::new(20.0)), 0.0).unwrap().1.contains("wholly under the bed"));
}

#[test]
fn copies_and_a_full_area_are_noticed() {
    let one = spec(block(3.0), Base::OnBed, 90.0);
    let mut other = one.clone();
    other.id = "twin".into();
    assert!(one.is_copy_of(&other));
    other.north_m = Finite::new(-5.5);
    assert!(!one.is_copy_of(&other));
    let build = |size: f64| {
        let spec = spec(block(size), Base::OnBed, 90.0);
        Obstacle::build(&spec, &LEVEL, std::path::Path::new("")).unwrap()
    };
    assert!(Obstacles(vec![build(30.0)]).leave_water(&area(), &LEVEL));
    assert!(!Obstacles(vec![build(200.0)]).leave_water(&area(), &LEVEL));
}

#[test]
fn a_mesh_beyond_all_measure_is_refused() {
    let dir = tempfile::tempdir().expect("a temporary folder");
    let text = "v 0 0 0\nv 9e9 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    std::fs::write(dir.path().join("far.obj"), text).expect("a written file");
    let shape = ShapeSpec::Mesh(MeshShape { file: "far.obj".into(), scale: Positive::new(1.0) });
    let e = Obstacle::build(&spec(shape, Base::OnBed, 90.0), &LEVEL, dir.path());
    let e = e.expect_err("too far").to_string();
    assert!(e.contains("far.obj") && e.contains("farther than 100000 m"), "{e}");
}
