//! Search by a policy: looks for the plume until the first detection, then goes the ways that a policy chooses by the
//! robot's map, until a rule declares.
//!
//! *Source*: the loop of cognitive searchers, as in Vergassola et al. 2007 (Nature 445, 406): update the belief, weigh
//! the moves, make one. What is weighed is the policy's matter.
//!
//! *Parameters*: speed over ground `speed_m_s`, m/s, 1.5; length of a way, `way_m`, m, 48: the published moves of 1
//! to 2 m times 24 m, the turning circle of a REMUS; distance to keep from charted solids, `clearance_m`, m, 5 (ours):
//! the hull of `MapAndPlan` and the clearance of its planners; find, policy and declaration rule by name.
//!
//! *Deviations*: moves are arcs that a vehicle can turn (see `handoff/ways.rs`), not steps to four neighbours, and
//! the chance of a detection is that on the whole way. Ways that leave the area are left out, and those that come too
//! near to a charted solid at the vehicle's present depth; solids that the chart lacks are not noticed. Without a way
//! left, the vehicle goes towards the middle of the area, whatever lies between. A vehicle that passes over the source
//! does not notice it: the rule declares, from the map.

use super::about::About;
use super::setting::Setting;
use super::spec::{Strategy, StrategyParams};
use super::wishes::{VerticalSpec, Wishes};
use crate::behave::{Behave, FindSpec};
use crate::declare::{BeliefRule, BeliefRuleSpec};
use crate::error::{RobotError, require};
use crate::handoff::{
    Behaviour, Belief, Decision, Declaration, Goal, Manoeuvre, Observation, Outcome, Outlook, WAYS, WaysAhead,
};
use crate::memory::PlumeMemory;
use crate::places::{MARGIN_M, inside};
use crate::policy::{Policy, PolicySpec, Prospect, Way};
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::obstacles::Obstacles;
use world::ranges::{NonNegative, Positive};
use world::registry::Listed;
use world::seeds::Stream;

/// A place on a way is at most this far from the next one that is checked, m, unless solids are farther away.
const STRIDE_M: f64 = 0.5;
/// A way is left when it takes longer than this many times its length at the commanded speed.
const PATIENCE: f64 = 2.0;

/// Composition and parameters.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PolicySearchSpec {
    /// Speed over ground, m/s.
    #[default(Positive::new(1.5))]
    pub speed_m_s: Positive,
    /// Altitude or depth.
    #[default(VerticalSpec::Altitude(Positive::new(2.0)))]
    pub vertical: VerticalSpec,
    /// Search for the plume until the first detection.
    pub find: FindSpec,
    /// How the next way is chosen.
    pub policy: PolicySpec,
    /// Length of a way, m.
    #[default(Positive::new(48.0))]
    pub way_m: Positive,
    /// Ways that come nearer to a solid of the chart are left out, m.
    #[default(NonNegative::new(5.0))]
    pub clearance_m: NonNegative,
    /// The declaration rule.
    pub declare: BeliefRuleSpec,
}

impl Listed for PolicySearchSpec {
    const ENTRY: Entry = Entry {
        name: "PolicySearch",
        what: "zig-zag to the first detection, then the ways that a policy chooses by the map, until a rule declares",
        source: "Vergassola et al. 2007, Nature 445, 406",
    };
}

impl StrategyParams for PolicySearchSpec {
    fn build(&self, setting: &Setting) -> Result<Box<dyn Strategy>, RobotError> {
        Ok(Box::new(PolicySearch::new(self, setting)?))
    }

    fn about(&self) -> About {
        About { wishes: Wishes::mission(self.speed_m_s, self.vertical), ..About::default() }
    }
}

/// State of the strategy.
#[derive(Debug)]
pub struct PolicySearch {
    spec: PolicySearchSpec,
    chart: Obstacles,
    find: Box<dyn Behave>,
    policy: Box<dyn Policy>,
    rule: Box<dyn BeliefRule>,
    memory: PlumeMemory,
    now: Behaviour,
    goal: Goal,
    /// The ways about which the map is asked; and until when the present way may last, s.
    asked: Option<WaysAhead>,
    until_s: f64,
    questions: u32,
    outcome: Option<Outcome>,
}

impl PolicySearch {
    /// # Errors
    /// [`RobotError::Invalid`] if the robot keeps no map that looks ahead.
    pub fn new(spec: &PolicySearchSpec, setting: &Setting) -> Result<Self, RobotError> {
        require(
            setting.outlook,
            "strategy",
            "PolicySearch needs a source map that looks ahead, and the robot has none; use for example map: Pomdp()",
        )?;
        Ok(Self {
            chart: setting.chart.clone(),
            find: spec.find.build()?,
            policy: spec.policy.build(),
            rule: spec.declare.build(),
            memory: PlumeMemory::default(),
            now: Behaviour::Idle,
            goal: Goal::none_yet(spec.vertical.into(), spec.speed_m_s.get()),
            asked: None,
            until_s: 0.0,
            questions: 0,
            outcome: None,
            spec: spec.clone(),
        })
    }

    fn end(&mut self, outcome: Outcome) {
        (self.outcome, self.now, self.asked) = (Some(outcome), Behaviour::Done, None);
    }

    fn go(&mut self, manoeuvre: Manoeuvre) {
        self.goal = Goal { id: self.goal.id + 1, manoeuvre, ..self.goal };
    }

    fn search(&mut self, seen: &Observation, arrived: bool, rng: &mut Stream) {
        if self.now != Behaviour::Find {
            self.now = Behaviour::Find;
            self.find.enter(seen, &self.memory);
        }
        let stride = self.find.step(seen, arrived, &mut self.memory, rng);
        stride.turn(&mut self.goal, self.spec.vertical.into());
    }

    /// Asks the map about the ways from here.
    fn ask(&mut self, seen: &Observation) {
        self.questions += 1;
        self.asked = Some(WaysAhead {
            number: self.questions,
            from: seen.estimate.position,
            z_m: -seen.estimate.depth_m,
            heading: seen.estimate.attitude.heading,
            radius_m: seen.able.turning_radius_m,
            length_m: self.spec.way_m.get(),
        });
    }

    /// Whether a way keeps clear of charted solids. A vehicle that is already too near to one must not come nearer.
    fn clear(&self, ways: &WaysAhead, k: usize) -> bool {
        let to_solid_m = |p: Vector2<f64>| self.chart.distance(&p.push(ways.z_m));
        let least_m = self.spec.clearance_m.get().min(to_solid_m(ways.from));
        let mut gone_m = 0.0;
        while gone_m < ways.length_m {
            // No place within the spare distance is too near.
            let spare_m = to_solid_m(ways.place(k, gone_m / ways.length_m)) - least_m;
            if spare_m < 0.0 {
                return false;
            }
            gone_m += spare_m.max(STRIDE_M);
        }
        to_solid_m(ways.place(k, 1.0)) >= least_m
    }

    /// Goes the way that the policy chooses.
    fn choose(&mut self, seen: &Observation, belief: &Belief, outlook: &Outlook, rng: &mut Stream) {
        let ends = outlook.ways.ends();
        let within = |p: &Vector2<f64>| (inside(&seen.area, *p, MARGIN_M) - p).norm() < 1e-9;
        let free = |k: &usize| outlook.ways.points(*k).iter().all(within) && self.clear(&outlook.ways, *k);
        let free: Vec<usize> = (0..WAYS).filter(free).collect();
        let way = |k: &usize| Way::with_detection(ends[*k].0, &outlook.chances[*k]);
        let ways: Vec<Way> = free.iter().map(way).collect();
        let point = if ways.is_empty() {
            // It heads outward at the area's edge, or for a solid.
            inside(&seen.area, seen.area.centre, MARGIN_M)
        } else {
            let cells: Vec<_> = (0..belief.grid.len()).map(|cell| belief.grid.centre(cell).xy()).collect();
            let prospect = Prospect::new(&belief.p, &cells, self.spec.way_m.get(), &ways);
            ways[self.policy.choose(&prospect, rng)].end
        };
        self.go(Manoeuvre::GoToPoint { point, radius_m: None });
        self.until_s = seen.t_s + PATIENCE * self.spec.way_m.get() / self.spec.speed_m_s.get();
    }

    fn run(&mut self, seen: &Observation, arrived: bool, rng: &mut Stream) -> Option<Declaration> {
        let Some(belief) = seen.belief.as_ref().filter(|b| b.informed) else {
            self.search(seen, arrived, rng);
            return None;
        };
        if let Some(place) = self.rule.step(seen.t_s, belief) {
            self.end(Outcome::Completed);
            return Some(Declaration::first(seen.t_s, place.xy(), self.spec.declare.name()));
        }
        let first = self.now != Behaviour::FollowPath;
        self.now = Behaviour::FollowPath;
        match (self.asked, &belief.outlook) {
            (Some(ways), Some(outlook)) if outlook.ways == ways => {
                self.asked = None;
                self.choose(seen, belief, outlook, rng);
            }
            (None, _) if first || arrived || seen.t_s >= self.until_s => self.ask(seen),
            _ => {}
        }
        None
    }
}

impl Strategy for PolicySearch {
    fn step(&mut self, seen: &Observation, rng: &mut Stream) -> Decision {
        self.memory.take_flow(seen);
        let mut declared = None;
        if self.outcome.is_none() {
            let arrived = seen.guidance.done && seen.guidance.goal_id == self.goal.id;
            if seen.guidance.aborted {
                self.end(Outcome::Aborted);
            } else {
                declared = self.run(seen, arrived, rng);
            }
        }
        Decision { declared, ways: self.asked, outcome: self.outcome, ..Decision::new(self.now, self.goal) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handoff::testing::{area, block, seen, smelling, sure_of};
    use crate::handoff::{BeliefGrid, Capabilities};
    use crate::strategy::testing::{point_of, setting};
    use std::sync::Arc;

    fn searcher() -> Box<dyn Strategy> {
        PolicySearchSpec::default().build(&setting(8.0, true)).expect("legal")
    }

    /// The map's answer: whoever goes east meets dye, if the source is where the map thinks.
    fn answer(mut belief: Belief, ways: WaysAhead) -> Belief {
        let chances = (0..WAYS).map(|k| {
            let east = ways.ends()[k].0.x > ways.from.x + 1.0;
            Arc::new(vec![if east { 0.5 } else { 1e-6 }; belief.p.len()])
        });
        belief.outlook = Some(Arc::new(Outlook { ways, chances: chances.collect() }));
        belief
    }

    #[test]
    fn asks_goes_the_chosen_way_and_asks_again_on_arrival() {
        let (mut s, mut rng) = (searcher(), Stream::new(1, "auv0", "strategy"));
        let mut o = smelling(seen(0.0, Vector2::zeros(), 0.0, Some(Vector2::new(0.0, -0.2))), false);
        let first = s.step(&o, &mut rng);
        assert_eq!((first.behaviour, first.ways), (Behaviour::Find, None));
        let grid = BeliefGrid::over(&area(), 0.0, 8.0, [60, 40, 1]);
        let cell = grid.cell(&nalgebra::Vector3::new(100.0, 0.0, -3.0)).expect("inside");
        let belief = sure_of(grid, cell, 0.9);
        o.belief = Some(belief.clone());
        let asked = s.step(&o, &mut rng);
        let ways = asked.ways.expect("asks");
        assert_eq!((ways.from, ways.length_m), (Vector2::zeros(), 48.0));
        assert_eq!(s.step(&o, &mut rng).ways, Some(ways), "until it is answered");
        o.belief = Some(answer(belief, ways));
        let goes = s.step(&o, &mut rng);
        // The source is east: space-aware infotaxis goes there.
        assert_eq!((goes.ways, goes.behaviour), (None, Behaviour::FollowPath));
        let end = point_of(&goes);
        assert!(end.x > 20.0 && ways.ends().iter().any(|(p, _)| *p == end), "{end:?}");
        assert_eq!(s.step(&o, &mut rng).ways, None, "on its way");
        o.guidance.goal_id = goes.goal.id;
        o.guidance.done = true;
        assert_eq!(s.step(&o, &mut rng).ways.map(|w| w.number), Some(2));
    }

    #[test]
    fn no_way_leaves_the_area_and_the_rule_declares() {
        let (mut s, mut rng) = (searcher(), Stream::new(1, "auv0", "strategy"));
        // Ten metres from the east edge, heading there.
        let mut o = seen(0.0, Vector2::new(185.0, 0.0), 90.0, None);
        let grid = BeliefGrid::over(&area(), 0.0, 8.0, [60, 40, 1]);
        let belief = sure_of(grid, 7, 0.9);
        o.belief = Some(belief.clone());
        let ways = s.step(&o, &mut rng).ways.expect("asks");
        o.belief = Some(answer(belief, ways));
        assert!(point_of(&s.step(&o, &mut rng)).x <= 190.0);
        o.t_s = 40.0;
        let end = s.step(&o, &mut rng);
        assert_eq!(end.outcome, Some(Outcome::Completed));
        let place = end.declared.expect("the likeliest cell has not changed for 30 s").position;
        assert!((place - o.belief.expect("there").grid.centre(7).xy()).norm() < 1e-9);
        let e = PolicySearchSpec::default().build(&setting(8.0, false)).expect_err("no map").to_string();
        assert!(e.contains("needs a source map that looks ahead"), "{e}");
    }

    /// Where the vehicle goes from the origin, heading for a source in the east, by a chart.
    fn chosen(chart: &[([f64; 2], [f64; 3])], able: Capabilities) -> (WaysAhead, Vector2<f64>) {
        let mut mission = setting(20.0, true);
        let pile = |(at, size_m): &([f64; 2], [f64; 3])| block(&mission.bed, "pile", *at, *size_m);
        mission.chart = Obstacles(chart.iter().map(pile).collect());
        let mut s = PolicySearchSpec::default().build(&mission).expect("legal");
        let mut rng = Stream::new(1, "auv0", "strategy");
        let mut o = Observation { able, ..seen(0.0, Vector2::zeros(), 90.0, None) };
        let grid = BeliefGrid::over(&area(), 0.0, 8.0, [60, 40, 1]);
        let cell = grid.cell(&nalgebra::Vector3::new(100.0, 0.0, -3.0)).expect("inside");
        let belief = sure_of(grid, cell, 0.9);
        o.belief = Some(belief.clone());
        let ways = s.step(&o, &mut rng).ways.expect("asks");
        o.belief = Some(answer(belief, ways));
        (ways, point_of(&s.step(&o, &mut rng)))
    }

    #[test]
    fn a_way_past_a_charted_pile_is_never_chosen() {
        for turning_radius_m in [12.0, 0.0] {
            let able = Capabilities { turning_radius_m, ..Default::default() };
            let (ways, open) = chosen(&[], able);
            // A pile of a metre anywhere on the way: between its points, too.
            let way = (0..WAYS).find(|k| ways.ends()[*k].0 == open).expect("one of them");
            for share in [0.35, 0.43, 0.5, 0.9, 1.0] {
                let at = ways.place(way, share);
                let (again, other) = chosen(&[([at.x, at.y], [1.0, 1.0, 19.0])], able);
                assert_eq!(again, ways);
                let taken = (0..WAYS).find(|k| ways.ends()[*k].0 == other).expect("one of them");
                let nearest = (0..=1000).map(|i| (ways.place(taken, f64::from(i) / 1000.0) - at).norm());
                assert!(nearest.fold(f64::INFINITY, f64::min) > 5.2, "{share}: {other:?}");
                // One that ends 7 m below the vehicle is none.
                let (_, over) = chosen(&[([at.x, at.y], [1.0, 1.0, 10.0])], able);
                assert_eq!((over, other == open), (open, false));
            }
        }
    }

    #[test]
    fn who_is_too_near_may_go_away_and_who_is_shut_in_makes_for_the_middle() {
        let able = Capabilities { turning_radius_m: 12.0, ..Default::default() };
        // A wall 2 m to the west of a vehicle that heads east.
        let (ways, goes) = chosen(&[([-3.0, 0.0], [2.0, 40.0, 19.0])], able);
        assert_eq!(goes, chosen(&[], able).1);
        assert!(ways.ends().iter().any(|(end, _)| *end == goes));
        assert_eq!(chosen(&[([12.0, 0.0], [2.0, 60.0, 19.0])], able).1, area().centre);
    }
}
