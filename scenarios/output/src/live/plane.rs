//! The control plane of a run: pause, go on, step, speed, stop. It sets the pace of a run and never its result.
#![allow(
    clippy::disallowed_methods,
    reason = "pace is for people; it does not enter the run"
)]

use serde_json::{Value, json};
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
        "lets a held run go on for `s` seconds of simulated time, or one step without it",
    ),
    (
        "speed",
        "sets the pace: `times` simulated seconds in a second, or `max`",
    ),
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
    /// A held run goes on up to this time, s.
    until_s: Option<f64>,
    one_step: bool,
    /// Simulated seconds in a second; `None` as fast as the machine can.
    times: Option<f64>,
    stop: bool,
    /// Wall time and mission time from which the pace is counted.
    since: Option<(Instant, f64)>,
}

impl Plane {
    /// Of a run with a pace: simulated seconds in a second, or `None` for as fast as the machine can. If it is not
    /// `allowed`, others may only ask how the run stands.
    #[must_use]
    pub fn new(allowed: bool, times: Option<f64>) -> Self {
        Self {
            allowed,
            state: Mutex::new(State {
                times,
                ..State::default()
            }),
            changed: Condvar::new(),
        }
    }

    /// Whether others may do more than ask how the run stands.
    #[must_use]
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
        let stepped = std::mem::take(&mut state.one_step);
        if stepped || state.until_s.is_some_and(|until_s| t_s >= until_s - SAME_S) {
            (state.paused, state.until_s) = (true, None);
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

    /// The run has ended at a time of the mission, s.
    pub fn ended(&self) {
        self.lock().ended = true;
    }

    /// Does what a command asks for; the answer says how the run stands.
    ///
    /// # Errors
    /// Why not, in words.
    pub fn command(&self, name: &str, parameter: Option<&str>) -> Result<Value, String> {
        let mut state = self.lock();
        if name != "status" && !self.allowed {
            return Err(
                "this run was started without --allow-control: it only tells how it stands"
                    .to_string(),
            );
        }
        match name {
            "status" => {}
            "pause" => (state.paused, state.until_s) = (true, None),
            "resume" => (state.paused, state.until_s) = (false, None),
            "step" => {
                match parameter {
                    Some(text) => state.until_s = Some(state.t_s + positive("s", text)?),
                    None => state.one_step = true,
                }
                state.paused = false;
            }
            "speed" => {
                let text = parameter.ok_or("give `times`: a number, or max")?;
                state.times = match text {
                    "max" => None,
                    text => Some(positive("times", text)?),
                };
                state.since = None;
            }
            "stop" => state.stop = true,
            _ => {
                let known: Vec<_> = COMMANDS.iter().map(|(name, _)| *name).collect();
                return Err(format!("no command {name:?}: {}", known.join(", ")));
            }
        }
        self.changed.notify_all();
        Ok(json!({
            "t_s": state.t_s, "steps": state.steps, "ended": state.ended, "paused": state.paused,
            "stopping": state.stop, "times": state.times, "controllable": self.allowed,
        }))
    }
}

impl State {
    /// How long a run is ahead of its pace; `None` if it is not.
    fn early(&mut self, t_s: f64) -> Option<Duration> {
        let times = self.times?;
        let now = Instant::now();
        let (since, from_s) = *self.since.get_or_insert((now, t_s));
        let due = Duration::try_from_secs_f64((t_s - from_s) / times).unwrap_or(Duration::MAX);
        due.checked_sub(now - since)
            .filter(|early| !early.is_zero())
    }
}

fn positive(name: &str, text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number),
        _ => Err(format!("`{name}` must be a number above 0, got {text:?}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;
    use std::sync::atomic::{AtomicU64, Ordering};

    #[test]
    fn only_a_run_that_allows_it_is_controlled() {
        let plane = Plane::new(false, None);
        assert_eq!(plane.command("status", None).unwrap()["paused"], false);
        let refused = plane.command("pause", None).unwrap_err();
        assert!(refused.contains("--allow-control"), "{refused}");
        assert!(plane.hold(0.1, || true));
        let plane = Plane::new(true, None);
        assert!(plane.command("fly", None).unwrap_err().contains("resume"));
        for wrong in ["0", "-1", "NaN", "inf", "fast"] {
            assert!(plane.command("speed", Some(wrong)).is_err(), "{wrong}");
        }
    }

    /// Runs steps of 1 s in a thread of its own; how far it is.
    fn runs(plane: &Arc<Plane>) -> (Arc<AtomicU64>, std::thread::JoinHandle<u64>) {
        let at = Arc::new(AtomicU64::new(0));
        let (plane, now) = (Arc::clone(plane), Arc::clone(&at));
        let run = std::thread::spawn(move || {
            let mut t_s = 0;
            loop {
                t_s += 1;
                now.store(t_s, Ordering::SeqCst);
                if !plane.hold(t_s as f64, || true) {
                    return t_s;
                }
            }
        });
        (at, run)
    }

    /// Waits until the run is held; its time.
    fn held(plane: &Plane, at: &AtomicU64) -> u64 {
        loop {
            let told = plane.command("status", None).unwrap();
            let now = at.load(Ordering::SeqCst);
            // At first it is paused before it has begun.
            if now > 0 && told["paused"] == true && told["t_s"].as_f64() == Some(now as f64) {
                return now;
            }
            std::thread::yield_now();
        }
    }

    #[test]
    fn a_held_run_steps_goes_on_and_stops() {
        let plane = Arc::new(Plane::new(true, None));
        plane.command("pause", None).unwrap();
        let (at, run) = runs(&plane);
        assert_eq!(held(&plane, &at), 1);
        plane.command("step", None).unwrap();
        assert_eq!(held(&plane, &at), 2);
        plane.command("step", Some("3")).unwrap();
        assert_eq!(held(&plane, &at), 5);
        plane.command("resume", None).unwrap();
        while at.load(Ordering::SeqCst) < 50 {
            std::thread::yield_now();
        }
        plane.command("stop", None).unwrap();
        assert!(run.join().unwrap() >= 50);
    }

    #[test]
    fn whoever_ends_the_run_ends_a_pause() {
        let plane = Plane::new(true, None);
        plane.command("pause", None).unwrap();
        assert!(!plane.hold(1.0, || false));
        plane.command("resume", None).unwrap();
        plane.command("speed", Some("1e-9")).unwrap();
        plane.hold(1.0, || false);
        assert!(!plane.hold(1000.0, || false), "far ahead of its pace");
    }
}
