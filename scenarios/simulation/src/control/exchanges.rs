//! A machine that asks: what it gathers between two questions, its open question, and what it was told.

use super::{Exchange, Question, QuestionContent, Response};
use crate::score::Score;
use crate::searchers::{Roster, SearcherId};
use bevy_ecs::prelude::{Component, Entity, World};
use robots::handoff::{
    Bounds, ChemicalReading, ExchangeTiming, MotionOrder, Picture, ProbeScan, RangeScan, Readings, Reply, ReplyOutcome,
    SidescanPing,
};
use world::clock::{Clock, Every};
use world::frames::Truth;

/// What a machine's instruments said since the last question.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadingsSince {
    /// Readings of the chemical sensor.
    pub readings: u32,
    /// Those of them with a detection.
    pub detections: u32,
    /// Sum of them, as shares of full scale.
    pub sum: f64,
    /// The greatest, as a share of full scale.
    pub highest: f64,
    /// The newest.
    pub chemical: Option<ChemicalReading>,
    /// When the newest detection was, s of the mission; it stays from question to question.
    pub detected_s: Option<f64>,
    /// The newest ping of the forward ranging.
    pub ranging: Option<RangeScan>,
    /// The newest ping of the sidescan sonar.
    pub sidescan: Option<SidescanPing>,
    /// The newest picture.
    pub picture: Option<Picture>,
    /// All scans of a gantry's probes, oldest first.
    pub scans: Vec<ProbeScan>,
}

impl ReadingsSince {
    /// Adds a robot's readings of a tick.
    pub(crate) fn add(&mut self, t_s: f64, readings: &Readings) {
        if let Some(reading) = readings.chemical {
            self.readings += 1;
            self.sum += reading.of_full_scale;
            self.highest = self.highest.max(reading.of_full_scale);
            self.chemical = Some(reading);
            if reading.detected {
                self.detections += 1;
                self.detected_s = Some(t_s);
            }
        }
        fn newest<T: Clone>(kept: &mut Option<T>, new: &Option<T>) {
            if new.is_some() {
                kept.clone_from(new);
            }
        }
        newest(&mut self.ranging, &readings.ranging);
        newest(&mut self.sidescan, &readings.sidescan);
        newest(&mut self.picture, &readings.picture);
    }

    /// Hands out what was gathered, and begins anew.
    fn take(&mut self) -> Self {
        let next = Self { detected_s: self.detected_s, ..Self::default() };
        std::mem::replace(self, next)
    }
}

/// A machine that asks a searcher outside this program.
#[derive(Component, Clone, Debug)]
pub(crate) struct ExchangeState {
    every: Every,
    deadline_s: f64,
    /// Drives of a robot that an order may set; `None` for a gantry.
    drives: Option<usize>,
    asked: u64,
    pub(crate) gathered: Box<ReadingsSince>,
    question: Option<Box<Question>>,
    told: Option<ReplyOutcome>,
}

impl ExchangeState {
    /// Of a robot with so many drives, or of a gantry.
    pub(crate) fn new(consulted: ExchangeTiming, drives: Option<usize>, dt_s: f64) -> Self {
        Self {
            every: Every::period(consulted.period_s, dt_s),
            deadline_s: consulted.deadline_s,
            drives,
            asked: 0,
            gathered: Box::default(),
            question: None,
            told: None,
        }
    }

    /// Whether it asks in this tick.
    pub(crate) fn due(&self, clock: &Clock) -> bool {
        self.every.due(clock)
    }

    /// Asks.
    pub(crate) fn ask(&mut self, clock: &Clock, robot: &str, see: impl FnOnce(ReadingsSince) -> QuestionContent) {
        self.question = Some(Box::new(Question {
            robot: robot.to_string(),
            number: self.asked,
            step: clock.step,
            t_s: clock.t_s(),
            deadline_s: self.deadline_s,
            seen: see(self.gathered.take()),
        }));
        self.asked += 1;
    }

    /// What it was told in this tick.
    pub(crate) fn take_told(&mut self) -> Option<ReplyOutcome> {
        self.told.take()
    }

    fn fault(&self, answer: &Reply) -> Option<String> {
        let fault = match (&answer.order, self.drives) {
            (Some(MotionOrder::Move(order)), Some(drives)) => order.fault(drives),
            (Some(MotionOrder::Head(order)), None) => order.fault(Bounds::OWN),
            (Some(MotionOrder::Move(_)), None) => Some("it is an order for a robot: a gantry takes `head`".to_string()),
            (Some(MotionOrder::Head(_)), Some(_)) => {
                Some("it is an order for a gantry: a robot takes `goal`, `steer`, `slide` or `drives`".to_string())
            }
            (None, _) => None,
        };
        fault.or_else(|| answer.declared.and_then(|d| d.fault(Bounds::OWN)))
    }
}

/// The machine of a name among those that ask.
fn named(world: &World, name: &str) -> Option<Entity> {
    let is = |e: &&Entity| (world.get::<SearcherId>(**e)).is_some_and(|id| id.name == name);
    world.resource::<Roster>().asking.iter().find(is).copied()
}

/// The true state of a robot that asks; `None` for a gantry.
pub(crate) fn truth_of(world: &World, name: &str) -> Option<Truth> {
    world.get::<Truth>(named(world, name)?).copied()
}

/// The questions of this tick that nobody has taken, in the order of the scenario.
pub(crate) fn take_questions(world: &mut World) -> Vec<Question> {
    let mut open = Vec::new();
    let mut n = 0;
    while let Some(entity) = world.resource::<Roster>().asking.get(n).copied() {
        let consulting = world.get_mut::<ExchangeState>(entity);
        open.extend(consulting.and_then(|mut c| c.question.take()).map(|question| *question));
        n += 1;
    }
    open
}

/// Counts what came of a question, tells it to the machine that asked, and returns it as observers see it. An answer that
/// the machine cannot carry out counts as nonsense.
pub(crate) fn put_in(world: &mut World, mut exchange: Exchange) -> Exchange {
    let Some(entity) = named(world, &exchange.robot) else {
        return exchange;
    };
    let mut asked = world.entity_mut(entity);
    let place = asked.get::<SearcherId>().map(|id| id.place);
    let (Some(place), Some(mut consulting)) = (place, asked.get_mut::<ExchangeState>()) else {
        return exchange;
    };
    if let Response::Answer(answer) = &exchange.response
        && let Some(fault) = consulting.fault(answer)
    {
        exchange.response = Response::Nonsense(fault);
    }
    consulting.told = Some(match &exchange.response {
        Response::Answer(answer) => ReplyOutcome::Answer(Box::new(answer.clone())),
        _ => ReplyOutcome::Nothing,
    });
    let mut score = world.resource_mut::<Score>();
    let own = score.searchers[place].consulted.get_or_insert_default();
    own.asked += 1;
    *match &exchange.response {
        Response::Answer(_) => &mut own.answered,
        Response::Late => &mut own.late,
        Response::Absent => &mut own.absent,
        Response::Gone => &mut own.gone,
        Response::Nonsense(_) => &mut own.nonsense,
    } += 1;
    exchange
}
