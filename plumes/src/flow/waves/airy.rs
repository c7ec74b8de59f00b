//! One long-crested surface wave over a level bed, by linear theory.
//!
//! *Source*: Airy's solution, Dean & Dalrymple 1991, Water Wave Mechanics for Engineers and Scientists, ch. 3 and 4: η
//! = a cos θ, θ = k·x − ωt + ε, ω² = gk tanh kh, u = aω C cos θ, w = aω S sin θ with C = cosh k(z+h)/sinh kh, S = sinh
//! k(z+h)/sinh kh; displacement of a particle from its mean place −aC sin θ along k and aS cos θ upwards; head of the
//! wave's pressure a C tanh(kh) cos θ; Stokes' drift a²ωk (C² + S²)/2 (Phillips 1977, The Dynamics of the Upper Ocean,
//! section 3.3).
//!
//! *Parameters*: amplitude a (m), period 2π/ω at a fixed place (s), direction of travel, ε (rad), depth h (m).
//!
//! *Deviations*: currents cause no Doppler shift. Wave number, displacement and drift are those in still water, with an
//! error of about U/c where a current U runs along a wave of speed c (5 % for 20 cm/s along a wave of 2.6 s). Linear
//! theory ends at z = 0: above it and below the bed, the values at them apply.

use nalgebra::{Matrix3, Vector2, Vector3};
use world::fields::WaterSample;
use world::math;
use world::units::GRAVITY_M_S2;

/// A wave, ready to be evaluated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Airy {
    amplitude: f64,
    omega: f64,
    phase: f64,
    along: Vector2<f64>,
    k: f64,
    depth: f64,
    // 1 − e^(−2kh) and tanh kh.
    rest: f64,
    tanh: f64,
}

/// C, S and sin θ, cos θ at a place and time.
struct State {
    c: f64,
    s: f64,
    sin: f64,
    cos: f64,
}

/// Wave number, 1/m, of a wave of angular frequency `omega` (rad/s) in water `depth_m` deep: ω² = gk tanh kh to
/// rounding.
pub(super) fn wave_number(omega: f64, depth_m: f64) -> f64 {
    let deep = omega * omega / GRAVITY_M_S2;
    let wanted = deep * depth_m;
    // From above the root, Newton's steps on x tanh x, which is convex there, approach it without overshooting.
    let mut x = wanted.max(wanted.sqrt()) * 1.2;
    for _ in 0..50 {
        let tanh = math::tanh(x);
        let step = (x * tanh - wanted) / (tanh + x * (1.0 - tanh * tanh));
        x -= step;
        if step.abs() <= 1e-15 * x {
            break;
        }
    }
    x / depth_m
}

impl Airy {
    pub(super) fn new(amplitude_m: f64, omega: f64, along: Vector2<f64>, phase: f64, depth_m: f64) -> Self {
        let k = wave_number(omega, depth_m);
        let e2 = math::exp(-2.0 * k * depth_m);
        Self {
            amplitude: amplitude_m,
            omega,
            phase,
            along,
            k,
            depth: depth_m,
            rest: 1.0 - e2,
            tanh: (1.0 - e2) / (1.0 + e2),
        }
    }

    /// Makes its phase that at a place (east, north).
    pub(super) fn begin_at(&mut self, place: Vector2<f64>) {
        self.phase -= self.along.dot(&place) * self.k;
    }

    /// Energy over ρg: variance of the surface, m².
    pub(super) fn variance(&self) -> f64 {
        0.5 * self.amplitude * self.amplitude
    }

    #[cfg(test)]
    pub(super) fn omega(&self) -> f64 {
        self.omega
    }

    #[cfg(test)]
    pub(super) fn along(&self) -> Vector2<f64> {
        self.along
    }

    /// C and S, from exponentials that fall with depth, so that they do not overflow in deep water.
    fn shape(&self, z: f64) -> (f64, f64) {
        let z = z.clamp(-self.depth, 0.0);
        let up = math::exp(self.k * z);
        let down = math::exp(-self.k * (z + 2.0 * self.depth));
        ((up + down) / self.rest, (up - down) / self.rest)
    }

    fn state(&self, p: &Vector3<f64>, t_s: f64) -> State {
        let (c, s) = self.shape(p.z);
        let way = self.along.dot(&p.xy()) * self.k;
        let (sin, cos) = math::sin_cos(way - self.omega * t_s + self.phase);
        State { c, s, sin, cos }
    }

    fn vector(&self, along: f64, up: f64) -> Vector3<f64> {
        Vector3::new(self.along.x * along, self.along.y * along, up)
    }

    /// Orbital velocity, m/s.
    pub(super) fn velocity(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
        let w = self.state(p, t_s);
        let speed = self.amplitude * self.omega;
        self.vector(speed * w.c * w.cos, speed * w.s * w.sin)
    }

    /// Adds velocity, gradient and rate of change.
    pub(super) fn add_to(&self, sample: &mut WaterSample, p: &Vector3<f64>, t_s: f64) {
        let w = self.state(p, t_s);
        let speed = self.amplitude * self.omega;
        sample.velocity += self.vector(speed * w.c * w.cos, speed * w.s * w.sin);
        let (force, bend) = (speed * self.omega, speed * self.k);
        sample.rate += self.vector(force * w.c * w.sin, -force * w.s * w.cos);
        // Free of divergence and rotation: symmetric, with zero trace.
        let (e, flat, tilt) = (self.along, bend * w.c * w.sin, bend * w.s * w.cos);
        sample.gradient += Matrix3::new(
            -flat * e.x * e.x,
            -flat * e.x * e.y,
            tilt * e.x,
            -flat * e.x * e.y,
            -flat * e.y * e.y,
            tilt * e.y,
            tilt * e.x,
            tilt * e.y,
            flat,
        );
    }

    /// Displacement of the particle whose mean place is `p`, m.
    pub(super) fn displacement(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
        let w = self.state(p, t_s);
        self.vector(-self.amplitude * w.c * w.sin, self.amplitude * w.s * w.cos)
    }

    /// Head of its pressure, m of water.
    pub(super) fn head(&self, p: &Vector3<f64>, t_s: f64) -> f64 {
        let w = self.state(p, t_s);
        self.amplitude * w.c * self.tanh * w.cos
    }

    /// Stokes' drift at a height, m/s.
    pub(super) fn drift(&self, z: f64) -> Vector2<f64> {
        let (c, s) = self.shape(z);
        self.along * (self.amplitude * self.amplitude * self.omega * self.k * 0.5 * (c * c + s * s))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn dispersion_is_solved_to_rounding_at_any_depth() {
        for period in [0.5, 2.0, 4.0, 8.0, 20.0, 900.0] {
            for depth in [0.05, 1.0, 10.0, 200.0, 5000.0] {
                let omega = TAU / period;
                let k = wave_number(omega, depth);
                let back = GRAVITY_M_S2 * k * math::tanh(k * depth) / (omega * omega);
                assert!((back - 1.0).abs() < 1e-13, "{period} s, {depth} m: {back}");
            }
        }
    }

    #[test]
    fn no_depth_breaks_the_numbers() {
        for (period, depth) in [(1.0, 4000.0), (2000.0, 0.1)] {
            let w = Airy::new(0.01, TAU / period, Vector2::x(), 0.3, depth);
            for z in [0.0, -depth / 2.0, -depth, -2.0 * depth, 5.0] {
                let u = w.velocity(&Vector3::new(3.0, 0.0, z), 7.0);
                assert!(u.iter().all(|v| v.is_finite()), "{period} {depth} {z}: {u}");
            }
        }
    }
}
