//! How a run asks searchers outside this program, and takes their answers.

use super::{Event, Observer, RunPhase, Trial};
use crate::control::exchanges::{put_in, take_questions, truth_of};
use crate::control::{Controller, Exchange, Question, Response};
use crate::scenario::Scenario;
use robots::handoff::ExchangeTiming;
use std::sync::Arc;
use world::frames::Truth;

/// A robot that nobody outside this program can control.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no robot or gantry {robot:?} has the strategy External; {}", those(.outside))]
pub struct NotControlled {
    /// Its id.
    pub robot: String,
    /// Ids of those that can be controlled.
    pub outside: Vec<String>,
}

fn those(outside: &[String]) -> String {
    if outside.is_empty() { "none has".to_string() } else { format!("those that have: {}", outside.join(", ")) }
}

/// The robots and gantries of a scenario whose strategy is `External`, in its order, and how they ask.
pub fn consulted(scenario: &Scenario) -> Vec<(String, ExchangeTiming)> {
    let robots = scenario.robots.iter();
    let robots = robots.filter_map(|r| Some((r.id.as_str(), r.strategy.consulted()?)));
    let gantries = scenario.gantries.iter();
    let gantries = gantries.filter_map(|g| Some((g.id.as_str(), g.tracker.consulted()?)));
    let all = robots.chain(gantries);
    all.map(|(id, consulted)| (id.to_string(), consulted)).collect()
}

/// Their ids.
pub fn controlled(scenario: &Scenario) -> Vec<String> {
    consulted(scenario).into_iter().map(|(id, _)| id).collect()
}

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

    /// Runs to the next questions that no controller answers, with the spin-up before the first. The answers are given
    /// with [`Self::answer`]; then this, [`Self::step`] or [`Self::run`] goes on. Without questions the run is over.
    pub fn until_asked(&mut self, observer: &mut dyn Observer) -> Vec<Question> {
        if self.progress.phase == RunPhase::Assembled {
            self.run_spin_up(observer);
        }
        if self.progress.open.is_some() && !self.advance(observer) {
            return Vec::new();
        }
        while self.going() {
            let open = self.observe(observer);
            if !open.is_empty() {
                return open;
            }
            self.advance(observer);
        }
        Vec::new()
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
