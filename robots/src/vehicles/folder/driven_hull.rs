//! A hull with blocks of damping and drives at work.
//!
//! *Source:* the equation of motion in `vehicles/dynamics`; drives in `vehicles/drives`.
//!
//! *Parameters:* [`VehicleFile`](super::VehicleFile).
//!
//! *Deviations:* a step is cut into so many equal ones that the fastest decay and the fastest swing of the hull stay
//! within what a Runge-Kutta step follows ([`FASTEST`]), 1024 at most. What is asked of the drives holds for the whole
//! step; they follow it exactly.

use super::blocks::{Damping, Step};
use crate::handoff::{
    Actuation, Capabilities, Control, DriveCommand, DriveUnit, MOST_DRIVES, NamedDrive, Plant, PlantDrive,
};
use crate::vehicles::drives::{Drive, Kind};
use crate::vehicles::dynamics::Equation;
use crate::vehicles::motion::{Inertia, Motion, Statics, VehicleDrive, foreign};
use nalgebra::{Matrix6, Vector3, Vector6};
use world::fields::WaterSample;
use world::frames::Truth;

/// Greatest product of a step and a rate of the hull. Runge-Kutta's fourth order is stable to 2.8; at 0.5 its error in
/// amplitude is below 1e-4 of a swing.
const FASTEST: f64 = 0.5;
/// Most parts of a step.
const MOST_PARTS: f64 = 1024.0;

/// Rates of a hull, 1/s, of which none is exceeded by an eigenvalue of its linearised motion.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rates {
    /// Swing in roll and pitch, and linear damping.
    pub(super) rest: f64,
    /// Quadratic damping, for each unit of each velocity.
    pub(super) by_speed: [f64; 6],
    /// Mass with added mass, FLU, and the inverse of its root.
    pub(super) mass: [Matrix6<f64>; 2],
}

impl Rates {
    /// Bound of all of them at a velocity.
    fn bound(&self, nu: &Vector6<f64>) -> f64 {
        let fast = self.rest + self.coriolis(nu);
        (self.by_speed.iter().zip(nu.iter())).fold(fast, |sum, (rate, v)| sum + rate * v.abs())
    }

    /// Rate of the Coriolis forces: twice the norm of C(ν) between inverse roots of the mass, for they are quadratic.
    fn coriolis(&self, nu: &Vector6<f64>) -> f64 {
        let [mass, root] = &self.mass;
        let momentum = mass * nu;
        let l = momentum.fixed_rows::<3>(0).into_owned().cross_matrix();
        let h = momentum.fixed_rows::<3>(3).into_owned().cross_matrix();
        let mut C = Matrix6::zeros();
        C.fixed_view_mut::<3, 3>(0, 3).copy_from(&l);
        C.fixed_view_mut::<3, 3>(3, 0).copy_from(&l);
        C.fixed_view_mut::<3, 3>(3, 3).copy_from(&h);
        2.0 * (root * C * root).norm()
    }
}

/// A hull with drives, and their state.
#[derive(Clone, Debug)]
pub(in crate::vehicles) struct DrivenHull {
    pub(super) equation: Equation,
    pub(super) damping: Damping,
    pub(super) rates: Rates,
    pub(super) drives: Vec<Drive>,
    pub(super) states: [f64; MOST_DRIVES],
    pub(super) asked: [f64; MOST_DRIVES],
    pub(super) statics: Statics,
    pub(super) plant: Plant,
    pub(super) capabilities: Capabilities,
}

impl DrivenHull {
    /// The state after a step with these set-points.
    fn drive(&mut self, truth: &Truth, water: &WaterSample, command: &DriveCommand, dt_s: f64) -> Truth {
        let n = self.drives.len();
        self.asked[..n].copy_from_slice(command.all());
        let parts = self.parts(truth, water, dt_s);
        let h = dt_s / f64::from(parts);
        let mut now = *truth;
        for part in 0..parts {
            let mut states = [self.states; 3];
            for (k, drive) in self.drives.iter().enumerate() {
                let after = |t_s| drive.after(self.states[k], self.asked[k], t_s);
                (states[0][k], states[1][k], states[2][k]) = (after(0.0), after(h / 2.0), after(h));
            }
            let t_s = h * f64::from(part);
            let moved = now.pose.p_WB - truth.pose.p_WB;
            let sample = WaterSample { velocity: water.velocity + water.gradient * moved + water.rate * t_s, ..*water };
            let terms = Step {
                damping: &self.damping,
                drives: &self.drives,
                states: [&states[0][..n], &states[1][..n], &states[2][..n]],
            };
            (now, ()) = self.equation.advance(&terms, &now, &(), &sample, h);
            self.states = states[2];
        }
        now
    }

    /// Time in which its fastest motion decays or swings at a speed in every direction, m/s, and at 1 rad/s, s.
    pub(super) fn shortest_s(&self, v: f64) -> f64 {
        1.0 / self.rates.bound(&Vector6::new(v, v, v, 1.0, 1.0, 1.0))
    }

    /// Into how many parts a step is cut.
    fn parts(&self, truth: &Truth, water: &WaterSample, dt_s: f64) -> u32 {
        let v = truth.v_WB_B - truth.pose.R_WB.inverse() * water.velocity;
        let w = truth.w_WB_B;
        let fast = self.rates.bound(&Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z));
        (dt_s * fast / FASTEST).ceil().clamp(1.0, MOST_PARTS) as u32
    }
}

impl Motion for DrivenHull {
    fn control(&self) -> Control {
        Control::Drives(Box::new(self.plant.clone()))
    }

    fn capabilities(&self, _: f64) -> Capabilities {
        self.capabilities
    }

    fn top_speed_m_s(&self, _: f64) -> f64 {
        self.capabilities.top_speed_m_s
    }

    fn idle(&self) -> Actuation {
        Actuation::Drives(DriveCommand::new(&self.drives.iter().map(Drive::idle).collect::<Vec<_>>()))
    }

    fn drives(&self) -> Vec<VehicleDrive> {
        let fitted = |(drive, plant): (&Drive, &PlantDrive)| {
            let (unit, way) = match &drive.kind {
                Kind::Thruster(t) => (DriveUnit::Own, t.axis),
                // A positive angle turns its leading edge against the lift.
                Kind::Fin(fin) => (DriveUnit::Fin, -fin.lift),
                Kind::Buoyancy(..) => (DriveUnit::Own, -Vector3::z()),
                Kind::Mass(way, ..) => (DriveUnit::Own, *way),
            };
            VehicleDrive {
                named: NamedDrive { name: drive.link.clone(), unit, idle: plant.idle },
                limits: plant.limits,
                way: Vector3::new(way.x, -way.y, -way.z),
                does: plant.does.clone(),
            }
        };
        self.drives.iter().zip(&self.plant.drives).map(fitted).collect()
    }

    fn states(&self) -> Vec<f64> {
        self.states[..self.drives.len()].to_vec()
    }

    fn power_w(&self) -> f64 {
        let each = self.drives.iter().zip(self.states.iter().zip(&self.asked));
        each.map(|(d, (now, asked))| d.power_w(*now, *asked)).sum()
    }

    fn inertia(&self) -> Inertia {
        Inertia { p_BG: self.statics.centres[0], mass: self.statics.whole_mass, without_momentum: false }
    }

    fn statics(&self) -> Option<Statics> {
        Some(self.statics.clone())
    }

    fn follows(&self, step_s: f64, speed_m_s: f64) -> Result<(), String> {
        let shortest_s = self.shortest_s(speed_m_s);
        let most_s = FASTEST * MOST_PARTS * shortest_s;
        if step_s <= most_s {
            return Ok(());
        }
        Err(format!(
            "steps of {step_s} s are too long for this hull, whose motion at {speed_m_s:.2} m/s decays within \
             {shortest_s:.1e} s; the longest possible are of {most_s:.1e} s: look at its mass and damping"
        ))
    }

    fn step_in(&mut self, truth: &Truth, water: &WaterSample, set: &Actuation, dt_s: f64) -> Truth {
        match set {
            Actuation::Drives(set) => self.drive(truth, water, set, dt_s),
            other => foreign(other),
        }
    }
}
