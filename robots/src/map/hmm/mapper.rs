//! Source map by a hidden Markov model, evaluated backwards from where the vehicle is.
//!
//! *Source*: Farrell, Pang & Li 2003 (IEEE SMC-B 33(6)).
//!
//! *Parameters*: `step_s`, 1 s: step of the chain, time between two releases and between two updates; chance b of
//! detecting odour that is there, `mu` in `trajectory`; σ, h there; ε, `false_detection`. `release_period_s` of
//! the trajectory has no part in it; `sheared`, off: in a map of the space, each level has the flow last measured
//! there (levels not visited yet: that of the nearest visited), else the flow at the vehicle holds at all depths.
//!
//! *Deviations*: reconstructed (the paper's own equations were not at hand): with the vehicle in cell j, none
//! detected: π_i ← π_i Π_l (1 − b Φ_ij(l, k)); detected: π_i ← π_i [ε + (1 − ε)(1 − Π_l (1 − b Φ_ij(l, k)))], with
//! Φ(l, k) = A_{l+1} … A_k, evaluated backwards: see `adjoint`; cell to cell chances: see `transition`. Shear is
//! ours.

use super::transition::{Hops, Transition};
use crate::error::RobotError;
use crate::handoff::{Belief, BeliefGrid};
use crate::map::catalogue::Mapper;
use crate::map::log_belief::LogBelief;
use crate::map::releases::Gatherer;
use crate::map::spec::{GridSpec, TrajectorySpec, invalid, some_false_detection};
use crate::map::terms::Terms;
use crate::map::watch::{MapObservation, Watch};
use serde::{Deserialize, Serialize};
use std::collections::VecDeque;
use std::sync::Arc;
use world::ranges::{Fraction, Positive};

/// The mapper's parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct HmmSpec {
    /// The cells.
    pub grid: GridSpec,
    /// How dye is believed to travel.
    pub trajectory: TrajectorySpec,
    /// Step of the chain, s.
    pub step_s: Positive,
    /// Chance ε of a detection where no dye is; must be greater than 0.
    pub false_detection: Fraction,
    /// In a map of the space, keep the flow of each level as last measured there.
    pub sheared: bool,
}

impl Default for HmmSpec {
    fn default() -> Self {
        Self {
            grid: GridSpec::default(),
            trajectory: TrajectorySpec::default(),
            step_s: Positive::new(1.0),
            false_detection: Fraction::new(1e-6),
            sheared: false,
        }
    }
}

/// The mapper at work.
#[derive(Clone, Debug)]
pub struct Hmm {
    pub(super) watch: Watch,
    pub(super) grid: Arc<BeliefGrid>,
    /// Steps of the look-back, oldest first.
    pub(super) steps: VecDeque<Transition>,
    most_steps: usize,
    /// The steps of the look-back before the first measurement.
    pub(super) assumed: Option<Transition>,
    steady_before: bool,
    sigmas: [f64; 3],
    step_s: f64,
    /// Chance of detecting odour that is there.
    pub(super) b: f64,
    belief: LogBelief,
    false_detection: f64,
    pub(super) gatherer: Gatherer,
    pub(super) terms: Terms,
    likelihood: Vec<f64>,
    seen_marks: u64,
    /// Displacement a step at each level, m, as last measured there; empty without shear.
    levels: Vec<Option<[f64; 2]>>,
    level: usize,
}

impl Hmm {
    /// A mapper over a grid, all cells alike.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] for a chance of false detection of 0 or 1, or a look-back without steps.
    pub fn new(spec: &HmmSpec, grid: BeliefGrid) -> Result<Self, RobotError> {
        spec.trajectory.check()?;
        let (h, step_s) = (spec.trajectory.lookback_s.get(), spec.step_s.get());
        if h < step_s {
            return Err(invalid(
                "step_s",
                &format!("must be at most trajectory.lookback_s, {h}, got {step_s}"),
            ));
        }
        let grid = Arc::new(grid);
        Ok(Self {
            watch: Watch::new(&grid, spec.trajectory.history(step_s), step_s),
            steps: VecDeque::new(),
            most_steps: (h / step_s) as usize,
            assumed: None,
            steady_before: spec.trajectory.steady_before,
            sigmas: spec.trajectory.sigmas(),
            step_s,
            b: spec.trajectory.mu.get(),
            belief: LogBelief::uniform(&grid),
            false_detection: some_false_detection(spec.false_detection)?,
            gatherer: Gatherer::new(
                spec.trajectory.sigmas(),
                [grid.cell_m[0], grid.cell_m[1]],
                spec.trajectory.merge.get(),
            ),
            terms: Terms::new(grid.n),
            likelihood: vec![1.0; grid.len()],
            seen_marks: 0,
            levels: if spec.sheared {
                vec![None; grid.n[2]]
            } else {
                Vec::new()
            },
            level: 0,
            grid,
        })
    }

    /// Takes the newest step of the measured flow into the chain.
    fn extend(&mut self, marks: u64) {
        let fresh = (marks.min(self.most_steps as u64 + 1)) as usize;
        let places: Vec<[f64; 2]> = (self.watch.history.newest(fresh + 1))
            .map(|m| m.s_m)
            .collect();
        for pair in places.windows(2) {
            let u = [0, 1].map(|a| pair[1][a] - pair[0][a]);
            self.measure(u);
        }
        self.assumed = None;
        if self.steady_before && self.steps.len() < self.most_steps {
            // Before the first measurement: the mean flow since, or with shear that of each level as it is now.
            let mean = self.watch.history.mean();
            self.assumed = mean.map(|v| self.transition(&self.flows(v.map(|v| v * self.step_s))));
        }
    }

    /// All steps of the look-back, oldest first.
    pub(super) fn chain(&self) -> Vec<&Transition> {
        let before = self.most_steps - self.steps.len();
        let assumed = self.assumed.iter().cycle().take(before);
        assumed.chain(&self.steps).collect()
    }

    /// A step in which the flow at the vehicle moved odour by `u` (the grid's axes, m).
    fn measure(&mut self, u: [f64; 2]) {
        if !self.levels.is_empty() {
            self.levels[self.level] = Some(u);
        }
        self.push_step(&self.flows(u));
    }

    /// Displacement in a step, m: `u` for all levels, or with shear that of each, unvisited ones as the nearest visited.
    fn flows(&self, u: [f64; 2]) -> Vec<[f64; 2]> {
        let measured: Vec<_> = (0..)
            .zip(&self.levels)
            .filter_map(|(k, u)| Some((k, (*u)?)))
            .collect();
        let nearest = |k: usize| measured.iter().min_by_key(|(m, _)| k.abs_diff(*m));
        let flows: Vec<_> = (0..self.levels.len())
            .filter_map(|k| Some(nearest(k)?.1))
            .collect();
        if flows.is_empty() { vec![u] } else { flows }
    }

    /// Adds a step with a displacement for all levels, or one a level (the grid's axes, m).
    pub(super) fn push_step(&mut self, flows: &[[f64; 2]]) {
        self.steps.push_back(self.transition(flows));
        while self.steps.len() > self.most_steps {
            self.steps.pop_front();
        }
    }

    fn transition(&self, flows: &[[f64; 2]]) -> Transition {
        let root = self.step_s.sqrt();
        let hops =
            |a: usize, u: f64| Hops::new(u, self.sigmas[a] * root, self.grid.cell_m[a], a == 2);
        let alike = flows.iter().all(|u| *u == flows[0]);
        let shown = if alike { &flows[..1] } else { flows };
        Transition {
            levels: shown
                .iter()
                .map(|u| [hops(0, u[0]), hops(1, u[1])])
                .collect(),
            vertical: if self.grid.n[2] == 1 {
                Hops::still()
            } else {
                hops(2, 0.0)
            },
        }
    }

    /// Takes probabilities as given.
    #[cfg(test)]
    pub(super) fn believe(&mut self, p: &[f64]) {
        self.belief.replace(0.0, false, p);
    }
}

impl Mapper for Hmm {
    fn step(&mut self, seen: &MapObservation) {
        self.watch.see(seen);
        let up = self.grid.local(&seen.p_W)[2] / self.grid.cell_m[2];
        self.level = (up.max(0.0) as usize).min(self.grid.n[2] - 1);
        let marks = self.watch.history.pushed();
        if marks == self.seen_marks {
            return;
        }
        self.extend(marks - self.seen_marks);
        self.seen_marks = marks;
        let Some(sighting) = self.watch.take(seen.t_s) else {
            return;
        };
        let mut likelihood = std::mem::take(&mut self.likelihood);
        self.not_detecting(sighting.cell, &mut likelihood);
        if sighting.detected {
            let e = self.false_detection;
            for l in &mut likelihood {
                *l = e + (1.0 - e) * (1.0 - *l);
            }
        }
        self.belief
            .update(sighting.t_s, sighting.detected, &likelihood);
        self.likelihood = likelihood;
    }

    fn belief(&self) -> &Belief {
        self.belief.belief()
    }
}
