//! Added mass and damping of a vehicle's file, as terms of the equation of motion.
//!
//! *Source:* Fossen, "Handbook of Marine Craft Hydrodynamics and Motion Control", 2nd ed. 2021, sections 6.3 and 6.4;
//! C_A by the skew-symmetric form of the full added mass.
//!
//! *Parameters:* [`HydrodynamicsSpec`](super::HydrodynamicsSpec).
//!
//! *Deviations:* damping is proportional to the water's density and to the share of the hull that is under water. The
//! water turns, for the damping, as it turns along the hull's x axis: its velocity's change from tail to nose. D_u acts
//! by the speed |u|, so that its diagonal resists astern too.

use crate::vehicles::drives::Drive;
use crate::vehicles::dynamics::{Body, Relative, Stage, Terms, added_coriolis};
use nalgebra::{Matrix6, Vector3, Vector6};

/// Damping, FRD.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Damping {
    /// D.
    pub(super) linear: Matrix6<f64>,
    /// D_q.
    pub(super) quadratic: Matrix6<f64>,
    /// D_u.
    pub(super) forward: Matrix6<f64>,
    /// Density for which they hold, kg/m³.
    pub(super) density_kg_m3: f64,
    /// Share of the hull under water for which they hold.
    pub(super) wet: f64,
}

impl Damping {
    /// Force on a hull that moves through the water of its own density.
    pub(super) fn force(&self, nu: &Vector6<f64>) -> Vector6<f64> {
        let squared = nu.map(|v| v * v.abs());
        -(self.linear * nu + self.quadratic * squared + self.forward * nu * nu.x.abs())
    }
}

/// All terms during one step.
pub(super) struct Step<'a> {
    pub(super) damping: &'a Damping,
    pub(super) drives: &'a [Drive],
    /// State of each drive at the beginning, the middle and the end of the step.
    pub(super) states: [&'a [f64]; 3],
}

impl Terms for Step<'_> {
    type Drives = ();

    fn forces(&self, body: &Body, at: &Relative, (): &(), stage: Stage) -> (Vector3<f64>, Vector3<f64>) {
        let (mut force, mut moment) = added_coriolis(&body.added, &at.v, &at.w);
        force = -force;
        moment = -moment;

        let turn = at.w - Vector3::new(0.0, -at.along.z, at.along.y);
        let nu = Vector6::new(at.v.x, at.v.y, at.v.z, turn.x, turn.y, turn.z);
        let share = at.rho / self.damping.density_kg_m3 * at.wet / self.damping.wet;
        let drag = self.damping.force(&nu) * share;
        force += drag.fixed_rows::<3>(0);
        moment += drag.fixed_rows::<3>(3);

        let states = match stage {
            Stage::Start => self.states[0],
            Stage::Middle => self.states[1],
            Stage::End => self.states[2],
        };
        for (drive, state) in self.drives.iter().zip(states) {
            let (f, m) = drive.force(*state, body, at);
            force += f;
            moment += m;
        }
        (force, moment)
    }

    fn rate(&self, (): &()) {}
}
