//! Tests of the planner's room.

use super::*;
use crate::handoff::testing::fixed;
use crate::plan::testing::{block, lattice};
use proptest::prelude::*;

fn room() -> FreeSpace {
    FreeSpace::new(lattice([20, 20, 1], [1.0, 1.0, 1.0]), 0.5, 3.0)
}

#[test]
fn chart_gives_clearances_and_inflation() {
    let mut r = room();
    let solids = Obstacles(vec![block("b", 10.0, 10.0, [4.0, 4.0, 8.0])]);
    r.chart(&solids, &Terrain::Level { depth_m: 8.0 }, &|_, _| -4.0);
    let at = |x: f64, y: f64| r.lattice().cell(&Vector3::new(x, y, 0.0)).unwrap();
    assert!(r.solid(at(10.5, 10.5)) && !r.free(at(10.5, 10.5)));
    assert!((r.clearance_m(at(14.5, 10.5)) - 2.5).abs() < 1e-6);
    // 0.5 m of hull and 0.71 m of half diagonal: the first free cell has its middle 1.5 m from the face.
    assert!(!r.free(at(12.5, 10.5)) && r.free(at(13.5, 10.5)));
    // Above the block's top the plane is free.
    let mut high = room();
    let low = Obstacles(vec![block("b", 10.0, 10.0, [4.0, 4.0, 2.0])]);
    high.chart(&low, &Terrain::Level { depth_m: 8.0 }, &|_, _| -4.0);
    assert!(high.free(at(10.5, 10.5)));
}

#[test]
fn echoes_make_solid_and_beams_through_make_free_again() {
    let mut r = room();
    let (from, hit) = (Vector3::new(2.5, 5.5, 0.0), Vector3::new(9.2, 5.5, 0.0));
    let cell = r.lattice().cell(&hit).unwrap();
    let before = r.revision().clone();
    r.beam(&from, &hit, true);
    r.refresh();
    assert!(r.solid(cell) && r.sensed() == 1 && *r.revision() != before);
    let beyond = Vector3::new(15.0, 5.5, 0.0);
    // One beam that passes is noise, four are a gap.
    r.beam(&from, &beyond, false);
    r.refresh();
    assert!(r.solid(cell));
    (0..3).for_each(|_| r.beam(&from, &beyond, false));
    r.refresh();
    assert!(r.free(cell) && r.sensed() == 0);
    assert!((0..r.lattice().len()).all(|c| r.free(c)), "no shadow is left");
}

#[test]
fn nearest_cell_takes_points_from_outside_in() {
    let r = room();
    assert_eq!(r.nearest_cell(&Vector3::new(-50.0, 3.2, 9.0)), r.lattice().index([0, 3, 0]));
    assert_eq!(r.nearest_cell(&Vector3::new(19.99, 900.0, 9.0)), r.lattice().index([19, 19, 0]));
}

proptest! {
    #![proptest_config(fixed(256))]

    /// Cells found and freed again in any order leave the clearances that the remaining solid cells give.
    #[test]
    fn lifting_a_cell_leaves_what_the_others_give(
        deep in 1_usize..5, reach in 0.5..4.0, cells in proptest::collection::vec((0_usize..12, 0_usize..9, 0_usize..4), 1..30),
        lift in proptest::collection::vec(0_usize..30, 1..8),
    ) {
        let solid = Obstacles(vec![block("b", 4.0, 4.0, [2.0, 3.0, 8.0])]);
        let make = || {
            let mut r = FreeSpace::new(lattice([12, 9, deep], [1.0, 1.5, 0.7]), 0.5, reach);
            r.chart(&solid, &Terrain::Level { depth_m: 8.0 }, &|_, _| -4.0);
            r
        };
        let mut lifted = make();
        let cells: Vec<usize> = cells.into_iter().map(|(i, j, k)| lifted.lattice().index([i, j, k % deep])).collect();
        cells.iter().for_each(|c| lifted.weigh(*c, 2));
        let mut left = cells.clone();
        for l in lift {
            let Some(c) = cells.get(l) else { continue };
            // As much evidence against the cell as there can be for it.
            lifted.weigh(*c, -100);
            left.retain(|k| k != c);
        }
        lifted.refresh();
        let mut plain = make();
        left.iter().for_each(|c| plain.weigh(*c, 2));
        for cell in 0..plain.lattice().len() {
            prop_assert_eq!(lifted.clearance_m(cell), plain.clearance_m(cell));
        }
    }

    #[test]
    fn a_line_meets_every_cell_it_samples(
        ax in 0.0..20.0, ay in 0.0..20.0, az in 0.0..5.0, bx in 0.0..20.0, by in 0.0..20.0, bz in 0.0..5.0,
    ) {
        let r = FreeSpace::new(lattice([20, 10, 10], [1.0, 2.0, 0.5]), 0.5, 3.0);
        let z0 = r.lattice().corner.z;
        let (a, b) = (Vector3::new(ax, ay, z0 + az), Vector3::new(bx, by, z0 + bz));
        let mut met = Vec::new();
        let whole = r.line(&a, &b, |c| {
            met.push(c);
            true
        });
        prop_assert!(whole);
        for k in 0..=500 {
            let p = a + (b - a) * (f64::from(k) / 500.0);
            // Points within rounding of a face may count for either side.
            let near = r.lattice().cell(&p).is_none_or(|c| met.contains(&c));
            let q = a + (b - a) * ((f64::from(k) + 1e-6) / 500.0);
            prop_assert!(near || r.lattice().cell(&q).is_none_or(|c| met.contains(&c)), "{p:?}");
        }
        met.sort_unstable();
        let all = met.len();
        met.dedup();
        prop_assert_eq!(all, met.len());
    }
}
