//! Many environments of one scenario, stepped together: what the classes for Gymnasium, PettingZoo and Stable-Baselines3
//! stand on.

mod agent;
mod constants;
mod group;
mod pilot;
mod plumes;
mod searcher_state;
mod worker_pool;

use crate::cache::{Cache, opened, tell_fault};
use crate::error::{apart, other, panicked};
use crate::scenario::PyScenario;
use agent::{Agent, take_over};
use constants::BatchConstants;
use group::{Group, Task};
pub(crate) use pilot::Pilot;
use plumes::Plumes;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rheotaxis::lanes::Worlds;
use rheotaxis::ocean::Origin;
use rheotaxis::scenario::Loaded;
use std::sync::{Arc, Mutex, PoisonError};
use worker_pool::WorkerPool;
use world::ranges::Positive;

/// Whether a searcher is a gantry, the numbers of its action, and names and bounds of its observation.
type Space = (bool, usize, Vec<(String, f32, f32)>);

/// Most environments in a batch.
const MOST: usize = 65_536;

/// What all environments of a batch have in common.
pub(crate) struct Rules {
    pub(crate) loaded: Loaded,
    /// Worlds in which the runs take turns.
    pub(crate) worlds: Arc<Worlds>,
    pub(crate) agents: Vec<Agent>,
    /// Time between two decisions, s, and the same in steps.
    pub(crate) period_s: f64,
    pub(crate) steps: u64,
    pub(crate) step_s: f64,
    /// Longest episode, s.
    pub(crate) limit_s: f64,
    /// An episode is a success when a searcher has come so near to a source, m.
    pub(crate) goal_m: Option<f64>,
    /// Whether an action has one more number, which declares.
    pub(crate) declare: bool,
    /// What 1 means in an action: a turn, rad; a change of depth or altitude, m; and the two speeds, m/s.
    pub(crate) turn_rad: f64,
    pub(crate) climb_m: f64,
    pub(crate) speed_m_s: Option<[f64; 2]>,
}

impl Rules {
    /// Numbers of an action of a searcher.
    pub(crate) fn width(&self, agent: &Agent) -> usize {
        agent.moves() + usize::from(self.declare)
    }
}

/// The numbers of an action, from their bytes.
fn numbers(bytes: &[u8]) -> Vec<f64> {
    let each = bytes.chunks_exact(8);
    each.map(|b| f64::from_ne_bytes(b.try_into().expect("8 bytes"))).collect()
}

/// What changes.
struct Inside {
    groups: Vec<Group>,
    plumes: Plumes,
    /// Why it cannot go on until the next reset of all.
    broken: Option<String>,
}

/// Environments of one scenario. Each method works without the interpreter's lock.
#[pyclass(frozen, name = "_Batch", module = "rheotaxis._rheotaxis")]
pub(crate) struct Batch {
    rules: Arc<Rules>,
    per_plume: usize,
    crew: WorkerPool,
    inside: Mutex<Inside>,
}

#[pymethods]
impl Batch {
    #[new]
    #[pyo3(signature = (
        scenario, *, n = 1, per_plume = 1, period_s = 1.0, limit_s = None, goal_m = None, declare = false,
        turn_deg = 180.0, climb_m = 1.0, speed_m_s = None, kept_plumes = 32, threads = 1, cache = None
    ))]
    #[allow(clippy::too_many_arguments, reason = "they are keywords")]
    fn new(
        scenario: &Bound<'_, PyAny>,
        n: usize,
        per_plume: usize,
        period_s: f64,
        limit_s: Option<f64>,
        goal_m: Option<f64>,
        declare: bool,
        turn_deg: f64,
        climb_m: f64,
        speed_m_s: Option<[f64; 2]>,
        kept_plumes: usize,
        threads: usize,
        cache: Option<Cache>,
    ) -> PyResult<Self> {
        let py = scenario.py();
        let mut loaded = Loaded::clone(&*PyScenario::meant(scenario)?);
        let refused = |text: String| Err(PyValueError::new_err(text));
        let time = &loaded.scenario.time;
        let (step_s, limit_s) = (time.step_s.get(), limit_s.unwrap_or(time.limit_s.get()));
        let steps = (period_s / step_s).round();
        if !(steps >= 1.0 && (steps * step_s - period_s).abs() < 1e-6 * period_s) {
            return refused(format!(
                "period_s must be a whole number of the scenario's steps of {step_s} s, got {period_s}"
            ));
        }
        let good = |v: f64| v.is_finite() && v > 0.0;
        let named =
            [("limit_s", limit_s), ("goal_m", goal_m.unwrap_or(1.0)), ("turn_deg", turn_deg), ("climb_m", climb_m)];
        if let Some((name, got)) = named.into_iter().find(|(_, v)| !good(*v)) {
            return refused(format!("{name} must be above 0, got {got}"));
        }
        if let Some([low, high]) = speed_m_s.filter(|[a, b]| !(*a >= 0.0 && b > a && b.is_finite())) {
            return refused(format!("speed_m_s must be two speeds, the smaller first, got {low}, {high}"));
        }
        if n == 0 || per_plume == 0 || !n.is_multiple_of(per_plume) {
            return refused(format!("the environments must fill their plumes: got {n} with {per_plume} in each"));
        }
        if n > MOST {
            return refused(format!("there are at most {MOST} environments in a batch, got {n}"));
        }
        let agents = apart(py, || {
            let origin = Origin::from_scenario(&loaded.scenario, &loaded.base_dir, 1);
            let ocean = origin.build(&loaded.base_dir).map_err(other)?;
            take_over(&mut loaded, &ocean, period_s).map_err(other)
        })?;
        if agents.is_empty() {
            return refused(format!("{} has no robot and no gantry", loaded.name));
        }
        // The last question of an episode comes at its limit, so the run must not be over by then. Nobody looks at frames.
        loaded.scenario.time.limit_s = Positive::new(limit_s + 2.0 * period_s);
        let never = Positive::new(limit_s + 10.0 * period_s);
        loaded.scenario.record.frame_period_s = never;
        loaded.scenario.record.plume_period_s = never;
        let rules = Arc::new(Rules {
            agents,
            period_s,
            steps: steps as u64,
            step_s,
            limit_s,
            goal_m,
            declare,
            turn_rad: turn_deg.to_radians(),
            climb_m,
            speed_m_s,
            worlds: Arc::new(Worlds::new(&loaded)),
            loaded,
        });
        let groups = (0..n / per_plume).map(|_| Group::new(&rules, per_plume));
        Ok(Self {
            inside: Mutex::new(Inside {
                groups: groups.collect(),
                plumes: Plumes::new(kept_plumes, opened(py, cache)?),
                broken: Some("the environments have not been reset yet: reset first".to_string()),
            }),
            per_plume,
            crew: WorkerPool::new(threads),
            rules,
        })
    }

    /// Ids of the searchers, in the scenario's order.
    #[getter]
    fn agents(&self) -> Vec<&str> {
        self.rules.agents.iter().map(|a| a.id.as_str()).collect()
    }

    /// Of each searcher: whether it is a gantry, the numbers of its action, and names and bounds of its observation.
    #[getter]
    fn spaces(&self) -> Vec<Space> {
        let space = |agent: &Agent| {
            let gantry = matches!(agent.machine, agent::Machine::Gantry { .. });
            let features = agent.features.iter();
            let features = features.map(|f| (f.name.clone(), f.low, f.high)).collect();
            (gantry, self.rules.width(agent), features)
        };
        self.rules.agents.iter().map(space).collect()
    }

    /// Longest episode, s.
    #[getter]
    fn limit_s(&self) -> f64 {
        self.rules.limit_s
    }

    /// Begins episodes: for each environment its number, the seed of its ocean and that of its searcher. Environments
    /// that share an ocean keep it, unless `fresh`; then all of them must begin.
    fn reset(&self, py: Python<'_>, begin: Vec<(usize, u64, u64)>, fresh: bool) -> PyResult<()> {
        let fault = apart(py, || {
            let mut inside = self.inside.lock().unwrap_or_else(PoisonError::into_inner);
            self.begin(&mut inside, &begin, fresh)?;
            Ok(inside.plumes.fault())
        })?;
        tell_fault(py, fault)
    }

    /// Carries out actions in the environments whose episodes go on: for each its number, and the numbers of all its
    /// searchers' actions.
    fn step(&self, py: Python<'_>, acting: Vec<usize>, actions: &[u8]) -> PyResult<()> {
        apart(py, || {
            let mut inside = self.inside.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(why) = &inside.broken {
                return Err(panicked(why));
            }
            let width: usize = self.rules.agents.iter().map(|a| self.rules.width(a)).sum();
            if actions.len() != acting.len() * width * 8 {
                return Err(PyValueError::new_err("an action has a wrong number of numbers"));
            }
            let rows = actions.chunks_exact(width * 8);
            for (env, row) in acting.iter().zip(rows) {
                let (group, place) = (env / self.per_plume, env % self.per_plume);
                let group = &mut inside.groups[group];
                if let Task::Act(all) = &mut group.task {
                    all.push((place, numbers(row)));
                } else {
                    group.task = Task::Act(vec![(place, numbers(row))]);
                }
            }
            self.work(&mut inside)
        })
    }

    /// A controller for a whole run that decides for one of the searchers, by its place among them.
    fn pilot(&self, agent: usize, decide: Py<PyAny>) -> Pilot {
        Pilot { rules: self.rules.clone(), agent, decide }
    }

    /// What all environments are like: arrays, newly made.
    fn look<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let told = apart(py, || {
            let inside = self.inside.lock().unwrap_or_else(PoisonError::into_inner);
            Ok(BatchConstants::from_groups(&self.rules, &inside.groups))
        })?;
        told.dict(py)
    }
}

impl Batch {
    fn begin(&self, inside: &mut Inside, begin: &[(usize, u64, u64)], fresh: bool) -> PyResult<()> {
        let fresh = fresh || self.per_plume == 1;
        let first = |(env, ..): &&(usize, u64, u64)| env.is_multiple_of(self.per_plume);
        let oceans = begin.iter().filter(first).filter(|_| fresh);
        let oceans: Vec<(usize, u64)> = oceans.map(|(env, ocean, _)| (*env, *ocean)).collect();
        let seeds: Vec<u64> = oceans.iter().map(|(_, seed)| *seed).collect();
        let kept = inside.plumes.get(&self.rules.loaded, &seeds, &self.crew)?;
        let mut kept = kept.into_iter();
        for (env, ocean, seed) in begin {
            let (group, place) = (env / self.per_plume, env % self.per_plume);
            let ocean = (fresh && place == 0).then(|| kept.next().map(|k| (*ocean, k))).flatten();
            let group = &mut inside.groups[group];
            if let Task::Begin { places, .. } = &mut group.task {
                places.push((place, *seed));
            } else {
                group.task = Task::Begin { ocean, places: vec![(place, *seed)] };
            }
        }
        if fresh && begin.len() == self.per_plume * inside.groups.len() {
            inside.broken = None;
        } else if let Some(why) = &inside.broken {
            return Err(panicked(why));
        }
        self.work(inside)
    }

    /// Lets all groups do their tasks.
    fn work(&self, inside: &mut Inside) -> PyResult<()> {
        let busy = inside.groups.iter_mut();
        let mut busy: Vec<&mut Group> = busy.filter(|g| !matches!(g.task, Task::Nothing)).collect();
        let worked = self.crew.work(&mut busy, |group, _| group.work(&self.rules));
        let faults = busy.iter_mut().filter_map(|group| group.fault.take());
        let fault = faults.reduce(|first, _| first);
        let worked = worked.and_then(|()| fault.map_or(Ok(()), |said| Err(panicked(&said))));
        if let Err(error) = &worked {
            inside.broken = Some(format!("the last call ended with {error}: reset first"));
            for group in &mut inside.groups {
                group.task = Task::Nothing;
            }
        }
        worked
    }
}
