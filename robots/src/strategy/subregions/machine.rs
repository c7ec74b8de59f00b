//! Searches the subregions one after the other. The search of a subregion ends with a declaration, with a plume
//! traced to the up-flow edge, or with a time-out.
//!
//! *Source*: Pang 2009, section 6 (missions of several sources, "MT").
//!
//! *Parameters*: see [`SubregionsSpec`].
//!
//! *Deviations*: the paper prints neither the time-out nor where in a subregion its search begins. It names three
//! ends of a search. A fourth is a strategy that gives up by itself and goes home without a declaration: only this
//! end leaves the subregion source-free; a time-out leaves it unknown. A strategy that surveys its declared place may
//! finish the survey. If it rejects the place and searches on, it keeps the subregion until one of these ends. The
//! searching strategy sees the subregion as its area; the guidance's cage remains the whole area.

use super::super::setting::Setting;
use super::super::spec::{Strategy, StrategyParams};
use super::super::wishes::Wishes;
use super::edge::{Plume, crossing};
use super::rectangles::areas;
use super::spec::{Entry, RegionsSpec, SubregionsSpec};
use crate::error::{RobotError, require};
use crate::handoff::{
    Behaviour, Decision, Declaration, Goal, Manoeuvre, Observation, Outcome, Region, RegionState, Regions, Shown,
    UP_FLOW_EDGE, Verdict, detects,
};
use crate::places::inside;
use crate::strategy::about::About;
use nalgebra::Vector2;
use world::area::Area;
use world::cost::{Cost, Times};
use world::seeds::Stream;
use world::units::Heading;

/// A search begins this far inside, m: there an edge no longer turns a zig-zag back.
const MARGIN_M: f64 = 20.0;

impl StrategyParams for SubregionsSpec {
    fn build(&self, setting: &Setting) -> Result<Box<dyn Strategy>, RobotError> {
        Ok(Box::new(Subregions::new(self, setting)?))
    }

    fn check(&self, setting: &Setting) -> Result<(), RobotError> {
        self.search.check(setting)
    }

    fn about(&self) -> About {
        let search = self.search.about();
        let regions = match &self.regions {
            RegionsSpec::Grid(grid) => grid.order.len(),
            RegionsSpec::Rectangles(rectangles) => rectangles.list.len(),
        };
        let mut wishes = Wishes::mission(self.speed_m_s, self.vertical);
        let inner = search.wishes.within("search");
        wishes.verticals.extend(inner.verticals);
        wishes.speeds_m_s.extend(inner.speeds_m_s);
        wishes.waits.extend(inner.waits);
        About {
            needs: search.needs.into_iter().map(|n| n.within("search")).collect(),
            wishes,
            declares_at_most: regions * search.declares_at_most,
            regions: true,
            ..About::default()
        }
    }

    fn cost(&self, area: &Area, depth_m: f64, obstacles: usize, times: &Times) -> Cost {
        (self.search.cost(area, depth_m, obstacles, times)).under("search")
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    Begin,
    /// On the way to the start of a region's search; the start was chosen with a known flow, or without.
    Transit {
        to: usize,
        aimed: bool,
    },
    /// In a region.
    Search(usize),
    Home,
    Over,
}

/// State of the mission.
#[derive(Debug)]
pub struct Subregions {
    /// One strategy per region, fresh until its turn comes.
    searches: Vec<Box<dyn Strategy>>,
    spec: SubregionsSpec,
    phase: Phase,
    regions: Vec<Region>,
    up_flow: Option<Heading>,
    plume: Plume,
    /// The last goal, of the mission or of a search.
    goal: Goal,
    /// Goals of the present search are numbered from here.
    goals_from: u32,
    /// Declarations of the present search are numbered from here.
    numbers_from: u32,
    /// Declarations of the present search.
    declared: Vec<Declaration>,
    outcome: Option<Outcome>,
}

impl Subregions {
    /// # Errors
    /// [`RobotError::Invalid`] if a region makes no sense, or if its strategy cannot be built.
    pub fn new(spec: &SubregionsSpec, setting: &Setting) -> Result<Self, RobotError> {
        let areas = areas(&spec.regions, &setting.area)?;
        require(!spec.search.about().regions, "search", "subregions cannot have subregions")?;
        let search = |area: &Area| {
            let setting = Setting { area: *area, ..setting.clone() };
            spec.search.build(&setting).map_err(within_search)
        };
        let waiting = |area: &Area| Region { area: *area, state: RegionState::Waiting, from_s: None, until_s: None };
        Ok(Self {
            searches: areas.iter().map(search).collect::<Result<_, _>>()?,
            spec: spec.clone(),
            phase: Phase::Begin,
            regions: areas.iter().map(waiting).collect(),
            up_flow: None,
            plume: Plume::new(spec.edge.plume_s.get()),
            goal: Goal::none_yet(spec.vertical.into(), spec.speed_m_s.get()),
            goals_from: 0,
            numbers_from: 0,
            declared: Vec::new(),
            outcome: None,
        })
    }

    fn go_to(&mut self, point: Vector2<f64>) {
        self.goal = Goal {
            id: self.goal.id + 1,
            manoeuvre: Manoeuvre::GoToPoint { point, radius_m: None },
            vertical: self.spec.vertical.into(),
            speed_m_s: self.spec.speed_m_s.get(),
        };
    }

    /// Sets out for a region, or for home after the last one.
    fn set_out(&mut self, to: usize, home: Vector2<f64>) {
        let Some(region) = self.regions.get(to) else {
            self.phase = Phase::Home;
            self.go_to(home);
            return;
        };
        let area = region.area;
        let (point, aimed) = match (self.spec.entry, self.up_flow) {
            (Entry::Centre, _) => (area.centre, true),
            (Entry::DownFlowCorner, Some(up)) => (down_flow_corner(&area, up), true),
            (Entry::DownFlowCorner, None) => (area.centre, false),
        };
        self.phase = Phase::Transit { to, aimed };
        self.go_to(point);
    }

    fn mark(&mut self, k: usize, change: impl Fn(&mut Region)) {
        change(&mut self.regions[k]);
    }

    fn begin_search(&mut self, k: usize, t_s: f64) {
        self.phase = Phase::Search(k);
        self.goals_from = self.goal.id + 1;
        self.numbers_from += self.declared.len() as u32;
        self.declared.clear();
        self.plume.forget();
        self.mark(k, |r| {
            r.state = RegionState::Searching;
            r.from_s = Some(t_s);
        });
    }

    fn end_search(&mut self, k: usize, state: RegionState, seen: &Observation) {
        self.mark(k, |r| {
            r.state = state;
            r.until_s = Some(seen.t_s);
        });
        self.set_out(k + 1, seen.home);
    }

    /// One tick of the search of region `k`.
    fn search(&mut self, k: usize, seen: &Observation, rng: &mut Stream) -> Decision {
        let region = self.regions[k];
        let mut its = seen.clone();
        its.area = region.area;
        // Goals from before this search do not belong to it.
        let of_search = seen.guidance.goal_id.checked_sub(self.goals_from);
        its.guidance.goal_id = of_search.unwrap_or(u32::MAX);
        its.guidance.done &= of_search.is_some();
        let mut decision = self.searches[k].step(&its, rng);
        decision.goal.id += self.goals_from;
        self.goal = decision.goal;
        let behaviour = decision.behaviour;
        let over = matches!(behaviour, Behaviour::GoHome | Behaviour::Done) || decision.outcome.take().is_some();
        if let Some(own) = decision.declared {
            decision.declared = Some(self.declare(k, own));
        }
        let crossing = if over { None } else { self.traced(region, behaviour, seen) };
        let timed_out = region.from_s.is_some_and(|from| seen.t_s - from >= self.spec.timeout_s.get());
        if let (Some(place), None) = (crossing, decision.declared) {
            let number = self.declared.len() as u32;
            let at_edge = Declaration { number, ..Declaration::first(seen.t_s, place, UP_FLOW_EDGE) };
            decision.declared = Some(self.declare(k, at_edge));
            self.end_search(k, RegionState::UpFlowEdge, seen);
        } else if over || (timed_out && behaviour != Behaviour::Survey) {
            let stands = self.declared.iter().any(|d| d.verdict != Verdict::Rejected);
            let state = if stands {
                RegionState::Declared
            } else if over {
                RegionState::SourceFree
            } else {
                RegionState::TimedOut
            };
            self.end_search(k, state, seen);
        }
        decision
    }

    /// Makes a declaration of the search of region `k` one of the mission.
    fn declare(&mut self, k: usize, own: Declaration) -> Declaration {
        own.join(&mut self.declared);
        Declaration { number: own.number + self.numbers_from, region: Some(k as u32), ..own }
    }

    /// Where the plume crosses the region's up-flow edge, if it has been traced there.
    fn traced(&mut self, region: Region, behaviour: Behaviour, seen: &Observation) -> Option<Vector2<f64>> {
        let tracing = !matches!(
            behaviour,
            Behaviour::Idle
                | Behaviour::OpenLoop
                | Behaviour::GoTo
                | Behaviour::Survey
                | Behaviour::GoHome
                | Behaviour::Done
        );
        if !(tracing && detects(seen)) {
            return None;
        }
        let here = seen.estimate.position;
        let plume = self.plume.note(seen.t_s, here);
        let within_m = self.spec.edge.within_m.get();
        crossing(&region.area, self.up_flow?, here, plume, within_m)
    }

    /// The decision while no search is running.
    fn under_way(&self) -> Decision {
        let behaviour = match self.phase {
            Phase::Begin | Phase::Transit { .. } | Phase::Search(_) => Behaviour::GoTo,
            Phase::Home => Behaviour::GoHome,
            Phase::Over => Behaviour::Done,
        };
        Decision::new(behaviour, self.goal)
    }
}

impl Strategy for Subregions {
    fn step(&mut self, seen: &Observation, rng: &mut Stream) -> Decision {
        if let Some(flow) = seen.estimate.flow {
            self.up_flow = Some(flow.up_flow());
        }
        if seen.guidance.aborted && self.outcome.is_none() {
            self.outcome = Some(Outcome::Aborted);
            self.phase = Phase::Over;
        }
        let arrived = seen.guidance.done && seen.guidance.goal_id == self.goal.id;
        match self.phase {
            Phase::Begin => self.set_out(0, seen.home),
            Phase::Transit { to, aimed: false } if self.up_flow.is_some() => {
                self.set_out(to, seen.home);
            }
            Phase::Transit { to, .. } if arrived => self.begin_search(to, seen.t_s),
            Phase::Home if arrived => {
                self.phase = Phase::Over;
                self.outcome.get_or_insert(Outcome::Completed);
            }
            _ => {}
        }
        let mut decision = match self.phase {
            Phase::Search(k) => {
                let searched = self.search(k, seen, rng);
                if self.phase == Phase::Search(k) {
                    searched
                } else {
                    // The search is over: its last declaration remains, its last goal does not.
                    Decision { declared: searched.declared, ..self.under_way() }
                }
            }
            _ => self.under_way(),
        };
        decision.outcome = self.outcome;
        decision
    }

    fn shown(&self) -> Shown {
        let searching = match self.phase {
            Phase::Search(k) => Some(k),
            _ => None,
        };
        Shown {
            regions: Regions { all: self.regions.clone(), now: searching.map(|k| k as u32) },
            ..searching.map_or_else(Shown::default, |k| self.searches[k].shown())
        }
    }
}

/// The corner farthest down-flow, a little inside.
fn down_flow_corner(area: &Area, up_flow: Heading) -> Vector2<f64> {
    let down = up_flow.opposite().unit();
    let corner = (area.corners().into_iter()).max_by(|a, b| a.dot(&down).total_cmp(&b.dot(&down)));
    inside(area, corner.unwrap_or(area.centre), MARGIN_M)
}

/// Turns an error of the searching strategy into one of this strategy.
fn within_search(error: RobotError) -> RobotError {
    match error {
        RobotError::Invalid { field, problem } => {
            RobotError::invalid(format!("search.{}", field.trim_start_matches("strategy.")), problem)
        }
        other => other,
    }
}
