//! Searchers outside this program: what they are asked, what they answer, and what came of each question.
//!
//! A robot or gantry whose strategy is `External` asks once a period. The question is made after the stages `Sense`,
//! `Estimate` and `Map`, and the answer is put in before `Decide`: between the halves of a tick, so that no stage waits
//! and nothing but the answers of a [`Trial`](crate::trial::Trial)'s controllers enters it. Each question comes to a
//! [`Consultation`], which observers see and recordings keep; a [`Replay`] of them makes the same run again.
//!
//! Two ways to answer:
//!
//! - [`Trial::control`](crate::trial::Trial::control) gives a robot a [`Controller`], which is called for each question;
//! - [`Trial::until_asked`](crate::trial::Trial::until_asked) stops at the questions, and
//!   [`Trial::answer`](crate::trial::Trial::answer) answers them.

mod answers;
pub(crate) mod consulting;
mod forms;
mod names;
mod questions;
mod replay;
#[cfg(test)]
mod tests;

pub use answers::{answer_json, read_answer};
pub use consulting::{Gathered, HeadGathered};
pub use questions::question_json;
pub use replay::{Replay, consultation_json, read_consultation};

use robots::handoff::{Answer, GantryObservation, Observation};

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
    pub seen: Seen,
}

/// What a machine sees in the tick of a question, and what it has seen since the last one.
#[derive(Clone, Debug, PartialEq)]
pub enum Seen {
    /// A robot.
    Robot(Box<Observation>, Box<Gathered>),
    /// A gantry.
    Gantry(GantryObservation, HeadGathered),
}

/// What came back.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "there is one at a time, and controllers make them by hand")]
pub enum Heard {
    /// An answer.
    Answer(Answer),
    /// Nothing within the deadline.
    Late,
    /// Nobody is there.
    Absent,
    /// Whoever was there went away while it was asked.
    Gone,
    /// Something that is no answer, or one that the machine cannot carry out: what is wrong with it.
    Nonsense(String),
}

impl Heard {
    /// Name as it stands in files and topics.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Heard::Answer(_) => "answered",
            Heard::Late => "late",
            Heard::Absent => "absent",
            Heard::Gone => "gone",
            Heard::Nonsense(_) => "nonsense",
        }
    }
}

/// A question and what came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Consultation {
    /// Id of the robot or gantry.
    pub robot: String,
    /// How many it was asked before.
    pub number: u64,
    /// Step of the mission.
    pub step: u64,
    /// Mission time, s.
    pub t_s: f64,
    /// What came back.
    pub heard: Heard,
}

/// Whoever decides for a robot or gantry whose strategy is `External`.
pub trait Controller: Send {
    /// Answers a question. The run waits.
    fn answer(&mut self, question: &Question) -> Heard;
}

impl<F: FnMut(&Question) -> Heard + Send> Controller for F {
    fn answer(&mut self, question: &Question) -> Heard {
        self(question)
    }
}
