//! When a mission counts as a success.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::ranges::Positive;

/// When the mission counts as a success.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum SuccessSpec {
    /// A robot declared a source near enough to a true one.
    Declared(DeclaredSpec),
    /// Every true source was declared near enough, and every robot ended its mission. Other declarations are counted
    /// and do no harm: a plume that was traced to the edge of a subregion is declared there.
    AllDeclared(DeclaredSpec),
    /// A robot came near enough to a true source, whatever it declared.
    Reached(ReachedSpec),
    /// Every robot reached the planned end of its mission.
    #[default]
    Completed,
}

impl SuccessSpec {
    /// Greatest distance at which a declaration counts, m; `None` if the rule asks for no declaration.
    pub fn declared_within_m(&self) -> Option<f64> {
        match self {
            SuccessSpec::Declared(d) | SuccessSpec::AllDeclared(d) => Some(d.within_m.get()),
            SuccessSpec::Reached(_) | SuccessSpec::Completed => None,
        }
    }
}

impl SuccessSpec {
    /// The rule in words.
    pub fn describe(&self) -> String {
        match self {
            SuccessSpec::Declared(d) => format!("a source is declared within {} m of a true one", d.within_m.get()),
            SuccessSpec::AllDeclared(d) => {
                format!("every true source is declared within {} m, and every robot ends its mission", d.within_m.get())
            }
            SuccessSpec::Reached(r) => format!("a robot comes within {} m of a true source", r.within_m.get()),
            SuccessSpec::Completed => "every robot comes to its planned end".to_owned(),
        }
    }
}

/// What counts as near enough.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DeclaredSpec {
    /// Greatest horizontal distance from a true source, m.
    pub within_m: Positive,
}

/// How near a robot must come.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReachedSpec {
    /// Greatest horizontal distance between a robot and a true source, m.
    pub within_m: Positive,
}
