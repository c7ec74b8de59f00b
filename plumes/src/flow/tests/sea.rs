//! Tide and waves as parts of the whole water: what hulls feel and what the plume gets.

use nalgebra::{Vector2, Vector3};
use world::area::Area;
use world::fields::{Flow, Mixing};
use world::math;
use world::terrain::Terrain;
use world::units::Heading;

use super::kit::{of, rough, tide};
use crate::flow::catalogue::CurrentSpec;
use crate::flow::waves::tests::{regular, train};
use crate::flow::{Water, WaterSpec};

const BED: Terrain = Terrain::Level { depth_m: 10.0 };

fn area() -> Area {
    Area { centre: Vector2::zeros(), length_m: 500.0, width_m: 200.0, axis: Heading::from_deg(90.0) }
}

fn waves() -> CurrentSpec {
    CurrentSpec::new(regular(vec![train(0.4, 4.0, 70.0), train(0.2, 6.0, 10.0)]))
}

fn build(currents: Vec<CurrentSpec>) -> Water {
    WaterSpec { bed: rough(0.001, 8.0), ..of(currents) }.build(&area(), &BED, 3).unwrap()
}

#[test]
fn tide_is_slowed_by_the_bed_and_turns_with_time() {
    let water = build(vec![tide(0.05, 90.0)]);
    let at = |z: f64, t: f64| water.velocity(&Vector3::new(5.0, 6.0, z), t);
    let (top, low) = (at(-1.0, 4000.0), at(-9.9, 4000.0));
    // ln(0.1/0.001)/ln(8/0.001), the direction unchanged.
    let factor = math::ln(100.0) / math::ln(8000.0);
    assert!((low - top * factor).norm() < 1e-12);
    assert!(at(-1.0, 4000.0).x > 0.2 && at(-1.0, 4000.0 + 6.21 * 3600.0).x < -0.2);
    let later = (at(-1.0, 4001.0) - at(-1.0, 3999.0)) / 2.0;
    let rate = water.sample(&Vector3::new(5.0, 6.0, -1.0), 4000.0).rate;
    assert!((rate - later).norm() < 1e-9, "{rate} {later}");
}

#[test]
fn hull_feels_orbits_with_gradient_and_rate_and_the_plume_does_not() {
    let (calm, rough) = (build(vec![tide(0.05, 90.0)]), build(vec![tide(0.05, 90.0), waves()]));
    let waves = rough.waves().unwrap();
    let p = Vector3::new(12.0, -30.0, -1.5);
    let (s, still) = (rough.sample(&p, 500.0), calm.sample(&p, 500.0));
    let orbit = waves.velocity(&p, 500.0);
    assert!(orbit.norm() > 0.05);
    assert!((s.velocity - still.velocity - orbit).norm() < 1e-12);
    assert!((rough.velocity(&p, 500.0) - s.velocity).norm() < 1e-12);
    let rise = waves.velocity(&(p + Vector3::z() * 1e-4), 500.0) - orbit;
    assert!(((s.gradient - still.gradient).column(2) - rise / 1e-4).norm() < 1e-4);
    assert!((s.rate - still.rate).norm() > 0.05);
    // The plume's column has the drift instead, and does not depend on the phase.
    let mut out = [[(Vector3::zeros(), Mixing::default())]; 2];
    for (n, t) in [500.0, 500.4].into_iter().enumerate() {
        Flow::column(&rough, p.xy(), &[p.z], t, &mut out[n]);
    }
    let [u, k] = [out[0][0].0, Vector3::repeat(out[0][0].1.k_z_m2_s)];
    let drift = waves.drift(p.z);
    assert!((u - calm.velocity(&p, 500.0)).xy().metric_distance(&drift) < 1e-12);
    assert!((out[1][0].0 - u).norm() < 1e-4);
    let stirred = waves.vertical(p.z);
    assert!(stirred > 1e-4 && (k.x - calm.mixing(&p, 500.0).k_z_m2_s - stirred).abs() < 1e-12);
    assert_eq!(rough.displacement(&p, 500.0), Some(waves.displacement(&p, 500.0)));
    assert_eq!((calm.displacement(&p, 500.0), calm.head(&p, 500.0)), (None, 0.0));
}
