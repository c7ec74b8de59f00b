//! What a paper reports, and the scenario with which we compare it: one row file each.

mod shipped;

use super::measure::RunEvent;
use super::quantity::Quantity;
use crate::campaign::{Arm, ThreadsError};
use crate::draw::{Draw, check};
use output::files::ReportError;
use rheotaxis::scenario::{Loaded, ScenarioError, UnplacedFault, load_text, load_with, set_value, template};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use shipped::ROWS;
use std::num::NonZeroU64;
use std::path::{Path, PathBuf};
use world::files;
use world::registry::Registry;

/// Longest file read, bytes: a row is text of a few kilobytes.
const LONGEST: u64 = 1 << 20;

/// A row of the reproduction table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// Its name.
    pub id: String,
    /// What the experiment does.
    pub what: String,
    /// Paper, section, table or figure.
    pub source: String,
    /// A scenario that comes with the program, or a file beside that of the row.
    pub scenario: String,
    /// Changes to the scenario, by arm; all arms run with the same seeds. Without arms, the scenario runs as it is.
    #[serde(default)]
    pub arms: Vec<Arm>,
    /// Values of the scenario that are drawn anew for every seed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub draw: Vec<Draw>,
    /// Seeds of a first look (`--quick`): fewer where a run takes long.
    #[serde(default = "quick")]
    pub quick: NonZeroU64,
    /// Whether the reliability of the arms' maps is shown: what they state against what is true.
    #[serde(default)]
    pub reliability: bool,
    /// The figures compared.
    pub figures: Vec<Figure>,
}

/// Seeds of a first look, unless the row says otherwise.
fn quick() -> NonZeroU64 {
    NonZeroU64::new(20).expect("20 is not zero")
}

/// One figure of a row.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Figure {
    /// Its name for people.
    pub name: String,
    /// Name of the arm; required if the row has arms.
    #[serde(default)]
    pub arm: Option<String>,
    /// Only runs in which this happened count.
    #[serde(default)]
    pub among: Option<RunEvent>,
    /// What is computed from our runs.
    pub quantity: Quantity,
    /// The paper's figure; absent if there is nothing to compare.
    #[serde(default)]
    pub paper: Option<Paper>,
    /// A remark that is needed for the comparison.
    #[serde(default)]
    pub note: String,
}

/// A paper's figure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Paper {
    /// A figure over many runs, in the quantity's unit (shares from 0 to 1).
    Value(f64),
    /// A figure of a single run, in the quantity's unit.
    Run(f64),
    /// A count: so many of so many.
    Count(u64, u64),
    /// So few of so few that it is no share: one run that did or did not.
    RunCount(u64, u64),
    /// A mean and its standard error.
    Measured(f64, f64),
    /// A mean over so many runs.
    MeanOf(f64, u64),
    /// A mean over so many runs that is only said to be at least this.
    AtLeast(f64, u64),
}

impl Paper {
    /// As a number in the quantity's unit.
    pub fn value(self) -> f64 {
        match self {
            Paper::Value(v) | Paper::Run(v) | Paper::Measured(v, _) | Paper::MeanOf(v, _) | Paper::AtLeast(v, _) => v,
            Paper::Count(k, n) | Paper::RunCount(k, n) => k as f64 / n as f64,
        }
    }

    fn is_sound(self) -> bool {
        match self {
            Paper::Value(v) | Paper::Run(v) => v.is_finite(),
            Paper::Measured(v, error) => v.is_finite() && error.is_finite() && error > 0.0,
            Paper::MeanOf(v, n) | Paper::AtLeast(v, n) => v.is_finite() && n > 0,
            Paper::Count(k, n) | Paper::RunCount(k, n) => n > 0 && k <= n,
        }
    }
}

/// Why a row cannot be reproduced.
#[derive(Debug, thiserror::Error)]
pub enum ReproduceError {
    /// There is no such row.
    #[error("there is no row `{name}`; there are: {known}. A row file of your own may be named, too")]
    Unknown {
        /// The name asked for.
        name: String,
        /// The existing names.
        known: String,
    },
    /// No row that was asked for has such an arm.
    #[error("no row asked for has an arm `{name}`; there are: {known}")]
    Arm {
        /// The name asked for.
        name: String,
        /// The existing names.
        known: String,
    },
    /// A row file that cannot be read.
    #[error("{name}: {problem}")]
    Row {
        /// The file.
        name: String,
        /// What is wrong.
        problem: String,
    },
    /// Its scenario is wrong.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// Its results cannot be written.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// A table of kept runs that cannot be read.
    #[error("{}: {problem}", path.display())]
    Table {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        problem: String,
    },
    /// Kept runs that the program no longer gives.
    #[error("{row} is out of date: {problem}. `--anew` makes its runs anew")]
    OutOfDate {
        /// The row.
        row: String,
        /// What shows it.
        problem: String,
    },
    /// The threads cannot be started.
    #[error(transparent)]
    Threads(#[from] ThreadsError),
    /// Ctrl-C or a termination signal.
    #[error("interrupted: nothing is written, for the runs that end first are not a fair sample")]
    Interrupted,
}

/// A row with the scenario it runs.
#[derive(Clone, Debug)]
pub struct Reference {
    /// The row.
    pub row: Row,
    /// Its scenario.
    pub loaded: Loaded,
    /// The scenario as each arm changes it, with the arm's name; at least one.
    pub arms: Vec<(String, Loaded)>,
}

/// All rows that come with the program. Their scenarios may use what a registry adds.
///
/// # Errors
/// If one is wrong (tests prevent this).
pub fn rows(registry: &Registry) -> Result<Vec<Reference>, ReproduceError> {
    ROWS.iter().map(|(name, text)| embedded(registry, name, text)).collect()
}

/// The rows asked for by name or by file, each once; all rows if none is named. Only the named arms are kept, if any.
///
/// # Errors
/// If a name is unknown, if its file or scenario is wrong, or if no row has such an arm.
pub fn wanted(registry: &Registry, names: &[PathBuf], arms: &[String]) -> Result<Vec<Reference>, ReproduceError> {
    let mut found: Vec<Reference> = Vec::new();
    if names.is_empty() {
        found = rows(registry)?;
    }
    for name in names {
        for reference in some(registry, name)? {
            if found.iter().all(|f| f.row != reference.row) {
                found.push(reference);
            }
        }
    }
    if arms.is_empty() {
        return Ok(found);
    }
    let known: Vec<String> = (found.iter()).flat_map(|f| f.row.arms.iter().map(|a| format!("`{}`", a.name))).collect();
    if let Some(odd) = arms.iter().find(|a| !known.contains(&format!("`{a}`"))) {
        return Err(ReproduceError::Arm { name: odd.clone(), known: known.join(", ") });
    }
    for reference in &mut found {
        reference.keep(arms);
    }
    found.retain(|f| !f.arms.is_empty());
    Ok(found)
}

/// The row of that name; if there is none, all rows whose names begin with it and `_`.
fn named(name: &str) -> Vec<&'static (&'static str, &'static str)> {
    if let Some(row) = ROWS.iter().find(|(id, _)| *id == name) {
        return vec![row];
    }
    let group = format!("{name}_");
    let of_group = ROWS.iter().filter(|(id, _)| id.starts_with(&group));
    of_group.collect()
}

/// Rows by their name or that of their group, or a row file.
fn some(registry: &Registry, path: &Path) -> Result<Vec<Reference>, ReproduceError> {
    let name = path.display().to_string();
    let rows = named(&name);
    if !rows.is_empty() {
        return rows.iter().map(|(id, text)| embedded(registry, id, text)).collect();
    }
    if !path.is_file() {
        let known: Vec<&str> = ROWS.iter().map(|(id, _)| *id).collect();
        return Err(ReproduceError::Unknown { name, known: known.join(", ") });
    }
    let text = files::read_text(path, LONGEST)
        .map_err(|e| ReproduceError::Row { name: name.clone(), problem: format!("cannot be read: {e}") })?;
    let row = read(&name, &text)?;
    let beside = path.parent().unwrap_or(Path::new("")).join(&row.scenario);
    let loaded = if beside.is_file() { load_with(registry, &beside)? } else { scenario(registry, &name, &row)? };
    loaded.check()?;
    Ok(vec![Reference::new(&name, row, loaded)?])
}

impl Reference {
    fn new(name: &str, row: Row, loaded: Loaded) -> Result<Self, ReproduceError> {
        let mut arms = Vec::new();
        for arm in &row.arms {
            let wrong = |path: &str, problem: String| ReproduceError::Row {
                name: name.to_string(),
                problem: format!("arm `{}`: {path}: {problem}", arm.name),
            };
            let mut text = loaded.text().into_owned();
            for (path, value) in &arm.set {
                text = set_value(&text, path, value).map_err(|problem| wrong(path, problem))?;
            }
            let shown = format!("{} (arm {})", loaded.name, arm.name);
            let changed = loaded.with_text(Path::new(&shown), text)?;
            changed.check()?;
            arms.push((arm.name.clone(), changed));
        }
        if arms.is_empty() {
            arms.push((row.id.clone(), loaded.clone()));
        }
        check(&row.draw, &arms).map_err(|problem| ReproduceError::Row { name: name.to_string(), problem })?;
        Ok(Self { row, loaded, arms })
    }

    /// Keeps these arms and their figures; each arm runs as it would together with the others.
    fn keep(&mut self, arms: &[String]) {
        let asked = |name: &String| arms.contains(name);
        self.arms.retain(|(name, _)| asked(name));
        self.row.arms.retain(|a| asked(&a.name));
        let of = |f: &Figure| f.arm.as_ref().is_some_and(asked);
        self.row.figures.retain(of);
        if self.row.arms.is_empty() {
            self.arms.clear();
        }
    }
}

fn embedded(registry: &Registry, name: &str, text: &str) -> Result<Reference, ReproduceError> {
    let row = read(name, text)?;
    let loaded = scenario(registry, name, &row)?;
    Reference::new(name, row, loaded)
}

/// The scenario that comes with the program, whatever files the current folder has.
fn scenario(registry: &Registry, name: &str, row: &Row) -> Result<Loaded, ReproduceError> {
    let template = template(&row.scenario).ok_or_else(|| ReproduceError::Row {
        name: name.to_string(),
        problem: format!("there is no scenario `{}`", row.scenario),
    })?;
    Ok(load_text(registry, template.name, template.text)?)
}

fn read(name: &str, text: &str) -> Result<Row, ScenarioError> {
    rheotaxis::scenario::read(&Registry::default(), name, text, faults)
}

/// What is wrong with a row that could be read.
fn faults(row: &Row) -> Vec<UnplacedFault> {
    let mut found = Vec::new();
    let mut wrong = |path: &str, problem: String| found.push(UnplacedFault::error(path, problem));
    let plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
    if row.id.is_empty() || !row.id.chars().all(plain) {
        wrong("id", format!("must be of a-z, 0-9 and _, got `{}`", row.id));
    }
    if row.figures.is_empty() {
        wrong("figures", "must name at least one".to_string());
    }
    for (i, f) in row.figures.iter().enumerate() {
        let known = |arm: &String| row.arms.iter().any(|a| a.name == *arm);
        match &f.arm {
            None if !row.arms.is_empty() => {
                wrong(&format!("figures[{i}].arm"), "must name one of the row's arms".to_string());
            }
            Some(arm) if !known(arm) => wrong(&format!("figures[{i}].arm"), format!("the row has no arm `{arm}`")),
            _ => {}
        }
        if let Some(problem) = f.quantity.fault() {
            wrong(&format!("figures[{i}].quantity"), problem);
        }
        if let Some(paper) = f.paper.filter(|paper| !paper.is_sound()) {
            let problem =
                format!("must be finite, a count at most its total, and an error or a total above 0, got {paper:?}");
            wrong(&format!("figures[{i}].paper"), problem);
        }
    }
    found
}

#[cfg(test)]
mod tests;
