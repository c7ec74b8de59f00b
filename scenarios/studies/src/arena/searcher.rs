//! A searcher: what makes a machine search in its own way.

use super::family::Machine;
use rheotaxis::explain::FileKind;
use rheotaxis::scenario::Version;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Files of searchers, for `rheotaxis explain`.
pub const SEARCHERS_FILE: FileKind =
    FileKind::new::<SearchersSpec>("searchers", "Searchers, which `rheotaxis arena --searcher` reads.");

/// A file of searchers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SearchersSpec {
    /// Version of the file; the first field.
    pub version: Version,
    /// The searchers.
    pub searchers: Vec<SearcherSpec>,
}

/// A searcher.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SearcherSpec {
    /// Its name in tables, unlike those of others.
    pub name: String,
    /// Paper, or whose it is.
    pub source: String,
    /// What it moves.
    pub machine: Machine,
    /// It is told what no searcher can know, such as the place of the source: it stands in no ranking.
    #[serde(default)]
    pub privileged: bool,
    /// Changes to the scenario: a path and the new value in RON. Who is ranked may set `robots[0].strategy`,
    /// `robots[0].map`, `robots[0].sensors.fluorometers_aside` and `gantries[0].tracker`. `{NAME}` is what the family
    /// gives by this name, with a number before the name so many times that. Only for who is privileged, `{PATH}` is
    /// the value that was drawn for this path.
    pub set: Vec<(String, String)>,
}
