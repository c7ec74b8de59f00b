//! Gathers a summary from the frames of a run.

use super::sources::{DeclarationSummary, DeclaredKind, Position, SourceTruth};
use super::summary::{
    AbnormalSummary, EnergySummary, RegionSummary, RobotSummary, RunSummary, SourceSummary, Summary, Totals, Versions,
};
use super::{GantryPath, MapEnd, MapStated, RunInfo};
use nalgebra::Vector2;
use rheotaxis::frame::{Frame, RobotFrame};
use rheotaxis::outcome::RunOutcome;
use rheotaxis::score::{Score, SearcherScore};
use rheotaxis::trial::Trial;
use robots::handoff::{Behaviour, Belief, BeliefGrid, Region, RegionState, Regions, region_name};
use serde_json::Value;
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use world::units::Heading;

/// What is known only when a run is over.
#[derive(Clone, Debug, PartialEq)]
pub struct SummaryEnd {
    /// How it ended.
    pub outcome: RunOutcome,
    /// The error that ended it.
    pub error: Option<String>,
    /// Digest of states, declarations and outcome.
    pub digest: String,
    /// The score: what each searcher did, and what went wrong.
    pub score: Score,
    /// Times and counts.
    pub totals: Totals,
}

/// How long fixes are remembered, s: those that may have spoilt a declaration.
const FIX_S: f64 = 60.0;

#[derive(Debug)]
struct Robot {
    id: String,
    last_t_s: f64,
    behaviour: Behaviour,
    /// What was known when a declaration was made, by its number: the straight distance from the first detection in
    /// the area or subregion, and the largest shift by a fix in the minute before, m.
    made: BTreeMap<u32, [Option<f64>; 2]>,
    regions: Regions,
    /// First detection in the present subregion, or in the last one.
    in_region: Option<Vector2<f64>>,
    /// Fixes of the last minute: the time, and how far each moved the estimate, m.
    fixes: VecDeque<(f64, f64)>,
    /// Newest numbers of instruments of other crates.
    numbers: BTreeMap<&'static str, f64>,
    behaviour_s: Vec<(Behaviour, f64)>,
    /// The most probable cell of its map and since when, with the map's cells.
    best: Option<(f64, usize, Arc<BeliefGrid>)>,
    /// The last map, and the one at the first declaration.
    map: Option<Belief>,
    map_declared: Option<Belief>,
}

impl Robot {
    fn new(t_s: f64, r: &RobotFrame) -> Self {
        Self {
            id: r.id.clone(),
            last_t_s: t_s,
            behaviour: r.behaviour,
            made: BTreeMap::new(),
            regions: Regions::default(),
            in_region: None,
            fixes: VecDeque::new(),
            numbers: BTreeMap::new(),
            behaviour_s: Vec::new(),
            best: None,
            map: None,
            map_declared: None,
        }
    }

    fn observe(&mut self, t_s: f64, r: &RobotFrame) {
        let spent = t_s - self.last_t_s;
        match self.behaviour_s.iter_mut().find(|(b, _)| *b == self.behaviour) {
            Some((_, s)) => *s += spent,
            None => self.behaviour_s.push((self.behaviour, spent)),
        }
        self.last_t_s = t_s;
        self.behaviour = r.behaviour;
        self.declared(t_s, r);
        if let Some(b) = r.belief.as_ref().filter(|b| b.informed)
            && self.best.as_ref().is_none_or(|(_, cell, _)| *cell != b.best)
        {
            self.best = Some((b.t_s, b.best, b.grid.clone()));
        }
        if let Some(b) = &r.belief {
            // A copy is cheap: it only counts two references, because the cells are shared.
            self.map = Some(b.clone());
        }
        if !r.declarations.is_empty() && self.map_declared.is_none() {
            self.map_declared = self.map.clone();
        }
    }

    /// Notes what is known about a declaration only at the time when it is made.
    fn declared(&mut self, t_s: f64, r: &RobotFrame) {
        self.numbers.extend(r.readings.other.iter().map(|(name, reading)| (*name, reading.value)));
        self.fixes.extend(r.fix_m.map(|m| (t_s, m)));
        self.fixes.retain(|(then, _)| t_s - then <= FIX_S);
        if r.shown.regions.now.is_some() && r.shown.regions.now != self.regions.now {
            self.in_region = None;
        }
        if r.detected && (r.shown.regions.all.is_empty() || r.shown.regions.now.is_some()) {
            self.in_region.get_or_insert(r.truth.pose.p_WB.xy());
        }
        self.regions = r.shown.regions.clone();
        for d in &r.declarations {
            self.made.entry(d.number).or_insert_with(|| {
                let traced_m = self.in_region.map(|from| (d.position - from).norm());
                let fix_m = self.fixes.iter().map(|f| f.1).max_by(f64::total_cmp);
                [traced_m, fix_m]
            });
        }
    }

    fn summary(&self, score: &SearcherScore, sources: &[SourceTruth]) -> RobotSummary {
        let mut declarations: Vec<DeclarationSummary> = (score.declarations.iter())
            .map(|d| {
                let [traced_m, fix_m] = self.made.get(&d.number).copied().unwrap_or_default();
                DeclarationSummary { traced_m, fix_m, ..DeclarationSummary::compare(d, sources) }
            })
            .collect();
        let found = (declarations.iter_mut()).filter(|d| d.kind == DeclaredKind::Source);
        let sources_declared = found.enumerate().map(|(k, d)| d.name = format!("source {}", k + 1)).count();
        let timed_out = |r: &&Region| r.state == RegionState::TimedOut;
        RobotSummary {
            id: self.id.clone(),
            up_flow_edges: declarations.len() - sources_declared,
            sources_declared,
            declarations,
            regions_timed_out: self.regions.all.iter().filter(timed_out).count(),
            map: (self.map.as_ref()).map(|last| MapEnd::from_belief(last, &score.declarations, sources)),
            map_stated: match (&self.map_declared, &self.map) {
                (Some(map), _) => Some(MapStated::from_belief(map, true, sources)),
                (None, map) => (map.as_ref()).map(|last| MapStated::from_belief(last, false, sources)),
            },
            regions: (self.regions.all.iter().zip(0..))
                .map(|(region, k)| RegionSummary {
                    name: region_name(k),
                    centre: region.area.centre.into(),
                    state: region.state,
                    from_s: region.from_s,
                    until_s: region.until_s,
                })
                .collect(),
            first_detection_s: score.first_detection_s,
            first_detection: score.first_detection.map(Position::from),
            detections: score.detections,
            traced_m: score.traced_m(),
            correct_cell_s: (self.best.as_ref())
                .filter(|(_, best, grid)| sources.iter().any(|s| grid.cell(&s.position) == Some(*best)))
                .map(|(since_s, ..)| *since_s),
            travelled_m: score.travelled_m,
            final_position_error_m: score.final_position_error_m,
            greatest_position_error_m: score.greatest_position_error_m,
            energy: score.energy.map(|e| EnergySummary {
                battery_wh: e.battery_wh,
                drives_wh: e.drives_wh,
                hotel_wh: e.hotel_wh,
                endurance_s: Some(e.endurance_s()).filter(|s| s.is_finite()),
                emptied_s: e.emptied_s,
            }),
            consulted: score.consulted,
            saturated: score.saturation.map(|s| s.share()),
            last_numbers: self.numbers.clone(),
            last_behaviour: self.behaviour.name().to_owned(),
            behaviour_s: self
                .behaviour_s
                .iter()
                .filter(|(_, s)| *s > 0.0)
                .map(|(b, s)| (b.name().to_owned(), *s))
                .collect(),
        }
    }
}

/// Gathers the data of a [`Summary`]; it needs every frame, in order.
#[derive(Debug)]
pub struct SummaryBuilder {
    run: RunInfo,
    robots: Vec<Robot>,
    gantries: Vec<GantryPath>,
    apparatus: BTreeMap<String, Value>,
    published: BTreeMap<String, Value>,
}

impl SummaryBuilder {
    /// Begins the summary of a run.
    pub fn new(run: &RunInfo) -> Self {
        Self {
            run: run.clone(),
            robots: Vec::new(),
            gantries: Vec::new(),
            apparatus: BTreeMap::new(),
            published: BTreeMap::new(),
        }
    }

    /// What other crates add to the summary at the end: the parts of their machines and the last values of their topics.
    pub fn added(&mut self, trial: &Trial) {
        self.apparatus = trial.apparatus();
        let last = trial.published().map(|p| (p.key.clone(), p.value.clone()));
        self.published = last.collect();
    }

    /// Adds a frame.
    pub fn observe(&mut self, frame: &Frame) {
        if self.robots.is_empty() {
            let new = |r| Robot::new(frame.t_s, r);
            self.robots = frame.robots.iter().map(new).collect();
        }
        for (known, r) in self.robots.iter_mut().zip(&frame.robots) {
            debug_assert_eq!(known.id, r.id, "frames list the robots in one order");
            known.observe(frame.t_s, r);
        }
        if self.gantries.is_empty() {
            self.gantries = frame.gantries.iter().map(GantryPath::new).collect();
        }
        for (known, g) in self.gantries.iter_mut().zip(&frame.gantries) {
            known.observe(frame.t_s, g);
        }
    }

    /// The summary of the run, compared with the true sources.
    pub fn finish(&self, end: &SummaryEnd, sources: &[SourceTruth]) -> Summary {
        let t = end.totals;
        let score = |id: &str| {
            let found = end.score.searchers.iter().find(|s| s.id == id);
            found.unwrap_or_else(|| panic!("{id} is in a frame and has no score: let it join"))
        };
        let ratio = |wall: f64| (wall > 0.0).then(|| t.mission_s / wall);
        Summary {
            scenario: self.run.scenario_name.clone(),
            title: self.run.title.clone(),
            success_rule: self.run.success.clone(),
            seed: self.run.seed.number(),
            key: self.run.seed.key().mark(),
            versions: Versions::with_version(&self.run.version),
            digest: end.digest.clone(),
            outcome: end.outcome,
            error: end.error.clone(),
            sources: sources
                .iter()
                .map(|s| SourceSummary {
                    id: s.id.clone(),
                    position: s.position.xy().into(),
                    depth_m: -s.position.z,
                    flow_heading_deg: s.direction().map(|u| Heading::from_vector(u).deg()),
                })
                .collect(),
            robots: self.robots.iter().map(|r| r.summary(score(&r.id), sources)).collect(),
            gantries: self.gantries.iter().map(|g| g.summary(score(g.id()), sources)).collect(),
            apparatus: self.apparatus.clone(),
            published: self.published.clone(),
            abnormal: (end.score.abnormal.iter()).map(AbnormalSummary::from).collect(),
            run: RunSummary {
                totals: t,
                real_time_factor: ratio(t.mission_wall_s),
                real_time_factor_with_spin_up: ratio(t.mission_wall_s + t.spin_up_wall_s),
            },
        }
    }
}
