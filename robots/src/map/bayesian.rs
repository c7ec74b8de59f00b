//! Source map by Bayesian inference: the sum over releases on a detection, the product on none.
//!
//! *Source*: Pang & Farrell 2006 (IEEE SMC-B 36(5)), as Wang & Pang cite it (ref. 17).
//!
//! *Parameters*: as `Pomdp`; the paper's S_ij is Wang & Pang's p of eq. 1.
//!
//! *Deviations*: reconstructed (the paper's own equations were not at hand): γ_ij = Π_l (1 − μ S_ij(l)) on
//! non-detection; on detection β_ij = Σ_l S_ij(l), normalised over the cells i; α_i ← α_i·β_ij or α_i·γ_ij,
//! renormalised. So it differs from `Pomdp` only on a detection, in giving the sum over releases in the place
//! of 1 − Π: the two are near each other where chances are small, and part near the vehicle, where the
//! product saturates. With ε = `false_detection`: (1 − ε) β + ε / n. Else as `Pomdp`.

use super::catalogue::Mapper;
use super::kernel::Kernel;
use super::log_belief::LogBelief;
use super::spec::{GridSpec, TrajectorySpec, some_false_detection};
use super::watch::{MapObservation, Watch};
use crate::error::RobotError;
use crate::handoff::{Belief, BeliefGrid};
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use world::ranges::{Fraction, Positive};

/// The mapper's parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct BayesianSpec {
    /// The cells.
    pub grid: GridSpec,
    /// How dye is believed to travel.
    pub trajectory: TrajectorySpec,
    /// Time between two updates, s.
    pub update_period_s: Positive,
    /// Chance ε of a detection where no dye is; must be greater than 0.
    pub false_detection: Fraction,
}

impl Default for BayesianSpec {
    fn default() -> Self {
        Self {
            grid: GridSpec::default(),
            trajectory: TrajectorySpec::default(),
            update_period_s: Positive::new(1.0),
            false_detection: Fraction::new(1e-6),
        }
    }
}

/// The mapper at work.
#[derive(Clone, Debug)]
pub struct Bayesian {
    watch: Watch,
    kernel: Kernel,
    belief: LogBelief,
    false_detection: f64,
    likelihood: Vec<f64>,
}

impl Bayesian {
    /// A mapper over a grid, all cells alike.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] for a chance of false detection of 0 or 1, or a look-back without releases.
    pub fn new(spec: &BayesianSpec, grid: BeliefGrid) -> Result<Self, RobotError> {
        spec.trajectory.check()?;
        let grid = Arc::new(grid);
        let history = spec
            .trajectory
            .history(spec.trajectory.release_period_s.get());
        Ok(Self {
            watch: Watch::new(&grid, history, spec.update_period_s.get()),
            kernel: Kernel::new(&grid, &spec.trajectory),
            belief: LogBelief::uniform(&grid),
            false_detection: some_false_detection(spec.false_detection)?,
            likelihood: vec![1.0; grid.len()],
        })
    }
}

impl Mapper for Bayesian {
    fn step(&mut self, seen: &MapObservation) {
        let Some(sighting) = self.watch.step(seen) else {
            return;
        };
        self.kernel.aim(&self.watch.history, sighting.cell);
        if sighting.detected {
            self.kernel.expected(&mut self.likelihood);
            let total: f64 = self.likelihood.iter().sum();
            let e = self.false_detection;
            let (scale, floor) = if total > 0.0 {
                ((1.0 - e) / total, e / self.likelihood.len() as f64)
            } else {
                // No cell explains it: a false alarm, which says nothing.
                (0.0, 1.0)
            };
            for l in &mut self.likelihood {
                *l = *l * scale + floor;
            }
        } else {
            self.kernel.not_detecting(&mut self.likelihood);
        }
        self.belief
            .update(sighting.t_s, sighting.detected, &self.likelihood);
    }

    fn belief(&self) -> &Belief {
        self.belief.belief()
    }
}
