//! Exact tests of the eddies: free of divergence, tangent to every wall, with the stated strength and decay.

use super::stretch::{LENGTH, Shape, Stretch};
use super::{Eddies, EddiesSpec};
use crate::flow::Water;
use crate::flow::catalogue::CurrentSpec;
use crate::flow::channel::Channel;
use crate::flow::channel::open_channel::OpenChannelSpec;
use crate::flow::tests::kit::of;
use nalgebra::{Vector2, Vector3};
use world::area::Area;
use world::fields::Flow;
use world::ranges::{HeadingDeg, NonNegative, Positive};
use world::seeds::Stream;
use world::terrain::Terrain;
use world::units::Heading;

pub(crate) fn channel_spec(mean_m_s: f64, roughness_m: f64) -> OpenChannelSpec {
    OpenChannelSpec {
        mean_m_s: Positive::new(mean_m_s),
        heading_deg: HeadingDeg::new(90.0),
        roughness_m: NonNegative::new(roughness_m),
        viscosity_m2_s: Positive::new(1e-6),
        eddies: Some(EddiesSpec::default()),
    }
}

pub(crate) fn flume(length_m: f64) -> Area {
    Area { centre: Vector2::new(0.5 * length_m - 0.4, 0.0), length_m, width_m: 1.07, axis: Heading::from_deg(90.0) }
}

pub(crate) const BED: Terrain = Terrain::Level { depth_m: 0.2 };

pub(crate) fn water(length_m: f64, seed: u64) -> Water {
    of(vec![CurrentSpec::new(channel_spec(0.05, 0.0))]).build(&flume(length_m), &BED, seed).unwrap()
}

fn parts(seed: u64) -> (Channel, Eddies) {
    let water = water(2.5, seed);
    (*water.channel().unwrap(), water.eddies().unwrap().clone())
}

fn shape(cells: usize) -> Shape {
    let (_, eddies) = parts(1);
    Shape { up: cells, across: (1.07 / 0.2 * cells as f64).round() as usize, ..*eddies.shape() }
}

#[test]
fn nothing_goes_through_bed_surface_or_walls() {
    let (_, eddies) = parts(3);
    let mut r = Stream::new(1, "test", "walls");
    let mut strongest: f64 = 0.0;
    for _ in 0..2000 {
        let (x, t) = (3.0 * r.uniform(), 500.0 * r.uniform());
        let (y, z) = (1.07 * (r.uniform() - 0.5), -0.2 * r.uniform());
        for wall in [-0.535, 0.535] {
            let v = eddies.velocity(&Vector3::new(x, wall, z), t);
            assert!(v.y.abs() < 1e-9, "{v}");
        }
        for level in [-0.2, 0.0] {
            let v = eddies.velocity(&Vector3::new(x, y, level), t);
            assert!(v.z.abs() < 1e-9, "{v}");
            strongest = strongest.max(v.norm());
        }
    }
    assert!(strongest > 0.005, "it slips along them: {strongest}");
}

/// Differences at the nodes are second order in the spacing. The divergence that they show must fall with its square
/// when the same waves are put on a grid twice as fine.
#[test]
fn divergence_is_only_that_of_the_grid() {
    let part = |cells: usize| {
        let shape = shape(cells);
        let h = shape.spacing();
        let nodes = Stretch::new(&shape, 5, 1).nodes;
        let (row, sheet) = (shape.up + 1, (shape.up + 1) * LENGTH);
        let (mut left, mut all) = (0.0, 0.0);
        for i in 1..LENGTH - 1 {
            for j in 1..shape.across {
                for k in 1..shape.up {
                    let at = j * sheet + i * row + k;
                    let d = |step: usize, c: usize| f64::from(nodes[at + step][c] - nodes[at - step][c]) / (2.0 * h[c]);
                    let (x, y, z) = (d(row, 0), d(sheet, 1), d(1, 2));
                    left += (x + y + z) * (x + y + z);
                    all += x * x + y * y + z * z;
                }
            }
        }
        (left / all).sqrt()
    };
    let (coarse, fine) = (part(16), part(32));
    assert!(coarse < 0.25, "{coarse}");
    let order = coarse / fine;
    assert!((3.4..4.6).contains(&order), "{coarse} {fine}");
}

#[test]
fn what_a_check_asks_of_the_water_is_all_but_its_eddies() {
    let water = water(2.5, 4);
    let eddies = water.eddies().unwrap();
    let mut strongest: f64 = 0.0;
    for (n, z) in [-0.19, -0.1, -0.03].into_iter().enumerate() {
        let (p, t_s) = (Vector3::new(0.3 * n as f64, -0.1, z), 7.0 * n as f64);
        let without = water.velocity_without_eddies(&p, t_s);
        assert_eq!(without, water.velocity_without_eddies(&p, 0.0), "steady");
        let of_eddies = eddies.velocity(&p, t_s);
        assert_eq!(water.velocity(&p, t_s), without + of_eddies);
        strongest = strongest.max(of_eddies.norm());
    }
    assert!(strongest > 1e-3, "{strongest}");
}

#[test]
fn any_number_of_threads_draws_the_same_stretch() {
    let bits = |threads: usize| {
        let nodes = Stretch::new(&shape(12), 3, threads).nodes;
        nodes.concat().into_iter().map(f32::to_bits).collect::<Vec<_>>()
    };
    let one = bits(1);
    assert!(one.iter().any(|v| *v != 0));
    for threads in [0, 2, 3, 8, 100] {
        assert_eq!(bits(threads), one, "{threads} threads");
    }
}

/// Mean squares of eight stretches, compared with the expected ones within four standard errors found from the eight;
/// and the expected ones compared with Nezu & Nakagawa's in the middle of the water, where they were fitted as a mean.
#[test]
fn intensities_are_those_stated() {
    const SEEDS: u64 = 8;
    let (channel, eddies) = parts(1);
    let shape = shape(16);
    let levels = [2, 4, 6, 8, 10, 12, 14];
    let mut squares = vec![[[0.0; 3]; SEEDS as usize]; levels.len()];
    for seed in 0..SEEDS {
        let nodes = Stretch::new(&shape, seed, 2).nodes;
        for (l, level) in levels.iter().enumerate() {
            let mut sum = [0.0; 3];
            let mut count = 0.0;
            for (n, v) in nodes.chunks_exact(shape.up + 1).enumerate() {
                // The ends of the width count half.
                let j = n / LENGTH;
                let w = if j == 0 || j == shape.across { 0.5 } else { 1.0 };
                count += w;
                for c in 0..3 {
                    sum[c] += w * f64::from(v[*level][c]).powi(2);
                }
            }
            squares[l][seed as usize] = sum.map(|s| s / count);
        }
    }
    let resolved = eddies.spectrum().resolved();
    assert!((0.8..0.95).contains(&resolved), "{resolved}");
    let mut mean_ratio = [0.0; 3];
    for (l, level) in levels.iter().enumerate() {
        let height = 0.2 * *level as f64 / 16.0;
        let expected = shape.expected(height);
        for c in 0..3 {
            let of = |f: &dyn Fn(f64) -> f64| squares[l].iter().map(|s| f(s[c])).sum::<f64>() / SEEDS as f64;
            let mean = of(&|s| s);
            let error = (of(&|s| (s - mean) * (s - mean)) / (SEEDS - 1) as f64).sqrt();
            let want = expected[c] * expected[c];
            assert!(
                (mean - want).abs() < 4.0 * error + 1e-3 * want,
                "level {level}, component {c}: {mean} ± {error}, expected {want}"
            );
        }
        let stated = channel.intensities(height);
        for c in 0..3 {
            let ratio = expected[c] * channel.u_star_m_s / (stated[c] * resolved.sqrt());
            mean_ratio[c] += ratio / levels.len() as f64;
            let whole = (4..=12).contains(level);
            assert!(!whole || (0.8..1.25).contains(&ratio), "{height}: {c}: {ratio}");
        }
    }
    assert!(mean_ratio.iter().all(|r| (0.85..1.15).contains(r)), "{mean_ratio:?}");
}

/// In the frame that moves with the stream, the strength is the same at any time. After one period T, the mean of
/// sin(πp/2)·cos(πp/2) over its phase, 1/π, is left; after two, nothing.
#[test]
fn eddies_live_as_stated() {
    let (channel, first) = parts(0);
    let period = first.turn_over_s() * std::f64::consts::PI.powi(2) / 8.0;
    let n = 6000;
    let mut r = Stream::new(2, "test", "lives");
    let (mut square, mut one, mut two) = ([0.0; 2], 0.0, 0.0);
    let strength = first.intensities(0.08)[1].powi(2);
    for k in 0..n {
        let eddies = first.with_seed(k);
        let p = Vector3::new(2.0 * r.uniform(), r.uniform() - 0.5, -0.12);
        let t = 1000.0 * r.uniform();
        let at = |lag: f64| {
            let q = p + Vector3::new(channel.mean_m_s * lag, 0.0, 0.0);
            eddies.velocity(&q, t + lag).y
        };
        let (a, b, c) = (at(0.0), at(period), at(2.0 * period));
        square[0] += a * a / (n as f64 * strength);
        square[1] += b * b / (n as f64 * strength);
        one += a * b / (n as f64 * strength);
        two += a * c / (n as f64 * strength);
    }
    // Products of unit normals have standard errors of √2 and 1 over √n = 77. The one stretch from which all draw adds
    // about as much again to the squares (some 500 independent eddies at a height), as the test of intensities found.
    let error = 1.0 / (n as f64).sqrt();
    assert!((square[0] / square[1] - 1.0).abs() < 4.0 * 2.0 * error, "{square:?}");
    assert!((square[0] - 1.0).abs() < 4.0 * (2.0_f64 / 500.0).sqrt(), "{square:?}");
    assert!((one / square[0] - std::f64::consts::FRAC_1_PI).abs() < 4.0 * error, "{one}");
    assert!(two.abs() < 4.0 * error, "{two}");
}

#[test]
fn water_follows_from_the_seed_alone_however_time_is_cut() {
    let (mut once, mut often, other) = (water(2.5, 4), water(2.5, 4), water(2.5, 5));
    once.advance(70.0);
    for k in 0..=700 {
        often.advance(0.1 * f64::from(k));
    }
    let p = Vector3::new(0.7, 0.1, -0.15);
    assert_eq!(once.velocity(&p, 70.0), often.velocity(&p, 70.0));
    assert_ne!(once.velocity(&p, 70.0), other.velocity(&p, 70.0));
}

#[test]
fn places_are_carried_with_the_velocity_there() {
    let (_, eddies) = parts(6);
    let p = Vector3::new(0.3, -0.2, -0.08);
    let (mut x, mut y, mut z) = ([p.x as f32], [p.y as f32], [p.z as f32]);
    eddies.carry(33.0, &[0.05], Vector2::zeros(), [&mut x, &mut y, &mut z]);
    let v = eddies.velocity(&p, 33.0) * 0.05;
    let went = Vector3::new(f64::from(x[0]), f64::from(y[0]), f64::from(z[0])) - p;
    // Half a step ahead the water is 0.1 mm further on, with gradients of 0.5 1/s: 3e-6 m; f32 at 0.3 m: 3e-8 m.
    assert!((went - v).norm() < 3e-6 && v.norm() > 2e-5, "{went} {v}");
}
