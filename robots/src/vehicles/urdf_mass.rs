//! The mass that a vehicle's URDF gives, and what the equation of motion takes from it.
//!
//! *Source:* parallel-axis theorem over all links with a mass, joints at zero.
//!
//! *Parameters:* none.
//!
//! *Deviations:* hydrodynamic parameters were fitted to one hull. So mass, inertia and height of the centre of
//! gravity may differ from theirs by 1 %, and the URDF's values are then used. A centre of gravity off the hull's
//! axis, and products of inertia, within 1 % are left out. Both are reported.

use super::torpedo::Coefficients;
use super::urdf_parts::{finite, joined, pose_of};
use crate::error::ensure;
use nalgebra::{Matrix3, Vector3};
use std::collections::BTreeMap;
use urdf_rs::Robot;
use world::frames::Pose;

/// Greatest relative difference of mass and inertia from the hydrodynamic parameters.
const MASS_TOLERANCE: f64 = 0.01;
/// Relative difference that rounding to eight digits in a file can cause; it counts as none.
const ROUNDING: f64 = 1e-6;

/// Mass, centre of gravity and inertia of a vehicle, FLU.
#[derive(Clone, Debug)]
pub(super) struct Ballast {
    mass_kg: f64,
    p_BG: Vector3<f64>,
    /// About the centre of gravity.
    inertia_kg_m2: Matrix3<f64>,
}

impl Ballast {
    /// Sum over all links: a link may be a frame without mass, the whole may not.
    pub(super) fn from_links(robot: &Robot, links: &BTreeMap<String, Pose>) -> Result<Self, String> {
        let mut pieces = Vec::new();
        for link in &robot.links {
            let (name, inertial) = (&link.name, &link.inertial);
            let mass = inertial.mass.value;
            ensure(mass >= 0.0 && mass.is_finite(), || format!("link \"{name}\": <mass> must be >= 0 kg, got {mass}"))?;
            finite(&inertial.origin, &format!("link \"{name}\", inertial"))?;
            let i = &inertial.inertia;
            let own = Matrix3::new(i.ixx, i.ixy, i.ixz, i.ixy, i.iyy, i.iyz, i.ixz, i.iyz, i.izz);
            if let Some(v) = own.iter().find(|v| !v.is_finite()) {
                return Err(format!("link \"{name}\": <inertia> must be finite, got {v}"));
            }
            let at = joined(&links[name], &pose_of(&inertial.origin));
            let turn = at.R_WB.to_rotation_matrix();
            pieces.push((mass, at.p_WB, turn * own * turn.inverse()));
        }
        let mass_kg: f64 = pieces.iter().map(|p| p.0).sum();
        if mass_kg <= 0.0 {
            return Err("no link has a <mass> > 0: give one of them an <inertial>".into());
        }
        let moments = pieces.iter().map(|(m, p, _)| p * *m);
        let p_BG = moments.sum::<Vector3<f64>>() / mass_kg;
        let about_G = pieces.iter().map(|(m, p, own)| {
            let arm = (p - p_BG).cross_matrix();
            own - arm * arm * *m
        });
        Ok(Self { mass_kg, p_BG, inertia_kg_m2: about_G.sum() })
    }

    /// Mass (kg), centre of gravity (m) and inertia about it (kg m²), FLU.
    pub(super) fn whole(&self) -> (f64, Vector3<f64>, Matrix3<f64>) {
        (self.mass_kg, self.p_BG, self.inertia_kg_m2)
    }

    /// The parameters with this mass, and what must be reported about it.
    ///
    /// # Errors
    /// If it is not the mass of the hull for which the parameters are.
    pub(super) fn put_into(&self, body: &str, c: &Coefficients) -> Result<(Coefficients, Vec<String>), String> {
        let near = |have: f64, want: f64| (have - want).abs() <= MASS_TOLERANCE * want;
        let mass = self.mass_kg;
        ensure(near(mass, c.mass_kg), || {
            format!("link \"{body}\": <mass> is {mass} kg, but the hydrodynamic parameters are for {:.3} kg", c.mass_kg)
        })?;
        let (inertia, want) = (&self.inertia_kg_m2, c.inertia_kg_m2);
        for (k, axis) in ["ixx", "iyy", "izz"].into_iter().enumerate() {
            let (have, want) = (inertia[(k, k)], want[k]);
            ensure(near(have, want), || {
                format!(
                    "link \"{body}\": {axis} is {have} kg m2, but the hydrodynamic parameters are for {want:.5} kg m2"
                )
            })?;
        }
        for ((row, column), axis) in [((0, 1), "ixy"), ((0, 2), "ixz"), ((1, 2), "iyz")] {
            let have = inertia[(row, column)];
            ensure(near(want.x + have, want.x), || {
                format!(
                    "link \"{body}\": {axis} is {have} kg m2, but the hydrodynamic parameters are for a hull with zero"
                )
            })?;
        }
        let [x, y, z] = [self.p_BG.x, self.p_BG.y, self.p_BG.z];
        ensure(near(c.z_g_m + x, c.z_g_m) && near(c.z_g_m + y, c.z_g_m), || {
            format!(
                "link \"{body}\": the centre of gravity is at x = {x} m, y = {y} m, but the hydrodynamic parameters \
                have it under the middle"
            )
        })?;
        ensure(near(-z, c.z_g_m), || {
            format!(
                "link \"{body}\": the centre of gravity is at z = {z} m, but the hydrodynamic parameters are for {} m",
                -c.z_g_m
            )
        })?;
        Ok(self.taken(c))
    }

    fn taken(&self, c: &Coefficients) -> (Coefficients, Vec<String>) {
        let differs = |have: f64, want: f64| (have - want).abs() > ROUNDING * want;
        let mut used = c.clone();
        let mut told = Vec::new();
        if differs(self.mass_kg, c.mass_kg) {
            used.mass_kg = self.mass_kg;
            let excess_N = (self.mass_kg - c.ballast_density_kg_m3 * c.volume_m3) * c.gravity_m_s2;
            let (way, by) = if excess_N > 0.0 { ("sinks", "heavier") } else { ("rises", "lighter") };
            told.push(format!(
                "weighs {} kg by its URDF, the hull of the hydrodynamic parameters {:.3} kg: the URDF's mass is used; \
                 {:.2} N {by} than water of {} kg/m3, it {way}",
                self.mass_kg,
                c.mass_kg,
                excess_N.abs(),
                c.ballast_density_kg_m3
            ));
        }
        for (k, axis) in ["ixx", "iyy", "izz"].into_iter().enumerate() {
            let (have, want) = (self.inertia_kg_m2[(k, k)], c.inertia_kg_m2[k]);
            if differs(have, want) {
                used.inertia_kg_m2[k] = have;
                told.push(format!(
                    "{axis} is {have} kg m2 by its URDF, {want:.5} kg m2 by the hydrodynamic parameters: the URDF's \
                    is used"
                ));
            }
        }
        if differs(-self.p_BG.z, c.z_g_m) {
            used.z_g_m = -self.p_BG.z;
            told.push(format!(
                "the centre of gravity is {} m low by its URDF, {} m by the hydrodynamic parameters: the URDF's is \
                used",
                used.z_g_m, c.z_g_m
            ));
        }
        let i = &self.inertia_kg_m2;
        for (what, have, unit, scale) in [
            ("x of the centre of gravity", self.p_BG.x, "m", c.z_g_m),
            ("y of the centre of gravity", self.p_BG.y, "m", c.z_g_m),
            ("ixy", i[(0, 1)], "kg m2", c.inertia_kg_m2.x),
            ("ixz", i[(0, 2)], "kg m2", c.inertia_kg_m2.x),
            ("iyz", i[(1, 2)], "kg m2", c.inertia_kg_m2.x),
        ] {
            if have.abs() > ROUNDING * scale {
                told.push(format!(
                    "{what} is {have} {unit} by its URDF: ignored, because the equation of motion has none"
                ));
            }
        }
        (used, told)
    }
}
