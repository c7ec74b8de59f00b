//! Acceleration of a hull in moving water.
//!
//! *Source:* Fossen, "Handbook of Marine Craft Hydrodynamics and Motion Control", 2nd ed. 2021, chapters 6 and 8:
//!
//! ```text
//! ν̇ = ċ + M⁻¹ [ τ(ν_r) − C_RB(ν_r) ν_r − g + (ρV − M_RB) a_u ]
//! ```
//!
//! with ν = (u v w p q r) of the body's origin over ground, ν_r = ν − c, M = M_RB + M_A, c the current in body axes,
//! ċ = −ω × c + a_u, a_u = Rᵀ(∂u/∂t + (v·∇)u); the ρV term takes the material derivative of the water
//! (Froude-Krylov). τ are the forces of [`Terms`], C_A among them. For steady uniform water it is the same as with
//! C_RB(ν)ν on the right.
//!
//! *Parameters:* [`Body`].
//!
//! *Deviations:* a hull partly out of the water keeps its added mass; buoyancy falls with the share under water, and
//! the terms say how they do.

use super::axes::{flip, turned};
use super::body::{Body, coriolis};
use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3, Vector6};

/// Water around the hull, ENU.
#[derive(Clone, Copy, Debug)]
pub(in crate::vehicles) struct HullWater {
    /// Velocity at the origin, m/s.
    pub(in crate::vehicles) u_W: Vector3<f64>,
    /// ∂u_i/∂x_j, 1/s.
    pub(in crate::vehicles) gradient_W: Matrix3<f64>,
    /// ∂u/∂t, m/s².
    pub(in crate::vehicles) rate_W: Vector3<f64>,
    /// kg/m³.
    pub(in crate::vehicles) density_kg_m3: f64,
    /// Share of the hull under water.
    pub(in crate::vehicles) wet: f64,
    /// Middle of that share, from the middle of the whole hull, m, FRD.
    pub(in crate::vehicles) wet_r: Vector3<f64>,
    /// Height of the origin above the surface, m.
    pub(in crate::vehicles) z_m: f64,
}

/// Motion of a hull relative to the water, FRD.
#[derive(Clone, Copy, Debug)]
pub(in crate::vehicles) struct Relative {
    /// Velocity over ground, m/s.
    pub(in crate::vehicles) v_ground: Vector3<f64>,
    /// Velocity through the water, m/s.
    pub(in crate::vehicles) v: Vector3<f64>,
    /// Angular velocity, rad/s.
    pub(in crate::vehicles) w: Vector3<f64>,
    /// Change of the water's velocity for each metre towards the nose, 1/s.
    pub(in crate::vehicles) along: Vector3<f64>,
    /// Density of the water, kg/m³.
    pub(in crate::vehicles) rho: f64,
    /// Downwards, a unit vector.
    pub(in crate::vehicles) down: Vector3<f64>,
    /// Height of the origin above the surface, m.
    pub(in crate::vehicles) z_m: f64,
    /// Share of the hull under water.
    pub(in crate::vehicles) wet: f64,
}

/// An instant within a step of the integrator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::vehicles) enum Stage {
    /// Its beginning.
    Start,
    /// Its middle.
    Middle,
    /// Its end.
    End,
}

/// A state of drives that the integrator carries along.
pub(in crate::vehicles) trait Carried: Copy {
    /// The state after `h` seconds at a rate.
    fn moved(&self, rate: &Self, h: f64) -> Self;
}

impl Carried for () {
    fn moved(&self, (): &Self, _: f64) -> Self {}
}

/// Forces of the water on a hull and of its drives, during one step.
pub(in crate::vehicles) trait Terms {
    /// State of the drives, as far as the integrator carries it.
    type Drives: Carried;

    /// Force and moment about the origin, FRD, with those of the added mass's Coriolis term.
    fn forces(&self, body: &Body, at: &Relative, drives: &Self::Drives, stage: Stage) -> (Vector3<f64>, Vector3<f64>);

    /// Change of the drives' state per second.
    fn rate(&self, drives: &Self::Drives) -> Self::Drives;
}

/// A hull's equation of motion.
#[derive(Clone, Debug)]
pub(in crate::vehicles) struct Equation {
    pub(in crate::vehicles) body: Body,
    inverse_mass: Matrix6<f64>,
}

impl Equation {
    /// `None` if the mass matrix cannot be inverted.
    pub(in crate::vehicles) fn new(body: Body) -> Option<Self> {
        let inverse_mass = (body.mass.matrix() + body.added).try_inverse()?;
        Some(Self { body, inverse_mass })
    }

    /// M_RB + M_A in FLU, for contacts.
    pub(in crate::vehicles) fn whole_mass_flu(&self) -> Matrix6<f64> {
        turned(&(self.body.mass.matrix() + self.body.added))
    }

    /// (v̇, ω̇) in body axes (FLU) of velocity over ground `v` and angular velocity `w` (FLU).
    #[allow(clippy::too_many_arguments, reason = "the state, the water and the drives of one instant")]
    #[inline]
    pub(in crate::vehicles) fn acceleration<T: Terms>(
        &self,
        terms: &T,
        R_WB: &Rotation3<f64>,
        v: &Vector3<f64>,
        w: &Vector3<f64>,
        water: &HullWater,
        drives: &T::Drives,
        stage: Stage,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let body = &self.body;
        let mass = &body.mass;
        let (v, w) = (flip(*v), flip(*w));
        let to_body = |x: &Vector3<f64>| flip(R_WB.inverse_transform_vector(x));
        let up = R_WB.matrix().row(2);
        let down = Vector3::new(0.0 - up[0], up[1], up[2]);

        let mut force = Vector3::zeros();
        let (current, mut current_rate);
        let mut moment = Vector3::zeros();
        let mut along = Vector3::zeros();
        if body.current_by_yaw_only {
            let bow = R_WB.matrix().fixed_view::<2, 1>(0, 0).normalize();
            let starboard = Vector3::new(bow.y, -bow.x, 0.0);
            current = Vector3::new(bow.x * water.u_W.x + bow.y * water.u_W.y, starboard.dot(&water.u_W), 0.0);
            current_rate = Vector3::new(w.z * current.y, -w.z * current.x, 0.0);
        } else {
            current = to_body(&water.u_W);
            let (mut a_hull, mut a_water) = (Vector3::zeros(), Vector3::zeros());
            // Uniform, steady water does not push.
            if water.rate_W != Vector3::zeros() || water.gradient_W != Matrix3::zeros() {
                let v_W = R_WB * flip(v);
                a_hull = to_body(&(water.rate_W + water.gradient_W * v_W));
                a_water = to_body(&(water.rate_W + water.gradient_W * water.u_W));
                along = to_body(&(water.gradient_W * R_WB.matrix().column(0)));
            }
            current_rate = -w.cross(&current) + a_hull;
            let pushed = a_water * (water.density_kg_m3 * body.volume_m3 * water.wet);
            force += pushed;
            moment += body.r_B.cross(&pushed);
            // M_RB a_u also has a moment, because the centre of gravity is not the origin.
            force -= a_hull * mass.kg;
            moment -= mass.r_G.cross(&(a_hull * mass.kg));
        }
        let v_r = v - current;

        let (f, m) = coriolis(&v_r, &w, mass.momentum(&v_r, &w));
        force -= f;
        moment -= m;

        let at =
            Relative { v_ground: v, v: v_r, w, along, rho: water.density_kg_m3, down, z_m: water.z_m, wet: water.wet };
        let (f, m) = terms.forces(body, &at, drives, stage);
        force += f;
        moment += m;

        // Weight at the centre of gravity, buoyancy at the middle of the part under water.
        let weight = mass.kg * body.gravity_m_s2;
        let buoyancy = water.density_kg_m3 * body.volume_m3 * body.gravity_m_s2 * water.wet;
        force += down * (weight - buoyancy);
        moment += mass.r_G.cross(&(down * weight));
        moment -= (body.r_B + water.wet_r).cross(&(down * buoyancy));

        let tau = Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
        let nu_dot = self.inverse_mass * tau;
        current_rate += nu_dot.fixed_rows::<3>(0);
        (flip(current_rate), flip(nu_dot.fixed_rows::<3>(3).into_owned()))
    }
}
