//! Environments that share an ocean, each with its run in a place of its own.

use super::Rules;
use super::searcher_state::SearcherState;
use rheotaxis::control::{Question, Response};
use rheotaxis::lanes::{Shared, Standing};
use rheotaxis::ocean::SpunUp;
use rheotaxis::outcome::RunOutcome;
use rheotaxis::trial::Trial;
use std::sync::Arc;

/// How an environment stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum State {
    /// It has not been reset.
    Empty,
    /// Its episode goes on.
    Going,
    /// Its mission is over, or the goal is reached.
    Terminated,
    /// Its time is over.
    Truncated,
}

/// One environment.
pub(crate) struct Env {
    pub(crate) minds: Vec<SearcherState>,
    pub(crate) state: State,
    pub(crate) success: bool,
    /// Time of its episode, s.
    pub(crate) t_s: f64,
    /// How its run ended, if it did.
    pub(crate) outcome: Option<RunOutcome>,
    /// Digest of its run, if the mission is over.
    pub(crate) digest: Option<String>,
    began_s: f64,
}

/// Environments with one ocean.
pub(crate) struct Group {
    shared: Option<Shared>,
    pub(crate) envs: Vec<Env>,
    /// What the next job is to do.
    pub(crate) task: Task,
    /// What went wrong in the last one.
    pub(crate) fault: Option<String>,
}

/// What a group is to do next.
pub(crate) enum Task {
    Nothing,
    /// Begin episodes at places, with seeds of their searchers; in a new ocean, if there is one.
    Begin {
        ocean: Option<(u64, Arc<SpunUp>)>,
        places: Vec<(usize, u64)>,
    },
    /// Carry out actions at places: all numbers of all searchers.
    Act(Vec<(usize, Vec<f64>)>),
}

impl Group {
    /// A group of so many environments.
    pub(crate) fn new(rules: &Rules, places: usize) -> Self {
        let envs = (0..places).map(|_| Env::new(rules, 0.0)).collect();
        Self { shared: None, envs, task: Task::Nothing, fault: None }
    }

    /// Does what there is to do.
    pub(crate) fn work(&mut self, rules: &Rules) {
        let done = match std::mem::replace(&mut self.task, Task::Nothing) {
            Task::Nothing => Ok(()),
            Task::Begin { ocean, places } => self.begin(rules, ocean, places),
            Task::Act(actions) => self.act(rules, actions),
        };
        self.fault = done.err();
    }

    fn begin(
        &mut self,
        rules: &Rules,
        ocean: Option<(u64, Arc<SpunUp>)>,
        places: Vec<(usize, u64)>,
    ) -> Result<(), String> {
        if let Some((seed, kept)) = ocean {
            let made = Shared::among(&rules.worlds, seed, self.envs.len(), Some(&kept));
            self.shared = Some(made.map_err(|e| e.to_string())?);
            self.envs.iter_mut().for_each(|env| env.state = State::Empty);
        }
        let shared = self.shared.as_mut().ok_or("there is no ocean yet: reset first")?;
        for (place, seed) in places {
            let env = &mut self.envs[place];
            shared.leave(place);
            *env = Env::new(rules, shared.step() as f64 * rules.step_s);
            let asked = shared.begin(place, seed).map_err(|e| e.to_string())?;
            env.state = State::Going;
            for question in asked {
                env.ask(rules, question);
            }
            shared.look(place, |trial| env.look(rules, trial));
        }
        Ok(())
    }

    fn act(&mut self, rules: &Rules, actions: Vec<(usize, Vec<f64>)>) -> Result<(), String> {
        let shared = self.shared.as_mut().ok_or("there is no ocean yet: reset first")?;
        for (place, action) in &actions {
            let env = &mut self.envs[*place];
            let mut rest = action.as_slice();
            for (mind, agent) in env.minds.iter_mut().zip(&rules.agents) {
                let (own, others) = rest.split_at(rules.width(agent));
                rest = others;
                if !mind.asks {
                    continue;
                }
                let answer = Response::Answer(mind.answer(rules, agent, own));
                let told = shared.answer(*place, &agent.id, answer);
                if let Some(Response::Nonsense(why)) = told.map(|t| t.response) {
                    return Err(format!("{} cannot do that: {why}", agent.id));
                }
            }
        }
        let envs = &mut self.envs;
        shared.pass(|place, trial, questions| {
            let env = &mut envs[place];
            for question in questions {
                env.ask(rules, question);
            }
            env.look(rules, trial);
        });
        for (place, _) in &actions {
            self.envs[*place].judge(rules, shared, *place)?;
        }
        // If nobody asks, the ocean stands between two questions: whoever comes next comes with the next one.
        let step = shared.step();
        let idle = (0..self.envs.len()).all(|place| shared.standing(place) != Standing::Going);
        if idle && self.envs.len() > 1 {
            shared.wait_for(step.next_multiple_of(rules.steps));
        }
        Ok(())
    }
}

impl Env {
    /// One without an episode, from a time on.
    fn new(rules: &Rules, began_s: f64) -> Self {
        Self {
            minds: rules.agents.iter().map(SearcherState::new).collect(),
            state: State::Empty,
            success: false,
            t_s: 0.0,
            outcome: None,
            digest: None,
            began_s,
        }
    }

    fn ask(&mut self, rules: &Rules, question: Question) {
        self.t_s = question.t_s - self.began_s;
        let mut all = rules.agents.iter().zip(&mut self.minds);
        if let Some((agent, mind)) = all.find(|(agent, _)| agent.id == question.robot) {
            mind.see(rules, agent, question, self.began_s);
        }
    }

    /// Looks at the truth.
    fn look(&mut self, rules: &Rules, trial: &Trial) {
        for (mind, agent) in self.minds.iter_mut().zip(&rules.agents) {
            mind.look(agent, trial);
        }
    }

    /// Decides how the episode stands after a step.
    fn judge(&mut self, rules: &Rules, shared: &mut Shared, place: usize) -> Result<(), String> {
        if shared.standing(place) == Standing::Failed {
            let said = shared.failure(place).unwrap_or("of unknown cause").to_string();
            return Err(format!("the run broke off: {said}"));
        }
        let reached = |mind: &SearcherState| rules.goal_m.is_some_and(|m| mind.truth.closest_m <= m);
        if shared.standing(place) == Standing::Ended {
            let ended = shared.look(place, Trial::ended);
            self.outcome = ended.as_ref().map(|e| e.outcome);
            if let Some(ended) = ended {
                self.t_s = ended.t_s - self.began_s;
                self.digest = Some(ended.digest);
            }
            let good = [Some(RunOutcome::Found), Some(RunOutcome::Completed)];
            self.success = good.contains(&self.outcome);
            self.state = State::Terminated;
        } else if self.minds.iter().any(reached) {
            self.success = true;
            self.state = State::Terminated;
        } else if self.t_s >= rules.limit_s - 1e-9 {
            self.state = State::Truncated;
        }
        if self.state != State::Going {
            shared.leave(place);
        }
        Ok(())
    }
}
