//! Tests of the particle filter.

use super::*;
use crate::map::testing;

fn filter(particles: u32) -> ParticleFilter {
    let spec = ParticleFilterSpec { particles, ..ParticleFilterSpec::default() };
    let grid = spec.grid.build(&testing::paper_area()).expect("grid");
    ParticleFilter::new(&spec, grid, Stream::new(5, "auv0", "map")).expect("filter")
}

#[test]
fn systematic_resampling_keeps_each_particle_near_its_share() {
    let mut f = filter(1000);
    f.spec.roughening = NonNegative::new(0.0);
    f.spec.resample_below = Fraction::new(1.0);
    let total = 1000.0 * 1001.0 / 2.0;
    for (i, w) in f.weights.iter_mut().enumerate() {
        *w = (i + 1) as f64 / total;
    }
    let (places, weights) = (f.places.clone(), f.weights.clone());
    f.resample_if_worn();
    for (place, w) in places.iter().zip(weights) {
        let copies = f.places.iter().filter(|p| *p == place).count() as f64;
        // The property that makes it systematic: floor or ceiling of N·w.
        assert!((copies - 1000.0 * w).abs() <= 1.0 + 1e-9);
    }
}

/// Each update's map is that of the weights by eqs. 1 and 2, one release after the other at each particle's place.
#[test]
fn the_map_is_that_of_the_equations_written_out() {
    let mut f = filter(500);
    f.spec.trajectory.merge = Fraction::new(0.0);
    f.spec.trajectory.lookback_s = Positive::new(80.0);
    let grid = f.with.grid.clone();
    f.kernel = Kernel::new(&grid, &f.spec.trajectory);
    f.with.watch.history = f.spec.trajectory.history(1.0);
    let mut plume = testing::ToyPlume::slow();
    let mut detections = 0;
    for t in 1..=300 {
        let seen = plume.seen(f64::from(t));
        let mut old = f.clone();
        f.step(&seen);
        let Some(sighting) = old.with.watch.step(&seen) else {
            continue;
        };
        let at = grid.local_centre(sighting.cell);
        let [sx, sy, _] = f.spec.trajectory.sigmas();
        for (place, w) in old.places.iter().zip(&mut old.weights) {
            let mut gamma = 1.0;
            for (age, s) in old.with.watch.history.releases() {
                let (dx, dy) = (at[0] - place[0] - s[0], at[1] - place[1] - s[1]);
                let d2 = dx * dx / (sx * sx) + dy * dy / (sy * sy);
                let top = grid.cell_m[0] * grid.cell_m[1] / (std::f64::consts::TAU * age * sx * sy);
                gamma *= 1.0 - 0.9 * (top * math::exp(-0.5 * d2 / age)).min(1.0);
            }
            *w *= if sighting.detected { 1e-6 + (1.0 - 1e-6) * (1.0 - gamma) } else { gamma.max(1e-6) };
        }
        let total: f64 = old.weights.iter().sum();
        detections += u32::from(sighting.detected);
        if sighting.detected && total < 0.01 {
            // The particles were drawn anew.
            continue;
        }
        old.weights.iter_mut().for_each(|w| *w /= total);
        old.onto_grid(sighting.t_s, sighting.detected);
        for (p, wanted) in f.belief().p.iter().zip(old.belief().p.iter()) {
            assert!((p - wanted).abs() < 1e-8, "{t}: {p} {wanted}");
        }
    }
    assert!(detections > 5, "{detections}");
}

#[test]
fn roughened_particles_stay_in_the_area() {
    for x in [-250.0, -1.0, 0.0, 50.0, 100.0, 101.0, 730.0] {
        assert!((0.0..=100.0).contains(&within(x, 100.0)));
    }
    assert!((within(-3.0, 100.0) - 3.0).abs() < 1e-12);
    assert!((within(103.0, 100.0) - 97.0).abs() < 1e-12);
}
