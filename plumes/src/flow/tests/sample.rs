//! A hull's sample of the water beside differences of its velocity.

use nalgebra::{Vector2, Vector3};
use world::fields::Flow;
use world::terrain::Terrain;

use super::kit::{layer, of, tide, two_layers, uniform, wave};
use super::water::{duck, duck_area, duck_bed, places};
use crate::flow::catalogue::CurrentSpec;
use crate::flow::number::{Jet, Number};
use crate::flow::plane_current::PlaneCurrent;
use crate::flow::{Water, WaterSpec};

/// A current of which the water knows nothing but its values.
#[derive(Clone, Debug)]
struct Turning;

/// The same with slopes of its own.
#[derive(Clone, Debug)]
struct TurningWithSlopes;

impl TurningWithSlopes {
    fn at<N: Number>(p: Vector2<N>, t_s: N) -> Vector2<N> {
        let (sin, cos) = (p.x * 0.01 - p.y * 0.02 + t_s * 0.005).sin_cos();
        Vector2::new(sin * 0.1, cos * 0.05)
    }
}

impl PlaneCurrent for Turning {
    fn velocity(&self, p: Vector2<f64>, t_s: f64) -> Vector2<f64> {
        TurningWithSlopes::at(p, t_s)
    }
}

impl PlaneCurrent for TurningWithSlopes {
    fn velocity(&self, p: Vector2<f64>, t_s: f64) -> Vector2<f64> {
        Self::at(p, t_s)
    }

    fn with_slopes(&self, p: Vector2<Jet>, t_s: Jet) -> Vector2<Jet> {
        Self::at(p, t_s)
    }
}

/// A current that gives its slopes is asked for them, and one that does not has those of differences.
#[test]
fn slopes_of_a_current_are_its_own_or_those_of_differences() {
    let still = WaterSpec::default().build(&duck_area(), &duck_bed(), 7).unwrap();
    let (mut by_values, mut by_slopes) = (still.clone(), still);
    by_values.free.add(Turning);
    by_slopes.free.add(TurningWithSlopes);
    for p in places(100) {
        let p = p.push(-3.0);
        let (a, b) = (by_values.sample(&p, 40.0), by_slopes.sample(&p, 40.0));
        assert_eq!(a.velocity, b.velocity);
        // Rounding of 0.1 m/s over 2 mm.
        assert!((a.gradient - b.gradient).norm() < 1e-12 && (a.rate - b.rate).norm() < 1e-12, "{a:?} {b:?}");
        let [x, y, _, t] = Jet::coordinates(&p, 40.0);
        let own = TurningWithSlopes::at(Vector2::new(x, y), t);
        assert_eq!((own.x.slopes[0], own.y.slopes[3]), (b.gradient[(0, 0)], b.rate.y));
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
    tidal.currents.extend([tide(0.1, 30.0), uniform(0.2, 100.0)]);
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
        let waves = vec![wave(0.1, 50.0, 100.0, 90.0, Some(20.0))];
        let layers = two_layers([layer(0.2, 90.0, 1023.0), layer(0.1, 90.0, 1026.0)], interface_m, thickness_m, waves);
        let bed = Terrain::Level { depth_m };
        let water = of(vec![CurrentSpec::new(layers)]).build(&duck_area(), &bed, 7).unwrap();
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
