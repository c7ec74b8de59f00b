//! Motion command generator: numbers the commands, keeps them within the travel, and measures their progress.
//!
//! *Source*: Webster et al. 2012 (Bioinspir. Biomim. 7:036023), section 4, Fig. 7 (motion command generator).
//!
//! *Parameters*: travel and greatest speeds of the machine; `ANSWER_S`, 0.1 s, the time after a command before the
//! drives' "arrived" or "blocked" counts as an answer to it (two scans).
//!
//! *Deviations*: targets beyond the travel are cut off at its end; the paper does not say what its tracker did there.
//! A drive that gave up counts as arrived at its present place.

use crate::handoff::{Behaviour, Decision, GantryLayout, HeadGoal, JointReadings, Outcome};
use nalgebra::Vector2;

/// Time before the drives answer to a new command, s.
const ANSWER_S: f64 = 0.1;

/// Progress of the present command.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Time since the head came to rest, s; `None` while it moves.
    pub rest_s: Option<f64>,
    /// Time of motion left at the commanded speed, s.
    pub to_go_s: f64,
    /// A drive gave up.
    pub blocked: bool,
    /// Start of the next command (forward, left), m: the last target; before the first command or after a block, the
    /// head's place.
    pub here_m: Vector2<f64>,
}

/// The unit.
#[derive(Clone, Debug, Default)]
pub struct MotionCommand {
    travel_m: [[f64; 2]; 2],
    max_speed_m_s: Vector2<f64>,
    behaviour: Behaviour,
    goal: HeadGoal,
    since_s: f64,
    rest_since_s: Option<f64>,
    blocked: bool,
}

impl MotionCommand {
    /// Before the first command.
    pub fn new(layout: &GantryLayout) -> Self {
        let max_speed_m_s = Vector2::from(layout.max_speed_m_s);
        let goal = HeadGoal { speed_m_s: max_speed_m_s, ..HeadGoal::default() };
        Self { travel_m: layout.travel_m, max_speed_m_s, goal, ..Self::default() }
    }

    /// The nearest place within the travel.
    pub fn within(&self, p: Vector2<f64>) -> Vector2<f64> {
        let [x, y] = self.travel_m;
        Vector2::new(p.x.clamp(x[0], x[1]), p.y.clamp(y[0], y[1]))
    }

    /// A new command.
    pub fn go(&mut self, t_s: f64, behaviour: Behaviour, target_m: Vector2<f64>, speed_m_s: Vector2<f64>) {
        assert!(
            target_m.x.is_finite() && target_m.y.is_finite(),
            "the decision unit asks for {target_m:?}, which is not a place"
        );
        self.behaviour = behaviour;
        self.goal = HeadGoal {
            id: self.goal.id + 1,
            target_m: self.within(target_m),
            speed_m_s: speed_m_s.inf(&self.max_speed_m_s),
        };
        self.since_s = t_s;
        self.rest_since_s = None;
        self.blocked = false;
    }

    /// Progress of the present command.
    pub fn progress(&mut self, t_s: f64, joints: &JointReadings) -> Progress {
        if t_s - self.since_s >= ANSWER_S - 1e-9 {
            self.blocked |= joints.blocked;
            if joints.arrived || self.blocked {
                self.rest_since_s.get_or_insert(t_s);
            }
        }
        let HeadGoal { id, target_m, speed_m_s } = self.goal;
        let to_go = (target_m - joints.position_m).abs().component_div(&speed_m_s);
        Progress {
            rest_s: self.rest_since_s.map(|since| t_s - since),
            to_go_s: to_go.x.max(to_go.y),
            blocked: self.blocked,
            here_m: if self.blocked || id == 0 { joints.position_m } else { target_m },
        }
    }

    /// The present command as a decision; before the first one it holds the head in place. `stopped` says whether a
    /// search that has ended has found a source.
    pub fn decision(&self, joints: &JointReadings, stopped: Option<bool>) -> Decision<HeadGoal> {
        let mut goal = self.goal;
        if goal.id == 0 {
            goal.target_m = self.within(joints.position_m);
        }
        Decision { outcome: stopped.map(Outcome::of_search), ..Decision::new(self.behaviour, goal) }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::layout;
    use super::*;

    #[test]
    fn targets_and_speeds_stay_within_the_machine() {
        let mut m = MotionCommand::new(&layout());
        let at = JointReadings { position_m: Vector2::new(0.3, 0.1), ..Default::default() };
        let idle = m.decision(&at, None).goal;
        assert_eq!((idle.id, idle.target_m), (0, at.position_m));
        m.go(0.0, Behaviour::StepUp, Vector2::new(9.0, -9.0), Vector2::new(9.0, 0.01));
        let d = m.decision(&at, None);
        assert_eq!((d.goal.id, d.behaviour), (1, Behaviour::StepUp));
        assert_eq!(d.goal.target_m, Vector2::new(2.0, -0.5));
        assert_eq!(d.goal.speed_m_s, Vector2::new(0.15, 0.01));
    }

    #[test]
    fn an_old_answer_is_no_answer_and_a_block_ends_the_way() {
        let mut m = MotionCommand::new(&layout());
        m.go(1.0, Behaviour::StepUp, Vector2::new(0.1, 0.0), Vector2::new(0.05, 0.03));
        let mut joints = JointReadings { arrived: true, ..Default::default() };
        let p = m.progress(1.05, &joints);
        assert_eq!((p.rest_s, p.to_go_s), (None, 2.0));
        joints.arrived = false;
        assert_eq!(m.progress(1.2, &joints).rest_s, None);
        joints.position_m.x = 0.04;
        joints.blocked = true;
        assert_eq!(m.progress(1.5, &joints).rest_s, Some(0.0));
        joints.blocked = false;
        let p = m.progress(2.0, &joints);
        assert!(p.blocked && p.rest_s.is_some_and(|r| (r - 0.5).abs() < 1e-12));
        assert_eq!(p.here_m.x, 0.04);
    }
}
