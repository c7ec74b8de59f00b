//! What the water and its own drives do to a torpedo-shaped hull: terms of the equation of motion.
//!
//! *Source:* Fossen, "Handbook of Marine Craft Hydrodynamics and Motion Control", 2nd ed. 2021, in the form of the open
//! REMUS 100 model (see `coefficients.rs`).
//!
//! *Parameters:* [`Coefficients`].
//!
//! *Deviations:* the table in `coefficients.rs` compares these terms with the published ones. In both,
//! the entries of C_A that make the Munk moment are zero, as published: with that moment the hull is
//! unstable, and the published drag and lift were fitted without it. Hull lift, unless `published`, is
//! slope · sin α cos α (slender bodies: Munk 1924) instead of slope · α, which pushes a hull that lies
//! across the current forwards. Partly out of the water, every force falls with the share under water.

use super::actuators::Actuators;
use super::coefficients::{Coefficients, Inflow};
use crate::vehicles::dynamics::{Body, Relative, Stage, Terms};
use nalgebra::Vector3;
use world::math;

/// The terms during one step: the hull's numbers and what is asked of its actuators.
#[derive(Clone, Copy, Debug)]
pub(super) struct TorpedoTerms<'a> {
    pub(super) c: &'a Coefficients,
    pub(super) asked: Actuators,
}

impl Terms for TorpedoTerms<'_> {
    type Drives = Actuators;

    #[inline]
    fn forces(&self, _: &Body, at: &Relative, actuators: &Actuators, _: Stage) -> (Vector3<f64>, Vector3<f64>) {
        let standing = if self.c.spec.published { actuators.limited(self.c) } else { *actuators };
        let (force, moment) = self.submerged(at, &standing);
        (force * at.wet, moment * at.wet)
    }

    fn rate(&self, actuators: &Actuators) -> Actuators {
        actuators.rate(&self.asked, self.c)
    }
}

impl TorpedoTerms<'_> {
    /// All forces of the water on a fully submerged hull.
    #[inline]
    pub(super) fn submerged(&self, at: &Relative, actuators: &Actuators) -> (Vector3<f64>, Vector3<f64>) {
        let Relative { v_ground, v, w, along, rho, .. } = at;
        let rho = *rho;
        let speed = v.norm();
        let (mut force, mut moment) = self.added_coriolis(v, w);

        // Linear damping.
        let d = &self.c.damping;
        let fade = math::exp(-3.0 * speed);
        for i in 0..3 {
            // The published damping in heave does not fade.
            let share = if self.c.spec.published && i == 2 { 1.0 } else { fade };
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
        (Vector3::new(0.0, l.z * w.x, -l.y * w.x), Vector3::new(l.y * v.z - l.z * v.y, 0.0, 0.0) - w.cross(&h))
    }

    /// Lift and drag of the hull from its incidence α, C_D = C_D0 + C_L²/(π e AR).
    fn hull_lift_and_drag(&self, v: &Vector3<f64>, speed: f64, rho: f64) -> Vector3<f64> {
        let c = self.c;
        let pressure = 0.5 * rho * speed * speed * c.area_m2;
        let drag = |lift: f64| c.drag_0 + lift * lift / c.induced;
        if c.spec.published {
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
        let c = self.c;
        let (stations, dx) = &c.stations_m;
        let k = 0.5 * rho * c.spec.diameter_m.get() * c.cross_flow * dx;
        let (mut Y, mut Z, mut M, mut N) = (0.0, 0.0, 0.0, 0.0);
        if c.spec.published {
            for &x in stations {
                let vy = v.y + x * w.z;
                let fy = vy.abs() * vy;
                Y -= fy;
                N -= x * fy;
            }
        } else {
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
        }
        (Vector3::new(0.0, k * Y, k * Z), Vector3::new(0.0, k * M, k * N))
    }

    /// Rudder and stern plane. Unless `published`, a plate at angle δ feels the water across it,
    /// |V|(u δ + v), as the fins' Y_uuδ, Y_uv and Y_ur of Prestero 2001.
    fn fins(
        &self,
        v: &Vector3<f64>,
        w: &Vector3<f64>,
        along: &Vector3<f64>,
        rho: f64,
        actuators: &Actuators,
    ) -> (Vector3<f64>, Vector3<f64>) {
        let (c, fins) = (self.c, &self.c.spec.fins);
        let k = 0.5 * rho * (2.0 * fins.area_m2.get());
        let (kr, ks) = (k * fins.rudder_slope.get(), k * fins.stern_slope.get());
        let (dr, ds) = (actuators.rudder_rad, actuators.stern_rad);
        let (normal_r, normal_s) = if c.spec.published {
            ((v.x * v.x + v.y * v.y) * dr, (v.x * v.x + v.z * v.z) * ds)
        } else {
            let vy = v.y + c.fin_x_m * (w.z - along.y);
            let vz = v.z + c.fin_x_m * (-w.y - along.z);
            let at_rudder = (v.x * v.x + vy * vy).sqrt();
            let at_stern = (v.x * v.x + vz * vz).sqrt();
            (at_rudder * (v.x * dr + vy), at_stern * (v.x * ds + vz))
        };
        let (Y, Z) = (-kr * normal_r, -ks * normal_s);
        let X = Y * dr + Z * ds;
        (Vector3::new(X, Y, Z), Vector3::new(0.0, -c.fin_x_m * Z, c.fin_x_m * Y))
    }

    /// Power of the shaft, W, at a velocity through the water (FRD).
    pub(super) fn shaft_w(&self, v_ground: &Vector3<f64>, v: &Vector3<f64>, rho: f64, rpm: f64) -> f64 {
        let n = rpm / 60.0;
        let (_, torque) = self.propeller(v_ground, v, v.norm(), rho, n);
        (torque.x / self.c.spec.propeller.torque_share.get() * n * std::f64::consts::TAU).max(0.0)
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
        let (c, p) = (self.c, &self.c.spec.propeller);
        let inflow = match c.inflow {
            Inflow::Ground => v_ground.norm(),
            Inflow::Water => speed,
            Inflow::Axial => v.x.max(0.0),
        };
        let D = p.diameter_m.get();
        let D4 = D * D * D * D;
        // Astern, the curves' values at rest are used.
        let advance = if n > 0.0 { p.wake_share.get() * inflow / D } else { 0.0 };
        let by = |k: &[f64; 2]| k[0] * n * n.abs() + k[1] * advance * n.abs();
        (
            Vector3::new(p.thrust_share.get() * rho * D4 * by(&c.thrust), 0.0, 0.0),
            Vector3::new(p.torque_share.get() * rho * D4 * D * by(&c.torque), 0.0, 0.0),
        )
    }
}
