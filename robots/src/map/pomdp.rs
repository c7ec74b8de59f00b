//! Source map by the belief state of a partially observable Markov decision process.
//!
//! *Source*: Wang & Pang, section II-C, eqs. 1–6 (after Jiu, Chen, Deng & Pang 2019).
//!
//! *Parameters*: grid 40 × 25; μ, σx, σy, h in `trajectory` (the paper gives no values: ours); time unit, 1 s,
//! `update_period_s`; chance of a false detection, `false_detection`, none in the paper.
//!
//! *Deviations*: on a detection the factor is ε + (1 − ε)(1 − γ) with ε = `false_detection`, so that one false
//! alarm where no cell can explain it leaves a belief; on none it is γ, as in the paper. Any detection within
//! an update period counts as one. No update while the vehicle is outside the grid. Kernel: see `kernel`.

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
pub struct PomdpSpec {
    /// The cells.
    pub grid: GridSpec,
    /// How dye is believed to travel.
    pub trajectory: TrajectorySpec,
    /// Time between two updates, s.
    pub update_period_s: Positive,
    /// Chance ε of a detection where no dye is; must be greater than 0.
    pub false_detection: Fraction,
}

impl Default for PomdpSpec {
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
pub struct Pomdp {
    watch: Watch,
    kernel: Kernel,
    belief: LogBelief,
    false_detection: f64,
    likelihood: Vec<f64>,
}

impl Pomdp {
    /// A mapper over a grid, all cells alike.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] for a chance of false detection of 0 or 1, or a look-back without releases.
    pub fn new(spec: &PomdpSpec, grid: BeliefGrid) -> Result<Self, RobotError> {
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

impl Mapper for Pomdp {
    fn step(&mut self, seen: &MapObservation) {
        let Some(sighting) = self.watch.step(seen) else {
            return;
        };
        self.kernel.aim(&self.watch.history, sighting.cell);
        self.kernel.not_detecting(&mut self.likelihood);
        if sighting.detected {
            let e = self.false_detection;
            for l in &mut self.likelihood {
                *l = e + (1.0 - e) * (1.0 - *l);
            }
        }
        self.belief
            .update(sighting.t_s, sighting.detected, &self.likelihood);
    }

    fn belief(&self) -> &Belief {
        self.belief.belief()
    }
}
