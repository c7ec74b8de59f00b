//! The machines of a scenario, each behind the trait [`Machine`].

use crate::machines::Machine;
use crate::scenario::Scenario;

/// The machines of a scenario, in the order of their turns.
#[derive(Clone, Debug)]
pub struct Fleet<'s> {
    /// Those of the kinds that come with the program.
    own: Vec<&'s dyn Machine>,
    /// Those of other crates.
    added: Vec<&'s dyn Machine>,
}

impl<'s> Fleet<'s> {
    /// Robots, then gantries, then what other crates add, each in the scenario's order.
    pub fn from_scenario(scenario: &'s Scenario) -> Self {
        let robots = scenario.robots.iter().map(|r| r as &dyn Machine);
        let gantries = scenario.gantries.iter().map(|g| g as &dyn Machine);
        Self { own: robots.chain(gantries).collect(), added: scenario.apparatus.iter().map(|a| &**a).collect() }
    }

    /// All of them.
    pub fn all(&self) -> impl Iterator<Item = &'s dyn Machine> {
        self.own.iter().chain(&self.added).copied()
    }

    /// The first machine of each kind.
    pub(crate) fn kinds(&self) -> Vec<&'s dyn Machine> {
        let mut kinds = firsts(&self.own);
        kinds.extend(firsts(&self.added));
        kinds
    }

    /// How many of the kinds come with the program; they are the first ones.
    pub(crate) fn own_kinds(&self) -> usize {
        firsts(&self.own).len()
    }
}

/// The first of each kind.
fn firsts<'s>(all: &[&'s dyn Machine]) -> Vec<&'s dyn Machine> {
    let mut firsts: Vec<&dyn Machine> = Vec::new();
    for one in all {
        if firsts.iter().all(|f| f.entry().name != one.entry().name) {
            firsts.push(*one);
        }
    }
    firsts
}
