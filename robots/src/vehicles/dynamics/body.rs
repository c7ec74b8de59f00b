//! The mass of a hull and of the water that it moves.
//!
//! *Source:* Fossen, "Handbook of Marine Craft Hydrodynamics and Motion Control", 2nd ed. 2021, sections 3.3 and 6.3;
//! momenta in Kirchhoff's form.
//!
//! *Parameters:* beside each field. Axes are FRD, moments about the body's origin.
//!
//! *Deviations:* none.

use super::surface::Envelope;
use nalgebra::{Matrix3, Matrix6, Vector3};

/// Rigid mass.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::vehicles) struct Mass {
    /// kg.
    pub(in crate::vehicles) kg: f64,
    /// Centre of gravity, m.
    pub(in crate::vehicles) r_G: Vector3<f64>,
    /// Inertia about the body's origin, kg m².
    pub(in crate::vehicles) inertia_kg_m2: Matrix3<f64>,
}

impl Mass {
    /// From the inertia about the centre of gravity.
    pub(in crate::vehicles) fn about_centre(kg: f64, r_G: Vector3<f64>, inertia_kg_m2: &Matrix3<f64>) -> Self {
        let arm = r_G.cross_matrix();
        Self { kg, r_G, inertia_kg_m2: inertia_kg_m2 - arm * arm * kg }
    }

    /// M_RB.
    pub(in crate::vehicles) fn matrix(&self) -> Matrix6<f64> {
        let mut M = Matrix6::zeros();
        let arm = self.r_G.cross_matrix() * self.kg;
        M.fixed_view_mut::<3, 3>(0, 0).copy_from(&(Matrix3::identity() * self.kg));
        M.fixed_view_mut::<3, 3>(0, 3).copy_from(&-arm);
        M.fixed_view_mut::<3, 3>(3, 0).copy_from(&arm);
        M.fixed_view_mut::<3, 3>(3, 3).copy_from(&self.inertia_kg_m2);
        M
    }

    /// Linear and angular momentum.
    #[inline]
    pub(super) fn momentum(&self, v: &Vector3<f64>, w: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        ((v + w.cross(&self.r_G)) * self.kg, self.r_G.cross(v) * self.kg + self.inertia_kg_m2 * w)
    }
}

/// A hull without what resists or drives it.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::vehicles) struct Body {
    /// Rigid mass.
    pub(in crate::vehicles) mass: Mass,
    /// Added mass, symmetric.
    pub(in crate::vehicles) added: Matrix6<f64>,
    /// Displaced volume, m³.
    pub(in crate::vehicles) volume_m3: f64,
    /// Centre of buoyancy, m.
    pub(in crate::vehicles) r_B: Vector3<f64>,
    /// Gravity, m/s².
    pub(in crate::vehicles) gravity_m_s2: f64,
    /// Its shape where it comes out of the water.
    pub(in crate::vehicles) envelope: Envelope,
    /// Current turned by yaw only, as some published models do, or by the whole attitude.
    pub(in crate::vehicles) current_by_yaw_only: bool,
}

/// C(ν)ν of momenta l and h: force ω × l, moment v × l + ω × h.
pub(super) fn coriolis(
    v: &Vector3<f64>,
    w: &Vector3<f64>,
    (l, h): (Vector3<f64>, Vector3<f64>),
) -> (Vector3<f64>, Vector3<f64>) {
    (w.cross(&l), v.cross(&l) + w.cross(&h))
}

/// The added mass's part of the Coriolis forces, C_A(ν)ν, with the moment of Munk.
pub(in crate::vehicles) fn added_coriolis(
    added: &Matrix6<f64>,
    v: &Vector3<f64>,
    w: &Vector3<f64>,
) -> (Vector3<f64>, Vector3<f64>) {
    let part = |row, column| added.fixed_view::<3, 3>(row, column).into_owned();
    let momenta = (part(0, 0) * v + part(0, 3) * w, part(3, 0) * v + part(3, 3) * w);
    coriolis(v, w, momenta)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector6;

    /// Momenta are M ν, so that ν C ν is zero: Coriolis forces do no work.
    #[test]
    fn momenta_follow_from_the_matrix_and_do_no_work() {
        let inertia = Matrix3::new(1.0, 0.1, 0.2, 0.1, 2.0, -0.3, 0.2, -0.3, 3.0);
        let mass = Mass::about_centre(7.0, Vector3::new(0.1, -0.2, 0.3), &inertia);
        let (v, w) = (Vector3::new(1.0, -0.5, 0.3), Vector3::new(0.2, 0.7, -1.1));
        let nu = Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z);
        let (l, h) = mass.momentum(&v, &w);
        let both = mass.matrix() * nu;
        assert!((both - Vector6::new(l.x, l.y, l.z, h.x, h.y, h.z)).norm() < 1e-12);
        for (f, m) in [coriolis(&v, &w, (l, h)), added_coriolis(&mass.matrix(), &v, &w)] {
            assert!((f.dot(&v) + m.dot(&w)).abs() < 1e-12);
            assert!(f.norm() > 1.0);
        }
    }
}
