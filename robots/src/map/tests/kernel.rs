//! The fast kernel against the paper's equations written out.

use crate::handoff::testing::fixed;
use crate::map::kernel::Kernel;
use crate::map::spec::TrajectorySpec;
use crate::map::testing::{grid, history, p_by_hand};
use proptest::prelude::*;
use std::sync::Arc;
use world::math;
use world::ranges::{Fraction, Positive};
use world::seeds::Stream;

fn spec(mu: f64, sigma: [f64; 2], lookback_s: f64, merge: f64) -> TrajectorySpec {
    TrajectorySpec {
        mu: Fraction::new(mu),
        sigma_x_m_rts: Positive::new(sigma[0]),
        sigma_y_m_rts: Positive::new(sigma[1]),
        lookback_s: Positive::new(lookback_s),
        merge: Fraction::new(merge),
        ..TrajectorySpec::default()
    }
}

/// ln γ by eq. 2 as it stands.
fn ln_gamma_by_hand(p: &[Vec<f64>], mu: f64) -> Vec<f64> {
    let cells = p[0].len();
    (0..cells).map(|i| p.iter().map(|l| math::ln(1.0 - mu * l[i])).sum()).collect()
}

proptest! {
    #![proptest_config(fixed(96))]

    #[test]
    fn the_map_equals_the_product_written_out(
        nx in 1_usize..14, ny in 1_usize..11, mu in 0.05..0.99f64,
        sx in 0.1..6.0f64, sy in 0.1..6.0f64, u in -3.0..3.0f64, v in -3.0..3.0f64,
        bend in -0.05..0.05f64, cell in 0_usize..1000,
    ) {
        let grid = Arc::new(grid([nx, ny, 1]));
        let spec = spec(mu, [sx, sy], 40.0, 0.0);
        let history = history(&spec, 60.0, |t| [u + bend * t, v - bend * t]);
        let at = cell % grid.len();
        let mut kernel = Kernel::new(&grid, &spec);
        kernel.aim(&history, at);
        let (mut gamma, mut sum) = (vec![0.0; grid.len()], vec![0.0; grid.len()]);
        kernel.not_detecting(&mut gamma);
        kernel.expected(&mut sum);
        let p = p_by_hand(&grid, &spec, &history, at);
        prop_assert_eq!(p.len(), 40);
        let exact = ln_gamma_by_hand(&p, mu);
        let middles: Vec<_> = (0..grid.len()).map(|i| grid.local_centre(i)).collect();
        let mut there = Vec::new();
        kernel.anywhere().not_detecting(&middles, &mut there);
        for i in 0..grid.len() {
            // The kernel leaves out what lies beyond seven standard deviations: 2.4e-11 of a release's peak.
            let peak = |age: f64| grid.cell_m[0] * grid.cell_m[1] / (std::f64::consts::TAU * age * sx * sy);
            let cut: f64 = (1..=40).map(|age| 2.4e-11 * peak(f64::from(age))).sum();
            let e = math::exp(exact[i]);
            prop_assert!((gamma[i] - e).abs() <= cut + 1e-11, "{} {} {cut}", gamma[i], e);
            let by_hand: f64 = p.iter().map(|l| l[i]).sum();
            prop_assert!((sum[i] - by_hand).abs() <= cut + 1e-10, "{} {by_hand}", sum[i]);
            // A particle in the middle of a cell gets the same result.
            prop_assert!((there[i] - e).abs() <= 2.0 * cut + 1e-11);
        }
    }
}

proptest! {
    // Each case writes out 600 releases over 1000 cells.
    #![proptest_config(fixed(32))]

    #[test]
    fn merged_releases_change_the_logarithm_by_less_than_one_per_cent_of_its_largest(
        seed in 0_u64..1000, speed in 0.0..1.0f64, deg in 0.0..360.0f64, sigma in 0.2..1.0f64,
        wander in 0.0..0.1f64, cell in 0_usize..1000,
    ) {
        let error = merge_error(seed, speed, deg, sigma, wander, cell);
        prop_assert!(error < 0.01, "{error}");
    }
}

/// Largest error of ln γ over the 40 × 25 map, 600 releases, as a share of its largest value.
fn merge_error(seed: u64, speed: f64, deg: f64, sigma: f64, wander: f64, cell: usize) -> f64 {
    let grid = Arc::new(grid([40, 25, 1]));
    let spec = spec(0.9, [sigma, sigma], 600.0, 0.3);
    let (s, c) = math::sin_cos(deg.to_radians());
    let mut rng = Stream::new(seed, "flow", "wander");
    let noise: Vec<[f64; 2]> = (0..2000).map(|_| [wander * rng.normal(), wander * rng.normal()]).collect();
    let history = history(&spec, 650.0, |t| {
        let n = noise[(t * 2.0) as usize];
        [speed * c + n[0], speed * s + n[1]]
    });
    let mut kernel = Kernel::new(&grid, &spec);
    kernel.aim(&history, cell);
    assert!(kernel.sets() < 600);
    let mut gamma = vec![0.0; grid.len()];
    kernel.not_detecting(&mut gamma);
    let exact = ln_gamma_by_hand(&p_by_hand(&grid, &spec, &history, cell), 0.9);
    let most = exact.iter().fold(0.0, |m: f64, v| m.max(-v));
    let errors = gamma.iter().zip(&exact).map(|(g, e)| (math::ln(*g) - e).abs());
    errors.fold(0.0, f64::max) / most.max(1e-6)
}

#[test]
fn a_map_of_one_layer_is_the_map_of_the_plane_and_layers_add_up_to_it() {
    // Spread wide compared with a layer and narrow compared with the depth: the layers' factors then sum to 1
    // (midpoint rule for a Gaussian: error under 1e-9).
    let flat = Arc::new(grid([12, 9, 1]));
    let deep = Arc::new(grid([12, 9, 20]));
    let spec = TrajectorySpec { sigma_z_m_rts: Positive::new(0.45), ..spec(0.9, [4.0, 4.0], 30.0, 0.0) };
    let history = history(&spec, 40.0, |t| [0.8, 0.01 * t]);
    let mut plane = vec![0.0; flat.len()];
    let mut kernel = Kernel::new(&flat, &spec);
    kernel.aim(&history, flat.index([9, 5, 0]));
    kernel.expected(&mut plane);
    // Chances above 1 would not add up.
    assert!(p_by_hand(&flat, &spec, &history, flat.index([9, 5, 0])).iter().flatten().all(|p| *p < 1.0));
    let mut space = vec![0.0; deep.len()];
    let mut kernel = Kernel::new(&deep, &spec);
    for k in [0, 7, 19] {
        kernel.aim(&history, deep.index([9, 5, k]));
        kernel.expected(&mut space);
        for (i, p) in plane.iter().enumerate() {
            let column: f64 = space.iter().skip(i).step_by(flat.len()).sum();
            assert!((column - p).abs() < 1e-4 * (1.0 + p), "{k} {i}: {column} {p}");
        }
    }
}
