//! Dye and hull are in one water: the plume's grid against the water itself, where the two differ most easily.

use super::water::{basin, no_plume, plume_in, pour, silent, source};
use crate::flow::WaterSpec;
use crate::flow::catalogue::CurrentSpec;
use crate::flow::tests::kit::{layer, of, rough, two_layers, uniform, wave};
use nalgebra::Vector3;
use world::area::Area;
use world::fields::Flow;
use world::obstacles::Obstacles;
use world::ranges::NonNegative;
use world::terrain::Terrain;
use world::units::Heading;

/// A basin of 100 m by 60 m with a beach up to some depth at its east end.
fn beach(shallow_m: f64) -> (Area, Terrain) {
    let area = Area { length_m: 100.0, width_m: 60.0, ..basin() };
    let bed = Terrain::sloping_over(&area, Heading::from_deg(90.0), shallow_m, 12.0);
    (area, bed)
}

/// A beach that levels off within a cell of the grid, with dye that drifts towards it: none is under the bed, at no
/// time, also not in the middle of a step.
#[test]
fn no_dye_lies_under_a_bed_that_bends() {
    let (area, beach) = beach(0.5);
    let mut spec = of(vec![uniform(0.1, 90.0)]);
    spec.mixing.horizontal_m2_s = NonNegative::new(0.002);
    spec.mixing.background_vertical_m2_s = NonNegative::new(0.01);
    let dye = source(1.0, 10.0, 0.001, 0.03).at(30.0, 0.0);
    let (water, mut plume) = plume_in(&spec, dye, &area, &beach, &Obstacles::default(), 1.0);
    plume.pace(0.0, 600.0, 30.0);
    let (mut shallow, mut beyond) = (0, 0);
    for n in 1..=200 {
        let t_s = 3.0 * f64::from(n);
        plume.advance(&water, t_s);
        for [x, y, z, ..] in plume.iter() {
            let bed = beach.bed_z(x, y);
            assert!(z >= bed - 1e-5, "{:.3} m under the bed at east {x:.1} m", bed - z);
            shallow += usize::from(x > 45.0);
            beyond += usize::from(x > 55.0);
        }
    }
    assert!(shallow > 1000 && beyond > 1000, "{shallow} {beyond}");
}

/// What goes with the current at a constant part of the depth does so over a bend of the bed, too: without mixing, at
/// every place, to rounding.
#[test]
fn dye_follows_the_bed_over_its_bends() {
    let (area, beach) = beach(2.0);
    let spec = of(vec![uniform(0.35, 90.0)]);
    let (water, mut plume) = plume_in(&spec, silent(0.1).at(0.0, 0.0), &area, &beach, &Obstacles::default(), 1.0);
    let part = |k: usize| 0.05 + 0.9 * (k as f64 / 99.0);
    let start = |k: usize| [-57.0 + 0.6 * k as f64, 5.0];
    pour(&mut plume, 100, -7.0, |k| {
        let [x, y] = start(k);
        [x, y, beach.bed_z(x, y) * part(k)]
    });
    // `pour` takes one bed for all.
    let store = &mut plume.stores_mut()[0];
    for n in 0..100 {
        store.bed[n] = beach.bed_z(f64::from(store.x[n]), f64::from(store.y[n])) as f32;
    }
    plume.drift_on(&water, 1.0, 0..150);
    assert_eq!(plume.len(), 100);
    for (k, [x, y, z, ..]) in plume.iter().enumerate() {
        let [from, _] = start(k);
        assert!((x - from - 52.5).abs() < 1e-2, "{x} from {from}");
        let at = z / beach.bed_z(x, y);
        assert!((at - part(k)).abs() < 1e-4, "{at} for {} at east {x} m", part(k));
    }
}

/// A wave of 25 m on an interface at mid-depth carries dye as it carries a hull: the paths of twenty filaments against
/// those of particles in the water itself.
#[test]
fn a_short_internal_wave_carries_dye_as_it_carries_a_hull() {
    for length_m in [25.0, 60.0] {
        let bed = Terrain::Level { depth_m: 10.0 };
        let period_s = 2.0 * length_m;
        let layers = [layer(0.0, 90.0, 1020.0), layer(0.0, 90.0, 1024.0)];
        let waves = vec![wave(0.5, length_m, period_s, 90.0, Some(0.0))];
        let spec = of(vec![CurrentSpec::new(two_layers(layers, 5.0, 2.0, waves))]);
        let (water, mut plume) = plume_in(&spec, silent(0.1), &basin(), &bed, &Obstacles::default(), 1.0);
        let start = |k: usize| Vector3::new(-20.0 + 2.0 * k as f64, 3.0, -5.0);
        pour(&mut plume, 20, -10.0, |k| start(k).into());
        let (dt, steps) = (0.5, (0.75 * period_s / 0.5) as u32);
        plume.drift_on(&water, dt, 0..steps);
        let mut worst = 0.0_f64;
        for (k, f) in plume.iter().enumerate() {
            let mut p = start(k);
            for n in 0..steps {
                let t = f64::from(n) * dt;
                let half = p + water.velocity(&p, t) * (0.5 * dt);
                p += water.velocity(&half, t + 0.5 * dt) * dt;
            }
            assert!((f[0] - p.x).abs() < 0.15, "east {} for {}", f[0], p.x);
            worst = worst.max((f[2] - p.z).abs());
        }
        // Of ±0.5 m: a fortieth because the wave is linear in a cell, and up to a twentieth because the interface, where
        // the water rises most, lies between two levels.
        assert!(worst < 0.05, "{worst} m in a wave of {length_m} m");
    }
}

/// Through an interface thinner than any level of the grid nothing mixes if nothing mixes in it.
#[test]
fn nothing_mixes_through_a_thin_interface() {
    let bed = Terrain::Level { depth_m: 20.0 };
    for thickness_m in [0.01, 0.1] {
        for depth_m in [4.0, 9.7] {
            let layers = [layer(0.2, 90.0, 1020.0), layer(0.2, 90.0, 1024.0)];
            let layers = CurrentSpec::new(two_layers(layers, depth_m, thickness_m, Vec::new()));
            let spec = WaterSpec { bed: rough(0.001, 5.0), ..of(vec![layers]) };
            let (water, mut p) = plume_in(&spec, silent(0.1), &basin(), &bed, &Obstacles::default(), 1.0);
            pour(&mut p, 2000, -20.0, |k| [-90.0, 0.0, -20.0 + 0.0075 * k as f64 * (20.0 - depth_m) / 16.0]);
            p.drift_on(&water, 1.0, 0..500);
            let top = p.iter().map(|f| f[2]).fold(f64::NEG_INFINITY, f64::max);
            assert!(top <= -depth_m + thickness_m, "dye at {top} m, interface at -{depth_m} m");
            assert!(top > -depth_m - 1.5, "dye stops at {top} m");
        }
    }
}

/// Over a rough bed the plume sees the law of the wall down to the roughness.
#[test]
fn dye_near_the_bed_moves_by_the_law_of_the_wall() {
    for depth_m in [2.0, 12.0, 200.0] {
        let bed = Terrain::Level { depth_m };
        let spec = WaterSpec { bed: rough(0.002, 5.0), ..of(vec![uniform(0.4, 90.0)]) };
        let (water, mut p) = plume_in(&spec, source(1.0, 1.0, 0.0, 0.1), &basin(), &bed, &Obstacles::default(), 1.0);
        p.drift(&water, 0.0, 1.0);
        for height_m in [0.003, 0.01, 0.02, 0.05, 0.1, 0.3, 1.0] {
            let at = Vector3::new(-90.0, 0.0, height_m - depth_m);
            let want = water.velocity(&at, 0.0).x;
            let [x, y, z] = p.grid.local(&at);
            let got = f64::from(p.grid.sample(x, y, z).velocity[0]);
            assert!((got / want - 1.0).abs() < 0.03, "{got} for {want}, {height_m} m over {depth_m} m");
        }
    }
}

/// The drift's own arithmetic has that law: a filament that nothing kicks.
#[test]
fn a_filament_near_the_bed_goes_as_far_as_the_law_says() {
    struct Wall;
    impl Flow for Wall {
        fn velocity(&self, p: &Vector3<f64>, _: f64) -> Vector3<f64> {
            let height_m = (p.z + 12.0).max(0.001);
            Vector3::new(0.05 * world::math::ln(height_m / 0.001), 0.0, 0.0)
        }
        fn log_layer(&self) -> Option<[f64; 2]> {
            Some([0.001, 12.0])
        }
    }
    let mut p = no_plume(12.0);
    let height = |k: usize| 0.002 + 0.002 * k as f64;
    pour(&mut p, 200, -12.0, |k| [-90.0, 0.0, height(k) - 12.0]);
    p.drift_on(&Wall, 1.0, 0..40);
    for (k, f) in p.iter().enumerate() {
        let want = 40.0 * Wall.velocity(&Vector3::new(0.0, 0.0, height(k) - 12.0), 0.0).x;
        let went = f[0] + 90.0;
        assert!((went / want - 1.0).abs() < 0.02, "{went} m for {want} m at {} m", height(k));
    }
}
