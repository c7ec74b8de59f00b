//! Reads scenario files.

use super::catalog;
use super::change::set_value;
use super::check::check_within;
use super::cost;
use super::fault::{Fault, ScenarioError, Severity};
use super::reader;
use super::reader::outline::Outline;
use super::schema::Scenario;
use super::version::version_first;
use ron::extensions::Extensions;
use std::borrow::Cow;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};
use world::digest::Digest;
use world::encoding;
use world::files;
use world::registry::Registry;

/// Longest file that is read, bytes. A scenario has a few kilobytes.
const LONGEST: u64 = 1 << 20;

/// A scenario with the text it was read from.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// What the file says. If it is changed, [`Self::text`] and [`Self::hash`] follow.
    pub scenario: Scenario,
    // What was read, and from which text.
    read: Scenario,
    text: String,
    /// The file, as it was asked for.
    pub path: PathBuf,
    /// Name: the file's name without its ending.
    pub name: String,
    /// Folder to which paths in the scenario are relative.
    pub base_dir: PathBuf,
    /// The registry under which it was read; runs of it take up the systems and topics that this carries.
    pub registry: Registry,
}

impl Loaded {
    fn of_text(
        registry: &Registry,
        path: &Path,
        name: String,
        base_dir: PathBuf,
        text: String,
    ) -> Result<Self, ScenarioError> {
        let scenario = parse_with(registry, &path.display().to_string(), &text)?;
        let (path, registry) = (path.to_path_buf(), registry.clone());
        Ok(Self { read: scenario.clone(), scenario, text, path, name, base_dir, registry })
    }

    /// The text of the file; if the scenario was changed since, its own text, without the comments of the file.
    pub fn text(&self) -> Cow<'_, str> {
        if self.scenario == self.read {
            return Cow::Borrowed(&self.text);
        }
        let pretty = ron::ser::PrettyConfig::new()
            .struct_names(false)
            .extensions(Extensions::IMPLICIT_SOME | Extensions::UNWRAP_VARIANT_NEWTYPES);
        let text = ron::ser::to_string_pretty(&self.scenario, pretty);
        let text = text.expect("a scenario is written as it is read");
        // Files have these extensions without saying so.
        let whole = text.find("\n(").map_or(0, |at| at + 1);
        Cow::Owned(text[whole..].to_owned())
    }

    /// Hash of the text, 32 hexadecimal digits.
    pub fn hash(&self) -> String {
        hash(&self.text())
    }

    /// The same scenario with another text, which errors call by `path`. Paths in it are relative to the same folder.
    ///
    /// # Errors
    /// As [`load`].
    pub fn with_text(&self, path: &Path, text: String) -> Result<Self, ScenarioError> {
        Self::of_text(&self.registry, path, self.name.clone(), self.base_dir.clone(), text)
    }

    /// The same scenario, changed: `loaded.edit(|s| s.time.limit_s = Positive::new(120.0))`.
    pub fn edit(mut self, change: impl FnOnce(&mut Scenario)) -> Self {
        change(&mut self.scenario);
        self
    }

    /// The same scenario with a value (RON) at a path: `loaded.set("robots[0].strategy", "External(period_s: 1)")`.
    ///
    /// # Errors
    /// If the scenario has no such path, or its reader refuses the value.
    pub fn set(&self, path: &str, value: &str) -> Result<Self, ScenarioError> {
        let changed = set_value(&self.text(), path, value).map_err(|problem| ScenarioError::File {
            path: self.path.display().to_string(),
            problem: format!("`{path}` cannot be set: {problem}"),
            help: None,
        })?;
        self.with_text(&self.path, changed)
    }

    /// Checks what the scenario means: see [`check()`](super::check()).
    ///
    /// # Errors
    /// All mistakes that stop a run. If there are none, the warnings are returned.
    pub fn check(&self) -> Result<Vec<Fault>, ScenarioError> {
        let found = check_within(&self.scenario, &self.base_dir, cost::limit(&self.registry));
        let text = self.text();
        let outline = Outline::scan(&text);
        let path = self.path.display().to_string();
        let (faults, mut warnings): (Vec<Fault>, Vec<Fault>) =
            found.into_iter().map(|f| outline.located(&path, &text, f)).partition(|f| f.severity == Severity::Error);
        if faults.is_empty() {
            warnings.sort_by_key(|f| (f.line, f.column));
            Ok(warnings)
        } else {
            Err(ScenarioError::from_faults(&path, faults))
        }
    }
}

/// Reads a scenario file that uses what comes with the program. If there is no such file, reads the scenario of that
/// name that comes with the program.
///
/// # Errors
/// If the file cannot be read or is not a scenario: all its mistakes of form. What it means is checked by
/// [`Loaded::check`].
pub fn load(path: &Path) -> Result<Loaded, ScenarioError> {
    load_with(&Registry::default(), path)
}

/// The same for a scenario that may use what a registry adds.
///
/// # Errors
/// As [`load`].
pub fn load_with(registry: &Registry, path: &Path) -> Result<Loaded, ScenarioError> {
    let shown = path.display().to_string();
    let name = path.file_stem().map_or_else(|| shown.clone(), |s| s.to_string_lossy().into_owned());
    let mut base_dir = path.parent().unwrap_or(Path::new("")).to_path_buf();
    let text = match (read(path), catalog::template(&shown)) {
        (Err(Unread::Missing), Some(template)) => {
            base_dir = template.unpack().map_err(|e| ScenarioError::File {
                path: shown.clone(),
                problem: format!("the files that it refers to cannot be unpacked: {e}"),
                help: Some("they are written to the folder for temporary files".to_string()),
            })?;
            template.text.to_string()
        }
        (Err(Unread::Missing), None) => {
            return Err(ScenarioError::File {
                path: shown,
                problem: "there is no such file".to_string(),
                help: Some(
                    "`rheotaxis list scenarios` names those that come with the program, \
                     `rheotaxis init NAME` writes one to change"
                        .to_string(),
                ),
            });
        }
        (Err(Unread::Other(problem, help)), _) => {
            return Err(ScenarioError::File { path: shown, problem, help: help.map(str::to_string) });
        }
        (Ok(text), _) => text,
    };
    Loaded::of_text(registry, path, name, base_dir, text)
}

/// Reads a scenario from its text, with what a registry adds. Errors call it `name`. Paths in it are relative to the
/// working folder. It serves programs that change the text of a [`template`](super::template).
///
/// # Errors
/// As [`load`].
pub fn load_text(registry: &Registry, name: &str, text: &str) -> Result<Loaded, ScenarioError> {
    load_text_in(registry, name, text, Path::new(""))
}

/// The same with paths relative to `base_dir`.
///
/// # Errors
/// As [`load`].
pub fn load_text_in(registry: &Registry, name: &str, text: &str, base_dir: &Path) -> Result<Loaded, ScenarioError> {
    Loaded::of_text(registry, Path::new(name), name.to_string(), base_dir.to_path_buf(), text.to_string())
}

/// Hash of a scenario's text, 32 hexadecimal digits.
pub fn hash(text: &str) -> String {
    let mut digest = Digest::default();
    digest.text(text);
    digest.hex()
}

/// Reads a scenario from its text, without the files that belong to it; errors call it `name`.
///
/// # Errors
/// If it is not a scenario: all mistakes of form.
pub fn parse(name: &str, text: &str) -> Result<Scenario, ScenarioError> {
    parse_with(&Registry::default(), name, text)
}

/// The same as [`parse`] for a scenario that may use what a registry adds.
///
/// # Errors
/// As [`parse`].
pub fn parse_with(registry: &Registry, name: &str, text: &str) -> Result<Scenario, ScenarioError> {
    let outline = Outline::scan(text);
    if outline.nodes.is_empty() {
        return Err(ScenarioError::File {
            path: name.to_string(),
            problem: "the file is empty, or holds only comments".to_string(),
            help: Some("`rheotaxis init duck_st` writes a whole scenario to start from".to_string()),
        });
    }
    version_first(name, text, &outline)?;
    reader::read(registry, name, text, |_| Vec::new())
}

enum Unread {
    Missing,
    Other(String, Option<&'static str>),
}

fn read(path: &Path) -> Result<String, Unread> {
    let other = |e: std::io::Error| match e.kind() {
        ErrorKind::NotFound => Unread::Missing,
        ErrorKind::PermissionDenied => Unread::Other("may not be read".to_string(), None),
        _ => Unread::Other(format!("cannot be read: {e}"), None),
    };
    if path.is_dir() {
        return Err(Unread::Other("is a folder".to_string(), Some("name the scenario files in it")));
    }
    let mut bytes = Vec::new();
    files::open(path).and_then(|f| f.take(LONGEST + 1).read_to_end(&mut bytes)).map_err(other)?;
    if bytes.len() as u64 > LONGEST {
        return Err(Unread::Other(
            format!("is longer than {} MiB", LONGEST >> 20),
            Some("a scenario is text of a few kilobytes; is this the right file?"),
        ));
    }
    let text = encoding::unmarked(&bytes).to_vec();
    String::from_utf8(text).map_err(|e| {
        let good = e.utf8_error().valid_up_to();
        let line = 1 + e.as_bytes()[..good].iter().filter(|&&b| b == b'\n').count();
        Unread::Other(format!("is not UTF-8 text: line {line}, byte {good}"), Some("save it as UTF-8"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::CATALOG;
    use world::ranges::Positive;

    /// Whatever a program changes, the text is that of what runs.
    #[test]
    fn the_text_of_a_changed_scenario_reads_back_as_it() {
        for template in CATALOG {
            let unpacked = load(Path::new(template.name)).unwrap();
            assert_eq!(unpacked.text(), template.text);
            let mut changed = unpacked.clone();
            changed.scenario.time.limit_s = Positive::new(17.25);
            assert_ne!(changed.hash(), unpacked.hash());
            let back = unpacked.with_text(&unpacked.path, changed.text().into_owned()).unwrap();
            assert_eq!(back.scenario, changed.scenario, "{}", template.name);
            assert_eq!(back.hash(), changed.hash());
        }
    }
}
