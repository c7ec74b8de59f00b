//! Makes a run: tick by tick, to a time, to the next question, or to its end.

use super::observer::{Observer, Unwatched};
use super::progress::RunPhase;
use super::run::{RunEnd, Trial};
use crate::control::Question;

impl Trial {
    /// Makes the run to its end: the spin-up, unless it is done or taken over, and the rest of the mission.
    pub fn run(&mut self, observer: &mut dyn Observer) -> RunEnd {
        while self.advance(observer) {}
        self.ended()
    }

    /// One tick of the mission, with the spin-up before the first one; `false` once the run is over.
    pub fn step(&mut self) -> bool {
        self.advance(&mut Unwatched)
    }

    /// Ticks until a time of the mission, s; `false` if the run was over before.
    pub fn until(&mut self, t_s: f64) -> bool {
        while self.simulation.t_s() < t_s - 1e-9 {
            if !self.step() {
                return false;
            }
        }
        true
    }

    /// One tick with an observer; `false` once the run is over or `observer` stopped it.
    fn advance(&mut self, observer: &mut dyn Observer) -> bool {
        if self.progress.phase == RunPhase::Assembled {
            self.run_spin_up(observer);
        }
        if !self.going() {
            return false;
        }
        self.search(observer);
        self.simulation.drift();
        self.simulation.report();
        self.close_tick(observer)
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

    /// Makes the run to its end without an observer.
    pub fn finish_quietly(mut self) -> RunEnd {
        self.run(&mut Unwatched)
    }
}
