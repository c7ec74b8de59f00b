//! The strategy that searches nothing: it goes from place to place and notes what it smells.
//!
//! *Source*: way-point missions, as every survey vehicle flies them (Pang 2009, section 4.1: Go-To).
//!
//! *Parameters*: places `points` (east, north), m; speed over ground, m/s; depth or altitude; `stay_s`, how long to stay
//! at each place, s.
//!
//! *Deviations*: a vehicle that hovers holds its place while it stays; any other circles round it.

use super::about::About;
use super::setting::Setting;
use super::spec::{Strategy, StrategyParams};
use super::wishes::VerticalSpec;
use super::wishes::Wishes;
use crate::error::{RobotError, require};
use crate::handoff::{Behaviour, Decision, Goal, Manoeuvre, Observation, Outcome, Vertical};
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::catalogue::Entry;
use world::ranges::{Finite, NonNegative, Positive};
use world::registry::Listed;
use world::seeds::Stream;

/// Parameters of the strategy.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RouteSpec {
    /// Places (east, north), m, in order; at least one.
    pub points: Vec<(Finite, Finite)>,
    /// Speed over ground, m/s.
    #[serde(default = "speed")]
    pub speed_m_s: Positive,
    /// Depth or altitude; `None` for a vehicle that holds none, such as a glider or a craft on the surface.
    #[serde(default)]
    pub vertical: Option<VerticalSpec>,
    /// How long to stay at each place, s.
    #[serde(default = "none")]
    pub stay_s: NonNegative,
}

fn speed() -> Positive {
    Positive::new(1.0)
}

fn none() -> NonNegative {
    NonNegative::new(0.0)
}

impl Listed for RouteSpec {
    const ENTRY: Entry = Entry {
        name: "Route",
        what: "goes from place to place without searching; may stay at each",
        source: "way points, Pang 2009, section 4.1",
    };
}

impl StrategyParams for RouteSpec {
    fn build(&self, _: &Setting) -> Result<Box<dyn Strategy>, RobotError> {
        require(!self.points.is_empty(), "points", "must name at least one place")?;
        Ok(Box::new(Route::new(self)))
    }

    fn about(&self) -> About {
        let wishes = match self.vertical {
            Some(vertical) => Wishes::mission(self.speed_m_s, vertical),
            None => Wishes::speed(self.speed_m_s),
        };
        About { wishes, ..About::no_search() }
    }
}

/// State of the strategy.
#[derive(Debug)]
pub struct Route {
    spec: RouteSpec,
    points: Vec<Vector2<f64>>,
    next: usize,
    stays_until_s: Option<f64>,
    goal: Option<Goal>,
}

impl Route {
    /// Before its first place.
    pub fn new(spec: &RouteSpec) -> Self {
        let points = spec.points.iter().map(|(east, north)| Vector2::new(east.get(), north.get()));
        Self { spec: spec.clone(), points: points.collect(), next: 0, stays_until_s: None, goal: None }
    }

    fn to(&mut self, manoeuvre: Manoeuvre, seen: &Observation) -> Goal {
        let goal = Goal {
            id: self.goal.map_or(1, |g| g.id + 1),
            manoeuvre,
            vertical: (self.spec.vertical).map_or(Vertical::Depth(seen.estimate.depth_m.max(0.0)), Vertical::from),
            speed_m_s: self.spec.speed_m_s.get(),
        };
        self.goal = Some(goal);
        goal
    }
}

impl Strategy for Route {
    fn step(&mut self, seen: &Observation, _: &mut Stream) -> Decision {
        let Some(goal) = self.goal else {
            let first = Manoeuvre::GoToPoint { point: self.points[0], radius_m: None };
            return Decision::new(Behaviour::GoTo, self.to(first, seen));
        };
        if self.next == self.points.len() {
            return Decision { outcome: Some(Outcome::Completed), ..Decision::new(Behaviour::Done, goal) };
        }
        let point = self.points[self.next];
        match self.stays_until_s {
            Some(until_s) if seen.t_s < until_s => return Decision::new(Behaviour::GoTo, goal),
            Some(_) => self.stays_until_s = None,
            None if seen.guidance.done && seen.guidance.goal_id == goal.id => {
                let stay_s = self.spec.stay_s.get();
                if stay_s > 0.0 {
                    self.stays_until_s = Some(seen.t_s + stay_s);
                    let hold = Manoeuvre::Hold { point, heading: None };
                    return Decision::new(Behaviour::GoTo, self.to(hold, seen));
                }
            }
            None => return Decision::new(Behaviour::GoTo, goal),
        }
        self.next += 1;
        let Some(point) = self.points.get(self.next).copied() else {
            return Decision::new(Behaviour::GoTo, goal);
        };
        let on = Manoeuvre::GoToPoint { point, radius_m: None };
        Decision::new(Behaviour::GoTo, self.to(on, seen))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handoff::testing::seen;

    #[test]
    fn it_goes_from_place_to_place_stays_and_ends() {
        let f = Finite::new;
        let spec = RouteSpec {
            points: vec![(f(10.0), f(0.0)), (f(20.0), f(5.0))],
            speed_m_s: Positive::new(1.0),
            vertical: None,
            stay_s: NonNegative::new(10.0),
        };
        let mut route = Route::new(&spec);
        let mut rng = Stream::new(1, "auv0", "strategy");
        let mut manoeuvres = Vec::new();
        let mut ended = None;
        for t in 0..100 {
            let mut now = seen(f64::from(t), Vector2::zeros(), 0.0, None);
            // Whatever is asked is done two seconds later.
            now.guidance.goal_id = route.goal.map_or(0, |g| g.id);
            now.guidance.done = t % 2 == 1;
            let decision = route.step(&now, &mut rng);
            if manoeuvres.last() != Some(&decision.goal.manoeuvre) {
                manoeuvres.push(decision.goal.manoeuvre);
            }
            if decision.outcome.is_some() {
                ended = Some(t);
                break;
            }
        }
        assert_eq!(manoeuvres.len(), 4, "{manoeuvres:?}");
        assert!(matches!(manoeuvres[1], Manoeuvre::Hold { .. }));
        assert!(ended.is_some_and(|t| (20..40).contains(&t)), "{ended:?}");
    }
}
