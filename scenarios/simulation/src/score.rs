//! What a run is judged by, kept up to date in every step: how near each searcher came to a source, how far it
//! travelled, what it detected and declared, how it ended, and what went wrong on the way.
//!
//! Frames, summaries, rows of campaigns and live state read it. It depends on no frame, so it does not change with how
//! often the run is recorded. It holds the truth: no searcher may read it.

use crate::incidents::Incident;
use bevy_ecs::prelude::Resource;
use nalgebra::{Vector2, Vector3};
use robots::handoff::{Declaration, Outcome};
use robots::vehicles::Battery;

/// The score of all searchers.
#[derive(Resource, Clone, Debug, Default, PartialEq)]
pub struct Score {
    /// Where the sources are (ENU), m.
    sources: Vec<Vector3<f64>>,
    /// Robots, then gantries, then others, each in the scenario's order.
    pub searchers: Vec<SearcherScore>,
    /// All abnormal events so far, by their beginning, in the order in which they were noticed.
    pub abnormal: Vec<Incident>,
    /// Whether a mission ended since somebody last asked.
    ended: bool,
}

/// What a searcher has taken from its battery.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Energy {
    /// Energy of the full battery, Wh.
    pub battery_wh: f64,
    /// Used by the drives, Wh.
    pub drives_wh: f64,
    /// Used by everything else, Wh.
    pub hotel_wh: f64,
    /// Time for which it was counted, s.
    pub counted_s: f64,
    /// When the battery was empty, s.
    pub emptied_s: Option<f64>,
}

impl Energy {
    /// How long a full battery lasts at the mean power so far, s; infinite at none.
    pub fn endurance_s(&self) -> f64 {
        match self.emptied_s {
            Some(t_s) => t_s,
            None => self.battery_wh * self.counted_s / (self.drives_wh + self.hotel_wh),
        }
    }
}

/// How often a machine asked a searcher outside this program, by what came back.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
pub struct Consultations {
    /// Questions.
    pub asked: u64,
    /// Answers.
    pub answered: u64,
    /// Too late.
    pub late: u64,
    /// Nobody there.
    pub absent: u64,
    /// Gone while it was asked.
    pub gone: u64,
    /// No answers, or such as cannot be carried out.
    pub nonsense: u64,
}

/// How long a searcher's thrusters were at their limits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Saturation {
    /// Time with a thruster at its limit, s.
    pub saturated_s: f64,
    /// Time for which it was counted, s.
    pub counted_s: f64,
}

impl Saturation {
    /// Share of the time.
    pub fn share(&self) -> f64 {
        self.saturated_s / self.counted_s
    }
}

/// The score of one searcher.
#[derive(Clone, Debug, PartialEq)]
pub struct SearcherScore {
    /// Its id in the scenario.
    pub id: String,
    /// How its mission ended; `None` while it lasts.
    pub outcome: Option<Outcome>,
    /// Least horizontal distance between the robot and a source so far, m; infinite for a gantry, and without sources.
    pub closest_m: f64,
    /// Its declarations so far, by number.
    pub declarations: Vec<Declaration>,
    /// Length of its true path so far, m; of a gantry that of its head.
    pub travelled_m: f64,
    /// Readings with a detection so far; of a gantry scans with a spike on any probe.
    pub detections: u64,
    /// Time of the first detection, s.
    pub first_detection_s: Option<f64>,
    /// True position (east, north) at that time, m.
    pub first_detection: Option<Vector2<f64>>,
    /// Distance between believed and true position now, m.
    pub final_position_error_m: f64,
    /// Greatest distance between believed and true position so far, m.
    pub greatest_position_error_m: f64,
    /// Its battery; `None` if energy is not counted.
    pub energy: Option<Energy>,
    /// How often it asked a searcher outside this program; `None` if it never did.
    pub consulted: Option<Consultations>,
    /// Its thrusters; `None` of a vehicle whose autopilot shares out no forces among thrusters.
    pub saturation: Option<Saturation>,
    /// Where it was last.
    last: Option<Vector3<f64>>,
}

impl SearcherScore {
    fn new(id: &str) -> Self {
        Self {
            id: id.to_string(),
            outcome: None,
            closest_m: f64::INFINITY,
            declarations: Vec::new(),
            travelled_m: 0.0,
            detections: 0,
            first_detection_s: None,
            first_detection: None,
            final_position_error_m: 0.0,
            greatest_position_error_m: 0.0,
            energy: None,
            consulted: None,
            saturation: None,
            last: None,
        }
    }

    /// Straight distance from the first detection to the first declaration, m: how far it traced the plume.
    pub fn traced_m(&self) -> Option<f64> {
        let first = self.declarations.first()?;
        Some((first.position - self.first_detection?).norm())
    }

    /// It has moved to a place (ENU, m). This counts for its path, not for how near it came to a source.
    pub fn moved(&mut self, p_W: &Vector3<f64>) {
        if let Some(last) = self.last.replace(*p_W) {
            self.travelled_m += (p_W - last).norm();
        }
    }

    /// It has detected something at a time, s, and a true position (east, north), m.
    pub fn detected(&mut self, t_s: f64, position: Vector2<f64>) {
        self.detections += 1;
        self.first_detection_s.get_or_insert(t_s);
        self.first_detection.get_or_insert(position);
    }

    /// What it believes of its position is wrong by so much now, m.
    pub fn misplaced(&mut self, error_m: f64) {
        self.final_position_error_m = error_m;
        self.greatest_position_error_m = self.greatest_position_error_m.max(error_m);
    }

    /// Its battery stands like this at a time, s.
    pub fn powered(&mut self, t_s: f64, battery: &Battery) {
        let emptied_s = self.energy.and_then(|e| e.emptied_s);
        let [drives_wh, hotel_wh] = battery.used_wh();
        self.energy = Some(Energy {
            battery_wh: battery.full_wh(),
            drives_wh,
            hotel_wh,
            counted_s: t_s,
            emptied_s: emptied_s.or(battery.is_empty().then_some(t_s)),
        });
    }

    /// For a step of `dt_s` a thruster was at its limit, or none.
    pub fn allotted(&mut self, saturated: bool, dt_s: f64) {
        let sum = self.saturation.get_or_insert_default();
        sum.counted_s += dt_s;
        if saturated {
            sum.saturated_s += dt_s;
        }
    }

    /// It declares. A declaration of the same number takes the place of the earlier one.
    pub fn declared(&mut self, declaration: Declaration) {
        declaration.join(&mut self.declarations);
    }
}

impl Score {
    /// Without searchers.
    pub fn new(sources: Vec<Vector3<f64>>) -> Self {
        Self { sources, ..Self::default() }
    }

    /// Adds a searcher and returns its place in [`Score::searchers`]. The run lasts until the missions of all
    /// searchers have ended: an instrument that only measures does not join.
    pub fn join(&mut self, id: &str) -> usize {
        self.searchers.push(SearcherScore::new(id));
        self.searchers.len() - 1
    }

    /// Least horizontal distance between any robot and a source so far, m.
    pub fn closest_m(&self) -> f64 {
        let all = self.searchers.iter().map(|s| s.closest_m);
        all.fold(f64::INFINITY, f64::min)
    }

    /// Searcher `n` has moved to a place (ENU, m), which also counts for how near it came to a source.
    pub fn moved_to(&mut self, n: usize, p_W: &Vector3<f64>) {
        let away = (self.sources.iter()).map(|s| (s - p_W).xy().norm_squared());
        let nearest_m = away.fold(f64::INFINITY, f64::min).sqrt();
        let searcher = &mut self.searchers[n];
        searcher.closest_m = searcher.closest_m.min(nearest_m);
        searcher.moved(p_W);
    }

    /// The mission of searcher `n` has ended like this, or goes on.
    pub fn outcome(&mut self, n: usize, outcome: Option<Outcome>) {
        let known = &mut self.searchers[n].outcome;
        self.ended |= outcome.is_some() && known.is_none();
        *known = outcome;
    }

    /// Whether a mission ended since this was last asked.
    pub(crate) fn take_ended(&mut self) -> bool {
        std::mem::take(&mut self.ended)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_searcher_is_scored_by_its_path() {
        let mut score = Score::new(vec![Vector3::new(10.0, 0.0, -5.0)]);
        let (near, idle) = (score.join("near"), score.join("idle"));
        for x in [0.0, 3.0, 6.0, 3.0] {
            score.moved_to(near, &Vector3::new(x, 0.0, 0.0));
        }
        score.searchers[idle].moved(&Vector3::zeros());
        assert_eq!(score.closest_m(), 4.0);
        assert_eq!(score.searchers[near].travelled_m, 9.0);
        assert_eq!(score.searchers[idle].closest_m, f64::INFINITY);
        let one = &mut score.searchers[near];
        assert_eq!(one.saturation, None);
        for saturated in [true, false, false, true] {
            one.allotted(saturated, 0.5);
        }
        assert_eq!(one.saturation.map(|s| s.share()), Some(0.5));
        one.detected(1.0, Vector2::new(3.0, 0.0));
        one.detected(2.0, Vector2::new(6.0, 0.0));
        assert_eq!((one.detections, one.traced_m()), (2, None));
        one.declared(Declaration::first(3.0, Vector2::new(6.0, 4.0), "test"));
        assert_eq!(one.traced_m(), Some(5.0));
        assert_eq!(one.first_detection_s, Some(1.0));
    }

    #[test]
    fn the_end_of_a_mission_is_told_once() {
        let mut score = Score::default();
        let n = score.join("one");
        score.outcome(n, None);
        assert!(!score.take_ended());
        score.outcome(n, Some(Outcome::Completed));
        assert!(score.take_ended());
        score.outcome(n, Some(Outcome::Completed));
        assert!(!score.take_ended());
    }
}
