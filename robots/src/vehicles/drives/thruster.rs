//! A propeller that pushes the hull along its axis.
//!
//! *Source:* linear open-water curve, K_T = K_T0 (1 − J/J_0), with rotation from the thrust in still water: Fossen,
//! "Handbook of Marine Craft Hydrodynamics and Motion Control", 2nd ed. 2021, section 9.3.
//!
//! *Parameters:* [`ThrusterSpec`](super::ThrusterSpec): curve, V_0 `runs_free_m_s`, `torque_m`.
//!
//! ```text
//! T = T_0 − s V_a √(|T_0| T_full) / V_0,   s = sign T_0, V_a ≥ 0 the inflow along the thrust, |T| not below 0
//! ```
//!
//! *Deviations:* water that comes from behind leaves the thrust as in still water; no side force of a cross-flow. A
//! thruster within [`RADIUS_M`] of the surface, or above it, loses its thrust in proportion.

use crate::handoff::ThrustTable;
use crate::vehicles::dynamics::Relative;
use nalgebra::Vector3;

/// Half the height over which a drive comes out of the water, m.
const RADIUS_M: f64 = 0.05;

/// Share of a drive at `r` that is under water.
pub(super) fn wet(at: &Relative, r: &Vector3<f64>) -> f64 {
    let height = at.z_m - at.down.dot(r);
    ((RADIUS_M - height) / (2.0 * RADIUS_M)).clamp(0.0, 1.0)
}

/// A thruster, FRD.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::vehicles) struct Thruster {
    /// Place, m.
    pub(in crate::vehicles) r: Vector3<f64>,
    /// Direction of positive thrust, a unit vector.
    pub(in crate::vehicles) axis: Vector3<f64>,
    /// Thrust in still water.
    pub(in crate::vehicles) curve: ThrustTable,
    /// Inflow at which full thrust has fallen to zero, m/s.
    pub(in crate::vehicles) runs_free_m_s: Option<f64>,
    /// Reaction torque, N m for each N.
    pub(in crate::vehicles) torque_m: f64,
    /// Electric power at full thrust, W/N.
    pub(in crate::vehicles) power_w_n: f64,
}

impl Thruster {
    /// Force and moment of 1 N of thrust.
    pub(in crate::vehicles) fn arm(&self) -> (Vector3<f64>, Vector3<f64>) {
        let torque = self.axis * self.torque_m;
        (self.axis, self.r.cross(&self.axis) + torque)
    }

    /// Greatest thrust of either sign, N.
    fn full_n(&self, sign: f64) -> f64 {
        let [least, most] = self.curve.thrusts_n();
        if sign < 0.0 { -least } else { most }
    }

    /// Thrust at an input in the water round it, N.
    pub(super) fn thrust_n(&self, input: f64, at: &Relative) -> f64 {
        let still = self.curve.thrust_n(input);
        let Some(free) = self.runs_free_m_s.filter(|_| still != 0.0) else {
            return still * wet(at, &self.r);
        };
        let sign = still.signum();
        let inflow = (sign * self.axis.dot(&(at.v + at.w.cross(&self.r)))).max(0.0);
        let lost = inflow * (still.abs() * self.full_n(sign)).sqrt() / free;
        sign * (still.abs() - lost).max(0.0) * wet(at, &self.r)
    }

    /// Electric power at an input, W.
    pub(super) fn power_w(&self, input: f64) -> f64 {
        let still = self.curve.thrust_n(input);
        let full = self.full_n(still);
        if full == 0.0 {
            return 0.0;
        }
        // Momentum theory: power is thrust to the 3/2.
        self.power_w_n * still.abs() * (still.abs() / full).sqrt()
    }

    pub(super) fn force(&self, input: f64, at: &Relative) -> (Vector3<f64>, Vector3<f64>) {
        let n = self.thrust_n(input, at);
        let (force, moment) = self.arm();
        (force * n, moment * n)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn thruster() -> Thruster {
        Thruster {
            r: Vector3::new(-0.5, 0.2, 0.0),
            axis: Vector3::x(),
            curve: ThrustTable(vec![(-40.0, -40.0), (50.0, 50.0)]),
            runs_free_m_s: Some(4.0),
            torque_m: 0.01,
            power_w_n: 8.0,
        }
    }

    fn at(u: f64, z_m: f64) -> Relative {
        let v = Vector3::new(u, 0.0, 0.0);
        Relative {
            v_ground: v,
            v,
            w: Vector3::zeros(),
            along: Vector3::zeros(),
            rho: 1025.0,
            down: Vector3::z(),
            z_m,
            wet: 1.0,
        }
    }

    #[test]
    fn thrust_falls_with_the_inflow_and_vanishes_out_of_the_water() {
        let t = thruster();
        assert_eq!(t.thrust_n(50.0, &at(0.0, -1.0)), 50.0);
        assert!(t.thrust_n(50.0, &at(4.0, -1.0)).abs() < 1e-12);
        assert_eq!(t.thrust_n(50.0, &at(2.0, -1.0)), 25.0);
        // From behind it is as in still water.
        assert_eq!(t.thrust_n(50.0, &at(-2.0, -1.0)), 50.0);
        assert_eq!(t.thrust_n(-40.0, &at(-4.0, -1.0)), 0.0);
        assert_eq!(t.thrust_n(50.0, &at(0.0, 0.0)), 25.0);
        assert_eq!(t.thrust_n(50.0, &at(0.0, 1.0)), 0.0);
    }

    #[test]
    fn its_moment_is_that_of_its_place_and_of_its_torque() {
        let (force, moment) = thruster().force(10.0, &at(0.0, -1.0));
        assert_eq!(force, Vector3::new(10.0, 0.0, 0.0));
        assert!((moment - Vector3::new(0.1, 0.0, -2.0)).norm() < 1e-12);
        assert_eq!(thruster().power_w(50.0), 400.0);
        assert_eq!(thruster().power_w(12.5), 50.0);
    }
}
