//! A vehicle without dynamics: it takes the rates that its helm asks for, within its limits, exactly and at once.
//!
//! *Source:* the unicycle with bounded turn rate; with bounded curvature, the vehicle of Dubins 1957 (American Journal
//! of Mathematics 79). Such a point stands for the vehicle in simulations of plume tracing (Li, Farrell & Cardé 2001,
//! Adaptive Behavior 9).
//!
//! *Parameters:* [`KinematicSpec`](super::KinematicSpec).
//!
//! ```text
//! ψ(t + dt) = ψ + r dt      x(t + dt) = x + U sin(r dt/2)/(r dt/2) dt (sin, cos)(ψ + r dt/2) + u dt
//! ```
//!
//! *Deviations:* each step is an exact arc, so a steady turn has its radius U/r at any length of the step. The hull
//! stays level. Through the water it drifts horizontally with the water's velocity u at its origin; its height it
//! keeps by itself. In contacts it has no momentum and no friction: they take away what it would go into a wall, and it
//! slides along the wall and turns as its helm asks for. Where its own turn moves it against something, it gives way;
//! between walls without room to turn it turns less, by the mass and the moment of inertia about the vertical of its
//! URDF, without added mass. It cannot be tilted. What a contact does to its velocity lasts for that step. It does not rise above the surface.

use super::kinematic_spec::{KinematicSpec, Moves};
use super::motion::{Inertia, Motion, WaterInput, foreign};
use super::urdf::Shell;
use crate::error::ensure;
use crate::handoff::{Actuation, Capabilities, Control, RateCommand, RateLimits, TurnLimit};
use nalgebra::{Matrix6, Vector3, Vector6};
use world::fields::WaterSample;
use world::frames::{Pose, Truth};
use world::math;

/// Moment of inertia about the axes about which it cannot be tilted, kg m²: no contact turns it by as much as a
/// rounding.
const STIFF_KG_M2: f64 = 1e12;

/// A vehicle without dynamics.
#[derive(Clone, Debug)]
pub(super) struct Kinematic {
    mass_kg: f64,
    inertia_z_kg_m2: f64,
    moves: Moves,
    limits: RateLimits,
}

impl Kinematic {
    /// With the mass of a URDF.
    ///
    /// # Errors
    /// If that has no moment of inertia about the vertical.
    pub(super) fn new(spec: &KinematicSpec, shell: &Shell) -> Result<Self, String> {
        let (mass_kg, _, inertia) = shell.ballast.whole();
        let izz = inertia[(2, 2)];
        let body = &shell.body;
        ensure(izz > 0.0, || format!("link \"{body}\": izz must be > 0 kg m2, got {izz}"))?;
        Ok(Self { mass_kg, inertia_z_kg_m2: izz, moves: spec.moves, limits: spec.limits() })
    }

    /// The state after a step at rates. The water's velocity counts only for a vehicle that moves through the water.
    fn sail(&self, truth: &Truth, water_m_s: &Vector3<f64>, asked: &RateCommand, dt_s: f64) -> Truth {
        let rates = self.limits.held(asked);
        let drift = match self.moves {
            Moves::ThroughWater => Vector3::new(water_m_s.x, water_m_s.y, 0.0),
            Moves::OverGround => Vector3::zeros(),
        };
        let half = 0.5 * rates.turn_rad_s * dt_s;
        let middle = truth.pose.heading().turned(half);
        let heading = middle.turned(half);
        let way = middle.unit() * (rates.speed_m_s * dt_s * chord_of_arc(half));
        let start = truth.pose.p_WB;
        let mut p_WB = start + drift * dt_s + Vector3::new(way.x, way.y, rates.climb_m_s * dt_s);
        // The surface; a vehicle that something has pushed above it sinks back.
        p_WB.z = p_WB.z.min(0.0);
        let pose = Pose::level(p_WB, heading);
        let ahead = heading.unit() * rates.speed_m_s;
        let v_W = drift + Vector3::new(ahead.x, ahead.y, (p_WB.z - start.z) / dt_s);
        Truth { pose, v_WB_B: pose.R_WB.inverse() * v_W, w_WB_B: Vector3::new(0.0, 0.0, -rates.turn_rad_s) }
    }
}

impl Motion for Kinematic {
    fn control(&self) -> Control {
        Control::Rates(self.limits)
    }

    fn capabilities(&self, _: f64) -> Capabilities {
        let limits = &self.limits;
        Capabilities {
            least_speed_m_s: 0.0,
            top_speed_m_s: limits.speed_m_s,
            turning_radius_m: match limits.turn {
                TurnLimit::Rate(rad_s) => limits.speed_m_s / rad_s,
                TurnLimit::Radius(m) => m,
            },
            ..Capabilities::default()
        }
    }

    fn top_speed_m_s(&self, _: f64) -> f64 {
        self.limits.speed_m_s
    }

    fn idle(&self) -> Actuation {
        Actuation::Rates(RateCommand::default())
    }

    fn feels(&self) -> WaterInput {
        match self.moves {
            Moves::ThroughWater => WaterInput::Velocity,
            Moves::OverGround => WaterInput::Nothing,
        }
    }

    fn inertia(&self) -> Inertia {
        let (m, about_vertical) = (self.mass_kg, self.inertia_z_kg_m2);
        Inertia {
            p_BG: Vector3::zeros(),
            mass: Matrix6::from_diagonal(&Vector6::new(m, m, m, STIFF_KG_M2, STIFF_KG_M2, about_vertical)),
            without_momentum: true,
        }
    }

    fn step_in(&mut self, truth: &Truth, water: &WaterSample, set: &Actuation, dt_s: f64) -> Truth {
        match set {
            Actuation::Rates(set) => self.sail(truth, &water.velocity, set, dt_s),
            other => foreign(other),
        }
    }
}

/// Length of the chord of an arc of twice this angle, as a share of the arc's: sin(x)/x.
fn chord_of_arc(half_rad: f64) -> f64 {
    // The next term of the series, x⁴/120, is below rounding.
    if half_rad.abs() < 1e-4 {
        1.0 - half_rad * half_rad / 6.0
    } else {
        let (sin, _) = math::sin_cos(half_rad);
        sin / half_rad
    }
}

#[cfg(test)]
#[path = "kinematic_tests.rs"]
mod tests;
