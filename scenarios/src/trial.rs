//! One run of a scenario from spin-up to its end, without files or screens: those watch it.

use crate::assemble::{AssembleError, Simulation};
use crate::frame::{Frame, PlumeFrame};
use crate::scenario::{Loaded, Scenario, SuccessSpec};
use crate::system::{Dye, Outbox};
use nalgebra::Vector2;
use robots::handoff::{Declaration, Outcome};
use serde::Serialize;
use std::collections::BTreeMap;
use world::clock::Clock;
use world::record::Digest;

/// Somebody who looks on: records, publishes, paces, draws progress. Nothing it does reaches the run
/// but the wish to stop.
pub trait Watch {
    /// The share of the spin-up that is done; `false` stops the run.
    fn spun_up(&mut self, _share: f64) -> bool {
        true
    }
    /// A new picture of the robots.
    fn frame(&mut self, _frame: &Frame) {}
    /// A new picture of the plume.
    fn plume(&mut self, _plume: &PlumeFrame) {}
    /// After every tick; `false` stops the run.
    fn go_on(&mut self, _t_s: f64) -> bool {
        true
    }
}

/// Nobody looks on.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwatched;

impl Watch for Unwatched {}

/// How a run came to its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// A source was declared near enough to a true one.
    Found,
    /// All robots came to their planned end; nothing was to be found.
    Completed,
    /// Declared, but too far from any source.
    DeclaredElsewhere,
    /// The robots ended their missions without a declaration.
    NotFound,
    /// Time ran out without a declaration.
    TimeOut,
    /// A robot gave up outside the area.
    Aborted,
    /// Stopped from outside.
    Interrupted,
}

impl Verdict {
    /// Whether this is what the scenario calls a success.
    #[must_use]
    pub fn is_success(self) -> bool {
        matches!(self, Verdict::Found | Verdict::Completed)
    }

    /// For people.
    #[must_use]
    pub fn says(self) -> &'static str {
        match self {
            Verdict::Found => "source found",
            Verdict::Completed => "completed",
            Verdict::DeclaredElsewhere => "declared too far from any source",
            Verdict::NotFound => "ended without a declaration",
            Verdict::TimeOut => "time ran out without a declaration",
            Verdict::Aborted => "aborted outside the area",
            Verdict::Interrupted => "interrupted",
        }
    }
}

/// What is known at the end of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Ended {
    /// How it ended.
    pub verdict: Verdict,
    /// Digest of the whole state sequence.
    pub digest: String,
    /// Ticks of the mission.
    pub steps: u64,
    /// Mission time, s.
    pub t_s: f64,
    /// Declarations by robot.
    pub declarations: BTreeMap<String, Declaration>,
}

/// A run, ready to start.
pub struct Trial {
    /// Everything that lives in it.
    pub simulation: Simulation,
    success: SuccessSpec,
    limit_s: f64,
    sources: Vec<Vector2<f64>>,
    declarations: BTreeMap<String, Declaration>,
}

impl Trial {
    /// Puts a scenario together for a seed.
    ///
    /// # Errors
    /// See [`Simulation::assemble`].
    pub fn assemble(loaded: &Loaded, seed: u64) -> Result<Self, AssembleError> {
        let scenario: &Scenario = &loaded.scenario;
        let simulation = Simulation::assemble(scenario, &loaded.base_dir, seed)?;
        let sources = (simulation.world.resource::<Dye>().plume.sources().iter())
            .map(|s| s.p_W.xy())
            .collect();
        Ok(Self {
            simulation,
            success: scenario.success.clone(),
            limit_s: scenario.time.limit_s.get(),
            sources,
            declarations: BTreeMap::new(),
        })
    }

    /// Runs it to its end.
    pub fn run(&mut self, watch: &mut dyn Watch) -> Ended {
        let mut stopped = false;
        self.simulation.spin_up(|share| {
            stopped = !watch.spun_up(share);
            !stopped
        });
        self.simulation
            .world
            .resource_scope::<Digest, ()>(|world, mut digest| {
                world.resource::<Dye>().plume.digest_into(&mut digest);
            });
        while !stopped && self.simulation.t_s() < self.limit_s - 1e-9 {
            self.simulation.tick();
            self.show(watch);
            stopped = !watch.go_on(self.simulation.t_s());
            if self.all_over() {
                break;
            }
        }
        let world = &self.simulation.world;
        Ended {
            verdict: if stopped { Verdict::Interrupted } else { self.verdict() },
            digest: world.resource::<Digest>().hex(),
            steps: world.resource::<Clock>().step,
            t_s: self.simulation.t_s(),
            declarations: self.declarations.clone(),
        }
    }

    /// Runs it to its end with nobody looking on.
    #[must_use]
    pub fn finish_quietly(mut self) -> Ended {
        self.run(&mut Unwatched)
    }

    fn show(&mut self, watch: &mut dyn Watch) {
        let mut outbox = self.simulation.world.resource_mut::<Outbox>();
        let (frame, plume) = (outbox.frame.take(), outbox.plume.take());
        if let Some(frame) = frame {
            for robot in &frame.robots {
                if let Some(declared) = robot.declaration {
                    self.declarations.insert(robot.id.clone(), declared);
                }
            }
            watch.frame(&frame);
        }
        if let Some(plume) = plume {
            watch.plume(&plume);
        }
    }

    /// Every robot has ended its mission (without robots the run goes on to its limit).
    fn all_over(&mut self) -> bool {
        let decisions = self.simulation.outcomes();
        !decisions.is_empty() && decisions.iter().all(Option::is_some)
    }

    fn verdict(&mut self) -> Verdict {
        let outcomes = self.simulation.outcomes();
        if let SuccessSpec::Declared(wanted) = &self.success {
            let near = |d: &Declaration| {
                (self.sources.iter()).any(|s| (s - d.position).norm() <= wanted.within_m.get())
            };
            if self.declarations.values().any(near) {
                return Verdict::Found;
            } else if !self.declarations.is_empty() {
                return Verdict::DeclaredElsewhere;
            }
        }
        if outcomes.contains(&Some(Outcome::Aborted)) {
            Verdict::Aborted
        } else if self.success != SuccessSpec::Completed {
            if outcomes.contains(&None) { Verdict::TimeOut } else { Verdict::NotFound }
        } else if outcomes.contains(&None) {
            Verdict::TimeOut
        } else {
            Verdict::Completed
        }
    }
}
