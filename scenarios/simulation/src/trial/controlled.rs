//! Which machines of a scenario a searcher outside this program decides for.

use crate::scenario::Scenario;
use robots::handoff::ExchangeTiming;

/// A robot that nobody outside this program can control.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no robot or gantry {robot:?} has the strategy External; {}", those(.outside))]
pub struct NotControlled {
    /// Its id.
    pub robot: String,
    /// Ids of those that can be controlled.
    pub outside: Vec<String>,
}

fn those(outside: &[String]) -> String {
    if outside.is_empty() { "none has".to_string() } else { format!("those that have: {}", outside.join(", ")) }
}

/// The robots and gantries of a scenario whose strategy is `External`, in its order, and how they ask.
pub fn consulted(scenario: &Scenario) -> Vec<(String, ExchangeTiming)> {
    let robots = scenario.robots.iter();
    let robots = robots.filter_map(|r| Some((r.id.as_str(), r.strategy.about().consulted?)));
    let gantries = scenario.gantries.iter();
    let gantries = gantries.filter_map(|g| Some((g.id.as_str(), g.tracker.consulted()?)));
    let all = robots.chain(gantries);
    all.map(|(id, consulted)| (id.to_string(), consulted)).collect()
}

/// Their ids.
pub fn controlled(scenario: &Scenario) -> Vec<String> {
    consulted(scenario).into_iter().map(|(id, _)| id).collect()
}
