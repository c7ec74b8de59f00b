//! What a searcher outside this program answers, when its robot or gantry asks it.

use super::{Behaviour, Decision, Declaration, HeadGoal, Manoeuvre, Outcome, Vertical};
use nalgebra::Vector2;

/// How a searcher outside this program is asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExchangeTiming {
    /// Simulated time between two questions, s.
    pub period_s: f64,
    /// How long a run waits for an answer, s of real time.
    pub deadline_s: f64,
}

/// An answer to one question. What it leaves out stays as it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reply {
    /// What to do.
    pub order: Option<MotionOrder>,
    /// What the searcher calls that.
    pub behaviour: Option<Behaviour>,
    /// A declaration.
    pub declared: Option<Declaration>,
    /// Ask the camera for a picture.
    pub picture: bool,
    /// The mission is over.
    pub outcome: Option<Outcome>,
}

/// What an answer asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum MotionOrder {
    /// Of a robot.
    Move(MoveOrder),
    /// Of a gantry.
    Head(HeadOrder),
}

/// A robot's next goal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoveOrder {
    /// Number of the goal. The same number changes the goal under way; `None` begins the next one.
    pub id: Option<u32>,
    /// Horizontal part.
    pub manoeuvre: Manoeuvre,
    /// Vertical part; `None` for that of the last goal.
    pub vertical: Option<Vertical>,
    /// Speed over ground, or through the water for [`Manoeuvre::Steer`], m/s; `None` for that of the last goal.
    pub speed_m_s: Option<f64>,
}

/// A gantry's next motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeadOrder {
    /// Number of the motion; `None` for the next one.
    pub id: Option<u32>,
    /// Destination of the head's reference point in the gantry's frame (forward, left), m.
    pub target_m: Vector2<f64>,
    /// Speed of each axis (forward, left), m/s; `None` for the machine's greatest.
    pub speed_m_s: Option<Vector2<f64>>,
    /// What the searcher does.
    pub behaviour: Behaviour,
}

/// What came of a question.
#[derive(Clone, Debug, PartialEq)]
pub enum ReplyOutcome {
    /// An answer that fits the robot.
    Answer(Box<Reply>),
    /// None that can be used.
    Nothing,
}

/// The answer that makes a robot do what a strategy has decided.
impl From<&Decision> for Reply {
    fn from(decision: &Decision) -> Self {
        let goal = &decision.goal;
        Self {
            order: Some(MotionOrder::Move(MoveOrder {
                id: Some(goal.id),
                manoeuvre: goal.manoeuvre,
                vertical: Some(goal.vertical),
                speed_m_s: Some(goal.speed_m_s),
            })),
            behaviour: Some(decision.behaviour),
            declared: decision.declared,
            picture: decision.picture,
            outcome: decision.outcome,
        }
    }
}

/// The answer that makes a gantry do what a searcher has decided.
impl From<&Decision<HeadGoal>> for Reply {
    fn from(decision: &Decision<HeadGoal>) -> Self {
        let HeadGoal { id, target_m, speed_m_s } = decision.goal;
        Self {
            order: (id > 0).then_some(MotionOrder::Head(HeadOrder {
                id: Some(id),
                target_m,
                speed_m_s: Some(speed_m_s),
                behaviour: decision.behaviour,
            })),
            outcome: decision.outcome,
            ..Self::default()
        }
    }
}
