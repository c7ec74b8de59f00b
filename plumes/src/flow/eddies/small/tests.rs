//! Exact tests of the small eddies: free of divergence, as strong as the cascade, gone at bed and surface.

use super::{Small, SmallSpec};
use crate::flow::Water;
use crate::flow::catalogue::CurrentSpec;
use crate::flow::channel::Channel;
use crate::flow::channel::open_channel::OpenChannelSpec;
use crate::flow::eddies::EddiesSpec;
use crate::flow::eddies::tests_eddies::{BED, channel_spec, flume};
use crate::flow::tests::kit::of;
use crate::simd::f32x4::F32x4;
use world::math;
use world::ranges::Positive;
use world::seeds::Stream;

/// The water of the flume with eddies down to a length, m.
pub(crate) fn water(length_m: f64, finest_m: f64, seed: u64) -> Water {
    let spec = OpenChannelSpec {
        eddies: Some(EddiesSpec {
            small: Some(SmallSpec { finest_m: Positive::new(finest_m) }),
            ..EddiesSpec::default()
        }),
        ..channel_spec(0.05, 0.0)
    };
    of(vec![CurrentSpec::new(spec)]).build(&flume(length_m), &BED, seed).unwrap()
}

fn parts(finest_m: f64) -> (Channel, Small) {
    let water = water(2.5, finest_m, 1);
    let small = Small::clone(water.small().unwrap());
    (*water.channel().unwrap(), small)
}

/// Velocity at places that the mean shear alone has drawn out since the patterns began.
fn velocity(small: &Small, t_s: f64, shear: f32, p: [f32; 3]) -> [f32; 3] {
    let lives = small.lives(t_s);
    let label = |life: &super::Life| [p[0] - shear * life.age_s * (p[2] + 0.1), p[1], p[2]];
    let labels: Vec<[f32; 3]> = lives.iter().map(label).collect();
    let weights = small.weights(0.0, false);
    // SAFETY: a pair that every machine of the target has.
    unsafe { small.velocity::<[F32x4; 2]>(&lives, p[2], &weights, &labels) }
}

#[test]
fn nothing_gathers_in_them() {
    let (channel, small) = parts(0.0125);
    let mut rng = Stream::new(1, "test", "places");
    // In mid-depth, where the shear hardly changes, and just above the bed, where it is left out here: there the
    // strength changes fast.
    for (height, shear, within) in [(0.1, super::octave::shear(&channel)[128], 0.1), (0.004, 0.0, 0.35)] {
        let (mut gathers, mut slopes) = (0.0_f64, 0.0_f64);
        for _ in 0..3000 {
            let t = 20.0 * rng.uniform();
            let p = [rng.uniform() as f32, rng.uniform() as f32, (height - 0.2) as f32];
            let h = 4e-4_f32;
            let slope = |d: usize| {
                let (mut low, mut high) = (p, p);
                low[d] -= h;
                high[d] += h;
                let (a, b) = (velocity(&small, t, shear, low), velocity(&small, t, shear, high));
                [0, 1, 2].map(|c: usize| f64::from(b[c] - a[c]) / f64::from(2.0 * h))
            };
            let s = [slope(0), slope(1), slope(2)];
            gathers += (s[0][0] + s[1][1] + s[2][2]).powi(2);
            slopes += s.iter().flatten().map(|g| g * g).sum::<f64>();
        }
        let part = (gathers / slopes).sqrt();
        assert!(part < within, "{height}: {part}");
    }
}

#[test]
fn none_crosses_bed_or_surface() {
    let (_, small) = parts(0.0125);
    for n in 0..200 {
        let x = n as f32 * 0.037;
        for (z, most) in [(-0.2, 0.0), (0.0, 0.0), (-0.199_8, 5e-4), (-2e-4, 5e-4)] {
            assert!(velocity(&small, 3.0, 0.0, [x, 0.5 * x, z])[2].abs() <= most);
        }
    }
}

/// The longitudinal structure function at mid-depth: 4∫E(k)(1/3 − (sin kr − kr cos kr)/(kr)³)dk over the octaves (Batchelor
/// 1953, The Theory of Homogeneous Turbulence, section 3.4).
#[test]
fn as_strong_as_the_cascade() {
    let (channel, small) = parts(0.00625);
    let epsilon = channel.dissipation(0.1);
    let eta = (1e-18 / epsilon).sqrt().sqrt();
    let energy = |k: f64| {
        1.5 * math::powf(epsilon, 2.0 / 3.0)
            * math::powf(k, -5.0 / 3.0)
            * math::exp(-2.25 * math::powf(k * eta, 4.0 / 3.0))
    };
    let (low, high) = (std::f64::consts::TAU / 0.05, std::f64::consts::TAU / 0.00625);
    for r in [0.002_f64, 0.005, 0.01, 0.02] {
        let want: f64 = (0..4000)
            .map(|n| low + (high - low) * (f64::from(n) + 0.5) / 4000.0)
            .map(|k| {
                let x = k * r;
                4.0 * energy(k) * (1.0 / 3.0 - (math::sin(x) - x * math::cos(x)) / (x * x * x))
            })
            .sum::<f64>()
            * (high - low)
            / 4000.0;
        let mut rng = Stream::new(2, "test", "pairs");
        let (mut sum, mut count) = (0.0, 0.0);
        for _ in 0..1500 {
            let t = 200.0 * rng.uniform();
            let p = [rng.uniform() as f32, rng.uniform() as f32, -0.1];
            // Along x or y, where nothing but the patterns differs.
            for d in 0..2 {
                let mut q = p;
                q[d] += r as f32;
                let (a, b) = (velocity(&small, t, 0.0, p), velocity(&small, t, 0.0, q));
                sum += f64::from(b[d] - a[d]).powi(2);
                count += 1.0;
            }
        }
        // The shear draws u_x out, by up to 0.2 of w in 5 s; trilinear reading smooths the shortest waves.
        let got = sum / count;
        assert!((got / want - 1.0).abs() < 0.2, "{r}: {got:.3e} {want:.3e}");
    }
}

#[test]
fn kernels_feel_only_what_is_larger() {
    let (_, small) = parts(0.00625);
    let rms = |size: f32| {
        let mut sum = 0.0;
        for n in 0..500 {
            let x = n as f32 * 0.0371;
            let lives = small.lives(2.0);
            let labels = vec![[x, 0.3 * x, -0.1]; lives.len()];
            let weights = small.weights(size, false);
            // SAFETY: a pair that every machine of the target has.
            let v = unsafe { small.velocity::<[F32x4; 2]>(&lives, -0.1, &weights, &labels) };
            sum += v.iter().map(|v| v * v).sum::<f32>();
        }
        sum.sqrt()
    };
    let (point, small_kernel, large) = (rms(0.0), rms(0.001), rms(0.01));
    assert!(small_kernel < point && small_kernel > 0.9 * point);
    assert!(large < 0.2 * point, "{large} {point}");
}

#[test]
fn finer_scales_have_more_patterns() {
    for (finest_m, patterns) in [(0.0125, 4), (0.01, 6)] {
        assert_eq!(parts(finest_m).1.patterns(), patterns);
    }
}
