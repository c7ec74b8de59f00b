//! Filaments in a channel: none is lost, mixed water stays mixed, and they spread as Taylor and Fischer state.

use super::water::{moments, pour, source};
use crate::filaments::plume::{Plume, PlumeSettings};
use crate::flow::Water;
use crate::flow::eddies::tests_eddies::{BED, flume, water};
use crate::flow::eddies::tests_small;
use crate::flow::grid::GridShape;
use crate::release::{BuoyancySpec, NozzleSpec, ReleaseSpec, SourceSpec};
use std::collections::BTreeMap;
use world::fields::Flow;
use world::ranges::{Finite, Fraction, Positive};
use world::seeds::Stream;

pub(super) fn plume(length_m: f64, seed: u64) -> Plume {
    of(nozzle(), length_m, seed)
}

/// A release 7 kg/m³ lighter than the water.
pub(super) fn light(length_m: f64, seed: u64) -> Plume {
    let mut source = nozzle();
    source.release.buoyancy = BuoyancySpec::Excess(Finite::new(-7.0));
    of(source, length_m, seed)
}

/// A neutral thread with a share of its structure.
pub(in crate::filaments) fn structured(share: f64, length_m: f64, seed: u64) -> Plume {
    let mut source = nozzle();
    source.release.buoyancy = BuoyancySpec::Excess(Finite::new(0.0));
    source.release.structure = Fraction::new(share);
    of(source, length_m, seed)
}

fn nozzle() -> SourceSpec {
    let release = ReleaseSpec {
        eddy_size_m: Some(Positive::new(0.008)),
        nozzle: Some(NozzleSpec { diameter_m: Positive::new(0.0042), speed_m_s: Positive::new(0.05) }),
        ..ReleaseSpec::default()
    };
    SourceSpec { rate_g_s: Positive::new(0.032557), release, ..source(0.038, 1.0, 0.0, 0.1).at(0.0, 0.0) }
}

fn of(source: SourceSpec, length_m: f64, seed: u64) -> Plume {
    let area = flume(length_m);
    let settings = PlumeSettings { grid: GridShape::fitting(&area), refresh_s: 1e6 };
    Plume::new(&[source], &area, &BED, seed, settings).unwrap()
}

#[test]
fn nobody_leaves_but_down_stream_and_mass_is_kept() {
    let (water, mut plume) = (water(2.5, 2), plume(2.5, 2));
    for n in 0..480 {
        plume.drift_on(&water, 0.25, n..n + 1);
        assert!(plume.iter().all(|f| f[1].abs() <= 0.535_001 && (-0.2..=0.0).contains(&f[2])));
    }
    // d/4 = 1.05 mm at 5 cm/s: one filament every 21 ms.
    assert_eq!(plume.released(), (120.0_f64 / 0.021).floor() as u64);
    assert!(plume.left() > 2000);
    assert_eq!(plume.len() as u64 + plume.left(), plume.released());
    let kept = plume.mass_in_kg() + plume.mass_left_kg();
    assert!((kept / plume.mass_released_kg() - 1.0).abs() < 1e-9);
    // 47 g/L through the nozzle: 32.6 mg/s.
    assert!((plume.mass_released_kg() - 120.0 * 3.2557e-5).abs() < 1e-6);
}

/// A cloud that is even over the whole channel, for 30 s, as long as its middle is still between the ends; `t` is when
/// it was poured.
fn mixed(water: &Water, seed: u64, dt_s: f64) -> Vec<[f64; 5]> {
    let mut plume = plume(8.0, seed).carried_by(water.small());
    plume.drift(water, -1e-9, 0.0);
    let mut r = Stream::new(seed, "test", "even");
    pour(&mut plume, 40_000, -0.2, |_| {
        let across = 1.07 * (r.uniform() - 0.5);
        [7.6 * r.uniform() - 0.2, across, -0.2 * r.uniform()]
    });
    // They were not released by the source.
    if let Some(labels) = &mut plume.stores_mut()[0].labels {
        labels.begin();
    }
    plume.drift_on(water, dt_s, 0..(30.0 / dt_s) as u32);
    // Only the poured filaments: they have no kernel of their own. Those of the source lie behind the middle part.
    plume.iter().filter(|f| (2.0..7.0).contains(&f[0])).collect()
}

#[test]
fn mixed_water_stays_mixed() {
    let coarse = water(8.0, 3);
    let fine = tests_small::water(8.0, 0.00625, 3);
    for (water, dt) in [(&coarse, 0.25), (&fine, 0.2)] {
        let cloud = mixed(water, 3, dt);
        for (axis, low, high, bins) in [(1, -0.535, 0.535, 10), (2, -0.2, 0.0, 10)] {
            let mut counts = vec![0.0_f64; bins];
            for f in &cloud {
                let s = (f[axis] - low) / (high - low) * bins as f64;
                counts[(s as usize).min(bins - 1)] += 1.0;
            }
            let even = cloud.len() as f64 / bins as f64;
            // Poisson counts of about 2500 have 2 % of noise; four of these, plus 3 % for the divergence of the
            // trilinear look-up.
            let worst = counts.iter().fold(0.0_f64, |w, c| w.max((c / even - 1.0).abs()));
            assert!(worst < 0.11, "dt {dt}, axis {axis}: {worst}: {counts:?}");
        }
        // Nor do they gather in small places: the counts of cubes of 5 cm scatter as those of a Poisson process.
        let mut cubes = BTreeMap::<[i32; 3], f64>::new();
        for f in &cloud {
            let cube = [f[0], f[1] + 0.535, f[2]].map(|p| (p / 0.05).floor() as i32);
            *cubes.entry(cube).or_default() += 1.0;
        }
        let (mean, many) = moments(cubes.values().copied());
        assert!((many / mean) < 1.6, "dt {dt}: {}", many / mean);
    }
}

/// Absolute spread of filaments that start all over the middle of the channel. Resolved eddies and the remaining
/// diffusivity together are compared with Fischer's 0.15 u_*H and Elder's depth mean 0.067 u_*H.
#[test]
fn spread_is_that_of_open_channels() {
    let water = water(8.0, 9);
    let u_star_h = water.channel().unwrap().u_star_m_s * 0.2;
    let mut plume = plume(8.0, 9);
    plume.drift(&water, -1e-9, 0.0);
    let n = 4000;
    let mut r = Stream::new(7, "test", "spread");
    let mut start = Vec::new();
    pour(&mut plume, n, -0.2, |_| {
        start.push(0.4 * (r.uniform() - 0.5));
        [4.0 * r.uniform(), *start.last().unwrap(), -0.2 * r.uniform()]
    });
    let mut variance = [0.0; 2];
    for (k, until) in [80, 160].into_iter().enumerate() {
        plume.drift_on(&water, 0.25, until - 80..until);
        let went = plume.iter().zip(&start).map(|(f, y)| f[1] - y);
        variance[k] = went.map(|d| d * d).sum::<f64>() / n as f64;
    }
    // From 20 to 40 s. About 350 eddies of 12 cm fill the 5 m by 1 m: a standard error of 8 % of each variance, about
    // 20 % of K.
    let k = (variance[1] - variance[0]) / 40.0;
    let ratio = k / (0.15 * u_star_h);
    assert!((0.5..2.0).contains(&ratio), "K_y {k}, {ratio} of Fischer's");
    // While it remembers its velocity, a filament keeps it: variance below 2Kt.
    assert!(variance[0] < 2.0 * k * 20.0, "{variance:?}");
    assert!(water.mixing(&nalgebra::Vector3::new(1.0, 0.0, -0.1), 0.0).k_h_m2_s < 0.5 * k);
}
