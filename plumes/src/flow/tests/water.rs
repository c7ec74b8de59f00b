//! The whole water: bed, interfaces, stratification, mixing and the remaining divergence.

use nalgebra::{Vector2, Vector3};
use world::area::Area;
use world::fields::Flow;
use world::ranges::{NonNegative, Positive};
use world::seeds::Stream;
use world::terrain::Terrain;
use world::units::Heading;

use super::kit::{layer, meander, rough, two_layers, uniform, wave};
use crate::flow::catalogue::CurrentSpec;
use crate::flow::layered::LayeredSpec;
use crate::flow::mixing::MixingSpec;
use crate::flow::{Water, WaterSpec};

/// The area off Duck (Pang 2009, section 6).
pub(crate) fn duck_area() -> Area {
    Area { centre: Vector2::zeros(), length_m: 1094.0, width_m: 367.0, axis: Heading::from_deg(340.0) }
}

pub(crate) fn duck_bed() -> Terrain {
    Terrain::sloping_over(&duck_area(), Heading::from_deg(250.0), 4.0, 8.0)
}

pub(crate) fn duck_layers() -> LayeredSpec {
    let waves = vec![wave(0.3, 420.0, 1900.0, 250.0, None), wave(0.15, 260.0, 1200.0, 310.0, Some(70.0))];
    two_layers([layer(0.22, 350.0, 1020.0), layer(0.12, 158.0, 1024.0)], 1.8, 0.8, waves)
}

pub(crate) fn duck() -> WaterSpec {
    WaterSpec {
        currents: vec![CurrentSpec::new(duck_layers()), meander(0.02, 0.02, 25.0)],
        bed: rough(0.001, 2.0),
        mixing: MixingSpec { horizontal_m2_s: NonNegative::new(0.01), ..MixingSpec::default() },
        ..WaterSpec::default()
    }
}

fn build(spec: &WaterSpec) -> Water {
    spec.build(&duck_area(), &duck_bed(), 7).unwrap()
}

/// Places inside the area.
pub(crate) fn places(n: u32) -> impl Iterator<Item = Vector2<f64>> {
    let mut rng = Stream::new(9, "test", "places");
    (0..n).map(move |_| {
        let local = Vector2::new(rng.uniform() - 0.5, rng.uniform() - 0.5);
        duck_area().world(local.component_mul(&Vector2::new(1090.0, 363.0)))
    })
}

#[test]
fn by_default_the_water_is_still() {
    let w = build(&WaterSpec::default());
    let p = Vector3::new(10.0, 20.0, -3.0);
    assert_eq!(w.velocity(&p, 5.0), Vector3::zeros());
    assert_eq!(w.density(&p, 5.0), 1026.0);
    assert_eq!(w.mixing(&p, 5.0).k_z_m2_s, 0.0);
}

#[test]
fn flow_is_tangent_to_the_bed_and_the_surface() {
    // Without friction, so that there is a flow at the bed that can be tangent.
    let w = build(&WaterSpec { bed: None, ..duck() });
    for p in places(300) {
        let column = w.column(p, 0.0);
        let n = duck_bed().normal(p.x, p.y);
        let u = column.velocity(column.bed_z());
        assert!(u.norm() > 0.01 && u.dot(&n).abs() < 1e-12, "{u}");
        assert_eq!(column.velocity(0.0).z, 0.0);
        // Below the bed and above the surface, the values at them apply.
        assert_eq!(column.velocity(column.bed_z() - 3.0), u);
        assert_eq!(column.velocity(4.0), column.velocity(0.0));
    }
}

/// With friction the water stands at the bed, and lighter water lies above. No mixing is negative, and there is none at
/// bed and surface.
#[test]
fn columns_stand_on_the_bed_with_the_lightest_on_top() {
    let w = build(&duck());
    for p in places(100) {
        let column = w.column(p, 0.0);
        let u_star = column.friction_velocity();
        assert_eq!(column.velocity(column.bed_z()), Vector3::zeros());
        let at = |n: u32| column.bed_z() * (f64::from(n) / 100.0);
        let k = |n: u32| column.mixing(at(n), u_star).k_z_m2_s;
        let rho = |n: u32| column.density(at(n));
        assert!((0..100).all(|n| k(n) >= 0.0 && rho(n) <= rho(n + 1)));
        assert_eq!((k(0), k(100)), (0.0, 0.0));
        assert!(u_star > 0.0 && k(70) > 0.0 && rho(0) < 1020.1 && rho(100) > 1023.9);
    }
}

/// The interface moves, and the water with it: w = ∂η/∂t + u·∇η, checked by differences of its height.
#[test]
fn interface_moves_and_water_goes_with_it() {
    let w = build(&duck());
    let height = |p: Vector2<f64>, t: f64| w.column(p, t).interfaces()[0].z;
    for p in places(100) {
        let (t, e) = (3.0, 0.1);
        let eta = height(p, t);
        let (dx, dy) = (Vector2::new(e, 0.0), Vector2::new(0.0, e));
        let slope =
            Vector2::new(height(p + dx, t) - height(p - dx, t), height(p + dy, t) - height(p - dy, t)) / (2.0 * e);
        let rate = (height(p, t + e) - height(p, t - e)) / (2.0 * e);
        let u = w.column(p, t).velocity(eta);
        // Error of the differences: e²/6 of a third derivative, below 1e-8.
        assert!((u.z - rate - u.xy().dot(&slope)).abs() < 1e-7);
    }
    let here = |t: u32| height(Vector2::zeros(), f64::from(t) * 20.0);
    let (low, high) = (0..400).map(here).fold((0.0_f64, -9.0_f64), |(l, h), z| (l.min(z), h.max(z)));
    // Sum of the amplitudes 0.45 m about −1.8 m.
    assert!(low >= -2.25 && high <= -1.35 && high - low > 0.6, "{low} {high}");
}

#[test]
fn an_interface_keeps_off_bed_and_surface() {
    let mut layers = duck_layers();
    layers.interfaces[0].depth_m = Positive::new(5.9);
    layers.interfaces[0].waves[0].amplitude_m = NonNegative::new(1.0);
    let w = build(&WaterSpec { currents: vec![CurrentSpec::new(layers)], ..duck() });
    let mut touched = 0;
    for p in places(300) {
        let column = w.column(p, 0.0);
        let part = column.interfaces()[0].z / column.bed_z();
        assert!((0.02 - 1e-12..=0.98 + 1e-12).contains(&part), "{part}");
        touched += u32::from(part > 0.979);
        assert!(column.velocity(column.bed_z() * 0.97).iter().all(|v| v.is_finite()));
    }
    assert!(touched > 20, "{touched}");
}

/// Over the water, 1/s: largest divergence, its root mean square, and that of the horizontal part alone.
fn divergence(spec: &WaterSpec, bed: &Terrain) -> [f64; 3] {
    let w = spec.build(&duck_area(), bed, 7).unwrap();
    let (mut worst, mut sum, mut flat): (f64, f64, f64) = (0.0, 0.0, 0.0);
    for (k, p) in places(2000).enumerate() {
        let z = w.column(p, 0.0).bed_z() * (0.01 + 0.98 * (k as f64 * 0.618_034).fract());
        let g = w.sample(&Vector3::new(p.x, p.y, z), 100.0).gradient;
        let (all, level) = (g.trace(), g[(0, 0)] + g[(1, 1)]);
        worst = worst.max(all.abs());
        sum += all * all / 2000.0;
        flat += level * level / 2000.0;
    }
    [worst, sum.sqrt(), flat.sqrt()]
}

#[test]
fn divergence_is_what_the_files_say() {
    let level_bed = Terrain::Level { depth_m: 6.0 };
    // A meander over a level bed: none at all, boundary layer included (rounding over 2 mm).
    let mut meander = duck();
    meander.currents.remove(0);
    assert!(divergence(&meander, &level_bed)[0] < 1e-9);
    // Layers with waves over a level bed. The layers' thickness changes at up to Σ 2πa/(T h) = 1.0e-3 above and 0.4e-3
    // below; tanh and straight line differ by at most half of the sum in the interface.
    let [worst, rms, horizontal] = divergence(&duck(), &level_bed);
    assert!(worst < 1.0e-3 && rms < 1.5e-4 && rms < 0.5 * horizontal, "{worst} {rms} {horizontal}");
    // Over the slope u·∇H/H = 0.1·0.011/6 = 2e-4 is added, and the lower layer is half as thick inshore.
    let [worst, rms, horizontal] = divergence(&duck(), &duck_bed());
    assert!(worst < 1.5e-3 && rms < 1.5e-4 && rms < 0.5 * horizontal, "{worst} {rms} {horizontal}");
}

/// A smooth flume of 20 cm at 5 cm/s (Webster, Volyanskyy & Weissburg 2012): u_* = 2.8 mm/s with z0 = ν/(9u_*) = 0.04
/// mm over the whole depth; then K_y = 0.15 u_*H = 8.4e-5 and the depth mean of K_z is κu_*H/6 = 3.7e-5 m²/s.
#[test]
fn a_flume_has_its_friction_and_mixing() {
    let spec = WaterSpec {
        currents: vec![uniform(0.0596, 90.0)],
        bed: rough(4e-5, 0.2),
        mixing: MixingSpec { transverse: NonNegative::new(0.15), ..MixingSpec::default() },
        ..WaterSpec::default()
    };
    let bed = Terrain::Level { depth_m: 0.2 };
    let w = spec.build(&duck_area(), &bed, 1).unwrap();
    let column = w.column(Vector2::zeros(), 0.0);
    let u_star = column.friction_velocity();
    let (mut u, mut k_z) = (0.0, 0.0);
    for k in 0..1000 {
        let z = -0.2 * (f64::from(k) + 0.5) / 1000.0;
        u += column.velocity(z).x / 1000.0;
        k_z += column.mixing(z, u_star).k_z_m2_s / 1000.0;
    }
    assert!((u_star - 0.0028).abs() < 2e-5, "{u_star}");
    // Mean of the log law: u_*/κ (ln(H/z0) − 1).
    assert!((u - 0.0526).abs() < 2e-4, "{u}");
    assert!((k_z - 3.73e-5).abs() < 3e-7, "{k_z}");
    assert!((column.mixing(-0.1, u_star).k_h_m2_s - 8.4e-5).abs() < 5e-7);
}

/// Just under the interface, the same shear with the full density step and with a hundredth of it.
#[test]
fn stratification_damps_mixing_at_the_interface() {
    let with_lower = |density: f64| {
        let mut layers = duck_layers();
        layers.layers[1].density_kg_m3 = Positive::new(density);
        build(&WaterSpec { currents: vec![CurrentSpec::new(layers)], ..duck() })
    };
    let (strong, weak) = (with_lower(1024.0), with_lower(1020.04));
    for p in places(50) {
        let z = strong.column(p, 0.0).interfaces()[0].z - 0.3;
        let k = |w: &Water| w.mixing(&Vector3::new(p.x, p.y, z), 0.0).k_z_m2_s;
        assert!(k(&strong) > 0.0 && k(&strong) < 0.5 * k(&weak));
    }
}

#[test]
fn phases_come_from_the_seed_or_the_file() {
    let at = |seed| {
        let w = duck().build(&duck_area(), &duck_bed(), seed).unwrap();
        w.column(Vector2::zeros(), 0.0).interfaces()[0].z
    };
    assert_eq!(at(1), at(1));
    assert_ne!(at(1), at(2));
}
