//! The mappers by name.

use super::bayesian::Bayesian;
use super::hmm::{Hmm, HmmSpec};
use super::particle_filter::{ParticleFilter, ParticleFilterSpec};
use super::pomdp::Pomdp;
use super::watch::MapObservation;
use super::workings::CellsSpec;
use crate::error::RobotError;
use crate::handoff::Belief;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::area::Area;
use world::catalogue::Entry;
use world::seeds::Stream;

/// A mapper: takes in an observation a tick, and believes.
pub trait Mapper: std::fmt::Debug + Send + Sync {
    /// One tick.
    fn step(&mut self, seen: &MapObservation);
    /// What is believed now.
    fn belief(&self) -> &Belief;
}

/// The mappers a scenario can ask for.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum MapSpec {
    /// Belief state of a partially observable Markov decision process.
    Pomdp(CellsSpec),
    /// Bayesian inference with the sum over releases.
    Bayesian(CellsSpec),
    /// Hidden Markov model of where odour goes from cell to cell.
    Hmm(HmmSpec),
    /// Particles of source positions.
    ParticleFilter(ParticleFilterSpec),
}

impl MapSpec {
    /// The mapper, ready for its first tick; `rng` is the robot's own stream for its map.
    ///
    /// # Errors
    /// [`RobotError::Invalid`], with the field below `map`.
    pub fn build(&self, area: &Area, rng: Stream) -> Result<Box<dyn Mapper>, RobotError> {
        Ok(match self {
            MapSpec::Pomdp(s) => Box::new(Pomdp::new(s, s.grid.build(area)?)?),
            MapSpec::Bayesian(s) => Box::new(Bayesian::new(s, s.grid.build(area)?)?),
            MapSpec::Hmm(s) => Box::new(Hmm::new(s, s.grid.build(area)?)?),
            MapSpec::ParticleFilter(s) => {
                Box::new(ParticleFilter::new(s, s.grid.build(area)?, rng)?)
            }
        })
    }

    /// That its cells and its look-back are as many as a mapper can have, without making any.
    ///
    /// # Errors
    /// [`RobotError::Invalid`], with the field below `map`.
    pub fn check(&self, area: &Area) -> Result<(), RobotError> {
        let (grid, trajectory) = match self {
            MapSpec::Pomdp(s) | MapSpec::Bayesian(s) => (&s.grid, &s.trajectory),
            MapSpec::ParticleFilter(s) => (&s.grid, &s.trajectory),
            MapSpec::Hmm(s) => {
                s.trajectory.holds("step_s", s.step_s.get())?;
                (&s.grid, &s.trajectory)
            }
        };
        grid.build(area)?;
        trajectory.check()
    }

    /// Name of the mapper, as in the catalogue.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            MapSpec::Pomdp(_) => "Pomdp",
            MapSpec::Bayesian(_) => "Bayesian",
            MapSpec::Hmm(_) => "Hmm",
            MapSpec::ParticleFilter(_) => "ParticleFilter",
        }
    }
}

/// Mappers.
pub const CATALOGUE: &[Entry] = &[
    Entry {
        name: "Pomdp",
        what: "source map: Bayes' rule with the chance of meeting any release of the look-back",
        source: "Wang & Pang, section II-C, eqs. 1-6",
    },
    Entry {
        name: "Bayesian",
        what: "source map: product over releases on non-detection, their sum on detection (reconstructed)",
        source: "Pang & Farrell 2006, IEEE SMC-B 36(5)",
    },
    Entry {
        name: "Hmm",
        what: "hidden Markov model of odour from cell to cell: source map, detection map, likely paths (reconstructed)",
        source: "Farrell, Pang & Li 2003, IEEE SMC-B 33(6)",
    },
    Entry {
        name: "ParticleFilter",
        what: "particles of source positions, weighted by the chance of what was and was not smelt (reconstructed)",
        source: "Li, Meng, Wang & Zeng 2011, Autonomous Robots 30(3)",
    },
];
