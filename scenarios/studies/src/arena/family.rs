//! A family of water: a scenario, and what differs in it from seed to seed.

use crate::distribution::Distribution;
use rheotaxis::explain::FileKind;
use rheotaxis::scenario::Version;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::num::NonZeroU64;

/// Family files, for `rheotaxis explain`.
pub const FAMILY_FILE: FileKind =
    FileKind::new::<FamilySpec>("family", "A family of water, which `rheotaxis arena --family` reads.");

/// A family: water, a source and a machine that looks for it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FamilySpec {
    /// Version of the file; the first field.
    pub version: Version,
    /// What it is, in a few words.
    pub title: String,
    /// Scenario: a file relative to the family's, or the name of one that comes with the program.
    pub base: String,
    /// What searches.
    pub machine: Machine,
    /// Changes to the scenario, the same for every searcher: a path and the new value in RON.
    #[serde(default)]
    pub set: Vec<(String, String)>,
    /// What is drawn anew for each seed, the same for every searcher: a path and from what.
    pub draw: Vec<(String, Distribution)>,
    /// Texts that searchers use by name: `{speed}`, or `{0.5 step}` for half of a number.
    #[serde(default)]
    pub given: Vec<(String, String)>,
    /// Number of seeds of `rheotaxis arena --quick`.
    pub quick: NonZeroU64,
}

/// What searches in a family.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Machine {
    /// A vehicle: `robots[0]`.
    Robot,
    /// A sensor head on a gantry: `gantries[0]`.
    Gantry,
}
