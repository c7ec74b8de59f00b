//! The numbers of a torpedo-shaped hull, and what follows from them.
//!
//! *Source:* T. I. Fossen, "Handbook of Marine Craft Hydrodynamics and Motion Control", 2nd ed. 2021,
//! chapters 3, 6 and 8, in its open implementation for the REMUS 100 (Python Vehicle Simulator,
//! commit c717e073), whose drag and propeller are calibrated to Allen, Vorus & Prestero, "Propulsion
//! system performance enhancements on REMUS AUVs", OCEANS 2000. Added mass: Lamb's k-factors of a
//! prolate spheroid (Fossen 8.4).
//!
//! *Parameters:* [`TorpedoHullSpec`]; those of the REMUS 100 stand in its `vehicle.ron`.
//!
//! *Deviations:* unless `published` asks for it, the terms differ from the published code in these, because its choice
//! is a quirk of that code and not of the vehicle:
//!
//! | what | `published` | else |
//! |---|---|---|
//! | propeller inflow | speed through the water in any direction | axial speed through the water, not below 0 |
//! | current | horizontal, turned by yaw only | three components, turned by the whole attitude, with its gradient along the hull |
//! | accelerating water | no force | Froude-Krylov force and ċ of the added mass |
//! | cross-flow drag | sway only, coefficient 1.19772883, 21 stations at full weight (5 % too long) | sway and heave alike, cylinder coefficient 1.1 (Hoerner 1965), 20 stations of L/20 |
//! | hull lift | heave only, slope · α | in the plane of incidence, whichever it is, slope · sin α cos α |
//! | fins | angle is the deflection | angle of attack of the water at the fin, turning included |
//! | yaw damping | linear, time constant 1 s | what the fins and the cross-flow give |
//! | linear heave damping | at all speeds | fades with speed as in surge and sway |
//! | limits of the actuators | on their state | on the command |

use super::spec::TorpedoHullSpec;
use crate::error::ensure;
use crate::vehicles::dynamics::{Body, Envelope, Mass};
use nalgebra::{Matrix3, Matrix6, Vector3};
use world::math;
use world::ranges::{NonNegative, Positive};

/// The speed that the propeller's inflow is taken from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inflow {
    /// Speed over ground (as first published).
    Ground,
    /// Speed through the water in any direction (as published later).
    Water,
    /// Speed through the water along the shaft, not below 0.
    Axial,
}

/// All numbers of a hull: those of its file, and what follows from them. Frames are FRD, moments are about the centre of
/// buoyancy CO.
#[derive(Clone, Debug, PartialEq)]
pub struct Coefficients {
    /// The numbers of its file.
    pub spec: TorpedoHullSpec,
    /// Density of the water for which the hull is ballasted, kg/m³.
    pub ballast_density_kg_m3: f64,
    /// Gravity, m/s².
    pub gravity_m_s2: f64,
    /// Mass, kg: that of the displaced water, unless a URDF gives another one.
    pub mass_kg: f64,
    /// Displaced volume, m³.
    pub volume_m3: f64,
    /// Centre of gravity below CO, m.
    pub z_g_m: f64,
    /// Inertia about the centre of gravity, kg m².
    pub inertia_kg_m2: Vector3<f64>,
    /// Added mass (kg) and inertia (kg m²), diagonal.
    pub added: [f64; 6],
    /// Linear damping, diagonal, at rest, N s/m and N m s.
    pub damping: [f64; 6],
    /// Reference area of hull lift and drag, m².
    pub area_m2: f64,
    /// Drag coefficient at no incidence, on that area.
    pub drag_0: f64,
    /// Lift slope of the hull, 1/rad.
    pub lift_slope: f64,
    /// π e AR: the induced drag is C_L² divided by it.
    pub induced: f64,
    /// Cross-flow drag coefficient.
    pub cross_flow: f64,
    /// Stations of the cross-flow integral: x (m), length dx (m), the same for all.
    pub stations_m: (Vec<f64>, f64),
    /// Place of the fins along the hull, x, m.
    pub fin_x_m: f64,
    /// Greatest fin deflection, rad.
    pub fin_limit_rad: f64,
    /// Thrust coefficient at rest and its slope by advance ratio.
    pub thrust: [f64; 2],
    /// Torque coefficient at rest and its slope by advance ratio.
    pub torque: [f64; 2],
    /// The speed that the propeller's inflow is taken from.
    pub inflow: Inflow,
}

impl Coefficients {
    /// From a vehicle's file: the numbers of its hull, the density of the water for which it is ballasted, and gravity.
    ///
    /// # Errors
    /// If it is no longer than thick, or if its motion is too quick for the steps of a mission.
    pub fn new(spec: &TorpedoHullSpec, density_kg_m3: f64, gravity_m_s2: f64) -> Result<Self, String> {
        use std::f64::consts::PI;
        let (length_m, diameter_m, rho) = (spec.length_m.get(), spec.diameter_m.get(), density_kg_m3);
        ensure(diameter_m < length_m, || {
            format!("hydrodynamics.terms.diameter_m: must be less than the length, {length_m} m, got {diameter_m} m")
        })?;
        let (a, b): (f64, f64) = (length_m / 2.0, diameter_m / 2.0);
        let volume_m3 = 4.0 / 3.0 * PI * a * b * b;
        let mass_kg = rho * volume_m3;
        let z_g_m = spec.centre_of_gravity_below_m.get();
        let ix = 0.4 * mass_kg * b * b;
        let iy = 0.2 * mass_kg * (a * a + b * b);

        // Lamb's k-factors.
        let e = (1.0 - (b / a) * (b / a)).sqrt();
        let log = math::ln((1.0 + e) / (1.0 - e));
        let alpha0 = 2.0 * (1.0 - e * e) / (e * e * e) * (0.5 * log - e);
        let beta0 = 1.0 / (e * e) - (1.0 - e * e) / (2.0 * e * e * e) * log;
        let k1 = alpha0 / (2.0 - alpha0);
        let k2 = beta0 / (2.0 - beta0);
        let e2 = e * e;
        let k_turn = e2 * e2 * (beta0 - alpha0) / ((2.0 - e2) * (2.0 * e2 - (2.0 - e2) * (beta0 - alpha0)));
        let added = [mass_kg * k1, mass_kg * k2, mass_kg * k2, spec.added_roll.get() * ix, k_turn * iy, k_turn * iy];

        let weight = mass_kg * gravity_m_s2;
        // Total mass at CO: the centre of gravity adds m z_g² to roll and pitch.
        let shift = mass_kg * z_g_m * z_g_m;
        let m = [
            mass_kg + added[0],
            mass_kg + added[1],
            mass_kg + added[2],
            ix + shift + added[3],
            iy + shift + added[4],
            iy + added[5],
        ];
        let swing = |inertia: f64| (weight * z_g_m / inertia).sqrt();
        let times = [spec.surge_s, spec.sway_s, spec.fins.lag_s, spec.propeller.lag_s].map(Positive::get);
        let swings = [m[3], m[4]].map(|inertia| 1.0 / swing(inertia));
        let quickest_s = times.into_iter().chain(swings).fold(f64::INFINITY, f64::min);
        ensure(quickest_s >= QUICKEST_S, || {
            format!(
                "hydrodynamics.terms: lags, time constants and swings must take {QUICKEST_S} s at least, for steps of 0.1 s \
                 follow nothing quicker; one takes {quickest_s:.1e} s"
            )
        })?;
        let damping = [
            m[0] / spec.surge_s.get(),
            m[1] / spec.sway_s.get(),
            m[2] / spec.sway_s.get(),
            2.0 * spec.roll_damping.get() * swing(m[3]) * m[3],
            2.0 * spec.pitch_damping.get() * swing(m[4]) * m[4],
            if spec.published { m[5] / PUBLISHED_YAW_S } else { 0.0 },
        ];

        let area_m2 = spec.area_share.get() * length_m * diameter_m;
        let aspect = diameter_m * diameter_m / area_m2;
        let dx = length_m / 20.0;
        let at = |place: f64| -a + place * dx;
        let stations = if spec.published {
            (0..=20).map(|i| at(f64::from(i))).collect()
        } else {
            (0..20).map(|i| at(f64::from(i) + 0.5)).collect()
        };
        let curve = |(rest, ahead): (Positive, NonNegative)| {
            [rest.get(), (ahead.get() - rest.get()) / spec.propeller.advance_ratio.get()]
        };
        Ok(Self {
            ballast_density_kg_m3: rho,
            gravity_m_s2,
            mass_kg,
            volume_m3,
            z_g_m,
            inertia_kg_m2: Vector3::new(ix, iy, iy),
            added,
            damping,
            area_m2,
            drag_0: spec.frontal_drag.get() * PI * b * b / area_m2,
            lift_slope: PI * aspect / (1.0 + (1.0 + aspect * aspect / 4.0).sqrt()),
            induced: PI * spec.span_efficiency.get() * aspect,
            cross_flow: if spec.published { HOERNER_AT_HALF } else { spec.cross_flow.get() },
            stations_m: (stations, dx),
            fin_x_m: -a,
            fin_limit_rad: spec.fins.limit_deg.get().to_radians(),
            thrust: curve(spec.propeller.thrust),
            torque: curve(spec.propeller.torque),
            inflow: if spec.published { Inflow::Water } else { Inflow::Axial },
            spec: spec.clone(),
        })
    }

    /// The hull as the equation of motion sees it.
    pub(in crate::vehicles) fn body(&self) -> Body {
        let i = Matrix3::from_diagonal(&self.inertia_kg_m2);
        Body {
            mass: Mass::about_centre(self.mass_kg, Vector3::new(0.0, 0.0, self.z_g_m), &i),
            added: self.added_mass(),
            volume_m3: self.volume_m3,
            r_B: Vector3::zeros(),
            gravity_m_s2: self.gravity_m_s2,
            envelope: Envelope::Spheroid(self.spec.length_m.get(), self.spec.diameter_m.get()),
            current_by_yaw_only: self.spec.published,
        }
    }

    /// Rigid-body mass matrix about CO, FRD.
    pub fn rigid_mass(&self) -> Matrix6<f64> {
        self.body().mass.matrix()
    }

    /// Added mass matrix, FRD.
    pub fn added_mass(&self) -> Matrix6<f64> {
        Matrix6::from_diagonal(&nalgebra::Vector6::from_row_slice(&self.added))
    }
}

/// Cross-flow drag coefficient interpolated in Hoerner's table for surface hulls at B/2T = 0.5, with the digits that the
/// published derivatives contain.
const HOERNER_AT_HALF: f64 = 1.197_728_834_355_83;
/// Shortest time constant, s: Runge-Kutta's fourth order is stable in steps of 2.8 of them, and steps have up to 0.1 s.
const QUICKEST_S: f64 = 0.04;
/// Time constant of the published linear damping in yaw, s.
const PUBLISHED_YAW_S: f64 = 1.0;

#[cfg(test)]
mod tests {
    use super::super::testing::remus100;

    /// Against the numbers printed by the published code.
    #[test]
    fn constants_are_the_published_ones() {
        let c = remus100(true);
        let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 5e-8, "{a} is not {b}");
        close(c.mass_kg, 31.029385);
        close(c.inertia_kg_m2.x, 0.11201608);
        close(c.inertia_kg_m2.y, 4.0277693);
        close(c.added[0], 0.83890859);
        close(c.added[1], 29.437637);
        close(c.added[3], 0.033604824);
        close(c.added[5], 3.4262101);
        close(c.drag_0, 0.055959619);
        close(c.lift_slope, 0.26599679);
        close(c.rigid_mass()[(3, 3)], 0.12442783);
        close(c.rigid_mass()[(0, 4)], 0.6205877);
    }

    #[test]
    fn lagged_added_mass_would_diverge_on_this_hull() {
        let c = remus100(false);
        let lag = c.rigid_mass().try_inverse().expect("mass") * c.added_mass();
        let rho = lag.complex_eigenvalues().iter().map(|l| l.norm()).fold(0.0, f64::max);
        assert!((rho - 1.09).abs() < 0.01, "spectral radius {rho}");
    }
}
