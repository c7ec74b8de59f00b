//! The adaptive mission planner: which behaviour acts, and when another takes over.
//!
//! *Source*: Pang 2009, section 5, Fig. 5.
//!
//! *Parameters*: see [`AmpSpec`].
//!
//! *Deviations*: none in the switching. After the declaration the vehicle goes home, unless the scenario asks for a
//! survey of the declared place (see `strategy/survey`); the mission is completed at home. After a rejected place the
//! vehicle continues the search. A cage abort ends the mission at once.

use super::super::setting::Setting;
use super::super::spec::{Strategy, StrategyParams};
use super::super::survey::{Eyes, PostDeclaration, Progress};
use super::super::wishes::Wishes;
use super::spec::{AmpSpec, Detections};
use crate::behave::{Behave, GoTo, Stride};
use crate::declare::DeclareSpec;
use crate::error::RobotError;
use crate::handoff::{Behaviour, Decision, Declaration, Goal, Observation, Outcome, Shown, Verdict, Vertical, Zone};
use crate::memory::{FixMove, PlumeMemory};
use crate::strategy::about::About;
use nalgebra::Vector2;
use world::seeds::Stream;

/// The behaviours it is composed of.
#[derive(Debug)]
struct Behaviours {
    go_to: Option<GoTo>,
    find: Box<dyn Behave>,
    track_in: Box<dyn Behave>,
    track_out: Box<dyn Behave>,
    reacquire: Box<dyn Behave>,
    go_home: GoTo,
}

impl Behaviours {
    fn get(&mut self, which: Behaviour) -> Option<&mut dyn Behave> {
        match which {
            Behaviour::GoTo => self.go_to.as_mut().map(|g| g as &mut dyn Behave),
            Behaviour::Find => Some(self.find.as_mut()),
            Behaviour::TrackIn => Some(self.track_in.as_mut()),
            Behaviour::TrackOut => Some(self.track_out.as_mut()),
            Behaviour::Reacquire => Some(self.reacquire.as_mut()),
            Behaviour::GoHome => Some(&mut self.go_home),
            _ => None,
        }
    }
}

/// State of the planner.
#[derive(Debug)]
pub struct Amp {
    vertical: Vertical,
    rule: DeclareSpec,
    /// What the rule looked at last.
    zone: Zone,
    post: PostDeclaration,
    heeds_on_the_way: bool,
    behaviours: Behaviours,
    memory: PlumeMemory,
    fixes: FixMove,
    now: Behaviour,
    goal: Goal,
    outcome: Option<Outcome>,
}

impl Amp {
    /// # Errors
    /// [`RobotError::Invalid`] if a behaviour's parameters make no sense.
    pub fn new(spec: &AmpSpec, eyes: &dyn Eyes) -> Result<Self, RobotError> {
        spec.declare.check(spec.lost_points, spec.lcdps)?;
        let vertical = spec.vertical.into();
        Ok(Self {
            vertical,
            rule: spec.declare.clone(),
            zone: Zone::default(),
            post: PostDeclaration::new(&spec.after_declaration, eyes, false)?,
            heeds_on_the_way: spec.start_at.as_ref().is_some_and(|s| s.detections == Detections::Heeded),
            behaviours: Behaviours {
                go_to: spec.start_at.as_ref().map(|s| GoTo::new(Vector2::new(s.east_m.get(), s.north_m.get()))),
                find: spec.find.build()?,
                track_in: spec.track_in.build()?,
                track_out: spec.track_out.build()?,
                reacquire: spec.reacquire.build()?,
                go_home: GoTo::home(),
            },
            memory: PlumeMemory::new(spec.lost_points, spec.lcdps),
            fixes: spec.fixes,
            now: Behaviour::Idle,
            goal: Goal::none_yet(vertical, spec.speed_m_s.get()),
            outcome: None,
        })
    }

    /// The switches of Fig. 5 that do not wait for a behaviour's end.
    fn switch(&self, detected: bool) -> Option<Behaviour> {
        match self.now {
            Behaviour::Idle if self.behaviours.go_to.is_some() && !(detected && self.heeds_on_the_way) => {
                Some(Behaviour::GoTo)
            }
            Behaviour::Idle if detected => Some(Behaviour::TrackIn),
            Behaviour::Idle => Some(Behaviour::Find),
            Behaviour::GoTo if detected && self.heeds_on_the_way => Some(Behaviour::TrackIn),
            Behaviour::Find | Behaviour::Reacquire if detected => Some(Behaviour::TrackIn),
            _ => None,
        }
    }

    /// The next behaviour after one that ended without a detection.
    fn after_end(&self) -> Behaviour {
        match self.now {
            Behaviour::TrackIn => Behaviour::TrackOut,
            Behaviour::TrackOut => Behaviour::Reacquire,
            Behaviour::GoHome | Behaviour::Done => Behaviour::Done,
            _ => Behaviour::Find,
        }
    }

    fn turn_to(&mut self, next: Behaviour, seen: &Observation) {
        self.now = next;
        if next == Behaviour::Done {
            self.outcome.get_or_insert(Outcome::Completed);
        }
        if let Some(behaviour) = self.behaviours.get(next) {
            behaviour.enter(seen, &self.memory);
        }
    }

    /// One step of the acting behaviour; true if it has ended.
    fn act(&mut self, seen: &Observation, arrived: bool, rng: &mut Stream) -> bool {
        let stride = match self.behaviours.get(self.now) {
            Some(behaviour) => behaviour.step(seen, arrived, &mut self.memory, rng),
            None => Stride::Keep,
        };
        stride.turn(&mut self.goal, self.vertical);
        stride == Stride::Over
    }

    /// One step of the survey of a declared place; at its end, the declaration again.
    fn survey(&mut self, seen: &Observation, arrived: bool) -> Option<Declaration> {
        match self.post.step(seen, arrived) {
            Progress::Go(stride) => {
                stride.turn(&mut self.goal, self.post.vertical().unwrap_or(self.vertical));
                None
            }
            Progress::Over(declaration) => {
                if declaration.verdict == Verdict::Rejected {
                    (self.memory).forget_near(declaration.position, self.post.forget_m());
                }
                self.turn_to(PostDeclaration::next(declaration.verdict), seen);
                Some(declaration)
            }
        }
    }

    /// The declaration test at the end of Track-Out (section 5.6).
    fn test(&mut self, seen: &Observation) -> Option<Declaration> {
        let up_flow = self.memory.up_flow_or_nose(seen);
        self.zone = self.rule.zone(&self.memory, up_flow);
        self.rule.declaration(seen.t_s, &self.memory, up_flow)
    }

    fn observe(&mut self, seen: &Observation) -> bool {
        let heeded = match self.now {
            Behaviour::GoHome | Behaviour::Survey | Behaviour::Done => false,
            Behaviour::Idle | Behaviour::GoTo => self.behaviours.go_to.is_none() || self.heeds_on_the_way,
            _ => true,
        };
        self.memory.observe(seen, self.fixes, heeded)
    }
}

impl StrategyParams for AmpSpec {
    fn build(&self, setting: &Setting) -> Result<Box<dyn Strategy>, RobotError> {
        Ok(Box::new(Amp::new(self, &*setting.eyes)?))
    }

    fn about(&self) -> About {
        let mut needs = self.after_declaration.needs();
        needs.extend(self.fixes.needs());
        needs.extend(self.track_in.needs().into_iter().map(|n| n.within("track_in")));
        let wishes = Wishes::mission(self.speed_m_s, self.vertical)
            .after(&self.after_declaration)
            .waiting("track_out", self.track_out.waits());
        About { needs, wishes, ..About::default() }
    }
}

impl Strategy for Amp {
    fn step(&mut self, seen: &Observation, rng: &mut Stream) -> Decision {
        let detected = self.observe(seen);
        let mut declared = None;
        if seen.guidance.aborted && self.outcome.is_none() {
            self.outcome = Some(Outcome::Aborted);
            self.turn_to(Behaviour::Done, seen);
        }
        if let Some(next) = self.switch(detected) {
            self.turn_to(next, seen);
        }
        let mut arrived = seen.guidance.done && seen.guidance.goal_id == self.goal.id;
        // A behaviour that ends is replaced within the tick. Only empty behaviours end twice, so a few turns are
        // always enough.
        for _ in 0..4 {
            if self.now == Behaviour::Survey {
                // What follows begins within the tick.
                declared = self.survey(seen, arrived).or(declared);
                arrived = false;
                if self.now == Behaviour::Survey {
                    break;
                }
            }
            let out = self.now == Behaviour::TrackOut;
            let over = if out && detected { true } else { self.act(seen, arrived, rng) };
            if !over {
                break;
            }
            arrived = false;
            let next = if out {
                if let Some(declaration) = self.test(seen) {
                    let along = self.memory.up_flow_or_nose(seen);
                    let (declaration, next) = self.post.enter(declaration, seen, along);
                    declared = Some(declaration);
                    next
                } else if detected {
                    Behaviour::TrackIn
                } else {
                    self.after_end()
                }
            } else {
                self.after_end()
            };
            self.turn_to(next, seen);
        }
        Decision {
            behaviour: self.now,
            goal: self.goal,
            declared,
            picture: self.now == Behaviour::Survey && self.post.picture(),
            ways: None,
            outcome: self.outcome,
        }
    }

    fn shown(&self) -> Shown {
        Shown {
            lost_points: self.memory.lost.all().iter().map(|l| l.position).collect(),
            zone: self.zone.clone(),
            ..Shown::default()
        }
    }
}
