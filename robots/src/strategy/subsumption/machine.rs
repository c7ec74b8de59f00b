//! The subsumption planner: in each tick the layers ask for the vehicle from the lowest up, and the highest that asks
//! controls it.
//!
//! *Source*: Tian et al. 2013, section 2, Fig. 3: Find-Plume, Maintain-Plume, Reacquire-Plume, Declare-Source,
//! Avoid-Obstacle, Construct-Plume-Map, and Go-Home; suppression and inhibition: Brooks 1986, IEEE J. Robotics and
//! Automation RA-2, 14.
//!
//! *Parameters*: see [`SubsumptionSpec`].
//!
//! *Deviations*: the paper names the mechanisms, but not which wire carries which. Here a layer that asks while a
//! higher one controls the vehicle is suppressed: its command is replaced. A layer whose input is taken away is
//! inhibited: it does not look, and asks for nothing. Go-Home inhibits all layers below it once a source is declared.
//! Find always asks. Maintain asks from a detection until it loses the plume, Reacquire from then until a detection
//! or its own end: the two never ask together. A suppressed search starts afresh when it gets the vehicle back, as in
//! Pang 2009, Fig. 5.
//!
//! Declare asks when its rule is met at the end of Track-Out (Pang 2009, section 5.6). It controls the vehicle for
//! the one tick of the declaration, or until the survey of the declared place is over (our choice, after Pang 2009,
//! section 6). Meanwhile the plume's layers are inhibited, and they start afresh if the place is rejected. If Avoid
//! suppresses Declare, it keeps asking, and declares afterwards. Avoid replaces the command of the layer that would
//! control the vehicle by one that turns away from the obstacle. Layers suppressed by Avoid keep observing but do not
//! arrive, unless Avoid gives up. For Construct-Plume-Map see `plume_map.rs`. Without a Go-Home layer the mission is
//! over with the declaration. A cage abort ends it at once.

use super::super::setting::Setting;
use super::super::spec::{Strategy, StrategyParams};
use super::super::survey::{AfterDeclaration, BLIND, PostDeclaration, Progress};
use super::super::wishes::Wishes;
use super::ask::{Ask, Kind, keep};
use super::compose::Layers;
use super::eyes::PointLooks;
use super::plume::PlumeRequests;
use super::spec::{LayerSpec, SubsumptionSpec};
use crate::behave::{Behave, Stride};
use crate::declare::Points;
use crate::error::RobotError;
use crate::handoff::{
    Behaviour, Decision, Declaration, Goal, Layer, LayerState, Manoeuvre, Need, Observation, Outcome, Shown, Verdict,
    Vertical, Zone,
};
use crate::memory::{FixMove, PlumeMemory};
use crate::strategy::about::About;
use world::seeds::Stream;

/// State of the planner.
#[derive(Debug)]
pub struct Subsumption {
    fixes: FixMove,
    layers: Layers,
    memory: PlumeMemory,
    /// The rule's declaration, while Declare asks.
    declaring: Option<Declaration>,
    /// What its declaration rule looked at last.
    zone: Zone,
    /// What follows a declaration; whether the survey has begun, and what it asks for.
    post: PostDeclaration,
    surveying: bool,
    eyes: Option<PointLooks>,
    passes: Option<Manoeuvre>,
    vertical: Vertical,
    /// Whether the way home has begun, and what was asked for on it.
    homing: bool,
    home: Option<Manoeuvre>,
    holder: Option<Kind>,
    /// The layer whose command Avoid turns away.
    under_avoid: Option<Kind>,
    states: Vec<Layer>,
    behaviour: Behaviour,
    goal: Goal,
    outcome: Option<Outcome>,
}

impl Subsumption {
    /// # Errors
    /// [`RobotError::Invalid`] if the layers make no sense together, or if a layer's parameters make none.
    pub fn new(spec: &SubsumptionSpec, setting: &Setting) -> Result<Self, RobotError> {
        let layers = Layers::new(spec, setting)?;
        if let Some(survey) = &spec.survey {
            survey.check("strategy.survey")?;
        }
        if let Some(eyes) = &spec.eyes {
            eyes.verifier.check("strategy.eyes.verifier")?;
        }
        let after = spec.survey.clone().map_or(AfterDeclaration::GoHome, AfterDeclaration::Survey);
        let silent = |k: &Kind| Layer { name: k.into(), state: LayerState::Silent };
        Ok(Self {
            fixes: spec.fixes,
            states: layers.order.iter().map(silent).collect(),
            layers,
            memory: PlumeMemory::new(spec.lost_points, spec.lcdps),
            declaring: None,
            zone: Zone::default(),
            post: PostDeclaration::new(&after, &*setting.eyes, false)?,
            surveying: false,
            eyes: spec.eyes.as_ref().map(|spec| PointLooks::new(spec, &setting.eyes)),
            passes: None,
            vertical: Vertical::from(spec.vertical),
            homing: false,
            home: None,
            holder: None,
            under_avoid: None,
            behaviour: Behaviour::Idle,
            goal: Goal::none_yet(Vertical::from(spec.vertical), spec.speed_m_s.get()),
            outcome: None,
        })
    }

    /// The rule's present answer.
    fn test(&mut self, seen: &Observation) -> Option<Declaration> {
        let up_flow = self.memory.up_flow_or_nose(seen);
        let rule = self.layers.declare.as_ref()?;
        self.zone = rule.zone(&self.memory, up_flow);
        rule.declaration(seen.t_s, &self.memory, up_flow)
    }

    /// The way home; `None` at its end.
    fn go_home(&mut self, seen: &Observation, arrived: Option<Kind>, rng: &mut Stream) -> Option<Ask> {
        let home = self.layers.go_home.as_mut()?;
        let stride = home.step(seen, arrived == Some(Kind::GoHome), &mut self.memory, rng);
        let anew = keep(&mut self.home, stride);
        let way = self.home.filter(|_| stride != Stride::Over);
        Ask::from_manoeuvre(Kind::GoHome, Behaviour::GoHome, way, anew)
    }

    /// One step of the survey: what it asks for, or at its end the declaration again.
    fn survey(&mut self, seen: &Observation, arrived: Option<Kind>) -> (Option<Ask>, Option<Declaration>) {
        match self.post.step(seen, arrived == Some(Kind::Declare)) {
            Progress::Go(stride) => {
                let anew = keep(&mut self.passes, stride);
                let ask = Ask::from_manoeuvre(Kind::Declare, Behaviour::Survey, self.passes, anew);
                (ask, None)
            }
            Progress::Over(declaration) => {
                self.surveying = false;
                if declaration.verdict == Verdict::Rejected {
                    (self.memory).forget_near(declaration.position, self.post.forget_m());
                    self.layers.plume.renew();
                } else {
                    self.leave(seen);
                }
                (None, Some(declaration))
            }
        }
    }

    /// The search is over: goes home, if there is such a layer.
    fn leave(&mut self, seen: &Observation) {
        match &mut self.layers.go_home {
            Some(home) => {
                home.enter(seen, &self.memory);
                self.homing = true;
            }
            None => self.end(Outcome::Completed),
        }
    }

    /// From the lowest layer up: which layers ask, which are suppressed or inhibited, and which one controls the
    /// vehicle.
    fn arbitrate(&mut self, seen: &Observation, asked: &PlumeRequests, above: Option<Ask>) -> Option<Ask> {
        let (homing, surveying) = (self.homing, self.surveying);
        let declaring = self.declaring.is_some();
        let Layers { order, avoid, .. } = &mut self.layers;
        let place = |kind| order.iter().position(|k| *k == kind);
        let from = (place(Kind::GoHome).filter(|_| homing))
            .or_else(|| place(Kind::Declare).filter(|_| surveying))
            .unwrap_or(0);
        let mut states = vec![LayerState::Silent; order.len()];
        states[..from].fill(LayerState::Inhibited);
        let mut holder: Option<Ask> = None;
        for (k, kind) in order.iter().enumerate().skip(from) {
            let of = |behaviour, manoeuvre| Ask { kind: *kind, behaviour, manoeuvre, anew: false };
            let ask = match kind {
                Kind::Find => asked.find,
                Kind::Maintain => asked.maintain,
                Kind::Reacquire => asked.reacquire,
                Kind::Declare if surveying => above,
                Kind::Declare => (holder.filter(|_| declaring)).map(|h| of(h.behaviour, h.manoeuvre)),
                Kind::Avoid => holder.and_then(|h| {
                    self.under_avoid = Some(h.kind);
                    let away = avoid.as_mut()?.step(seen, &h.manoeuvre)?;
                    Some(of(Behaviour::Avoid, away))
                }),
                Kind::GoHome => above.filter(|a| a.kind == Kind::GoHome),
                // Its command is used in place of Find's, below.
                Kind::PlumeMap => None,
            };
            let Some(ask) = ask else { continue };
            if let Some(below) = holder.and_then(|h| place(h.kind)) {
                states[below] = LayerState::Suppressed;
            }
            (states[k], holder) = (LayerState::Holds, Some(ask));
            if *kind == Kind::Find
                && let (Some(map), Some(i)) = (asked.plume_map, place(Kind::PlumeMap))
            {
                (states[k], states[i]) = (LayerState::Suppressed, LayerState::Holds);
                holder = Some(map);
            }
        }
        self.publish(&states);
        holder
    }

    fn publish(&mut self, states: &[LayerState]) {
        for (layer, state) in self.states.iter_mut().zip(states) {
            layer.state = *state;
        }
    }

    fn command(&mut self, ask: &Ask) {
        if ask.anew || self.holder != Some(ask.kind) {
            self.goal.id += 1;
        }
        self.goal.manoeuvre = ask.manoeuvre;
        let passes = self.post.vertical().filter(|_| self.surveying);
        self.goal.vertical = passes.unwrap_or(self.vertical);
        self.behaviour = ask.behaviour;
        self.holder = Some(ask.kind);
    }

    /// Declares; the goal holds for this one tick.
    fn declare(&mut self, seen: &Observation) -> Option<Declaration> {
        let declared = self.declaring.take()?;
        self.holder = Some(Kind::Declare);
        let along = self.memory.up_flow_or_nose(seen);
        let now = Declaration { t_s: seen.t_s, ..declared };
        let (now, next) = self.post.enter(now, seen, along);
        if next == Behaviour::Survey {
            (self.surveying, self.passes) = (true, None);
        } else {
            self.leave(seen);
        }
        Some(now)
    }

    fn wants_picture(&self) -> bool {
        let at_point = !self.homing && self.eyes.as_ref().is_some_and(PointLooks::asks);
        if self.surveying { self.post.picture() } else { at_point }
    }

    fn end(&mut self, outcome: Outcome) {
        self.outcome = Some(outcome);
        self.behaviour = Behaviour::Done;
        self.publish(&vec![LayerState::Silent; self.states.len()]);
    }

    fn run(&mut self, seen: &Observation, rng: &mut Stream) -> Option<Declaration> {
        // A detection reaches the plume's layers only while they search.
        let detected = self.memory.observe(seen, self.fixes, !self.homing && !self.surveying);
        let reached = seen.guidance.done && seen.guidance.goal_id == self.goal.id;
        let mut arrived = self.holder.filter(|_| reached);
        if let (Some(Kind::Avoid), Some(avoid)) = (self.holder, &mut self.layers.avoid)
            && avoid.gives_up()
        {
            arrived = self.under_avoid;
        }
        let (mut asked, mut above) = (PlumeRequests::default(), None);
        if self.homing {
            above = self.go_home(seen, arrived, rng);
            if above.is_none() {
                self.end(Outcome::Completed);
                return None;
            }
        } else if self.surveying {
            let (ask, again) = self.survey(seen, arrived);
            if again.is_some() {
                return again;
            }
            above = ask;
        } else {
            let plume = &mut self.layers.plume;
            asked = plume.step(seen, detected, arrived, &mut self.memory, rng);
            if asked.out_ended && self.declaring.is_none() {
                self.declaring = self.test(seen);
            }
            if let Some(eyes) = &mut self.eyes {
                if asked.reacquire.is_some() {
                    let by_sight = eyes.step(seen, &self.memory);
                    self.declaring = self.declaring.take().or(by_sight);
                } else {
                    eyes.rest();
                }
            }
        }
        let holder = self.arbitrate(seen, &asked, above)?;
        if holder.kind == Kind::Declare && !self.surveying {
            return self.declare(seen);
        }
        self.command(&holder);
        None
    }
}

impl StrategyParams for SubsumptionSpec {
    fn build(&self, setting: &Setting) -> Result<Box<dyn Strategy>, RobotError> {
        Ok(Box::new(Subsumption::new(self, setting)?))
    }

    fn about(&self) -> About {
        let survey = self.survey.as_ref().map(|s| s.needs("survey"));
        let mut needs = survey.unwrap_or_default();
        if self.layers.iter().any(|l| matches!(l, LayerSpec::Avoid(_))) {
            let so = "sees no obstacle that its Avoid layer could turn away from";
            needs.push(Need::vital("layers", "ranging", so));
        }
        if self.eyes.is_some() {
            needs.push(Need::vital("eyes", "camera", BLIND));
        }
        needs.extend(self.fixes.needs());
        let mut wishes = Wishes::mission(self.speed_m_s, self.vertical);
        for (k, layer) in self.layers.iter().enumerate() {
            if let LayerSpec::Maintain(maintain) = layer {
                let waits = maintain.track_out.as_ref().and_then(|t| t.waits());
                wishes = wishes.waiting(&format!("layers[{k}].track_out"), waits);
                let path = format!("layers[{k}].track_in");
                needs.extend(maintain.track_in.needs().into_iter().map(|n| n.within(&path)));
            }
        }
        if let Some(survey) = &self.survey {
            wishes = wishes.survey("survey", survey);
        }
        About { needs, wishes, layers: true, ..About::default() }
    }
}

impl Strategy for Subsumption {
    fn step(&mut self, seen: &Observation, rng: &mut Stream) -> Decision {
        let mut declared = None;
        if self.outcome.is_none() {
            if seen.guidance.aborted {
                self.end(Outcome::Aborted);
            } else {
                declared = self.run(seen, rng);
            }
        }
        Decision {
            behaviour: self.behaviour,
            goal: self.goal,
            declared,
            picture: self.outcome.is_none() && self.wants_picture(),
            ways: None,
            outcome: self.outcome,
        }
    }

    fn shown(&self) -> Shown {
        let rule = self.layers.declare.as_ref();
        let points = rule.map_or(Points::Lost, |r| r.points()).select(&self.memory);
        Shown {
            lost_points: points.iter().map(|l| l.position).collect(),
            zone: self.zone.clone(),
            layers: self.states.clone(),
            ..Shown::default()
        }
    }
}
