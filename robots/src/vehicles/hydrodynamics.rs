//! Acceleration of a torpedo-shaped hull in moving water: the only file with NED and FRD axes.
//!
//! *Source:* Fossen, "Handbook of Marine Craft Hydrodynamics and Motion Control", 2nd ed. 2021, in
//! the form of the open REMUS 100 model (see `coefficients.rs`):
//!
//! ```text
//! ν̇ = ċ + M⁻¹ [ τ − C_RB(ν_r) ν_r − C_A(ν_r) ν_r − D(ν_r) ν_r − g + (ρV − M_RB) a_u ]
//! ```
//!
//! with ν = (u v w p q r) of the centre of buoyancy CO over ground, ν_r = ν − c, M = M_RB + M_A,
//! c the current in body axes, ċ = −ω × c + a_u, a_u = Rᵀ(∂u/∂t + (v·∇)u); the ρV term takes the
//! material derivative of the water (Froude-Krylov). For steady uniform water it is the same as with C_RB(ν)ν on the right.
//!
//! *Parameters:* [`Coefficients`].
//!
//! *Deviations:* the table in `coefficients.rs` compares the default set with the published one. In both,
//! the entries of C_A that make the Munk moment are zero, as published: with that moment the hull is
//! unstable, and the published drag and lift were fitted without it. Hull lift of the default set is
//! slope · sin α cos α (slender bodies: Munk 1924) instead of slope · α, which pushes a hull that lies
//! across the current forwards. A hull partly out of the water keeps its added mass; every other
//! water force falls with the share under water.

use super::coefficients::{Coefficients, Inflow};
use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3, Vector6};
use world::math;
use world::units::GRAVITY_M_S2;

/// State of the actuators.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Actuators {
    /// Rudder, positive turns to starboard, rad.
    pub rudder_rad: f64,
    /// Stern plane, positive pitches the nose down, rad.
    pub stern_rad: f64,
    /// Propeller, rpm.
    pub rpm: f64,
}

/// Water around the hull, ENU.
#[derive(Clone, Copy, Debug)]
pub(super) struct HullWater {
    /// Velocity at CO, m/s.
    pub(super) u_W: Vector3<f64>,
    /// ∂u_i/∂x_j, 1/s.
    pub(super) gradient_W: Matrix3<f64>,
    /// ∂u/∂t, m/s².
    pub(super) rate_W: Vector3<f64>,
    /// kg/m³.
    pub(super) density_kg_m3: f64,
    /// Share of the hull under water.
    pub(super) wet: f64,
    /// Where the middle of that share is along the hull, m.
    pub(super) wet_x_m: f64,
}

/// A hull's equation of motion.
#[derive(Clone, Debug)]
pub(super) struct Hydrodynamics {
    pub(super) c: Coefficients,
    inverse_mass: Matrix6<f64>,
}

/// FLU to FRD and back: y and z change sign, also of angular vectors (a half turn about x). A zero becomes +0: the
/// published model starts from it, and in a following current atan2(±0, −u) is ±π.
fn flip(v: Vector3<f64>) -> Vector3<f64> {
    Vector3::new(v.x, 0.0 - v.y, 0.0 - v.z)
}

impl Hydrodynamics {
    pub(super) fn new(c: Coefficients) -> Self {
        let inverse_mass = (c.rigid_mass() + c.added_mass())
            .try_inverse()
            .expect("masses of the catalogue are positive");
        Self { c, inverse_mass }
    }

    /// (v̇, ω̇) in body axes (FLU) of velocity over ground `v` and angular velocity `w` (FLU).
    pub(super) fn acceleration(
        &self,
        R_WB: &Rotation3<f64>,
        v: &Vector3<f64>,
        w: &Vector3<f64>,
        water: &HullWater,
        actuators: &Actuators,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let c = &self.c;
        let (v, w) = (flip(*v), flip(*w));
        let to_body = |x: &Vector3<f64>| flip(R_WB.inverse_transform_vector(x));
        let down = to_body(&-Vector3::z());

        let mut force = Vector3::zeros();
        let (current, mut current_rate);
        let mut moment = Vector3::zeros();
        // Change of the water's velocity per metre towards the nose.
        let mut along = Vector3::zeros();
        if c.current_by_yaw_only {
            let bow = R_WB.matrix().fixed_view::<2, 1>(0, 0).normalize();
            let starboard = Vector3::new(bow.y, -bow.x, 0.0);
            current = Vector3::new(
                bow.x * water.u_W.x + bow.y * water.u_W.y,
                starboard.dot(&water.u_W),
                0.0,
            );
            current_rate = Vector3::new(w.z * current.y, -w.z * current.x, 0.0);
        } else {
            current = to_body(&water.u_W);
            let v_W = R_WB * flip(v);
            let a_hull = to_body(&(water.rate_W + water.gradient_W * v_W));
            let a_water = to_body(&(water.rate_W + water.gradient_W * water.u_W));
            current_rate = -w.cross(&current) + a_hull;
            force += a_water * (water.density_kg_m3 * c.volume_m3 * water.wet);
            // M_RB a_u also has a moment, because the centre of gravity is not CO.
            force -= a_hull * c.mass_kg;
            moment -= Vector3::new(0.0, 0.0, c.z_g_m).cross(&(a_hull * c.mass_kg));
            along = to_body(&(water.gradient_W * R_WB.matrix().column(0)));
        }
        let v_r = v - current;

        let (f, m) = self.rigid_coriolis(&v_r, &w);
        force -= f;
        moment -= m;

        let (f, m) = self.water_forces(&v, &v_r, &w, &along, water.density_kg_m3, actuators);
        force += f * water.wet;
        moment += m * water.wet;

        // Weight at CG, buoyancy at the middle of the part under water.
        let weight = c.mass_kg * GRAVITY_M_S2;
        let buoyancy = water.density_kg_m3 * c.volume_m3 * GRAVITY_M_S2 * water.wet;
        force += down * (weight - buoyancy);
        moment += Vector3::new(0.0, 0.0, c.z_g_m).cross(&(down * weight));
        moment -= Vector3::new(water.wet_x_m, 0.0, 0.0).cross(&(down * buoyancy));

        let tau = Vector6::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
        let nu_dot = self.inverse_mass * tau;
        current_rate += nu_dot.fixed_rows::<3>(0);
        (
            flip(current_rate),
            flip(nu_dot.fixed_rows::<3>(3).into_owned()),
        )
    }

    /// C_RB(ν)ν, Kirchhoff's form: l = m(v + ω × r_G), h = r_G × m v + I ω; force ω × l, moment v × l + ω × h.
    fn rigid_coriolis(&self, v: &Vector3<f64>, w: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let c = &self.c;
        let r_G = Vector3::new(0.0, 0.0, c.z_g_m);
        let l = (v + w.cross(&r_G)) * c.mass_kg;
        let shift = c.mass_kg * c.z_g_m * c.z_g_m;
        let inertia = c.inertia_kg_m2 + Vector3::new(shift, shift, 0.0);
        let h = r_G.cross(v) * c.mass_kg + inertia.component_mul(w);
        (w.cross(&l), v.cross(&l) + w.cross(&h))
    }

    /// τ − C_A(ν_r)ν_r − D ν_r: all forces of the water on a fully submerged hull.
    pub(super) fn water_forces(
        &self,
        v_ground: &Vector3<f64>,
        v: &Vector3<f64>,
        w: &Vector3<f64>,
        along: &Vector3<f64>,
        rho: f64,
        actuators: &Actuators,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let speed = v.norm();
        let (mut force, mut moment) = self.added_coriolis(v, w);

        // Linear damping.
        let d = &self.c.damping;
        let fade = math::exp(-3.0 * speed);
        for i in 0..3 {
            let share = if self.c.damping_fades[i] { fade } else { 1.0 };
            force[i] -= d[i] * share * v[i];
            moment[i] -= d[i + 3] * w[i];
        }

        force += self.hull_lift_and_drag(v, speed, rho);

        let parts = [
            self.cross_flow(v, w, along, rho),
            self.fins(v, w, along, rho, actuators),
            self.propeller(v_ground, v, speed, rho, actuators.rpm / 60.0),
        ];
        for (f, m) in parts {
            force += f;
            moment += m;
        }
        (force, moment)
    }

    /// −C_A(ν_r)ν_r without the entries (1,5) (1,6) (2,6) (3,5) and their transposes.
    fn added_coriolis(&self, v: &Vector3<f64>, w: &Vector3<f64>) -> (Vector3<f64>, Vector3<f64>) {
        let a = &self.c.added;
        let l = Vector3::new(a[0] * v.x, a[1] * v.y, a[2] * v.z);
        let h = Vector3::new(a[3] * w.x, a[4] * w.y, a[5] * w.z);
        (
            Vector3::new(0.0, l.z * w.x, -l.y * w.x),
            Vector3::new(l.y * v.z - l.z * v.y, 0.0, 0.0) - w.cross(&h),
        )
    }

    /// Lift and drag of the hull from its incidence α, C_D = C_D0 + C_L²/(π e AR).
    fn hull_lift_and_drag(&self, v: &Vector3<f64>, speed: f64, rho: f64) -> Vector3<f64> {
        let c = &self.c;
        let pressure = 0.5 * rho * speed * speed * c.area_m2;
        let drag = |lift: f64| c.drag_0 + lift * lift / c.induced;
        if !c.lift_any_plane {
            let alpha = math::atan2(v.z, v.x);
            let lift = c.lift_slope * alpha;
            let (sin, cos) = math::sin_cos(alpha);
            let (L, D) = (pressure * lift, pressure * drag(lift));
            return Vector3::new(-D * cos + L * sin, 0.0, -D * sin - L * cos);
        }
        if speed == 0.0 {
            return Vector3::zeros();
        }
        let across = Vector3::new(0.0, v.y, v.z) / speed;
        let (sin, cos) = (across.norm(), v.x / speed);
        let lift = c.lift_slope * sin * cos;
        let (L, D) = (pressure * lift, pressure * drag(lift));
        let side = if sin > 0.0 { across / sin } else { across };
        Vector3::x() * (L * sin - D * cos) - side * (D * sin + L * cos)
    }

    /// Strip-theory drag of the cross-flow along the hull.
    fn cross_flow(
        &self,
        v: &Vector3<f64>,
        w: &Vector3<f64>,
        along: &Vector3<f64>,
        rho: f64,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let c = &self.c;
        let (stations, dx) = &c.stations_m;
        let k = 0.5 * rho * c.diameter_m * c.cross_flow * dx;
        let (mut Y, mut Z, mut M, mut N) = (0.0, 0.0, 0.0, 0.0);
        if c.cross_flow_both {
            let (turn_y, turn_z) = (w.z - along.y, -w.y - along.z);
            for &x in stations {
                let (vy, vz) = (v.y + x * turn_y, v.z + x * turn_z);
                let size = (vy * vy + vz * vz).sqrt();
                let (fy, fz) = (size * vy, size * vz);
                Y -= fy;
                Z -= fz;
                N -= x * fy;
                M += x * fz;
            }
        } else {
            for &x in stations {
                let vy = v.y + x * w.z;
                let fy = vy.abs() * vy;
                Y -= fy;
                N -= x * fy;
            }
        }
        (
            Vector3::new(0.0, k * Y, k * Z),
            Vector3::new(0.0, k * M, k * N),
        )
    }

    /// Rudder and stern plane. With incidence: a plate at angle δ feels the water across it,
    /// |V|(u δ + v), as the fins' Y_uuδ, Y_uv and Y_ur of Prestero 2001.
    fn fins(
        &self,
        v: &Vector3<f64>,
        w: &Vector3<f64>,
        along: &Vector3<f64>,
        rho: f64,
        actuators: &Actuators,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let c = &self.c;
        let k = 0.5 * rho * c.fin_area_m2;
        let (kr, ks) = (k * c.fin_slope[0], k * c.fin_slope[1]);
        let (dr, ds) = (actuators.rudder_rad, actuators.stern_rad);
        let (normal_r, normal_s) = if c.fin_incidence {
            let vy = v.y + c.fin_x_m * (w.z - along.y);
            let vz = v.z + c.fin_x_m * (-w.y - along.z);
            let at_rudder = (v.x * v.x + vy * vy).sqrt();
            let at_stern = (v.x * v.x + vz * vz).sqrt();
            (at_rudder * (v.x * dr + vy), at_stern * (v.x * ds + vz))
        } else {
            ((v.x * v.x + v.y * v.y) * dr, (v.x * v.x + v.z * v.z) * ds)
        };
        let (Y, Z) = (-kr * normal_r, -ks * normal_s);
        let X = Y * dr + Z * ds;
        (
            Vector3::new(X, Y, Z),
            Vector3::new(0.0, -c.fin_x_m * Z, c.fin_x_m * Y),
        )
    }

    /// Thrust and shaft torque by linear open-water curves, n in rev/s.
    fn propeller(
        &self,
        v_ground: &Vector3<f64>,
        v: &Vector3<f64>,
        speed: f64,
        rho: f64,
        n: f64,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let c = &self.c;
        let inflow = match c.inflow {
            Inflow::Ground => v_ground.norm(),
            Inflow::Water => speed,
            Inflow::Axial => v.x.max(0.0),
        };
        let D = c.propeller_m;
        let D4 = D * D * D * D;
        // Astern, the curves' values at rest are used.
        let advance = if n > 0.0 {
            c.wake_share * inflow / D
        } else {
            0.0
        };
        let by = |k: &[f64; 2]| k[0] * n * n.abs() + k[1] * advance * n.abs();
        (
            Vector3::new(c.thrust_share * rho * D4 * by(&c.thrust), 0.0, 0.0),
            Vector3::new(c.torque_share * rho * D4 * D * by(&c.torque), 0.0, 0.0),
        )
    }
}
