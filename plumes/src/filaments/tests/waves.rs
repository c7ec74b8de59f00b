//! Dye under waves: mean places and the orbits about them, compared with the paths of particles in the waves
//! themselves.

use super::water::{basin, source};
use crate::filaments::displaced::DisplacedConcentration;
use crate::filaments::plume::{Plume, PlumeSettings};
use crate::flow::Water;
use crate::flow::catalogue::CurrentSpec;
use crate::flow::grid::GridShape;
use crate::flow::tests::kit::{of, uniform};
use crate::flow::waves::tests::{regular, train};
use nalgebra::Vector3;
use world::fields::{Concentration, Flow};
use world::ranges::NonNegative;
use world::terrain::Terrain;

const BED: Terrain = Terrain::Level { depth_m: 10.0 };
/// Height of the source above the bed, that is 1.5 m of depth. There, a wave of 0.3 m and 4 s has an orbit of radius
/// 0.104 m and a drift of 3.9 mm/s.
const HEIGHT: f64 = 8.5;

/// Waves along a current of 5 cm/s, without mixing.
fn water(stokes: bool) -> Water {
    let mut waves = regular(vec![train(0.3, 4.0, 90.0)]);
    waves.stokes = stokes;
    waves.mixing = NonNegative::new(0.0);
    of(vec![uniform(0.05, 90.0), CurrentSpec::new(waves)]).build(&basin(), &BED, 1).unwrap()
}

/// Filaments that neither grow nor spread, ten per second at equal intervals.
fn plume(water: &Water, until_s: f64) -> Plume {
    let mut thread = source(HEIGHT, 10.0, 0.0, 0.05);
    thread.release.poisson = false;
    let grid = GridShape { levels: 60, stretch: 0.0, ..GridShape::default() };
    let settings = PlumeSettings { grid, refresh_s: 10.0 };
    let mut plume = Plume::new(&[thread], &basin(), &BED, 1, settings).unwrap();
    plume.drift_on(water, 0.5, 0..(until_s / 0.5) as u32);
    plume
}

/// A particle released at the source at `from_s`, by Runge and Kutta's method through the orbits themselves.
fn particle(water: &Water, from_s: f64, to_s: f64) -> Vector3<f64> {
    let mut p = Vector3::new(-90.0, 0.0, -1.5);
    let steps = ((to_s - from_s) / 0.02).ceil();
    let h = (to_s - from_s) / steps;
    for n in 0..steps as u64 {
        let t = from_s + n as f64 * h;
        let a = water.velocity(&p, t);
        let b = water.velocity(&(p + a * (h / 2.0)), t + h / 2.0);
        let c = water.velocity(&(p + b * (h / 2.0)), t + h / 2.0);
        let d = water.velocity(&(p + c * h), t + h);
        p += (a + b * 2.0 + c * 2.0 + d) * (h / 6.0);
    }
    p
}

/// Greatest distance of some filaments, at 200 s, from particles released with them.
fn worst(stokes: bool) -> f64 {
    let water = water(stokes);
    let plume = plume(&water, 200.0);
    let all: Vec<_> = plume.places().collect();
    // The age of the n-th filament follows from its place in the row: the first interval begins at zero.
    let born = |n: usize| 200.0 - (all.len() - n) as f64 * 0.1;
    let offset = plume.len() as f64 * 0.1 - 200.0;
    assert!(offset.abs() <= 0.1, "{offset}");
    let mut worst: f64 = 0.0;
    for n in (0..all.len() - 1).step_by(133) {
        let there = all[n] + water.displacement(&all[n], 200.0).unwrap();
        // Released at most a tenth of a second apart, while the water moves at 16 cm/s at most.
        let off = [born(n), born(n) + 0.1].map(|from| (particle(&water, from, 200.0) - there).norm());
        worst = worst.max(off[0].min(off[1]));
    }
    worst
}

/// Second order in the steepness ak = 0.038: some ak of the orbit's 0.1 m, and U/c = 0.8 % of orbit and drift (0.8 m in
/// 200 s) for the Doppler shift by the current, together 2 cm. Without the drift, the dye lags by up to 0.78 m.
#[test]
fn mean_place_plus_orbit_is_where_particles_are() {
    let (with, without) = (worst(true), worst(false));
    assert!(with < 0.02, "{with}");
    assert!(without > 0.6, "{without}");
}

#[test]
fn a_probe_meets_the_dye_where_the_orbit_has_carried_it() {
    let water = water(true);
    let plume = plume(&water, 60.0);
    let mean = plume.places().nth(200).unwrap();
    for t in [60.0, 61.0, 62.3] {
        let way = water.displacement(&mean, t).unwrap();
        assert!(way.norm() > 0.09);
        let dye = DisplacedConcentration::new(&plume, &water, t);
        let (met, at_mean) = (dye.concentration(&(mean + way)), plume.concentration(&mean));
        // p − ξ(p) misses the mean place by ak of the orbit, 4 mm, compared with a size of 5 cm: 1 − exp(−0.08²/2).
        assert!((met / at_mean - 1.0).abs() < 0.02, "{met} {at_mean}");
    }
    // Without the orbits there would be nothing at this place half of the time: the dye rises and falls by two sizes.
    let up = Vector3::new(mean.x, mean.y, mean.z + 0.1);
    assert!(plume.concentration(&up) < 0.3 * plume.concentration(&mean));
}
