//! Voxels compared with geometry.

use super::Voxels;
use crate::area::Area;
use crate::obstacles::{Base, BoxShape, CylinderShape, Obstacle, ObstacleSpec, Obstacles, ShapeSpec};
use crate::ranges::{Finite, HeadingDeg, Positive};
use crate::seeds::Stream;
use crate::terrain::Terrain;
use crate::units::Heading;
use nalgebra::{Vector2, Vector3};
use std::path::Path;

fn area(axis_deg: f64) -> Area {
    Area { centre: Vector2::new(3.0, -8.0), length_m: 40.0, width_m: 30.0, axis: Heading::from_deg(axis_deg) }
}

fn bed() -> Terrain {
    Terrain::Level { depth_m: 5.0 }
}

fn solid(shape: ShapeSpec, heading_deg: f64, terrain: &Terrain) -> Obstacle {
    let spec = ObstacleSpec {
        surface: Default::default(),
        id: "o".into(),
        shape,
        east_m: Finite::new(5.0),
        north_m: Finite::new(-10.0),
        base: Base::default(),
        heading_deg: HeadingDeg::new(heading_deg),
    };
    Obstacle::build(&spec, terrain, Path::new("")).unwrap()
}

fn block(size: [f64; 3]) -> ShapeSpec {
    let [x, y, z] = size.map(Positive::new);
    ShapeSpec::Box(BoxShape { size_m: (x, y, z) })
}

#[test]
fn a_block_on_the_cells_lines_fills_just_its_cells() {
    let o = solid(block([4.0, 6.0, 2.0]), 90.0, &bed());
    let v = Voxels::new(&area(90.0), [1.0, 1.0, 0.5], &bed(), &Obstacles(vec![o])).unwrap();
    assert_eq!(v.size(), [40, 30, 10]);
    assert_eq!(v.solids().iter().filter(|s| **s).count(), 4 * 6 * 4);
    let beside = v.cell(&Vector3::new(7.5, -10.5, -4.0)).unwrap();
    assert!((v.clearance(beside) - 0.5).abs() < 1e-6);
    assert!((v.clearance_m(&Vector3::new(10.5, -10.5, -4.0)) - 3.5).abs() < 1e-6);
    assert_eq!(v.clearance_m(&Vector3::new(5.5, -10.5, -4.0)), 0.0);
    assert_eq!(v.cell(&Vector3::new(50.0, 0.0, -1.0)), None);
}

/// Open cells contain no point of a solid. Every solid cell lies within a cell's diagonal of one. This holds for turned
/// areas and turned obstacles.
#[test]
fn open_cells_are_free_of_solids() {
    let thin = ShapeSpec::Cylinder(CylinderShape { radius_m: Positive::new(0.2), height_m: Positive::new(4.3) });
    let slope = Terrain::sloping_over(&area(20.0), Heading::from_deg(290.0), 3.0, 6.0);
    for (shape, turned) in [(block([9.0, 3.0, 2.2]), 33.0), (thin, 0.0)] {
        let o = solid(shape, turned, &slope);
        let all = Obstacles(vec![o]);
        let v = Voxels::new(&area(20.0), [1.5, 1.0, 0.5], &slope, &all).unwrap();
        let mut rng = Stream::new(1, "test", "points");
        let (low, high) = all.0[0].bounds();
        let mut solid = 0;
        for _ in 0..20_000 {
            let p = low.zip_map(&high, |l, h| l - 1.0 + (h - l + 2.0) * rng.uniform());
            let Some(c) = v.cell(&p) else { continue };
            let under = p.z < slope.bed_z(p.x, p.y) - 1e-6;
            if v.solid(c[0], c[1], c[2]) {
                solid += 1;
            } else {
                assert!(!under && all.distance(&p) > -1e-5, "{p:?} in open {c:?}");
            }
            let diagonal = Vector3::from(v.cell_m()).norm();
            if all.distance(&p) > diagonal && p.z > slope.bed_z(p.x, p.y) + diagonal {
                assert!(!v.solid(c[0], c[1], c[2]), "{p:?}");
            }
        }
        assert!(solid > 100);
    }
}

#[test]
fn cells_and_centres_are_inverse() {
    let v = Voxels::new(&area(20.0), [1.5, 1.1, 0.7], &bed(), &Obstacles::default()).unwrap();
    for c in [[0, 0, 0], [26, 27, 7], [13, 5, 3]] {
        assert_eq!(v.cell(&v.centre(c)), Some(c));
    }
}

#[test]
fn a_cell_that_is_set_counts_after_measuring() {
    let mut v = Voxels::new(&area(90.0), [1.0, 1.0, 5.0], &bed(), &Obstacles::default()).unwrap();
    assert_eq!(v.clearance([3, 3, 0]), f64::INFINITY);
    v.set([5, 3, 0], true);
    v.measure();
    assert!((v.clearance([3, 3, 0]) - 1.5).abs() < 1e-6);
}

#[test]
fn what_cannot_be_is_refused() {
    let full = Obstacles(vec![solid(block([200.0, 200.0, 9.0]), 90.0, &bed())]);
    let e = Voxels::new(&area(90.0), [2.0, 2.0, 1.0], &bed(), &full).unwrap_err();
    assert!(e.to_string().starts_with("obstacles: no open water is left"), "{e}");
    let e = Voxels::new(&area(90.0), [0.0, 2.0, 1.0], &bed(), &full).unwrap_err();
    assert!(e.to_string().starts_with("cell_m: must be > 0"), "{e}");
    let e = Voxels::new(&area(90.0), [0.01, 0.01, 0.01], &bed(), &full).unwrap_err();
    assert!(e.to_string().contains("take larger cells"), "{e}");
}
