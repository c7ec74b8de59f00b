//! How a run asks searchers outside this program, and takes their answers.

use super::controlled::{NotControlled, controlled};
use super::observer::{Event, Observer};
use super::run::Trial;
use crate::control::exchanges::{put_in, take_questions, truth_of};
use crate::control::{Controller, Exchange, Question, Response};
use std::sync::Arc;
use world::frames::Truth;

impl Trial {
    /// The tick up to the step of the ocean, with the answers of searchers outside this program. Questions that nobody
    /// answers count as put to somebody absent.
    pub(crate) fn search(&mut self, observer: &mut dyn Observer) {
        self.observe(observer);
        for question in self.progress.open.take().unwrap_or_default() {
            let told = put_in(&mut self.simulation.world, question);
            observer.see(&Event::Exchange(Arc::new(told)));
        }
        self.simulation.act();
    }

    /// The tick up to the answers from outside, unless that is done, and the answers of the controllers. Returns the
    /// questions that are left; until they are answered, the run keeps them open.
    pub(crate) fn observe(&mut self, observer: &mut dyn Observer) -> Vec<Question> {
        if self.progress.open.is_some() {
            return Vec::new();
        }
        self.simulation.observe();
        let mut open = Vec::new();
        for question in take_questions(&mut self.simulation.world) {
            let Some(controller) = self.controllers.get_mut(&question.robot) else {
                open.push(question);
                continue;
            };
            let heard = controller.answer(&question);
            let told = put_in(&mut self.simulation.world, Exchange::new(&question, heard));
            observer.see(&Event::Exchange(Arc::new(told)));
        }
        self.progress.open = Some(open.iter().map(|asked| Exchange::new(asked, Response::Absent)).collect());
        open
    }

    /// Lets a controller decide for a robot or gantry whose strategy is `External`.
    ///
    /// # Errors
    /// If the scenario has no such robot, or its strategy is another.
    pub fn control(&mut self, robot: &str, controller: impl Controller + 'static) -> Result<(), NotControlled> {
        let outside = self.controlled();
        if !outside.iter().any(|name| name == robot) {
            return Err(NotControlled { robot: robot.to_string(), outside });
        }
        self.controllers.insert(robot.to_string(), Box::new(controller));
        Ok(())
    }

    /// Ids of the robots and gantries whose strategy is `External`, in the order of the scenario.
    pub fn controlled(&self) -> Vec<String> {
        controlled(&self.scenario)
    }

    /// The true state of a robot whose strategy is `External`: for rewards and scores, never for its searcher.
    pub fn truth(&self, robot: &str) -> Option<Truth> {
        truth_of(&self.simulation.world, robot)
    }

    /// Whether questions of this tick are open.
    pub(crate) fn waits(&self) -> bool {
        self.progress.open.as_ref().is_some_and(|open| !open.is_empty())
    }

    /// Answers an open question of a robot. `observer` gets what came of it, which is returned, too: an answer that the
    /// robot cannot carry out counts as nonsense. `None` if it has no open question.
    pub fn answer(&mut self, robot: &str, heard: Response, observer: &mut dyn Observer) -> Option<Exchange> {
        let open = self.progress.open.as_mut()?;
        let n = open.iter().position(|q| q.robot == robot)?;
        let answered = Exchange { response: heard, ..open.remove(n) };
        let told = put_in(&mut self.simulation.world, answered);
        observer.see(&Event::Exchange(Arc::new(told.clone())));
        Some(told)
    }
}
