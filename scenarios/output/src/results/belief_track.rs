//! `belief-<robot>.csv`: how a map of where the source may be converged. Also the maps kept for the figures.

use super::SourceTruth;
use super::thinning::Thinning;
use crate::columns::{ColumnInfo, columns, header};
use nalgebra::Vector3;
use rheotaxis::frame::{Frame, PlumeFrame, RobotFrame};
use robots::handoff::{Belief, Odour};
use std::fmt::Write as _;
use std::sync::Arc;

/// Most rows kept for a robot; beyond that, every other row is dropped.
const ROWS: usize = 40_000;
/// Most numbers kept in a robot's maps between the first and the last.
const NUMBERS: usize = 2_000_000;
/// Most maps kept between first and last.
const MAPS: usize = 64;

/// One update of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeliefRow {
    /// Time, s.
    pub t_s: f64,
    /// Updates so far.
    pub updates: u64,
    /// Whether it includes a detection.
    pub informed: bool,
    /// Entropy, nat.
    pub entropy_nat: f64,
    /// Centre of the most probable cell (ENU), m.
    pub best: Vector3<f64>,
    /// Its probability.
    pub p_best: f64,
    /// Size of the smallest set of cells that contains 95 % of the probability, m² (m³ in space).
    pub credible_95: f64,
}

/// A map with its plan, and the plume as it was last shown.
#[derive(Clone, Debug, PartialEq)]
pub struct BeliefSnapshot {
    /// The map.
    pub belief: Belief,
    /// The planned path (ENU), m.
    pub planned: Vec<Vector3<f64>>,
    /// The plume.
    pub plume: Option<Arc<PlumeFrame>>,
}

/// All that is kept of a robot's map.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotBelief {
    /// Id of the robot.
    pub id: String,
    /// Its updates; evenly thinned if the run is long.
    pub rows: Vec<BeliefRow>,
    /// The last map before the first detection.
    pub before: Option<BeliefSnapshot>,
    /// The first map with a detection in it.
    pub first: Option<BeliefSnapshot>,
    /// Maps in between, at even intervals.
    pub between: Vec<BeliefSnapshot>,
    /// What the map said about the odour, at even intervals.
    pub odour: Vec<Arc<Odour>>,
    /// The last map.
    pub last: BeliefSnapshot,
    thinning: [Thinning; 3],
}

/// The maps of all robots that keep one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BeliefTrack {
    /// One entry for each robot.
    pub robots: Vec<RobotBelief>,
    plume: Option<Arc<PlumeFrame>>,
}

impl BeliefTrack {
    /// Adds what is new in a frame.
    pub fn push(&mut self, frame: &Frame) {
        for r in &frame.robots {
            let Some(belief) = &r.belief else { continue };
            let snapshot = self.snapshot(r, belief);
            match self.robots.iter_mut().find(|k| k.id == r.id) {
                Some(known) => known.push(snapshot),
                None => self.robots.push(RobotBelief::new(&r.id, snapshot)),
            }
        }
    }

    /// Adds the newest snapshot of the plume.
    pub fn plume(&mut self, plume: &PlumeFrame) {
        self.plume = Some(Arc::new(plume.clone()));
    }

    fn snapshot(&self, r: &RobotFrame, belief: &Belief) -> BeliefSnapshot {
        BeliefSnapshot { belief: belief.clone(), planned: r.shown.planned.clone(), plume: self.plume.clone() }
    }
}

impl RobotBelief {
    fn new(id: &str, first: BeliefSnapshot) -> Self {
        Self {
            id: id.to_owned(),
            rows: vec![row(&first.belief)],
            before: None,
            first: first.belief.informed.then(|| first.clone()),
            between: Vec::new(),
            odour: first.belief.odour.iter().cloned().collect(),
            last: first,
            thinning: Default::default(),
        }
    }

    fn push(&mut self, new: BeliefSnapshot) {
        if new.belief.updates == self.last.belief.updates {
            // The plan may have changed although the map is the same.
            self.last = new;
            return;
        }
        let old = std::mem::replace(&mut self.last, new);
        if self.last.belief.informed && self.first.is_none() {
            self.before = Some(old.clone());
            self.first = Some(self.last.clone());
        }
        let row = row(&self.last.belief);
        let most = (NUMBERS / old.belief.p.len().max(1)).clamp(4, MAPS);
        if let Some(odour) = &self.last.belief.odour
            && old.belief.odour.as_ref().is_none_or(|o| o.t_s != odour.t_s)
        {
            self.thinning[2].push(&mut self.odour, MAPS, || odour.clone());
        }
        self.thinning[0].push(&mut self.rows, ROWS, || row);
        self.thinning[1].push(&mut self.between, most, || old);
    }

    /// When the most probable cell reached its final place and stayed there, s.
    pub fn settled_s(&self) -> Option<f64> {
        let end = self.rows.last()?;
        let same = self.rows.iter().rev().take_while(|r| r.best == end.best);
        same.last().filter(|r| r.informed).map(|r| r.t_s)
    }
}

fn row(b: &Belief) -> BeliefRow {
    BeliefRow {
        t_s: b.t_s,
        updates: b.updates,
        informed: b.informed,
        entropy_nat: b.entropy_nat,
        best: b.grid.centre(b.best),
        p_best: b.p[b.best],
        credible_95: b.credible_95,
    }
}

/// Horizontal distance to the nearest true source, m.
pub(crate) fn off(best: &Vector3<f64>, sources: &[SourceTruth]) -> Option<f64> {
    let away = sources.iter().map(|s| (s.position.xy() - best.xy()).norm());
    away.min_by(f64::total_cmp)
}

pub(crate) const COLUMNS: [ColumnInfo; 9] = columns! {
    "t_s", "s", "Time of the update since the start of the mission.";
    "updates", "", "Number of updates so far.";
    "informed", "", "Whether the map includes a detection: 1 or 0.";
    "entropy_nat", "nat", "Entropy of the map.";
    "best_east_m", "m", "Centre of the most probable cell, east.";
    "best_north_m", "m", "Centre of the most probable cell, north.";
    "best_up_m", "m", "Centre of the most probable cell, up; empty for a map of the plane.";
    "best_probability", "", "Probability of this cell.";
    "off_m", "m", "Horizontal distance from its centre to the nearest true source.";
};
/// The last column, of a map of the plane or of space.
pub(crate) const CREDIBLE: [ColumnInfo; 2] = columns! {
    "credible_95_m2", "m2", "Smallest set of cells with 95 % of the probability; for a map of the plane.";
    "credible_95_m3", "m3", "The same for a map of space, in its place.";
};

/// The table; its header gives the unit of the credible region's size.
pub(crate) fn csv(robot: &RobotBelief, sources: &[SourceTruth]) -> String {
    let plane = robot.last.belief.grid.n[2] == 1;
    let size = CREDIBLE[usize::from(!plane)];
    let mut text = format!("{},{}\n", header(&COLUMNS), size.name);
    for r in &robot.rows {
        // A map of the plane does not tell the height.
        let up = if plane { String::new() } else { format!("{:.3}", r.best.z) };
        let off = off(&r.best, sources).map_or_else(String::new, |m| format!("{m:.3}"));
        writeln!(
            text,
            "{:.3},{},{},{:.6},{:.3},{:.3},{up},{:.6e},{off},{:.4}",
            r.t_s,
            r.updates,
            u8::from(r.informed),
            r.entropy_nat,
            r.best.x,
            r.best.y,
            r.p_best,
            r.credible_95
        )
        .expect("writing to a String succeeds");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::{belief, frames, source};

    fn track(seconds: usize) -> BeliefTrack {
        let mut track = BeliefTrack::default();
        for f in &frames(seconds) {
            track.push(f);
        }
        track
    }

    #[test]
    fn the_maps_round_the_first_detection_and_the_last_are_kept() {
        let track = track(200);
        let robot = &track.robots[0];
        assert_eq!(csv(robot, &[source()]).lines().count(), 1 + robot.rows.len());
        assert_eq!(robot.rows.len(), 200);
        // The sample is informed after 20 s.
        assert_eq!(robot.before.as_ref().unwrap().belief.t_s, 20.0);
        assert_eq!(robot.first.as_ref().unwrap().belief.t_s, 21.0);
        assert_eq!(robot.last.belief.t_s, 199.0);
        assert!(robot.between.len() <= MAPS && robot.between.len() > MAPS / 4);
    }

    #[test]
    fn it_settles_when_the_best_cell_last_changed() {
        let at = |t: f64, best: usize| BeliefSnapshot {
            belief: Belief { t_s: t, updates: t as u64, informed: true, best, ..belief(50.0) },
            planned: Vec::new(),
            plume: None,
        };
        let mut robot = RobotBelief::new("auv0", at(1.0, 7));
        for (t, best) in [(2.0, 9), (3.0, 7), (4.0, 5), (5.0, 5), (6.0, 5)] {
            robot.push(at(t, best));
        }
        assert_eq!(robot.settled_s(), Some(4.0));
    }
}
