//! The control plane of a run: pause, go on, step, speed, stop. It sets the pace of a run and never its result.
#![allow(clippy::disallowed_methods, reason = "pace is for people; it does not enter the run")]

use serde_json::{Value, json};
use std::collections::VecDeque;
use std::fmt;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Longest wait before a run looks again whether it should end.
const NAP: Duration = Duration::from_millis(50);
/// Time within which two times of the mission are the same, s.
const SAME_S: f64 = 1e-9;

/// Commands, each with its parameter and what it does.
pub(super) const COMMANDS: [(&str, &str); 6] = [
    ("status", "tells how the run stands"),
    ("pause", "holds the run after the present step"),
    ("resume", "lets it go on"),
    (
        "step",
        "lets the run go on for `s` seconds of simulated time, or one step without it, and holds it then; it answers \
         when that is done, and several are done one after the other",
    ),
    ("speed", "sets the pace: `times` simulated seconds in a second, or `max`"),
    ("stop", "ends the run; what was recorded stays"),
];

/// What others may ask of a run, and how it stands.
#[derive(Debug)]
pub struct Plane {
    allowed: bool,
    state: Mutex<State>,
    changed: Condvar,
}

#[derive(Debug, Default)]
struct State {
    t_s: f64,
    steps: u64,
    ended: bool,
    paused: bool,
    /// What `step` has asked for and is not done, the first one under way.
    asked: VecDeque<Step>,
    /// Simulated seconds in a second; `None` as fast as the machine can.
    times: Option<f64>,
    stop: bool,
    /// Wall time and mission time from which the pace is counted.
    since: Option<(Instant, f64)>,
}

/// A step that was asked for, and who waits for its end.
#[derive(Debug)]
struct Step {
    /// How long it is, s; `None` is one step of the run.
    s: Option<f64>,
    /// When it ends, once it has begun, s.
    until_s: Option<f64>,
    answer: PlaneReply,
}

/// What tells somebody how the run stands, or why a command was not obeyed.
type Tell = dyn FnOnce(Result<Value, String>) + Send;

struct PlaneReply(Box<Tell>);

impl fmt::Debug for PlaneReply {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Answer")
    }
}

impl Plane {
    /// Of a run with a pace: simulated seconds in a second, or `None` for as fast as the machine can. If it is not
    /// `allowed`, others may only ask how the run stands.
    pub fn new(allowed: bool, times: Option<f64>) -> Self {
        Self { allowed, state: Mutex::new(State { times, ..State::default() }), changed: Condvar::new() }
    }

    /// Whether others may do more than ask how the run stands.
    pub fn allowed(&self) -> bool {
        self.allowed
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// After each step, at a time of the mission, s: waits as long as pace and pauses ask for and `going` is true.
    /// `false` if the run is to end.
    pub fn hold(&self, t_s: f64, going: impl Fn() -> bool) -> bool {
        let mut state = self.lock();
        state.t_s = t_s;
        state.steps += 1;
        if let Some(answer) = state.step_done() {
            let told = self.state_json(&state);
            // Whoever hears it may command at once.
            drop(state);
            (answer.0)(Ok(told));
            state = self.lock();
        }
        loop {
            if state.stop || !going() {
                return false;
            }
            let nap = if state.paused {
                state.since = None;
                NAP
            } else {
                let Some(early) = state.early(t_s) else {
                    return true;
                };
                early.min(NAP)
            };
            let waited = self.changed.wait_timeout(state, nap);
            state = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
    }

    /// The run has ended at a time of the mission, s. Whoever waits for a step is told so.
    pub fn ended(&self) {
        let mut state = self.lock();
        state.ended = true;
        let told = self.state_json(&state);
        let waiting = std::mem::take(&mut state.asked);
        drop(state);
        for step in waiting {
            (step.answer.0)(Ok(told.clone()));
        }
    }

    /// Does what a command asks for. `answer` is told how the run then stands, or why not, in words: of `step` once it
    /// is done, from the thread of the run; of the others at once.
    pub fn command(
        &self,
        name: &str,
        parameter: Option<&str>,
        answer: impl FnOnce(Result<Value, String>) + Send + 'static,
    ) {
        let mut state = self.lock();
        if name == "step" && self.allowed && !state.ended {
            match parameter.map(|text| positive("s", text)).transpose() {
                Ok(s) => {
                    state.ask(s, PlaneReply(Box::new(answer)));
                    self.changed.notify_all();
                }
                Err(why) => {
                    drop(state);
                    answer(Err(why));
                }
            }
            return;
        }
        let given_up = match name {
            "pause" | "resume" if self.allowed => std::mem::take(&mut state.asked),
            _ => VecDeque::new(),
        };
        let told = self.obeyed(&mut state, name, parameter);
        let t_s = state.t_s;
        let stops = name == "stop" && told.is_ok();
        drop(state);
        self.changed.notify_all();
        for step in given_up {
            let why = format!("`{name}` came before the step was done: the run is at {t_s} s");
            (step.answer.0)(Err(why));
        }
        answer(told);
        // Only then, so that the run does not end before it has answered.
        if stops {
            self.lock().stop = true;
            self.changed.notify_all();
        }
    }

    fn obeyed(&self, state: &mut State, name: &str, parameter: Option<&str>) -> Result<Value, String> {
        if name != "status" && !self.allowed {
            return Err("this run was started without --allow-control: it only tells how it stands".to_string());
        }
        match name {
            // A run that has ended makes no step.
            "status" | "step" => {}
            "pause" => state.paused = true,
            "resume" => state.paused = false,
            "speed" => {
                let text = parameter.ok_or("give `times`: a number, or max")?;
                state.times = match text {
                    "max" => None,
                    text => Some(positive("times", text)?),
                };
                state.since = None;
            }
            "stop" => {
                let mut told = self.state_json(state);
                told["stopping"] = true.into();
                return Ok(told);
            }
            _ => {
                let known: Vec<_> = COMMANDS.iter().map(|(name, _)| *name).collect();
                return Err(format!("no command {name:?}: {}", known.join(", ")));
            }
        }
        Ok(self.state_json(state))
    }

    fn state_json(&self, state: &State) -> Value {
        json!({
            "t_s": state.t_s, "steps": state.steps, "ended": state.ended, "paused": state.paused,
            "stopping": state.stop, "times": state.times, "controllable": self.allowed,
        })
    }
}

impl State {
    /// Asks for a step, which begins when those before it are done.
    fn ask(&mut self, s: Option<f64>, answer: PlaneReply) {
        self.asked.push_back(Step { s, until_s: None, answer });
        if self.asked.len() == 1 {
            self.begin();
        }
    }

    /// Begins the next step; without one, holds the run.
    fn begin(&mut self) {
        self.paused = self.asked.is_empty();
        if let Some(step) = self.asked.front_mut() {
            step.until_s = step.s.map(|s| self.t_s + s);
        }
    }

    /// Who waits for the step that is done now, if one is.
    fn step_done(&mut self) -> Option<PlaneReply> {
        let step = self.asked.front()?;
        if step.until_s.is_some_and(|until_s| self.t_s < until_s - SAME_S) {
            return None;
        }
        let done = self.asked.pop_front()?;
        self.begin();
        Some(done.answer)
    }

    /// How long a run is ahead of its pace; `None` if it is not.
    fn early(&mut self, t_s: f64) -> Option<Duration> {
        let times = self.times?;
        let now = Instant::now();
        let (since, from_s) = *self.since.get_or_insert((now, t_s));
        let due = Duration::try_from_secs_f64((t_s - from_s) / times).unwrap_or(Duration::MAX);
        due.checked_sub(now - since).filter(|early| !early.is_zero())
    }
}

fn positive(name: &str, text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number),
        _ => Err(format!("`{name}` must be a number above 0, got {text:?}")),
    }
}

#[cfg(test)]
#[path = "plane_tests.rs"]
mod tests;
