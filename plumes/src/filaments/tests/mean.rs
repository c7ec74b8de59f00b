//! Exact tests of averages: the Gaussian plume with its images, the flux through every section, gaps as in a Poisson
//! process.

use super::water::{Given, moments, plume, source};
use nalgebra::Vector3;
use world::fields::Concentration;
use world::math;
use world::terrain::Terrain;

const SPEED: f64 = 0.5;
const K: f64 = 0.005;
const DEPTH: f64 = 4.0;
const HEIGHT: f64 = 1.0;
/// kg/s
const RATE: f64 = 1e-3;

/// Gaussian plume `x` down-stream of the source with mirror images at bed and surface, kg/m³.
fn gaussian(x: f64, y: f64, z: f64) -> f64 {
    let age = x / SPEED;
    let v = 2.0 * K * age + 0.001 * age + 0.0316 * 0.0316;
    let zs = HEIGHT - DEPTH;
    let up: f64 = (-4..=4)
        .flat_map(|n| {
            let shift = 2.0 * DEPTH * f64::from(n);
            [z - zs - shift, z + zs - shift]
        })
        .map(|d| math::exp(-d * d / (2.0 * v)))
        .sum();
    RATE / (SPEED * std::f64::consts::TAU * v) * math::exp(-y * y / (2.0 * v)) * up
}

#[test]
fn time_mean_is_the_gaussian_plume_and_every_section_carries_what_is_released() {
    let mut p = plume(source(HEIGHT, 200.0, 0.001, 0.0316), &Terrain::Level { depth_m: DEPTH });
    let water = Given(|_| SPEED, |_| (K, K));
    let sections = [10.0, 40.0, 70.0];
    let points: Vec<Vector3<f64>> = sections
        .iter()
        .flat_map(|x| {
            [(0.0, -3.0), (0.0, -3.9), (0.0, -0.2), (0.6, -2.5), (-0.8, -3.4), (0.3, -1.5)]
                .map(|(y, z)| Vector3::new(x - 90.0, y, z))
        })
        .collect();
    let mut at_points = vec![Vec::new(); points.len()];
    let mut through = vec![Vec::new(); sections.len()];
    for k in 0..600 {
        p.drift(&water, f64::from(k), f64::from(k + 1));
        // The farthest section sees its first filaments after 140 s. A filament takes some seconds to pass, so samples
        // 5 s apart are almost independent.
        if k < 200 || k % 5 != 0 {
            continue;
        }
        for (q, seen) in points.iter().zip(&mut at_points) {
            seen.push(p.concentration(q));
        }
        for (x, seen) in sections.iter().zip(&mut through) {
            let (dy, dz) = (0.1, 0.1);
            let mut sum = 0.0;
            for j in -70..70 {
                for l in 0..40 {
                    let (y, z) = ((f64::from(j) + 0.5) * dy, -(f64::from(l) + 0.5) * dz);
                    sum += p.concentration(&Vector3::new(x - 90.0, y, z));
                }
            }
            seen.push(SPEED * sum * dy * dz);
        }
    }
    // Five standard errors from the scatter of the samples, and 1 % for what the formula leaves out: spread along the
    // stream, of the order of K/(U·x) = 0.1 % at 10 m, and the growth of a filament while it passes.
    let near = |seen: &Vec<f64>, exact: f64, what: &str| {
        let (mean, variance) = moments(seen.iter().copied());
        let slack = 5.0 * (variance / seen.len() as f64).sqrt() + 0.01 * exact;
        assert!((mean - exact).abs() < slack, "{what}: {mean} for {exact} ± {slack}");
        slack / exact
    };
    for (x, seen) in sections.iter().zip(&through) {
        assert!(near(seen, RATE, &format!("flux at {x} m")) < 0.06);
    }
    let mut sharp = 0;
    for (q, seen) in points.iter().zip(&at_points) {
        let exact = gaussian(q.x + 90.0, q.y, q.z);
        if exact > 1e-6 * RATE && near(seen, exact, &format!("mean at {q:?}")) < 0.25 {
            sharp += 1;
        }
    }
    assert!(sharp >= 10, "only {sharp} points say anything");
}

#[test]
fn gaps_of_a_random_release_are_poisson() {
    // Without mixing, the filaments lie on a line, n/U per metre. Within 3σ of a probe there are λ = 6σn/U = 1 on
    // average. Samples 0.5 s apart share no filament (6σ/U = 0.2 s), so the share of empty samples is binomial: 10⁴
    // samples, standard error √(p(1 − p)/10⁴), five of them allowed.
    let (rate, size) = (5.0, SPEED / 30.0);
    let mut p = plume(source(HEIGHT, rate, 0.0, size), &Terrain::Level { depth_m: DEPTH });
    let water = Given(|_| SPEED, |_| (0.0, 0.0));
    let probe = Vector3::new(-70.0, 0.0, HEIGHT - DEPTH);
    // One filament alone at 3σ: a lower concentration means that none is nearer.
    let alone = RATE / rate / (math::powf(std::f64::consts::TAU, 1.5) * size.powi(3) * 0.998_866) * math::exp(-4.5);
    let (mut empty, mut faint, samples) = (0.0, 0.0, 10_000);
    for k in 0..samples + 200 {
        p.drift(&water, 0.5 * f64::from(k), 0.5 * f64::from(k + 1));
        if k < 200 {
            continue;
        }
        let gap = p.iter().all(|f| (f[0] - probe.x).abs() > 3.0 * size);
        empty += f64::from(u8::from(gap));
        faint += f64::from(u8::from(p.concentration(&probe) < alone));
        // The concentration agrees with the positions: there cannot be no filament within 3σ and more than two at 3σ.
        assert!(!gap || p.concentration(&probe) <= 4.0 * alone);
    }
    let exact = math::exp(-1.0);
    let slack = 5.0 * (exact * (1.0 - exact) / f64::from(samples)).sqrt();
    let share = empty / f64::from(samples);
    assert!((share - exact).abs() < slack, "{share} for {exact} ± {slack}");
    assert!(faint <= empty && faint > 0.5 * empty, "{faint} of {empty}");
}
