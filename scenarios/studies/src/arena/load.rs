//! Reads families and searchers: those that come with the program, and files of the user's.

use super::family::FamilySpec;
use super::searcher::{SearcherSpec, SearchersSpec};
use crate::campaign::CampaignError;
use crate::shipped::{beside, stem, text_of};
use output::files::ReportError;
use rheotaxis::scenario::{Loaded, Outline, ScenarioError, Template, UnplacedFault};
use rheotaxis::scenario::{load_with, read, set_value, version_first};
use schemars::JsonSchema;
use serde::de::DeserializeOwned;
use std::path::{Path, PathBuf};
use world::registry::Registry;

macro_rules! catalog {
    ($($name:literal),* $(,)?) => {
        &[$(Template {
            name: $name,
            text: include_str!(concat!("../../arena/", $name, ".ron")),
            files: &[],
        }),*]
    };
}

/// The families that come with the program, in the order of the tables.
pub const FAMILIES: &[Template] =
    catalog!["uniform", "uniform_kinematic", "duck", "reversing", "tide_waves", "harbour", "midwater", "flume"];

/// The searchers that come with the program.
const SEARCHERS: &[Template] = catalog!["searchers"];

/// A family with its scenario.
#[derive(Clone, Debug)]
pub struct Family {
    /// Its name: that of the file, without its ending.
    pub name: String,
    /// The name that errors use.
    pub shown: String,
    /// The content of its file.
    pub spec: FamilySpec,
    /// Its scenario.
    pub base: Loaded,
}

/// The arena cannot be set up, run or shown.
#[derive(Debug, thiserror::Error)]
pub enum ArenaError {
    /// A file is wrong, or there is none.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// There is no such searcher.
    #[error("there is no searcher `{name}`; there are: {known}. A file of your own may be named, too")]
    Searcher {
        /// The name asked for.
        name: String,
        /// The existing names.
        known: String,
    },
    /// Two of the same name.
    #[error("there are two {what} called {name}: their results would be one")]
    Twice {
        /// Searchers, or families.
        what: &'static str,
        /// The name.
        name: String,
    },
    /// No searcher fits the machine of a family.
    #[error("{family}: none of the searchers asked for moves a {}, which this family has", machine.name())]
    Nobody {
        /// The family.
        family: String,
        /// Its machine.
        machine: super::Machine,
    },
    /// A text of a searcher, or of a family, names what is not given.
    #[error("{whose}: {problem}")]
    Fill {
        /// The family and the searcher.
        whose: String,
        /// What is wrong.
        problem: String,
    },
    /// The runs.
    #[error(transparent)]
    Campaign(#[from] CampaignError),
    /// The results cannot be written.
    #[error(transparent)]
    Report(#[from] ReportError),
}

/// The families asked for by name or by file; all if none is named. Their scenarios may use what a registry adds.
///
/// # Errors
/// If a name is unknown, or a file or scenario is wrong.
pub fn families(registry: &Registry, asked: &[PathBuf]) -> Result<Vec<Family>, ArenaError> {
    let all: Vec<PathBuf> = FAMILIES.iter().map(|t| PathBuf::from(t.name)).collect();
    let asked = if asked.is_empty() { &all } else { asked };
    let found: Result<Vec<Family>, ArenaError> = asked.iter().map(|path| family(registry, path)).collect();
    let found = found?;
    no_two("families", found.iter().map(|f| &f.name))?;
    Ok(found)
}

fn family(registry: &Registry, path: &Path) -> Result<Family, ArenaError> {
    let spec: FamilySpec = parsed(path, FAMILIES, "families", |spec: &FamilySpec| {
        let faults = spec.draw.iter().enumerate();
        faults.filter_map(|(i, (_, of))| Some(UnplacedFault::error(format!("draw[{i}]"), of.fault()?))).collect()
    })?;
    let mut base = load_with(registry, &beside(path, &spec.base))?;
    for (at, value) in &spec.set {
        let whose = path.display().to_string();
        let text = set_value(&base.text(), at, value);
        let text = text.map_err(|problem| ArenaError::Fill { whose, problem: format!("set `{at}`: {problem}") })?;
        base = base.with_text(&base.path, text)?;
    }
    Ok(Family { name: stem(path), shown: path.display().to_string(), spec, base })
}

/// The searchers asked for by name, or all of a file; all that come with the program if none is named.
///
/// # Errors
/// If a name is unknown, or a file is wrong.
pub fn searchers(asked: &[String]) -> Result<Vec<SearcherSpec>, ArenaError> {
    let shipped = file_of_searchers(Path::new("searchers"))?;
    if asked.is_empty() {
        return Ok(shipped);
    }
    let mut found = Vec::new();
    for name in asked {
        if let Some(known) = shipped.iter().find(|s| s.name == *name) {
            found.push(known.clone());
        } else if Path::new(name).is_file() {
            found.extend(file_of_searchers(Path::new(name))?);
        } else {
            let known: Vec<&str> = shipped.iter().map(|s| s.name.as_str()).collect();
            return Err(ArenaError::Searcher { name: name.clone(), known: known.join("; ") });
        }
    }
    no_two("searchers", found.iter().map(|s| &s.name))?;
    Ok(found)
}

fn file_of_searchers(path: &Path) -> Result<Vec<SearcherSpec>, ArenaError> {
    let spec: SearchersSpec = parsed(path, SEARCHERS, "searchers", |_| Vec::new())?;
    no_two("searchers", spec.searchers.iter().map(|s| &s.name))?;
    Ok(spec.searchers)
}

fn parsed<T: DeserializeOwned + JsonSchema + 'static>(
    path: &Path,
    shipped: &[Template],
    what: &str,
    meaning: impl FnOnce(&T) -> Vec<UnplacedFault>,
) -> Result<T, ScenarioError> {
    let (shown, text) = (path.display().to_string(), text_of(path, shipped, what)?);
    version_first(&shown, &text, &Outline::scan(&text))?;
    read(&Registry::default(), &shown, &text, meaning)
}

fn no_two<'a>(what: &'static str, names: impl Iterator<Item = &'a String> + Clone) -> Result<(), ArenaError> {
    let again = names.clone().enumerate().find(|(k, name)| names.clone().take(*k).any(|other| other == *name));
    again.map_or(Ok(()), |(_, name)| Err(ArenaError::Twice { what, name: name.clone() }))
}
