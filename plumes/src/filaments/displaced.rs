//! The plume as a probe at a fixed place meets it at one moment, moved to and fro by the orbits of the waves.
//!
//! *Source*: Andrews & McIntyre 1978, J. Fluid Mech. 89, 609: dye that the Lagrangian mean carries to a mean place X is
//! found at X + ξ(X, t).
//!
//! *Parameters*: none; ξ is [`Flow::displacement`].
//!
//! *Deviations*: X = p − ξ(p, t), which has an error of (ξ·∇)ξ. For waves of steepness ak it is a part ak of the
//! displacement: some millimetres to centimetres at most in waves that do not break. The filaments' mean places are
//! those of the latest drift.

use super::plume::Plume;
use nalgebra::Vector3;
use world::fields::{Concentration, Flow};

/// Concentration now, with the displacement by waves; without waves, that of the plume itself.
#[derive(Clone, Copy)]
pub struct DisplacedConcentration<'a> {
    plume: &'a Plume,
    flow: &'a dyn Flow,
    t_s: f64,
}

impl<'a> DisplacedConcentration<'a> {
    /// What a probe measures at time `t_s` of the flow, s.
    pub fn new(plume: &'a Plume, flow: &'a dyn Flow, t_s: f64) -> Self {
        Self { plume, flow, t_s }
    }

    fn mean_place(&self, p: &Vector3<f64>) -> Vector3<f64> {
        self.flow.displacement(p, self.t_s).map_or(*p, |way| p - way)
    }
}

impl Concentration for DisplacedConcentration<'_> {
    fn concentration(&self, p: &Vector3<f64>) -> f64 {
        self.plume.concentration(&self.mean_place(p))
    }

    fn sensed(&self, p: &Vector3<f64>, across_m: f64) -> f64 {
        self.plume.sensed(&self.mean_place(p), across_m)
    }
}
