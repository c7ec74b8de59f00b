//! Map and plan: zig-zag to the first detection, then planned paths to the likeliest source in the map, until a rule
//! declares.
//!
//! *Source*: Wang & Pang, section II-A, Fig. 1.
//!
//! *Parameters*: see [`MapAndPlanSpec`].
//!
//! *Deviations*: the paper's zig-zag knows no obstacle; here the planner leads around an obstacle on a leg, to the
//! place where the leg is free again. The paper does not say what the vehicle does at the target while the map still
//! changes: see [`AtTarget`]. A cell that is solid throughout is no target: the paper's map does not know of
//! obstacles. The map is the robot's own (`map` in the scenario); the strategy is refused if there is none.

use super::super::setting::Setting;
use super::super::spec::{Strategy, StrategyParams};
use super::super::survey::AfterDeclaration;
use super::super::wishes::{NO_DEPTH, Wishes};
use super::pilot::Pilot;
use super::spec::{AtTarget, MapAndPlanSpec};
use crate::behave::{Behave, Stride};
use crate::declare::BeliefRule;
use crate::error::{RobotError, require};
use crate::handoff::{
    Behaviour, Belief, Decision, Declaration, Goal, Manoeuvre, Need, Observation, Outcome, Shown, Vertical,
};
use crate::memory::PlumeMemory;
use crate::plan::Revision;
use crate::strategy::about::About;
use nalgebra::Vector3;
use world::area::Area;
use world::cost::{Cost, Times};
use world::seeds::Stream;
use world::units::Heading;

/// A leg of the search is checked this far ahead, m: two turning circles of 12 m and a margin.
const LOOK_M: f64 = 30.0;
/// Step of the search for the place where a leg is free again, m, and for how far it must then be free, m.
const BEYOND: (f64, f64) = (1.0, 6.0);
/// Home counts as reached within this distance, m.
const HOME_M: f64 = 10.0;

/// State of the strategy.
#[derive(Debug)]
pub struct MapAndPlan {
    spec: MapAndPlanSpec,
    find: Box<dyn Behave>,
    rule: Box<dyn BeliefRule>,
    pilot: Pilot,
    memory: PlumeMemory,
    now: Behaviour,
    goal: Goal,
    /// The leg that the search asks for.
    leg: Option<Manoeuvre>,
    /// Where a leg around an obstacle leads.
    detour: Option<Vector3<f64>>,
    /// The target cell, and which of the places near it (0: the cell itself).
    aim: Option<(usize, u32)>,
    /// The last visited cell.
    visited: Option<usize>,
    /// The likeliest cell that is not wholly solid, and the state of map and room for which it was found.
    likeliest: Option<((u64, Revision), usize)>,
    outcome: Option<Outcome>,
}

impl MapAndPlan {
    /// # Errors
    /// [`RobotError::Invalid`] if the robot keeps no map, or if parameters contradict each other.
    pub fn new(spec: &MapAndPlanSpec, setting: &Setting) -> Result<Self, RobotError> {
        require(
            setting.maps,
            "strategy",
            "MapAndPlan needs a source map, and the robot has none; add one, for example map: \
                    Pomdp()",
        )?;
        require(
            !matches!(spec.after_declaration, AfterDeclaration::Survey(_)),
            "strategy.after_declaration",
            "MapAndPlan flies no survey; use GoHome or Stop",
        )?;
        Ok(Self {
            spec: spec.clone(),
            find: spec.find.build()?,
            rule: spec.declare.build(),
            pilot: Pilot::new(spec, setting)?,
            memory: PlumeMemory::default(),
            now: Behaviour::Idle,
            goal: Goal::none_yet(spec.vertical.into(), spec.speed_m_s.get()),
            leg: None,
            detour: None,
            aim: None,
            visited: None,
            likeliest: None,
            outcome: None,
        })
    }

    fn turn_to(&mut self, next: Behaviour, seen: &Observation) {
        self.now = next;
        self.pilot.drop_path();
        self.detour = None;
        match next {
            Behaviour::Find => self.find.enter(seen, &self.memory),
            Behaviour::Done => {
                self.outcome.get_or_insert(Outcome::Completed);
            }
            _ => {}
        }
    }

    fn steer_by(&mut self, manoeuvre: Manoeuvre, z_m: Option<f64>, anew: bool) {
        self.goal = Goal {
            id: self.goal.id + u32::from(anew),
            manoeuvre,
            vertical: z_m.map_or(self.spec.vertical.into(), |z| Vertical::Depth(-z.min(0.0))),
            ..self.goal
        };
    }

    /// Moves along a planned path towards `wish`; true at its end.
    fn towards(&mut self, seen: &Observation, wish: Vector3<f64>) -> bool {
        let s = self.pilot.steer(seen, wish);
        let course = Manoeuvre::Course { course: s.course };
        self.steer_by(course, s.z_m, s.replanned);
        s.ended || (wish - seen.estimate.p_WB()).xy().norm() < self.spec.arrive_m.get()
    }

    fn search(&mut self, seen: &Observation, rng: &mut Stream) {
        let at = seen.estimate.p_WB();
        let arrived = match self.leg {
            Some(Manoeuvre::GoToPoint { point, .. }) => (point - at.xy()).norm() < 2.0 * self.spec.arrive_m.get(),
            _ => false,
        };
        match self.find.step(seen, arrived, &mut self.memory, rng) {
            Stride::Start(leg) | Stride::Adjust(leg) => {
                self.leg = Some(leg);
                self.detour = None;
                self.pilot.drop_path();
                self.steer_by(leg, None, true);
            }
            Stride::Over | Stride::Keep => {}
        }
        match self.leg {
            Some(Manoeuvre::GoToPoint { point, .. }) => {
                let z = self.pilot.level(point.x, point.y);
                self.towards(seen, Vector3::new(point.x, point.y, z));
            }
            Some(Manoeuvre::Course { course }) => self.along(seen, course),
            _ => {}
        }
    }

    /// Follows a leg of the search, around obstacles on it.
    fn along(&mut self, seen: &Observation, course: Heading) {
        if self.detour.is_none() {
            self.detour = self.way_round(seen, course);
        }
        if let Some(to) = self.detour {
            if self.towards(seen, to) {
                self.detour = None;
                self.pilot.drop_path();
            }
            return;
        }
        let leg = Manoeuvre::Course { course: self.pilot.clear(seen, course) };
        if self.goal.manoeuvre != leg {
            self.steer_by(leg, None, true);
        }
    }

    /// The place where a leg is free again after an obstacle; `None` if there is no obstacle near.
    fn way_round(&self, seen: &Observation, course: Heading) -> Option<Vector3<f64>> {
        let (at, room) = (seen.estimate.p_WB(), self.pilot.room());
        let u = course.unit();
        let on = |m: f64| {
            let p = at.xy() + u * m;
            Vector3::new(p.x, p.y, at.z)
        };
        let inside = |m: f64| seen.area.contains(on(m).xy());
        let (step, free_m) = BEYOND;
        let reach = (1..=(LOOK_M / step) as u32).map(|k| f64::from(k) * step).take_while(|m| inside(*m)).last()?;
        let closed = |from: f64, to: f64| !room.line_free(&on(from), &on(to));
        if !closed(0.0, reach) {
            return None;
        }
        let first = (0..).map(|k| f64::from(k) * step).find(|m| closed(*m, m + step))?;
        let beyond = (1..)
            .map(|k| first + f64::from(k) * step)
            .take_while(|m| inside(*m + free_m))
            .find(|m| !closed(*m, m + free_m));
        // If the leg is closed up to the edge, it continues along its mirror image.
        beyond.map(|m| on(m + free_m)).or_else(|| {
            let back = seen.estimate.attitude.heading.opposite().unit() * LOOK_M;
            let p = crate::places::inside(&seen.area, at.xy() + back, LOOK_M / 2.0);
            Some(Vector3::new(p.x, p.y, at.z))
        })
    }

    /// Moves towards the likeliest cell, and does there what `at_target` says.
    fn trace(&mut self, seen: &Observation, belief: &Belief) {
        let place = match self.aim {
            Some((cell, place)) if cell == belief.best => place,
            _ => 0,
        };
        self.aim = Some((belief.best, place));
        let wish = self.wish(belief, place);
        if self.towards(seen, wish) {
            let last = match self.spec.at_target {
                AtTarget::Circle => 0,
                AtTarget::Cross(_) => 2,
            };
            if place == last {
                self.visited = Some(belief.best);
            }
            self.aim = Some((belief.best, if place == last { 0 } else { place + 1 }));
        }
    }

    /// The target, or one of the two places down-flow of it between which the vehicle crosses the plume.
    fn wish(&self, belief: &Belief, place: u32) -> Vector3<f64> {
        let mut p = belief.grid.centre(belief.best);
        if belief.grid.n[2] == 1 {
            p.z = self.pilot.level(p.x, p.y);
        }
        if let (AtTarget::Cross(c), Some(up), 1..) = (self.spec.at_target, self.memory.up_flow, place) {
            let side = if place == 1 { 1.0 } else { -1.0 };
            let right = up.turned(std::f64::consts::FRAC_PI_2).unit();
            let d = right * (side * c.across_m.get()) - up.unit() * c.down_m.get();
            p += Vector3::new(d.x, d.y, 0.0);
        }
        p
    }

    /// The map's belief. The likeliest cell is taken among those that are not wholly solid, because those hold no
    /// source.
    fn informed(&mut self, seen: &Observation) -> Option<Belief> {
        let belief = seen.belief.as_ref().filter(|b| b.informed)?;
        let key = (belief.updates, self.pilot.room().revision().clone());
        let best = match &self.likeliest {
            Some((of, best)) if *of == key => *best,
            _ => {
                let free = |cell: &usize| !self.pilot.in_solid(&belief.grid, *cell);
                let likelier = |a: &usize, b: &usize| belief.p[*a].total_cmp(&belief.p[*b]).then(b.cmp(a));
                if free(&belief.best) {
                    belief.best
                } else {
                    (0..belief.p.len()).filter(free).max_by(likelier).unwrap_or(belief.best)
                }
            }
        };
        self.likeliest = Some((key, best));
        Some(Belief { best, ..belief.clone() })
    }

    fn declared(&mut self, seen: &Observation, belief: &Belief) -> Option<Declaration> {
        let position = self.rule.step(seen.t_s, belief)?;
        if self.spec.visit_first && self.visited != Some(belief.best) {
            return None;
        }
        // The one level of a flat map says nothing of the source's height.
        let z_m = (belief.grid.n[2] > 1).then_some(position.z);
        Some(Declaration { z_m, ..Declaration::first(seen.t_s, position.xy(), self.spec.declare.name()) })
    }
}

impl StrategyParams for MapAndPlanSpec {
    fn build(&self, setting: &Setting) -> Result<Box<dyn Strategy>, RobotError> {
        Ok(Box::new(MapAndPlan::new(self, setting)?))
    }

    fn check(&self, setting: &Setting) -> Result<(), RobotError> {
        let cells = self.room.cells(setting)?;
        self.planner.check(&cells, self.room.plane())
    }

    fn about(&self) -> About {
        let mut needs = self.after_declaration.needs();
        if !self.room.plane() {
            needs.push(Need::vital("room", "depth", NO_DEPTH));
        }
        let wishes = Wishes::mission(self.speed_m_s, self.vertical).after(&self.after_declaration);
        About { needs, wishes, ..About::default() }
    }

    fn cost(&self, area: &Area, depth_m: f64, obstacles: usize, times: &Times) -> Cost {
        self.work(area, depth_m, obstacles, times)
    }
}

impl Strategy for MapAndPlan {
    fn step(&mut self, seen: &Observation, rng: &mut Stream) -> Decision {
        self.pilot.sense(seen);
        self.memory.take_flow(seen);
        if seen.guidance.aborted && self.outcome.is_none() {
            self.outcome = Some(Outcome::Aborted);
            self.turn_to(Behaviour::Done, seen);
        }
        let informed = self.informed(seen);
        if matches!(self.now, Behaviour::Idle | Behaviour::Find) && informed.is_some() {
            self.turn_to(Behaviour::FollowPath, seen);
        } else if self.now == Behaviour::Idle {
            self.turn_to(Behaviour::Find, seen);
        }
        let mut declared = None;
        if let (Behaviour::FollowPath, Some(belief)) = (self.now, &informed) {
            declared = self.declared(seen, belief);
            if declared.is_some() {
                self.turn_to(
                    match self.spec.after_declaration {
                        AfterDeclaration::GoHome => Behaviour::GoHome,
                        AfterDeclaration::Stop | AfterDeclaration::Survey(_) => Behaviour::Done,
                    },
                    seen,
                );
            }
        }
        let back = match self.now {
            Behaviour::Done => None,
            _ => self.pilot.back(seen),
        };
        match (self.now, &informed) {
            _ if let Some(astern) = back => {
                self.steer_by(astern, None, astern != self.goal.manoeuvre);
            }
            (Behaviour::Find, _) => self.search(seen, rng),
            (Behaviour::FollowPath, Some(belief)) => self.trace(seen, belief),
            (Behaviour::GoHome, _) => {
                let home = Vector3::new(seen.home.x, seen.home.y, self.pilot.level(seen.home.x, seen.home.y));
                self.towards(seen, home);
                if (seen.home - seen.estimate.position).norm() < HOME_M {
                    self.turn_to(Behaviour::Done, seen);
                }
            }
            _ => {}
        }
        Decision {
            behaviour: match back {
                Some(_) => Behaviour::Avoid,
                None => self.now,
            },
            goal: self.goal,
            declared,
            picture: false,
            ways: None,
            outcome: self.outcome,
        }
    }

    fn shown(&self) -> Shown {
        let planned = match self.now {
            Behaviour::Done => Vec::new(),
            _ => self.pilot.planned(),
        };
        Shown { planned, ..Shown::default() }
    }
}

#[cfg(test)]
impl MapAndPlan {
    /// Cells that were sensed to be solid.
    pub(super) fn sensed(&self) -> usize {
        self.pilot.room().sensed()
    }
}
