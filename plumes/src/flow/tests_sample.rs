//! A hull's sample of the water beside differences of its velocity.

use nalgebra::{Vector2, Vector3};
use world::fields::Flow;
use world::math;
use world::ranges::{Finite, HeadingDeg, NonNegative, Positive};
use world::terrain::Terrain;

use super::tests_water::{duck, duck_area, duck_bed, layer, places, wave};
use crate::flow::catalogue::CurrentSpec;
use crate::flow::layered::{InterfaceSpec, LayeredSpec};
use crate::flow::plane_current::PlaneCurrent;
use crate::flow::tide::{ConstituentSpec, TideSpec};
use crate::flow::uniform::UniformSpec;
use crate::flow::{Water, WaterSpec};

/// A current of which the water knows nothing but its values.
#[derive(Clone, Debug)]
struct Turning;

impl PlaneCurrent for Turning {
    fn velocity(&self, p: Vector2<f64>, t_s: f64) -> Vector2<f64> {
        let (sin, cos) = math::sin_cos(0.01 * p.x - 0.02 * p.y + 0.005 * t_s);
        Vector2::new(0.1 * sin, 0.05 * cos)
    }
}

/// Slopes are those of central differences, and the velocity is the same to the last bit: over a slope and a
/// level bed, with every kind of current, inside the boundary layer, inside the interface and above it.
#[test]
fn sample_agrees_with_differences() {
    struct Plain(Water);
    impl Flow for Plain {
        fn velocity(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
            self.0.velocity(p, t_s)
        }
        fn density(&self, p: &Vector3<f64>, t_s: f64) -> f64 {
            self.0.density(p, t_s)
        }
    }
    let mut tidal = duck();
    tidal.currents.push(CurrentSpec::new(TideSpec {
        constituents: vec![ConstituentSpec {
            period_h: Positive::new(12.42),
            major_m_s: NonNegative::new(0.3),
            minor_m_s: Finite::new(0.1),
            heading_deg: HeadingDeg::new(30.0),
            phase_deg: Finite::new(40.0),
        }],
    }));
    tidal
        .currents
        .push(CurrentSpec::new(UniformSpec { speed_m_s: NonNegative::new(0.2), heading_deg: HeadingDeg::new(100.0) }));
    let mut layers_only = duck();
    layers_only.currents.pop();
    for (spec, bed) in [(&duck(), duck_bed()), (&tidal, duck_bed()), (&layers_only, Terrain::Level { depth_m: 6.0 })] {
        let mut w = spec.build(&duck_area(), &bed, 7).unwrap();
        w.free.add(Turning);
        // Between two levels of the meander, where its slope in time has no kink.
        w.advance(301.3);
        let plain = Plain(w.clone());
        for (n, p) in places(400).enumerate() {
            let part = 0.02 + 0.96 * (n as f64 * 0.618_034).fract();
            let p = Vector3::new(p.x, p.y, w.column(p, 301.3).bed_z() * part);
            let (a, b) = (w.sample(&p, 301.3), plain.sample(&p, 301.3));
            assert_eq!((a.velocity, a.density_kg_m3), (b.velocity, b.density_kg_m3));
            // Differences over 2 mm: their truncation beside the interface and the bed, and at a kink half the step.
            let scale = 1e-5 * (1.0 + b.gradient.norm());
            assert!((a.gradient - b.gradient).norm() < scale, "{p}: {} {}", a.gradient, b.gradient);
            assert!((a.rate - b.rate).norm() < 1e-6, "{p}: {} {}", a.rate, b.rate);
        }
    }
}

#[test]
fn layers_are_numbers_however_far_from_a_thin_interface() {
    for (depth_m, interface_m, thickness_m) in [(200.0, 10.0, 1.0), (10.0, 1.0, 0.03), (400.0, 9.0, 1e-4)] {
        let layers = LayeredSpec {
            layers: vec![layer(0.2, 90.0, 1023.0), layer(0.1, 90.0, 1026.0)],
            interfaces: vec![InterfaceSpec {
                depth_m: Positive::new(interface_m),
                thickness_m: Positive::new(thickness_m),
                waves: vec![wave(0.1, 50.0, 100.0, 90.0, Some(20.0))],
            }],
        };
        let spec = WaterSpec { currents: vec![CurrentSpec::new(layers)], ..WaterSpec::default() };
        let bed = Terrain::Level { depth_m };
        let water = spec.build(&duck_area(), &bed, 7).unwrap();
        for k in 0..=1000 {
            let z = -depth_m * f64::from(k) / 1000.0;
            let s = water.sample(&Vector3::new(3.0, 4.0, z), 5.0);
            let all = (s.velocity.iter().chain(&s.gradient).chain(&s.rate)).chain([&s.density_kg_m3]);
            assert!(all.into_iter().all(|v| v.is_finite()), "{s:?} at {z} m of {depth_m} m");
            let far = (z + interface_m).abs() > 1.0 + 10.0 * thickness_m;
            let density = if z > -interface_m { 1023.0 } else { 1026.0 };
            assert!(!far || (s.density_kg_m3 - density).abs() < 1e-9, "{s:?} at {z} m");
        }
    }
}
