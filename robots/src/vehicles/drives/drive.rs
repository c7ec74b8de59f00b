//! A drive of any kind: where its set-point may be, how fast it follows, and what it does.
//!
//! *Source:* first-order lags of thrusters and fins; buoyancy engine and moving mass of gliders: Leonard & Graver,
//! IEEE J. Oceanic Eng. 26, 2001 (the mass as a moment of its weight).
//!
//! *Parameters:* [`DriveSpec`](super::DriveSpec).
//!
//! *Deviations:* a moving mass shifts the weight; what its own motion and its new place do to the inertia is left out
//! (a tenth of a percent of the mass matrix for a glider). A buoyancy engine changes volume, not mass.

use super::fin::Fin;
use super::thruster::{Thruster, wet};
use crate::vehicles::dynamics::{Body, Relative};
use nalgebra::Vector3;
use world::math;

/// A drive.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::vehicles) struct Drive {
    /// Name of its link.
    pub(in crate::vehicles) link: String,
    /// What it is.
    pub(in crate::vehicles) kind: Kind,
    /// Least and greatest set-point.
    pub(in crate::vehicles) limits: [f64; 2],
    /// How it follows its set-point.
    pub(in crate::vehicles) follows: Follows,
}

/// What a drive is, FRD.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::vehicles) enum Kind {
    /// Set-point: input of its curve.
    Thruster(Thruster),
    /// Set-point: angle, rad.
    Fin(Fin),
    /// Place, m, and power while it pumps out, W. Set-point: volume, m³.
    Buoyancy(Vector3<f64>, f64),
    /// Direction of travel, mass (kg), power while it moves (W). Set-point: place along its way, m.
    Mass(Vector3<f64>, f64, f64),
}

/// How a drive follows its set-point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::vehicles) enum Follows {
    /// With a time constant, s; 0 for at once.
    Lag(f64),
    /// At a rate, 1/s of its own unit.
    Rate(f64),
}

impl Drive {
    /// Its state after `t_s` with one set-point.
    pub(in crate::vehicles) fn after(&self, now: f64, asked: f64, t_s: f64) -> f64 {
        let asked = asked.clamp(self.limits[0], self.limits[1]);
        match self.follows {
            Follows::Lag(0.0) => asked,
            Follows::Lag(lag_s) => asked + (now - asked) * math::exp(-t_s / lag_s),
            Follows::Rate(rate) => now + (asked - now).clamp(-rate * t_s, rate * t_s),
        }
    }

    /// The set-point at which it does nothing.
    pub(in crate::vehicles) fn idle(&self) -> f64 {
        match &self.kind {
            Kind::Thruster(t) => t.curve.input(0.0),
            _ => 0.0,
        }
    }

    /// Force and moment about the body's origin.
    pub(in crate::vehicles) fn force(&self, state: f64, body: &Body, at: &Relative) -> (Vector3<f64>, Vector3<f64>) {
        match &self.kind {
            Kind::Thruster(thruster) => thruster.force(state, at),
            Kind::Fin(fin) => fin.force(state, at),
            Kind::Buoyancy(r, _) => {
                let lift = at.rho * body.gravity_m_s2 * state * wet(at, r);
                let force = at.down * -lift;
                (force, r.cross(&force))
            }
            Kind::Mass(way, kg, _) => {
                let weight = at.down * (kg * body.gravity_m_s2);
                (Vector3::zeros(), (way * state).cross(&weight))
            }
        }
    }

    /// Electric power, W, in state `now` with a set-point.
    pub(in crate::vehicles) fn power_w(&self, now: f64, asked: f64) -> f64 {
        match &self.kind {
            Kind::Thruster(thruster) => thruster.power_w(now),
            Kind::Fin(_) => 0.0,
            Kind::Buoyancy(_, w) => {
                if asked > now {
                    *w
                } else {
                    0.0
                }
            }
            Kind::Mass(_, _, w) => {
                if asked == now {
                    0.0
                } else {
                    *w
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn drives_follow_exactly_at_any_step() {
        let of = |follows| Drive {
            link: "bladder".into(),
            kind: Kind::Buoyancy(Vector3::zeros(), 10.0),
            limits: [-1.0, 1.0],
            follows,
        };
        let lagging = of(Follows::Lag(0.5));
        let half = lagging.after(0.0, 1.0, 0.1);
        let twice = lagging.after(half, 1.0, 0.1);
        assert!((twice - lagging.after(0.0, 1.0, 0.2)).abs() < 1e-15);
        assert!((lagging.after(0.0, 1.0, 0.5) - (1.0 - math::exp(-1.0))).abs() < 1e-12);
        assert_eq!(lagging.after(0.0, 7.0, 1e9), 1.0);
        assert_eq!(of(Follows::Lag(0.0)).after(0.0, 0.3, 0.0), 0.3);
        let pumping = of(Follows::Rate(0.1));
        assert_eq!(pumping.after(0.0, 1.0, 2.0), 0.2);
        assert!((pumping.after(0.9, -1.0, 100.0) + 1.0).abs() < 1e-12);
        assert_eq!((pumping.power_w(0.0, 1.0), pumping.power_w(1.0, 0.0)), (10.0, 0.0));
    }
}
