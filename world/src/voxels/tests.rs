//! Voxels compared with geometry.

use super::Voxels;
use crate::area::Area;
use crate::obstacles::Obstacles;
use crate::obstacles::testing::{block, built, pillar, standing};
use crate::seeds::Stream;
use crate::terrain::Terrain;
use crate::units::Heading;
use nalgebra::{Vector2, Vector3};

const BED: Terrain = Terrain::Level { depth_m: 5.0 };
const PLACE: [f64; 2] = [5.0, -10.0];

fn area(axis_deg: f64) -> Area {
    Area { centre: Vector2::new(3.0, -8.0), length_m: 40.0, width_m: 30.0, axis: Heading::from_deg(axis_deg) }
}

#[test]
fn a_block_on_the_cells_lines_fills_just_its_cells() {
    let o = built(&standing(block([4.0, 6.0, 2.0]), PLACE, 90.0), &BED);
    let v = Voxels::new(&area(90.0), [1.0, 1.0, 0.5], &BED, &Obstacles(vec![o])).unwrap();
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
    let slope = Terrain::sloping_over(&area(20.0), Heading::from_deg(290.0), 3.0, 6.0);
    for (shape, turned) in [(block([9.0, 3.0, 2.2]), 33.0), (pillar(0.2, 4.3), 0.0)] {
        let all = Obstacles(vec![built(&standing(shape, PLACE, turned), &slope)]);
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
    let v = Voxels::new(&area(20.0), [1.5, 1.1, 0.7], &BED, &Obstacles::default()).unwrap();
    for c in [[0, 0, 0], [26, 27, 7], [13, 5, 3]] {
        assert_eq!(v.cell(&v.centre(c)), Some(c));
    }
}

#[test]
fn a_cell_that_is_set_counts_after_measuring() {
    let mut v = Voxels::new(&area(90.0), [1.0, 1.0, 5.0], &BED, &Obstacles::default()).unwrap();
    assert_eq!(v.clearance([3, 3, 0]), f64::INFINITY);
    v.set([5, 3, 0], true);
    v.measure();
    assert!((v.clearance([3, 3, 0]) - 1.5).abs() < 1e-6);
}

#[test]
fn what_cannot_be_is_refused() {
    let full = Obstacles(vec![built(&standing(block([200.0, 200.0, 9.0]), PLACE, 90.0), &BED)]);
    for (cell_m, said) in [
        ([2.0, 2.0, 1.0], "obstacles: no open water is left"),
        ([0.0, 2.0, 1.0], "cell_m: must be > 0"),
        ([0.01; 3], "take larger cells"),
    ] {
        let e = Voxels::new(&area(90.0), cell_m, &BED, &full).unwrap_err().to_string();
        assert!(e.contains(said), "{e}");
    }
}
