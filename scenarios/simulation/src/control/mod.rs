//! Searchers outside this program: what they are asked, what they answer, and what came of each question.
//!
//! A robot or gantry whose strategy is `External` asks once a period. The question is made after the stages `Sense`,
//! `Estimate` and `Map`, and the answer is put in before `Decide`: between the halves of a tick, so that no stage waits
//! and nothing but the answers of a [`Trial`](crate::trial::Trial)'s controllers enters it. Each question comes to a
//! [`Exchange`], which observers see and recordings keep; a [`Replay`] of them makes the same run again.
//!
//! Two ways to answer:
//!
//! - [`Trial::control`](crate::trial::Trial::control) gives a robot a [`Controller`], which is called for each question;
//! - [`Trial::until_asked`](crate::trial::Trial::until_asked) stops at the questions, and
//!   [`Trial::answer`](crate::trial::Trial::answer) answers them.

mod answers;
pub(crate) mod exchanges;
mod forms;
mod names;
mod questions;
mod replay;
#[cfg(test)]
mod tests;

pub use answers::{answer_json, read_answer};
pub use exchanges::ReadingsSince;
pub use questions::question_json;
pub use replay::{Replay, consultation_json, read_consultation};

use robots::handoff::{GantryObservation, Observation, Reply};

/// What a searcher outside this program is asked.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// Id of the robot or gantry in the scenario.
    pub robot: String,
    /// How many it was asked before.
    pub number: u64,
    /// Step of the mission.
    pub step: u64,
    /// Mission time, s.
    pub t_s: f64,
    /// How long the run waits for an answer, s of real time.
    pub deadline_s: f64,
    /// What it sees.
    pub seen: QuestionContent,
}

/// What a machine sees in the tick of a question, and what it has seen since the last one.
#[derive(Clone, Debug, PartialEq)]
pub enum QuestionContent {
    /// A robot.
    Robot(Box<Observation>, Box<ReadingsSince>),
    /// A gantry.
    Gantry(GantryObservation, Box<ReadingsSince>),
}

/// What came back.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "there is one at a time, and controllers make them by hand")]
pub enum Response {
    /// An answer.
    Answer(Reply),
    /// Nothing within the deadline.
    Late,
    /// Nobody is there.
    Absent,
    /// Whoever was there went away while it was asked.
    Gone,
    /// Something that is no answer, or one that the machine cannot carry out: what is wrong with it.
    Nonsense(String),
}

impl Response {
    /// Name as it stands in files and topics.
    pub fn name(&self) -> &'static str {
        match self {
            Response::Answer(_) => "answered",
            Response::Late => "late",
            Response::Absent => "absent",
            Response::Gone => "gone",
            Response::Nonsense(_) => "nonsense",
        }
    }
}

/// A question and what came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Exchange {
    /// Id of the robot or gantry.
    pub robot: String,
    /// How many it was asked before.
    pub number: u64,
    /// Step of the mission.
    pub step: u64,
    /// Mission time, s.
    pub t_s: f64,
    /// What came back.
    pub response: Response,
}

impl Exchange {
    /// A question to which this came back.
    pub fn new(question: &Question, response: Response) -> Self {
        let Question { number, step, t_s, .. } = *question;
        Self { robot: question.robot.clone(), number, step, t_s, response }
    }
}

/// Whoever decides for a robot or gantry whose strategy is `External`.
pub trait Controller: Send {
    /// Answers a question. The run waits.
    fn answer(&mut self, question: &Question) -> Response;
}

impl<F: FnMut(&Question) -> Response + Send> Controller for F {
    fn answer(&mut self, question: &Question) -> Response {
        self(question)
    }
}
