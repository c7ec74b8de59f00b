//! The chain against matrices written out and against enumerated paths.

use super::mapper::{Hmm, HmmSpec};
use super::products::{best_walk, neighbours};
use crate::handoff::testing::fixed;
use crate::map::mapper::Mapper;
use crate::map::spec::{GridSpec, TrajectorySpec};
use crate::map::testing::paper_area;
use crate::map::watch::MapObservation;
use nalgebra::{DMatrix, Vector2, Vector3};
use proptest::prelude::*;
use world::math;
use world::ranges::Positive;

/// Cells down to 10 m.
fn cells([along, across, vertical]: [u32; 3]) -> GridSpec {
    GridSpec { along, across, vertical, bottom_depth_m: Some(Positive::new(10.0)), ..GridSpec::default() }
}

fn build(spec: &HmmSpec) -> Hmm {
    Hmm::new(spec, spec.grid.build(&paper_area()).expect("grid")).expect("mapper")
}

fn hmm(n: [u32; 3], sigma: f64, flows: &[[f64; 2]]) -> Hmm {
    let mut hmm = build(&HmmSpec {
        grid: cells(n),
        trajectory: TrajectorySpec {
            sigma_x_m_rts: Positive::new(sigma),
            sigma_y_m_rts: Positive::new(0.7 * sigma),
            sigma_z_m_rts: Positive::new(0.1 * sigma),
            lookback_s: Positive::new(20.0),
            ..TrajectorySpec::default()
        },
        ..HmmSpec::default()
    });
    for u in flows {
        hmm.push_step(&[*u]);
    }
    hmm
}

/// The flow of each step, turned a little more at each level.
fn sheared(n: [u32; 3], sigma: f64, flows: &[[f64; 2]]) -> Hmm {
    let mut new = hmm(n, sigma, &[]);
    for [u, v] in flows {
        let levels: Vec<_> = (0..n[2]).map(|k| [u - 8.0 * f64::from(k), v + 5.0 * f64::from(k)]).collect();
        new.push_step(&levels);
    }
    new
}

/// A of each step, whole.
fn matrices(hmm: &Hmm) -> Vec<DMatrix<f64>> {
    let grid = &hmm.grid;
    let chance = |step: &super::transition::Transition, i: usize, j: usize| -> f64 {
        let (from, to) = (grid.place(i), grid.place(j));
        (0..3).map(|a| step.hops(a, from[2]).chance(from[a], to[a], grid.n[a])).product()
    };
    (hmm.steps.iter()).map(|s| DMatrix::from_fn(grid.len(), grid.len(), |i, j| chance(s, i, j))).collect()
}

fn flows() -> impl Strategy<Value = Vec<[f64; 2]>> {
    proptest::collection::vec((-30.0..30.0f64, -30.0..30.0f64).prop_map(|(u, v)| [u, v]), 5)
}

proptest! {
    #![proptest_config(fixed(24))]

    #[test]
    fn going_back_step_by_step_equals_the_matrix_product(
        flows in flows(), sigma in 3.0..30.0f64, deep in 1_u32..4, shear: bool,
    ) {
        let make = if shear { sheared } else { hmm };
        let mut hmm = make([5, 4, deep], sigma, &flows);
        let a = matrices(&hmm);
        let cells = hmm.grid.len();
        // Φ(l, k) for l = k − 1 … k − 5.
        let mut phi = Vec::new();
        let mut product = DMatrix::identity(cells, cells);
        for step in a.iter().rev() {
            product = step * product;
            phi.push(product.clone());
        }
        let mut gamma = vec![0.0; cells];
        for j in 0..cells {
            hmm.not_detecting(j, &mut gamma);
            for (i, g) in gamma.iter().enumerate() {
                let by_hand: f64 = phi.iter().map(|f| 1.0 - 0.9 * f[(i, j)]).product();
                prop_assert!((g - by_hand).abs() < 1e-11, "{i} {j}: {g} {by_hand}");
            }
        }
        // Detection map: π (Σ_l Φ(l, k)).
        let pi = DMatrix::from_fn(1, cells, |_, i| hmm.belief().p[i]);
        let total = phi.iter().fold(DMatrix::zeros(cells, cells), |s, f| s + f);
        let alpha = pi * total;
        for (j, d) in hmm.detection_map().iter().enumerate() {
            prop_assert!((d - (1.0 - math::exp(-0.9 * alpha[j]))).abs() < 1e-12);
        }
    }

    #[test]
    fn the_most_likely_odour_path_is_the_best_of_all(flows in flows(), sigma in 10.0..40.0f64, end in 0_usize..6) {
        for hmm in [hmm([3, 2, 1], sigma, &flows[..3]), sheared([3, 1, 2], sigma, &flows[..3])] {
        let a = matrices(&hmm);
        let p = &hmm.belief().p;
        let chance = |path: &[usize]| -> f64 {
            let steps = path.windows(2).zip(&a);
            p[path[0]] * steps.map(|(w, a)| a[(w[0], w[1])]).product::<f64>()
        };
        let mut best: f64 = 0.0;
        for code in 0..216_usize {
            best = best.max(chance(&[code % 6, code / 6 % 6, code / 36, end]));
        }
        match hmm.odour_path(end, 3) {
            Some(path) => {
                prop_assert_eq!(path.len(), 4);
                prop_assert_eq!(path[3], end);
                prop_assert!((chance(&path) - best).abs() <= 1e-12 * best);
            }
            None => prop_assert!(best < 1e-290),
        }
        prop_assert!(hmm.odour_path(end, 4).is_none());
        }
    }

    #[test]
    fn the_walk_most_likely_to_detect_is_the_best_of_all(
        p in proptest::collection::vec(0.0..0.9f64, 12), start in 0_usize..12,
    ) {
        let n = [4, 3, 1];
        let miss = |path: &[usize]| path.iter().map(|c| 1.0 - p[*c]).product::<f64>();
        let mut best: f64 = 1.0;
        for a in neighbours(n, start) {
            for b in neighbours(n, a) {
                for c in neighbours(n, b) {
                    best = best.min(miss(&[a, b, c]));
                }
            }
        }
        let path = best_walk(n, &p, start, 3);
        prop_assert_eq!(path.len(), 3);
        prop_assert!((miss(&path) - best).abs() < 1e-12);
        let mut at = start;
        for c in path {
            prop_assert!(neighbours(n, at).any(|x| x == c));
            at = c;
        }
    }
}

#[test]
fn odour_came_up_the_flow_from_the_age_that_fits() {
    // 10 m a step to the east in cells of 10 m; the source is believed in cell 2 of the row, the end is cell 7.
    let mut hmm = hmm([10, 1, 1], 1.0, &[[10.0, 0.0]; 12]);
    hmm.believe(&[1e-9, 1e-9, 1.0, 1e-9, 1e-9, 1e-9, 1e-9, 1e-9, 1e-9, 1e-9]);
    assert_eq!(hmm.likely_odour_path(7), Some(vec![2, 3, 4, 5, 6, 7]));
}

#[test]
fn a_level_not_visited_has_the_flow_of_the_nearest_that_was() {
    let mut hmm = build(&HmmSpec { grid: cells([4, 4, 5]), sheared: true, ..HmmSpec::default() });
    // Two seconds near the surface, two near the bed, in opposite flows.
    for (t, z, u) in [(0.0, -1.0, 30.0), (1.0, -1.0, 30.0), (2.0, -9.0, 30.0), (3.0, -9.0, -30.0), (4.0, -9.0, -30.0)] {
        hmm.step(&MapObservation {
            t_s: t,
            p_W: Vector3::new(50.0, 50.0, z),
            detected: Some(false),
            flow: Some(Vector2::new(u, 0.0)),
            fixed: false,
        });
    }
    let last = hmm.steps.back().expect("a step");
    assert!(!hmm.steps[0].sheared() && last.sheared());
    // 30 m a step over cells of 25 m: the likeliest hop is one cell, east above and west below.
    let likeliest = |k: usize| {
        let hops = last.hops(0, k);
        (hops.first..).zip(hops.p.iter()).max_by(|a, b| a.1.total_cmp(b.1)).expect("some").0
    };
    assert_eq!([0, 1, 2, 3, 4].map(likeliest), [-1, -1, -1, 1, 1]);
}

#[test]
fn the_chain_is_as_long_as_the_look_back() {
    let hmm = hmm([4, 4, 1], 5.0, &[[1.0, 0.0]; 50]);
    assert_eq!(hmm.steps.len(), 20);
}

#[test]
fn what_else_it_knows_is_said_when_asked_and_changes_no_map() {
    let spec = HmmSpec { odour_every_s: Some(Positive::new(10.0)), walk_steps: 6, ..HmmSpec::default() };
    let (mut asked, mut silent) = (build(&spec), build(&HmmSpec::default()));
    let mut times = Vec::new();
    for t in 0..60 {
        let seen = MapObservation {
            t_s: f64::from(t),
            p_W: Vector3::new(80.0, 50.0, -2.0),
            detected: Some((20..25).contains(&t)),
            flow: Some(Vector2::new(1.0, 0.0)),
            fixed: false,
        };
        asked.step(&seen);
        silent.step(&seen);
        assert_eq!(asked.belief().p, silent.belief().p);
        let odour = asked.belief().odour.as_ref();
        times.extend(odour.map(|o| o.t_s).filter(|t| times.last() != Some(t)));
    }
    assert!(silent.belief().odour.is_none());
    assert_eq!(times, [20.0, 30.0, 40.0, 50.0]);
    let odour = asked.belief().odour.clone().expect("said");
    let here = odour.grid.cell(&Vector3::new(80.0, 50.0, 0.0)).expect("inside");
    assert_eq!((odour.walk[0], odour.walk.len()), (here, 7));
    assert_eq!(odour.came.last(), Some(&here));
    // It came down the flow, from the west.
    let east = |c: usize| odour.grid.centre(c).x;
    assert!(odour.came.len() > 1 && east(odour.came[0]) < 80.0);
    assert!(odour.detection.iter().all(|p| (0.0..=1.0).contains(p)));
}

/// With several places in a cell the chance at the vehicle's place, in a chain of finer cells, stands for a whole cell.
#[test]
fn odour_at_the_vehicles_place_stands_for_a_cell() {
    let make = |n: [u32; 2], places: u32| {
        let mut hmm = build(&HmmSpec {
            grid: GridSpec { along: n[0], across: n[1], places, ..GridSpec::default() },
            trajectory: TrajectorySpec {
                sigma_x_m_rts: Positive::new(4.0),
                sigma_y_m_rts: Positive::new(3.0),
                lookback_s: Positive::new(20.0),
                merge: world::ranges::Fraction::new(0.0),
                ..TrajectorySpec::default()
            },
            ..HmmSpec::default()
        });
        for u in [[9.0, 1.0], [11.0, -4.0], [7.0, 3.0]] {
            hmm.push_step(&[u]);
        }
        hmm
    };
    let (mut places, cells) = (make([4, 3], 3), make([12, 9], 1));
    assert_eq!(places.grid.n, cells.grid.n);
    let at = cells.grid.index([8, 4, 0]);
    let mut wanted = vec![1.0; cells.grid.len()];
    cells.back(at, |g| {
        for (w, g) in wanted.iter_mut().zip(g) {
            *w *= 1.0 - cells.b * (9.0 * g).min(1.0);
        }
    });
    let mut got = vec![0.0; wanted.len()];
    places.not_detecting(at, &mut got);
    assert!(wanted.iter().any(|w| *w < 0.9));
    for (got, wanted) in got.iter().zip(&wanted) {
        assert!((got - wanted).abs() < 1e-12, "{got} {wanted}");
    }
}
