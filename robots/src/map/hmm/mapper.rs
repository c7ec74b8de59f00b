//! Source map by a hidden Markov model, evaluated backwards from the vehicle's place.
//!
//! *Source*: Farrell, Pang & Li 2003 (IEEE SMC-B 33(6)).
//!
//! *Parameters*: `step_s`, 1 s: step of the chain, time between two releases and between two updates; chance b of
//! detecting odour that is there, `mu` in `trajectory`; σ and h in `trajectory`; ε, `false_detection`.
//! `release_period_s` of the trajectory is not used. `sheared`, off: in a map of space, each level has the flow last
//! measured there (a level not visited yet has that of the nearest visited one); otherwise the flow at the vehicle
//! holds at all depths.
//!
//! `odour_every_s`, never, and `walk_steps`, 30: how often the other products are shown, and the length of the path.
//!
//! *Deviations*: reconstructed (the paper's own equations were not available). With the vehicle in cell j, a step
//! without a detection is π_i ← π_i Π_l (1 − b Φ_ij(l, k)), and one with a detection is
//! π_i ← π_i [ε + (1 − ε)(1 − Π_l (1 − b Φ_ij(l, k)))]. Here Φ(l, k) = A_{l+1} … A_k, evaluated backwards: see
//! `adjoint`; for the chances from cell to cell see `transition`. The shear is ours.

use super::transition::{Drift, Hops, Transition, spread, widest};
use crate::error::RobotError;
use crate::handoff::{Belief, BeliefGrid};
use crate::map::doubt::alternatives::Alternatives;
use crate::map::doubt::evidence::DoubtSpec;
use crate::map::kernel::flow_history::SLACK_S;
use crate::map::kernel::releases::Gatherer;
use crate::map::kernel::terms::Terms;
use crate::map::mapper::{MapParams, Mapper};
use crate::map::spec::{GridSpec, TrajectorySpec, invalid, must};
use crate::map::watch::MapObservation;
use crate::map::workings::Workings;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::collections::VecDeque;
use std::sync::Arc;
use world::area::Area;
use world::catalogue::Entry;
use world::cost::{Cost, Times};
use world::limits::shown;
use world::ranges::{Fraction, Positive};
use world::registry::Listed;
use world::seeds::Stream;

/// Most steps of the path that most likely leads to a detection.
const MOST_WALK: u32 = 500;

/// The mapper's parameters.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct HmmSpec {
    /// The cells.
    pub grid: GridSpec,
    /// Model of how dye travels.
    pub trajectory: TrajectorySpec,
    /// Step of the chain, s.
    #[default(Positive::new(1.0))]
    pub step_s: Positive,
    /// Chance ε of a detection where there is no dye; must be greater than 0.
    #[default(Fraction::new(1e-6))]
    pub false_detection: Fraction,
    /// How far the map doubts its model.
    pub doubt: DoubtSpec,
    /// How often, s, the map also shows where odour is likely to be met, which way it came, and the path that most
    /// likely meets it; not given: never.
    pub odour_every_s: Option<Positive>,
    /// Number of steps from cell to cell in that path; at most 500.
    #[default(30)]
    pub walk_steps: u32,
    /// In a map of space, keep for each level the flow last measured there.
    pub sheared: bool,
}

/// The parameter (name and value) that spreads odour too far along an axis, and its greatest legal value for cells of
/// `cell_m`.
fn wide(spec: &HmmSpec, axis: usize, cell_m: f64) -> ((&'static str, f64), f64) {
    let way = &spec.trajectory;
    let most = widest(cell_m) / spec.step_s.get().sqrt();
    let (name, sigma) = [
        ("sigma_x_m_rts", way.sigma_x_m_rts.get()),
        ("sigma_y_m_rts", way.sigma_y_m_rts.get()),
        ("sigma_z_m_rts", way.sigma_z_m_rts.get()),
    ][axis];
    let lasts = 2.0 * way.flow_error_s.get();
    if sigma > most || axis == 2 {
        return ((name, sigma), most);
    }
    let left = (most * most - sigma * sigma) / lasts;
    (("flow_error_m_s", way.flow_error_m_s.get()), left.sqrt())
}

impl Listed for HmmSpec {
    const ENTRY: Entry = Entry {
        name: "Hmm",
        what: "hidden Markov model of odour moving from cell to cell: source map, detection map, likely paths \
            (reconstructed)",
        source: "Farrell, Pang & Li 2003, IEEE SMC-B 33(6)",
    };
}

impl MapParams for HmmSpec {
    fn build(&self, area: &Area, _: Stream) -> Result<Box<dyn Mapper>, RobotError> {
        Alternatives::around(&self.doubt, |doubt| {
            let spec = Self { doubt: doubt.clone(), ..self.clone() };
            Ok(Box::new(Hmm::new(&spec, self.grid.build(area)?)?))
        })
    }

    fn check(&self, area: &Area) -> Result<(), RobotError> {
        self.trajectory.holds("step_s", self.step_s.get())?;
        self.grid.build(area)?;
        self.trajectory.check()
    }

    fn cost(&self, times: &Times) -> Cost {
        self.work(times)
    }
}

/// State of the mapper.
#[derive(Clone, Debug)]
pub struct Hmm {
    pub(super) with: Workings,
    pub(super) grid: Arc<BeliefGrid>,
    /// Steps of the look-back, oldest first.
    pub(super) steps: VecDeque<Transition>,
    most_steps: usize,
    /// The steps of the look-back before the first measurement, oldest first.
    pub(super) assumed: Vec<Transition>,
    steady_before: bool,
    /// Chances of the hops to both sides in a step, along each axis.
    aside: [Arc<[f64]>; 3],
    /// Chances that dye of a release is met so many cells to both sides, along the horizontal axes.
    pub(super) size: [Arc<[f64]>; 2],
    /// Displacement left over by the steps so far: one for all levels, or one per level.
    drifts: Vec<Drift>,
    step_s: f64,
    /// Chance of detecting odour that is there.
    pub(super) b: f64,
    pub(super) gatherer: Gatherer,
    pub(super) terms: Terms,
    seen_marks: u64,
    /// Displacement per step at each level, m, as last measured there; empty without shear.
    levels: Vec<Option<[f64; 2]>>,
    level: usize,
    /// Time between two reports of the other products (s), and the steps of the path.
    say: Option<(f64, usize)>,
    said_s: f64,
}

impl Hmm {
    /// A mapper over a grid; all cells begin with the same probability.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if the chance of a false detection is 0 or 1, or if the look-back holds no step.
    pub fn new(spec: &HmmSpec, grid: BeliefGrid) -> Result<Self, RobotError> {
        let (h, step_s) = (spec.trajectory.lookback_s.get(), spec.step_s.get());
        spec.trajectory.holds("step_s", step_s)?;
        must(h >= step_s, "step_s", format!("must be at most trajectory.lookback_s, {h}, got {step_s}"))?;
        let problem = format!("must be at most {MOST_WALK}, got {}", spec.walk_steps);
        must(spec.walk_steps <= MOST_WALK, "walk_steps", problem)?;
        let trajectory = &spec.trajectory;
        // The chain's steps are independent: a lasting error of the flow spreads odour as it does in the long run.
        let strayed =
            2.0 * trajectory.flow_error_m_s.get() * trajectory.flow_error_m_s.get() * trajectory.flow_error_s.get();
        let [x, y, z] = trajectory.sigmas();
        let sigmas = [(x * x + strayed).sqrt(), (y * y + strayed).sqrt(), z];
        let with = Workings::new(grid, trajectory, [step_s; 2], spec.false_detection, &spec.doubt, spec.grid.places)?;
        let problem =
            format!("must not be given with grid.places {}: odour is shown for one place in a cell", with.places);
        must(with.places <= 1 || spec.odour_every_s.is_none(), "odour_every_s", problem)?;
        let (grid, places) = (with.grid.clone(), with.places as f64);
        let mut aside = [0, 1, 2].map(|_| Arc::from([1.0]));
        // A single layer keeps everything.
        let axes = if grid.n[2] == 1 { 2 } else { 3 };
        for (a, aside) in aside.iter_mut().enumerate().take(axes) {
            let s = sigmas[a] * step_s.sqrt();
            *aside = spread(s, grid.cell_m[a]).ok_or_else(|| {
                let (field, most) = wide(spec, a, grid.cell_m[a]);
                let problem = format!(
                    "must be at most {} in cells of {} m: odour would spread by {} of them in a step of {step_s} s, \
                    got {}",
                    shown(most),
                    shown(grid.cell_m[a]),
                    shown((s / grid.cell_m[a]).round()),
                    shown(field.1)
                );
                invalid(&format!("trajectory.{}", field.0), &problem)
            })?;
        }
        let initial_m = trajectory.initial_m.get();
        let mut size = [0, 1].map(|_| Arc::from([1.0]));
        for (a, size) in size.iter_mut().enumerate().filter(|_| initial_m > 0.0) {
            *size = spread(initial_m, grid.cell_m[a]).ok_or_else(|| {
                let most = shown(widest(grid.cell_m[a]));
                let problem = format!("must be at most {most} in these cells, got {initial_m}");
                invalid("trajectory.initial_m", &problem)
            })?;
        }
        Ok(Self {
            with,
            steps: VecDeque::new(),
            most_steps: (h / step_s) as usize,
            assumed: Vec::new(),
            steady_before: trajectory.steady_before,
            aside,
            size,
            drifts: vec![Drift::default(); grid.n[2]],
            step_s,
            b: trajectory.mu.get(),
            gatherer: Gatherer::new(trajectory, [0, 1].map(|a| grid.cell_m[a] * places)),
            terms: Terms::new(grid.n),
            seen_marks: 0,
            levels: if spec.sheared { vec![None; grid.n[2]] } else { Vec::new() },
            level: 0,
            say: (spec.odour_every_s).map(|s| (s.get(), spec.walk_steps as usize)),
            said_s: f64::NEG_INFINITY,
            grid,
        })
    }

    /// Adds the newest step of the measured flow to the chain.
    fn extend(&mut self, marks: u64) {
        let fresh = (marks.min(self.most_steps as u64 + 1)) as usize;
        let places: Vec<[f64; 2]> = (self.with.watch.history.newest(fresh + 1)).map(|m| m.s_m).collect();
        for pair in places.windows(2) {
            let u = [0, 1].map(|a| pair[1][a] - pair[0][a]);
            self.measure(u);
        }
        self.assumed.clear();
        if self.steady_before && self.steps.len() < self.most_steps {
            // Before the first measurement: the mean flow since then, or with shear the present flow of each level.
            let Some(mean) = self.with.watch.history.mean() else {
                return;
            };
            let flows = self.flows(mean.map(|v| v * self.step_s));
            let mut drifts = vec![Drift::default(); self.grid.n[2]];
            let before = 0..self.most_steps - self.steps.len();
            self.assumed = before.map(|_| self.transition(&flows, &mut drifts)).collect();
        }
    }

    /// All steps of the look-back, oldest first.
    pub(super) fn chain(&self) -> Vec<&Transition> {
        self.assumed.iter().chain(&self.steps).collect()
    }

    /// Records a step in which the flow at the vehicle moved odour by `u` (the grid's axes, m).
    fn measure(&mut self, u: [f64; 2]) {
        if !self.levels.is_empty() {
            self.levels[self.level] = Some(u);
        }
        self.push_step(&self.flows(u));
    }

    /// Displacement in a step, m: `u` at all levels, or with shear that of each level; a level not visited has that
    /// of the nearest visited one.
    fn flows(&self, u: [f64; 2]) -> Vec<[f64; 2]> {
        let measured: Vec<_> = (0..).zip(&self.levels).filter_map(|(k, u)| Some((k, (*u)?))).collect();
        let nearest = |k: usize| measured.iter().min_by_key(|(m, _)| k.abs_diff(*m));
        let flows: Vec<_> = (0..self.levels.len()).filter_map(|k| Some(nearest(k)?.1)).collect();
        if flows.is_empty() { vec![u] } else { flows }
    }

    /// Adds a step with one displacement for all levels, or one per level (the grid's axes, m).
    pub(super) fn push_step(&mut self, flows: &[[f64; 2]]) {
        let mut drifts = std::mem::take(&mut self.drifts);
        (self.steps).push_back(self.transition(flows, &mut drifts));
        self.drifts = drifts;
        while self.steps.len() > self.most_steps {
            self.steps.pop_front();
        }
    }

    fn transition(&self, flows: &[[f64; 2]], drifts: &mut [Drift]) -> Transition {
        let cell_m = self.grid.cell_m;
        let mut level = |k: usize| {
            let by = drifts[k].cells(flows[k.min(flows.len() - 1)], cell_m);
            [0, 1].map(|a| Hops::new(by[a], &self.aside[a], false))
        };
        // As long as all levels are alike, so is the displacement that they have left over.
        let mut levels: Vec<_> = (0..self.levels.len().max(flows.len())).map(&mut level).collect();
        if levels.iter().all(|l| *l == levels[0]) {
            levels.truncate(1);
        }
        Transition {
            levels,
            vertical: if self.grid.n[2] == 1 { Hops::still() } else { Hops::new(0, &self.aside[2], true) },
        }
    }

    /// Takes probabilities as given.
    #[cfg(test)]
    pub(super) fn believe(&mut self, p: &[f64]) {
        self.with.belief.replace(0.0, false, p);
    }
}

impl Mapper for Hmm {
    fn step(&mut self, seen: &MapObservation) {
        self.with.watch.see(seen);
        let up = self.grid.local(&seen.p_W)[2] / self.grid.cell_m[2];
        self.level = (up.max(0.0) as usize).min(self.grid.n[2] - 1);
        let marks = self.with.watch.history.pushed();
        if marks == self.seen_marks {
            return;
        }
        self.extend(marks - self.seen_marks);
        self.seen_marks = marks;
        let Some(sighting) = self.with.watch.take(seen.t_s) else {
            return;
        };
        let mut likelihood = std::mem::take(&mut self.with.likelihood);
        self.not_detecting(sighting.cell, &mut likelihood);
        (self.with.evidence).weigh(sighting.t_s, sighting.detected, &mut likelihood);
        self.with.likelihood = likelihood;
        self.with.update(sighting.t_s, sighting.detected);
        if let Some((every_s, steps)) = self.say
            && self.belief().informed
            && sighting.t_s >= self.said_s + every_s - SLACK_S
        {
            self.said_s = sighting.t_s;
            let odour = self.odour(sighting.t_s, sighting.cell, steps);
            self.with.belief.say(odour);
        }
    }

    fn belief(&self) -> &Belief {
        self.with.belief.belief()
    }

    fn ln_evidence(&self) -> f64 {
        self.with.belief.ln_evidence()
    }
}
