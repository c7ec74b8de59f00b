//! A machine that asks: what it gathers between two questions, its open question, and what it was told.

use super::{Consultation, Heard, Question, Seen};
use crate::score::Score;
use crate::searchers::SearcherId;
use bevy_ecs::prelude::{Component, Entity, Resource, World};
use robots::handoff::{
    Answer, ChemicalReading, Consulted, HeadOrder, Manoeuvre, MoveOrder, Order, Picture, ProbeScan,
    RangeScan, Readings, SidescanPing, Told, Vertical,
};
use world::clock::{Clock, Every};
use world::frames::Truth;

/// All machines that ask, in the order of the scenario.
#[derive(Resource, Clone, Debug, Default)]
pub(crate) struct Asking(pub Vec<Entity>);

/// What a robot's instruments said since the last question.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Gathered {
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
}

impl Gathered {
    /// Adds the readings of a tick.
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
        let next = Self {
            detected_s: self.detected_s,
            ..Self::default()
        };
        std::mem::replace(self, next)
    }
}

/// What a gantry's probes said since the last question.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HeadGathered {
    /// All scans, oldest first.
    pub scans: Vec<ProbeScan>,
}

/// The gathered of a robot or of a gantry.
#[derive(Clone, Debug)]
pub(crate) enum Kept {
    Robot(Box<Gathered>),
    Gantry(HeadGathered),
}

/// A machine that asks a searcher outside this program.
#[derive(Component, Clone, Debug)]
pub(crate) struct Consulting {
    every: Every,
    deadline_s: f64,
    /// Drives of a robot that an order may set; `None` for a gantry.
    drives: Option<usize>,
    asked: u64,
    pub(crate) kept: Kept,
    question: Option<Box<Question>>,
    told: Option<Told>,
}

impl Consulting {
    /// A robot with so many drives.
    pub(crate) fn robot(consulted: Consulted, drives: usize, dt_s: f64) -> Self {
        Self::new(consulted, Some(drives), dt_s)
    }

    /// A gantry.
    pub(crate) fn gantry(consulted: Consulted, dt_s: f64) -> Self {
        Self::new(consulted, None, dt_s)
    }

    fn new(consulted: Consulted, drives: Option<usize>, dt_s: f64) -> Self {
        Self {
            every: Every::period(consulted.period_s, dt_s),
            deadline_s: consulted.deadline_s,
            drives,
            asked: 0,
            kept: match drives {
                Some(_) => Kept::Robot(Box::default()),
                None => Kept::Gantry(HeadGathered::default()),
            },
            question: None,
            told: None,
        }
    }

    /// Whether it asks in this tick.
    pub(crate) fn due(&self, clock: &Clock) -> bool {
        self.every.due(clock)
    }

    /// Asks.
    pub(crate) fn ask(&mut self, clock: &Clock, robot: &str, see: impl FnOnce(&mut Kept) -> Seen) {
        self.question = Some(Box::new(Question {
            robot: robot.to_string(),
            number: self.asked,
            step: clock.step,
            t_s: clock.t_s(),
            deadline_s: self.deadline_s,
            seen: see(&mut self.kept),
        }));
        self.asked += 1;
    }

    /// What it was told in this tick.
    pub(crate) fn take_told(&mut self) -> Option<Told> {
        self.told.take()
    }

    fn fault(&self, answer: &Answer) -> Option<String> {
        let fault = match (&answer.order, self.drives) {
            (Some(Order::Move(order)), Some(drives)) => fault_of_move(order, drives),
            (Some(Order::Head(order)), None) => fault_of_head(order),
            (Some(Order::Move(_)), None) => {
                Some("it is an order for a robot: a gantry takes `head`".to_string())
            }
            (Some(Order::Head(_)), Some(_)) => Some(
                "it is an order for a gantry: a robot takes `goal`, `steer`, `slide` or `drives`"
                    .to_string(),
            ),
            (None, _) => None,
        };
        let place = answer.declared.as_ref().map(|d| d.position);
        let placed = || place.and_then(|p| fault_of("declare.position_m", &[p.x, p.y], FAR_M));
        fault.or_else(placed)
    }
}

impl Kept {
    /// What a robot gathered.
    pub(crate) fn take_robot(&mut self) -> Gathered {
        match self {
            Kept::Robot(gathered) => gathered.take(),
            Kept::Gantry(_) => Gathered::default(),
        }
    }

    /// What a gantry gathered.
    pub(crate) fn take_gantry(&mut self) -> HeadGathered {
        match self {
            Kept::Gantry(gathered) => std::mem::take(gathered),
            Kept::Robot(_) => HeadGathered::default(),
        }
    }
}

/// Farther no place of a scenario is from its datum, m.
const FAR_M: f64 = 1e6;
/// No vehicle is faster, m/s.
const FAST_M_S: f64 = 100.0;

fn fault_of(field: &str, values: &[f64], most: f64) -> Option<String> {
    let wrong = values.iter().find(|v| !(v.abs() <= most))?;
    Some(format!("`{field}` must be within ±{most}, got {wrong}"))
}

fn fault_of_move(order: &MoveOrder, drives: usize) -> Option<String> {
    let manoeuvre = match &order.manoeuvre {
        Manoeuvre::GoToPoint { point, radius_m } => {
            let radius = radius_m.filter(|m| !(*m > 0.0 && *m <= FAR_M));
            let radius =
                radius.map(|m| format!("`radius_m` must be above 0 and at most {FAR_M}, got {m}"));
            radius.or_else(|| fault_of("point_m", point.as_slice(), FAR_M))
        }
        Manoeuvre::SlideTo {
            point,
            heading,
            radius_m,
        } => {
            let radius = radius_m.filter(|m| !(*m > 0.0 && *m <= FAR_M));
            let radius =
                radius.map(|m| format!("`radius_m` must be above 0 and at most {FAR_M}, got {m}"));
            radius.or_else(|| fault_of("point_m", &[point.x, point.y, heading.rad()], FAR_M))
        }
        Manoeuvre::FollowLine { from, to } => {
            fault_of("from_m, to_m", &[from.x, from.y, to.x, to.y], FAR_M)
        }
        Manoeuvre::GoToPointWithHeading { point, heading } => fault_of(
            "point_m, heading_rad",
            &[point.x, point.y, heading.rad()],
            FAR_M,
        ),
        Manoeuvre::Hold { point, heading } => {
            let heading = heading.map_or(0.0, |h| h.rad());
            fault_of("point_m, heading_rad", &[point.x, point.y, heading], FAR_M)
        }
        Manoeuvre::Course { course: heading } | Manoeuvre::Steer { heading } => {
            fault_of("heading_rad", &[heading.rad()], FAR_M)
        }
        Manoeuvre::Slide {
            heading,
            over_ground_m_s: v,
        } => fault_of("heading_rad", &[heading.rad()], FAR_M)
            .or_else(|| fault_of("velocity_m_s", &[v.x, v.y], FAST_M_S)),
        Manoeuvre::Drives(set) if set.all().len() != drives => Some(format!(
            "`drives` must have a set-point for each of the vehicle's {drives} drives, got {}",
            set.all().len()
        )),
        Manoeuvre::Drives(set) => fault_of("drives", set.all(), FAR_M),
        Manoeuvre::Direct {
            rudder_rad,
            stern_rad,
            rpm,
        } => fault_of("direct", &[*rudder_rad, *stern_rad, *rpm], FAR_M),
    };
    let vertical = order.vertical.and_then(|v| {
        let (field, m) = match v {
            Vertical::Depth(m) => ("depth_m", m),
            Vertical::Altitude(m) => ("altitude_m", m),
        };
        let wrong = !(0.0..=FAR_M).contains(&m);
        wrong.then(|| format!("`{field}` must be from 0 to {FAR_M}, got {m}"))
    });
    let speed = order.speed_m_s.and_then(|m_s| {
        let wrong = !(0.0..=FAST_M_S).contains(&m_s);
        wrong.then(|| format!("`speed_m_s` must be from 0 to {FAST_M_S}, got {m_s}"))
    });
    manoeuvre.or(vertical).or(speed)
}

fn fault_of_head(order: &HeadOrder) -> Option<String> {
    let speed = order.speed_m_s.and_then(|v| {
        let slow = v.iter().find(|v| !(**v > 0.0 && **v <= FAST_M_S))?;
        Some(format!(
            "`speed_m_s` must be above 0 and at most {FAST_M_S}, got {slow}"
        ))
    });
    speed.or_else(|| fault_of("target_m", order.target_m.as_slice(), FAR_M))
}

/// The true state of a robot that asks; `None` for a gantry.
pub(crate) fn truth_of(world: &World, name: &str) -> Option<Truth> {
    let asking = world.get_resource::<Asking>()?;
    let named = |e: &&Entity| (world.get::<SearcherId>(**e)).is_some_and(|id| id.name == name);
    let entity = asking.0.iter().find(named)?;
    world.get::<Truth>(*entity).copied()
}

/// The questions of this tick that nobody has taken, in the order of the scenario.
pub(crate) fn take_questions(world: &mut World) -> Vec<Question> {
    let mut open = Vec::new();
    for n in 0.. {
        let Some(entity) = asking(world, n) else {
            break;
        };
        if let Some(mut consulting) = world.get_mut::<Consulting>(entity) {
            open.extend(consulting.question.take().map(|question| *question));
        }
    }
    open
}

/// The machine in this place among those that ask.
fn asking(world: &World, n: usize) -> Option<Entity> {
    world.get_resource::<Asking>()?.0.get(n).copied()
}

/// A question that waits for its answer.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Open {
    /// Who asks.
    pub(crate) robot: String,
    number: u64,
    step: u64,
    t_s: f64,
}

impl From<&Question> for Open {
    fn from(question: &Question) -> Self {
        Self {
            robot: question.robot.clone(),
            number: question.number,
            step: question.step,
            t_s: question.t_s,
        }
    }
}

/// Puts in what came of a question, counts it, and returns it as observers see it. An answer that the machine cannot
/// carry out counts as nonsense.
pub(crate) fn put_in(world: &mut World, question: Open, mut heard: Heard) -> Consultation {
    for n in 0.. {
        let Some(entity) = asking(world, n) else {
            break;
        };
        let own = (world.get::<SearcherId>(entity)).filter(|id| id.name == question.robot);
        let Some(place) = own.map(|id| id.place) else {
            continue;
        };
        let Some(mut consulting) = world.get_mut::<Consulting>(entity) else {
            continue;
        };
        if let Heard::Answer(answer) = &heard
            && let Some(fault) = consulting.fault(answer)
        {
            heard = Heard::Nonsense(fault);
        }
        consulting.told = Some(match &heard {
            Heard::Answer(answer) => Told::Answer(Box::new(answer.clone())),
            _ => Told::Nothing,
        });
        let mut score = world.resource_mut::<Score>();
        let own = score.searchers[place].consulted.get_or_insert_default();
        own.asked += 1;
        *match &heard {
            Heard::Answer(_) => &mut own.answered,
            Heard::Late => &mut own.late,
            Heard::Absent => &mut own.absent,
            Heard::Gone => &mut own.gone,
            Heard::Nonsense(_) => &mut own.nonsense,
        } += 1;
    }
    Consultation {
        robot: question.robot,
        number: question.number,
        step: question.step,
        t_s: question.t_s,
        heard,
    }
}
