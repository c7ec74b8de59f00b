//! Exact tests of the drift: spread, shear, and that no filament leaves through bed or surface.

use super::water::{Given, basin, moments, no_plume, plume, pour, source};
use crate::filaments::plume::Plume;
use nalgebra::Vector3;
use world::fields::{Flow, Mixing};
use world::math;
use world::terrain::Terrain;
use world::units::Heading;

/// Steps over a 20-fold range, s.
const STEPS_S: [f64; 4] = [0.25, 1.0, 2.5, 5.0];

#[test]
fn spread_is_2kt_whatever_the_step() {
    // 100 s from a point: variance 2K·100 (x = U·100). With 5·10⁴ filaments a sample variance has a relative
    // standard error of √(2/n) = 0.63 %; five of them allowed, at every step.
    let n = 50_000;
    let water = Given(|_| 0.5, |_| (0.02, 0.005));
    for dt in STEPS_S {
        let mut p = no_plume(40.0);
        pour(&mut p, n, -40.0, |_| [-90.0, 0.0, -20.0]);
        p.drift_on(&water, dt, 0..(100.0 / dt) as u32);
        let all: Vec<[f64; 5]> = p.iter().collect();
        for (d, mean, k) in [(0, -40.0, 0.02), (1, 0.0, 0.02), (2, -20.0, 0.005)] {
            let (m, v) = moments(all.iter().map(|f| f[d]));
            let exact = 2.0 * k * 100.0;
            assert!((v / exact - 1.0).abs() < 0.0316, "axis {d}, step {dt}: {v} for {exact}");
            assert!((m - mean).abs() < 5.0 * (exact / n as f64).sqrt() + 1e-3, "axis {d}, step {dt}: mean {m}");
        }
    }
}

#[test]
fn spread_of_filaments_released_within_a_step_counts_from_their_release() {
    let water = Given(|_| 0.5, |_| (0.02, 0.0));
    for dt in STEPS_S {
        let mut p = plume(source(20.0, 200.0, 0.0, 0.1), &Terrain::Level { depth_m: 40.0 });
        p.drift_on(&water, dt, 0..(100.0 / dt) as u32);
        counts_from_release(&p, 0.5, 0.0);
    }
}

/// In a stream with K_h = 0.02 m²/s, y²/(2K·age) has mean 1 but for what is said to lack, with a relative standard
/// error of √(2/n).
pub(super) fn counts_from_release(p: &Plume, speed_m_s: f64, lacks: f64) {
    let ages: Vec<f64> = p.stores[0].born_s.iter().map(|born| p.now_s - born).collect();
    let (n, mut sum) = (p.len() as f64, 0.0);
    for (f, age) in p.iter().zip(&ages) {
        sum += f[1].powi(2) / (0.04 * age);
        // Carried for exactly its age, within 6 sigma of the kicks.
        assert!((f[0] + 90.0 - speed_m_s * age).abs() < 6.0 * (0.04 * age).sqrt() + 1e-4);
    }
    let (off, slack) = (sum / n - 1.0, 5.0 * (2.0 / n).sqrt());
    assert!(off < slack && off > -lacks - slack, "{off} at {} s", p.now_s);
}

#[test]
fn shear_stretches_a_cloud_by_its_exact_law_whatever_the_step() {
    // u = S(z − z0) with K_z alone: var x = ⅔ K S² t³ (Saffman 1962), cov(x, z) = K S t². Both from normal
    // variables: relative standard error of the variance √(2/n), of the covariance √((1 + 1/ρ²)/n), ρ² = ¾.
    let (n, shear, k, t) = (50_000.0_f64, 0.02, 0.01, 100.0);
    let water = Given(|z: f64| shear * (z + 20.0), |_| (0.0, k));
    for dt in STEPS_S {
        let mut p = no_plume(40.0);
        pour(&mut p, n as usize, -40.0, |_| [0.0, 0.0, -20.0]);
        p.drift_on(&water, dt, 0..(t / dt) as u32);
        let (_, v) = moments(p.iter().map(|f| f[0]).collect::<Vec<_>>().into_iter());
        let exact = 2.0 / 3.0 * k * shear * shear * t * t * t;
        assert!((v / exact - 1.0).abs() < 5.0 * (2.0 / n).sqrt(), "step {dt}: {v} for {exact}");
        let c = p.iter().map(|f| f[0] * (f[2] + 20.0)).sum::<f64>() / n;
        let exact = k * shear * t * t;
        assert!((c / exact - 1.0).abs() < 5.0 * ((1.0 + 4.0 / 3.0) / n).sqrt(), "step {dt}: {c} for {exact}");
    }
}

#[test]
fn nobody_is_in_the_bed_or_the_air_and_nobody_is_lost() {
    let terrain = Terrain::sloping_over(&basin(), Heading::from_deg(0.0), 2.0, 8.0);
    struct Wild;
    impl Flow for Wild {
        fn velocity(&self, p: &Vector3<f64>, _: f64) -> Vector3<f64> {
            Vector3::new(0.8, 0.05 * p.x / 90.0, 0.2 * math::sin(p.x))
        }
        fn mixing(&self, _: &Vector3<f64>, _: f64) -> Mixing {
            Mixing { k_h_m2_s: 0.5, k_z_m2_s: 0.5 }
        }
    }
    let mut p = plume(source(0.0, 50.0, 0.001, 0.03), &terrain);
    let mut seen_left = 0;
    for k in 0..600 {
        p.drift(&Wild, f64::from(k), f64::from(k + 1));
        for f in p.iter() {
            let [x, y, z] = [f[0], f[1], f[2]].map(|v| v as f32);
            let bed = f64::from(p.grid().sample(x, y, z).bed_z);
            assert!(f[2] <= 0.0 && f[2] >= bed - 1e-5, "{f:?} over {bed}");
            // Where the bed bends, at the edges of the area, the grid spreads the bend over a cell of 20 m.
            let true_bed = terrain.bed_z(f[0], f[1]);
            assert!(f[1].abs() > 40.0 || f[2] >= true_bed - 1e-4, "{f:?} over {true_bed}");
        }
        assert_eq!(p.released(), p.len() as u64 + p.left());
        assert!(p.left() >= seen_left);
        seen_left = p.left();
    }
    assert!(p.released() > 29_000 && seen_left > 1000 && p.len() > 1000);
}
