//! What moves in a step: where it would get on its own, what impulses add, and where it has come to.
//!
//! *Source:* generalised velocities. For bodies: of the centre of mass, and the angular velocity in body axes, in which
//! the mass matrix is constant. For gantries: of the joints.
//!
//! *Parameters:* mass matrices of the bodies (6 × 6, with added mass) and of the gantries (2 × 2).
//!
//! *Deviations:* on its own, a mover goes straight and turns evenly from the beginning of its step to the end. A
//! velocity that an impulse adds keeps its direction in body axes to the end of the step, so that it adds no energy
//! however far the hull turns.

use super::body::{BodyId, ContactReport};
use super::impulses::Row;
use super::solid::Physics;
use crate::frames::{Pose, Truth};
use nalgebra::{Matrix6, UnitQuaternion, Vector3, Vector6};

/// A mover: a body or a gantry.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Who {
    Body(usize),
    Gantry(usize),
}

/// A mover on its way through a step.
#[derive(Clone, Debug)]
pub(super) struct Course {
    pub(super) who: Who,
    /// Centre of mass and attitude of a body.
    pub(super) p_WG: Vector3<f64>,
    pub(super) R_WB: UnitQuaternion<f64>,
    /// Attitude that it would have without obstacles.
    R_alone: UnitQuaternion<f64>,
    /// Joints of a gantry, m.
    pub(super) joints_m: [f64; 2],
    /// Mean velocities over the step if nothing is in the way; for a body, in world axes.
    mean: Vector6<f64>,
    /// Velocities at the end of the step if nothing is in the way.
    pub(super) end: Vector6<f64>,
    /// Velocities that impulses added.
    pub(super) gained: Vector6<f64>,
    /// Whether something pushed it or was in it.
    pub(super) moved: bool,
    pub(super) contact: ContactReport,
    /// Impulses on each slide of a gantry, N s. Next: the greatest one, who gave it and where.
    pub(super) slides_N_s: [Vector3<f64>; 2],
    pub(super) hardest: Option<(f64, BodyId, Vector3<f64>)>,
}

impl Physics {
    /// All movers at the beginning of a step: bodies, then gantries.
    pub(super) fn courses(&self) -> Vec<Course> {
        let dt_s = self.dt_s();
        let blank = Course {
            who: Who::Body(0),
            p_WG: Vector3::zeros(),
            R_WB: UnitQuaternion::identity(),
            R_alone: UnitQuaternion::identity(),
            joints_m: [0.0; 2],
            mean: Vector6::zeros(),
            end: Vector6::zeros(),
            gained: Vector6::zeros(),
            moved: false,
            contact: ContactReport::default(),
            slides_N_s: [Vector3::zeros(); 2],
            hardest: None,
        };
        let bodies = self.bodies.iter().enumerate().map(|(i, body)| {
            let (start, free) = (&body.truth, body.free.as_ref().expect("step() filled it in"));
            let p_WG = start.pose.point(body.p_BG);
            let v = (free.pose.point(body.p_BG) - p_WG) / dt_s;
            let w = (free.pose.R_WB * start.pose.R_WB.inverse()).scaled_axis() / dt_s;
            Course {
                who: Who::Body(i),
                p_WG,
                R_WB: start.pose.R_WB,
                R_alone: start.pose.R_WB,
                mean: join(v, w),
                end: join(free.v_WB_B + free.w_WB_B.cross(&body.p_BG), free.w_WB_B),
                ..blank.clone()
            }
        });
        let gantries = self.gantries.iter().enumerate().map(|(i, gantry)| {
            let (from_m, to) = gantry.latest();
            let mean = [0, 1].map(|k| (to[k].position_m - from_m[k]) / dt_s);
            Course {
                who: Who::Gantry(i),
                joints_m: from_m,
                mean: Vector6::new(mean[0], mean[1], 0.0, 0.0, 0.0, 0.0),
                end: Vector6::new(to[0].speed_m_s, to[1].speed_m_s, 0.0, 0.0, 0.0, 0.0),
                ..blank.clone()
            }
        });
        bodies.chain(gantries).collect()
    }

    /// Speed that no point of a mover exceeds, m/s.
    pub(super) fn fastest_m_s(&self, course: &Course) -> f64 {
        let rate = course.rate();
        let (v, w) = (rate.fixed_rows::<3>(0), rate.fixed_rows::<3>(3));
        match course.who {
            Who::Body(i) => {
                let body = &self.bodies[i];
                v.norm() + w.norm() * (body.reach_m + body.p_BG.norm())
            }
            Who::Gantry(_) => v.abs().sum(),
        }
    }

    /// Speed of a mover's point along `axis_W`, for a unit of each of the mover's velocities.
    pub(super) fn share(
        &self,
        course: &Course,
        slide: usize,
        at_W: &Vector3<f64>,
        axis_W: &Vector3<f64>,
    ) -> Vector6<f64> {
        match course.who {
            Who::Body(_) => {
                let back = course.R_WB.inverse();
                let (axis, arm) = (back * axis_W, back * (at_W - course.p_WG));
                join(axis, arm.cross(&axis))
            }
            Who::Gantry(i) => {
                let along = self.gantries[i].along_W();
                let second = if slide == 1 { along[1].dot(axis_W) } else { 0.0 };
                Vector6::new(along[0].dot(axis_W), second, 0.0, 0.0, 0.0, 0.0)
            }
        }
    }

    /// Inverse mass matrices of the movers.
    pub(super) fn inverse_masses(&self, courses: &[Course]) -> Vec<Matrix6<f64>> {
        courses
            .iter()
            .map(|course| match course.who {
                Who::Body(i) => self.bodies[i].inverse_mass_G,
                Who::Gantry(i) => self.gantries[i].inverse_mass(),
            })
            .collect()
    }
}

impl Course {
    /// Pose of the body's origin.
    pub(super) fn pose(&self, p_BG: &Vector3<f64>) -> Pose {
        Pose { p_WB: self.p_WG - self.R_WB * p_BG, R_WB: self.R_WB }
    }

    /// Present velocities.
    pub(super) fn rate(&self) -> Vector6<f64> {
        let alone = match self.who {
            Who::Body(_) => {
                let back = self.R_alone.inverse();
                let (v, w) = (self.mean.fixed_rows::<3>(0), self.mean.fixed_rows::<3>(3));
                join(back * Vector3::from(v), back * Vector3::from(w))
            }
            Who::Gantry(_) => self.mean,
        };
        alone + self.gained
    }

    /// Moves on by `h`, s; `undo` counts for this move only.
    pub(super) fn go(&mut self, h: f64, undo: &Vector6<f64>) {
        let way = (self.rate() + undo) * h;
        match self.who {
            Who::Body(_) => {
                self.p_WG += self.R_WB * Vector3::from(way.fixed_rows::<3>(0));
                self.R_WB *= UnitQuaternion::from_scaled_axis(Vector3::from(way.fixed_rows::<3>(3)));
                let alone = Vector3::from(self.mean.fixed_rows::<3>(3)) * h;
                self.R_alone = UnitQuaternion::from_scaled_axis(alone) * self.R_alone;
            }
            Who::Gantry(_) => {
                self.joints_m[0] += way[0];
                self.joints_m[1] += way[1];
            }
        }
    }

    /// State of a body at the end of the step.
    pub(super) fn truth(&self, p_BG: &Vector3<f64>) -> Truth {
        let rate = self.end + self.gained;
        let w_WB_B = Vector3::from(rate.fixed_rows::<3>(3));
        Truth { pose: self.pose(p_BG), v_WB_B: Vector3::from(rate.fixed_rows::<3>(0)) - w_WB_B.cross(p_BG), w_WB_B }
    }
}

/// Records impulses with the movers on which they act.
pub(super) fn note(courses: &mut [Course], rows: &[Row], impulses: &[[f64; 3]], inverse: &[Matrix6<f64>]) {
    for (row, impulse) in rows.iter().zip(impulses) {
        let bodies = row.on.iter().all(|on| {
            let who = on.as_ref().map(|(m, _)| courses[*m].who);
            matches!(who, Some(Who::Body(_)))
        });
        let total: Vector3<f64> = (row.axes_W.iter().zip(impulse)).map(|(a, i)| a * *i).sum();
        for (side, (m, by)) in row.on.iter().enumerate().filter_map(|(s, on)| Some((s, on.as_ref()?))) {
            let course = &mut courses[*m];
            for (by, i) in by.iter().zip(impulse) {
                course.gained += inverse[*m] * by * *i;
            }
            if impulse[0] <= 0.0 {
                continue;
            }
            // The ends of a gantry's travel are no contact.
            if total == Vector3::zeros() {
                continue;
            }
            course.moved = true;
            let sign = if side == 0 { 1.0 } else { -1.0 };
            let contact = &mut course.contact;
            contact.only_bodies = bodies && (contact.only_bodies || !contact.touching);
            contact.touching = true;
            contact.impulse_N_s += total * sign;
            contact.max_penetration_m = contact.max_penetration_m.max(-row.gap_m);
        }
        if let [Some((a, _)), Some((b, by))] = &row.on
            && let (Who::Body(body), Who::Gantry(_)) = (courses[*a].who, courses[*b].who)
        {
            // Only the second slide moves with the second joint.
            let slide = usize::from(by.iter().any(|axis| axis[1] != 0.0));
            let course = &mut courses[*b];
            course.slides_N_s[slide] -= total;
            if impulse[0] > course.hardest.map_or(0.0, |(most, ..)| most) {
                course.hardest = Some((impulse[0], BodyId(body), row.at_W));
            }
        }
    }
}

fn join(a: Vector3<f64>, b: Vector3<f64>) -> Vector6<f64> {
    Vector6::new(a.x, a.y, a.z, b.x, b.y, b.z)
}
