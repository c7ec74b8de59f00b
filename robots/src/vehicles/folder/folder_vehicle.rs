//! A vehicle of a folder at work: its hull, its drives and their state.
//!
//! *Source:* the equation of motion in `vehicles/dynamics`; drives in `vehicles/drives`.
//!
//! *Parameters:* [`VehicleFile`](super::VehicleFile).
//!
//! *Deviations:* a step is cut into so many equal ones that the fastest decay and the fastest swing of the hull stay
//! within what a Runge-Kutta step follows ([`FASTEST`]), 1024 at most. What is asked of the drives holds for the whole
//! step; they follow it exactly.

use super::blocks::{Damping, Step};
use crate::handoff::{Capabilities, DriveCommand, DriveUnit, MOST_DRIVES, NamedDrive, Plant};
use crate::vehicles::drives::{Drive, Kind};
use crate::vehicles::dynamics::Equation;
use crate::vehicles::urdf::Shell;
use nalgebra::{Matrix6, Vector3, Vector6};
use world::fields::WaterSample;
use world::frames::{Pose, Truth};
use world::physics::{BodySpec, Shape};

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

/// A vehicle of a folder, and the state of its drives; pose and velocity belong to the physics.
#[derive(Clone, Debug)]
pub struct FolderVehicle {
    /// Name of the vehicle.
    pub(super) name: String,
    pub(super) shell: Shell,
    pub(super) equation: Equation,
    pub(super) damping: Damping,
    pub(super) rates: Rates,
    pub(super) drives: Vec<Drive>,
    pub(super) states: [f64; MOST_DRIVES],
    pub(super) asked: [f64; MOST_DRIVES],
    pub(super) told: Vec<String>,
    pub(super) plant: Plant,
    pub(super) capabilities: Capabilities,
}

impl FolderVehicle {
    /// Name of the vehicle.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// What is doubtful about it, one sentence each.
    pub fn doubts(&self) -> &[String] {
        &self.told
    }

    /// What its autopilot knows of it.
    pub fn plant(&self) -> &Plant {
        &self.plant
    }

    /// What it can do.
    pub fn capabilities(&self) -> Capabilities {
        self.capabilities
    }

    /// Mass by its URDF, kg.
    pub fn mass_kg(&self) -> f64 {
        self.equation.body.mass.kg
    }

    /// Centres of gravity and of buoyancy, FLU, m.
    pub fn centres(&self) -> [Vector3<f64>; 2] {
        let body = &self.equation.body;
        [body.mass.r_G, body.r_B].map(|r| Vector3::new(r.x, -r.y, -r.z))
    }

    /// Shapes to look at, in body axes, with their colours (`#rrggbb`).
    pub fn visuals(&self) -> &[(Pose, Shape, String)] {
        &self.shell.visuals
    }

    /// Where each drive acts and in which direction for a positive set-point, FLU: a moving mass along its way, a
    /// buoyancy engine upwards.
    pub fn acting(&self) -> impl Iterator<Item = (Vector3<f64>, Vector3<f64>)> {
        self.drives.iter().map(|drive| {
            let (r, way) = match &drive.kind {
                Kind::Thruster(t) => (t.r, t.axis),
                // A positive angle turns its leading edge against the lift.
                Kind::Fin(fin) => (fin.r, -fin.lift),
                Kind::Buoyancy(r, _) => (*r, -Vector3::z()),
                Kind::Mass(way, _, _) => (Vector3::zeros(), *way),
            };
            (Vector3::new(r.x, -r.y, -r.z), Vector3::new(way.x, -way.y, -way.z))
        })
    }

    /// Links of its drives, in the order of their set-points.
    pub fn drives(&self) -> impl Iterator<Item = &str> {
        self.drives.iter().map(|d| d.link.as_str())
    }

    /// Present state of each drive: thrusters' inputs, angles (rad), volumes (m³), places (m).
    pub fn states(&self) -> &[f64] {
        &self.states[..self.drives.len()]
    }

    /// Electric power of all drives now, W.
    pub fn power_w(&self) -> f64 {
        let each = self.drives.iter().zip(self.states.iter().zip(&self.asked));
        each.map(|(d, (now, asked))| d.power_w(*now, *asked)).sum()
    }

    /// Its drives by the names of their links.
    pub fn named_drives(&self) -> Vec<NamedDrive> {
        let named = |drive: &Drive| NamedDrive {
            name: drive.link.clone(),
            unit: match drive.kind {
                Kind::Fin(_) => DriveUnit::Fin,
                _ => DriveUnit::Own,
            },
            idle: drive.idle(),
        };
        self.drives.iter().map(named).collect()
    }

    /// Set-points at which no drive does anything.
    pub fn idle(&self) -> DriveCommand {
        DriveCommand::new(&self.drives.iter().map(Drive::idle).collect::<Vec<_>>())
    }

    /// Pose of an instrument (a link of the URDF), in body axes.
    pub fn mount(&self, name: &str) -> Option<Pose> {
        self.shell.links.get(name).copied()
    }

    /// The body for the physics.
    pub fn body_spec(&self, id: &str, truth: Truth) -> BodySpec {
        let r_G = self.equation.body.mass.r_G;
        BodySpec {
            id: id.to_string(),
            truth,
            shapes: self.shell.shapes.clone(),
            p_BG: Vector3::new(r_G.x, -r_G.y, -r_G.z),
            mass: self.equation.whole_mass_flu(),
            without_momentum: false,
        }
    }

    /// Kinetic energy in still water, with that of the water that moves along, and potential energy in water of a
    /// density, J.
    pub fn energy_J(&self, truth: &Truth, density_kg_m3: f64) -> f64 {
        let (v, w) = (truth.v_WB_B, truth.w_WB_B);
        let nu = Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z);
        let body = &self.equation.body;
        let flu = |r: Vector3<f64>| Vector3::new(r.x, -r.y, -r.z);
        let height = |r| truth.pose.point(flu(r)).z;
        let weight = body.mass.kg * height(body.mass.r_G);
        let lift = density_kg_m3 * body.volume_m3 * height(body.r_B);
        0.5 * nu.dot(&(self.equation.whole_mass_flu() * nu)) + body.gravity_m_s2 * (weight - lift)
    }

    /// The state after `dt_s` if the vehicle touches nothing, for `Physics::push`; also moves the drives.
    pub fn step(&mut self, truth: &Truth, water: &WaterSample, command: &DriveCommand, dt_s: f64) -> Truth {
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

    /// Whether a step can be cut finely enough for its motion at rest and up to a speed through the water, m/s.
    ///
    /// # Errors
    /// Why not: whoever takes such steps gets numbers that are none.
    pub fn follows(&self, step_s: f64, speed_m_s: f64) -> Result<(), String> {
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
