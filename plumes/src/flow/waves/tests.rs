//! A sea of waves: exact properties, limits, and what is refused.

use super::airy::{Airy, wave_number};
use super::{SpectrumSpec, TrainSpec, Waves, WavesSpec};
use nalgebra::{Matrix3, Vector2, Vector3};
use std::f64::consts::TAU;
use world::fields::WaterSample;
use world::math;
use world::ranges::{Finite, HeadingDeg, NonNegative, Positive};
use world::seeds::Stream;
use world::units::GRAVITY_M_S2;

const DEPTH: f64 = 10.0;

pub(crate) fn train(height: f64, period: f64, heading: f64) -> TrainSpec {
    TrainSpec {
        height_m: Positive::new(height),
        period_s: Positive::new(period),
        heading_deg: HeadingDeg::new(heading),
        phase_deg: Some(Finite::new(30.0)),
    }
}

pub(crate) fn regular(trains: Vec<TrainSpec>) -> WavesSpec {
    WavesSpec { trains, spectrum: None, stokes: true, mixing: NonNegative::new(0.028) }
}

pub(crate) fn wind_sea() -> WavesSpec {
    WavesSpec {
        spectrum: Some(SpectrumSpec {
            significant_height_m: Positive::new(0.4),
            peak_period_s: Positive::new(4.0),
            heading_deg: HeadingDeg::new(60.0),
            peakedness: Positive::new(3.3),
            spreading: NonNegative::new(10.0),
            components: 32,
        }),
        ..regular(vec![train(0.2, 8.0, 90.0)])
    }
}

fn sea() -> Waves {
    wind_sea().build("water.currents[0]", DEPTH, 5).unwrap()
}

fn places(n: usize) -> Vec<(Vector3<f64>, f64)> {
    let mut r = Stream::new(2, "test", "places");
    let mut wide = |w: f64| w * r.uniform();
    (0..n)
        .map(|_| {
            let p = Vector3::new(wide(400.0) - 200.0, wide(400.0), -wide(DEPTH));
            (p, wide(5000.0))
        })
        .collect()
}

fn sample(waves: &Waves, p: &Vector3<f64>, t_s: f64) -> WaterSample {
    let mut sample = WaterSample {
        velocity: Vector3::zeros(),
        gradient: Matrix3::zeros(),
        rate: Vector3::zeros(),
        density_kg_m3: 1026.0,
    };
    waves.add_to(&mut sample, p, t_s);
    sample
}

#[test]
fn free_of_divergence_and_rotation_to_rounding() {
    let waves = sea();
    for (p, t) in places(200) {
        let g = sample(&waves, &p, t).gradient;
        assert!(g.trace().abs() < 1e-15 * (1.0 + g.norm()), "{}", g.trace());
        assert!((g - g.transpose()).norm() == 0.0);
    }
}

#[test]
fn gradient_and_rate_are_those_of_the_velocity() {
    let waves = sea();
    const H: f64 = 1e-4;
    for (mut p, t) in places(50) {
        p.z = p.z.clamp(-DEPTH + 0.01, -0.01);
        let s = sample(&waves, &p, t);
        assert!((s.velocity - waves.velocity(&p, t)).norm() < 1e-15);
        let d = |e: Vector3<f64>, dt: f64| {
            let (a, b) = (waves.velocity(&(p + e), t + dt), waves.velocity(&(p - e), t - dt));
            (a - b) / (2.0 * H)
        };
        for j in 0..3 {
            let mut e = Vector3::zeros();
            e[j] = H;
            assert!((d(e, 0.0) - s.gradient.column(j)).norm() < 1e-6);
        }
        assert!((d(Vector3::zeros(), H) - s.rate).norm() < 1e-6);
        let way = (waves.displacement(&p, t + H) - waves.displacement(&p, t - H)) / (2.0 * H);
        assert!((way - s.velocity).norm() < 1e-6, "the orbit's speed is not the water's");
    }
}

#[test]
fn tangent_to_the_bed_and_moving_with_the_surface() {
    let waves = sea();
    for (p, t) in places(50) {
        let bed = Vector3::new(p.x, p.y, -DEPTH);
        assert_eq!(waves.velocity(&bed, t).z, 0.0);
        assert_eq!(waves.displacement(&bed, t).z, 0.0);
        // Pressure at the mean surface is that of the water above it.
        let top = Vector3::new(p.x, p.y, 0.0);
        assert!((waves.head(&top, t) - waves.displacement(&top, t).z).abs() < 1e-12);
        assert!(waves.head(&bed, t).abs() < waves.variance().sqrt() * 4.0);
    }
}

/// Stokes' transport over the depth is ga²/2c at any depth.
#[test]
fn drift_carries_what_it_should() {
    for (period, depth) in [(3.0, 10.0), (6.0, 3.0), (12.0, 40.0)] {
        let spec = regular(vec![train(0.2, period, 0.0)]);
        let waves = spec.build("w", depth, 1).unwrap();
        let n = 20_000;
        let cells = (0..n).map(|i| waves.drift(-depth * (f64::from(i) + 0.5) / f64::from(n)).y);
        let transport = cells.sum::<f64>() * depth / f64::from(n);
        let k = wave_number(TAU / period, depth);
        let want = GRAVITY_M_S2 * 0.01 / (2.0 * TAU / period / k);
        // The profile's linear pieces add (k·depth/1023)²/3 of it.
        assert!((transport / want - 1.0).abs() < 1e-3, "{transport} {want}");
    }
    let still = WavesSpec { stokes: false, ..wind_sea() };
    let waves = still.build("w", DEPTH, 1).unwrap();
    assert_eq!(waves.drift(-0.1), Vector2::zeros());
}

#[test]
fn mixing_is_that_of_the_wave_height() {
    let spec = regular(vec![train(0.5, 4.0, 0.0)]);
    let waves = spec.build("w", DEPTH, 1).unwrap();
    let k = wave_number(TAU / 4.0, DEPTH);
    // Sixteen variances of a sine of 0.5 m are 2 · 0.5².
    for z in [0.0, -1.5, -6.0] {
        let want = 0.028 * 2.0 * 0.25 / 4.0 * math::exp(2.0 * k * z);
        assert!((waves.vertical(z) / want - 1.0).abs() < 1e-4, "{z}");
    }
}

/// Over 3000 seas: the standard error of a variance is √(2/n) of it; four of these are 10 %.
#[test]
fn the_surface_has_the_variance_of_its_significant_height() {
    // Nobody looks at the drift, which is most of the work.
    let spec = WavesSpec { trains: vec![], stokes: false, ..wind_sea() };
    let n = 3000;
    let mut sum = 0.0;
    for seed in 0..n {
        let waves = spec.build("w", DEPTH, seed).unwrap();
        assert!((waves.variance() / 0.01 - 1.0).abs() < 1e-12);
        sum += waves.displacement(&Vector3::new(3.0, 9.0, 0.0), 77.0).z.powi(2);
    }
    let ratio = sum / n as f64 / 0.01;
    assert!((ratio - 1.0).abs() < 4.0 * (2.0 / n as f64).sqrt(), "{ratio}");
}

#[test]
fn a_sea_travels_where_it_should() {
    let waves = sea();
    assert_eq!(waves.waves.len(), 33);
    let mean: Vector2<f64> = waves.waves[1..].iter().map(Airy::along).sum::<Vector2<f64>>() / 32.0;
    // 60 degrees from north, reduced by the spread to 10/11; thirty-two directions leave a few per cent.
    let want = Vector2::new(math::sin(TAU / 6.0), math::cos(TAU / 6.0)) * (10.0 / 11.0);
    assert!((mean - want).norm() < 0.05, "{mean}");
    assert!(waves.waves[1..].windows(2).all(|w| w[0].omega() < w[1].omega()));
}
