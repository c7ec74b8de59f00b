//! Files of the user's, and those that come with the program, by name.

use rheotaxis::scenario::{ScenarioError, Template};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use world::files;

/// Longest file read, bytes: these are texts of a few kilobytes.
const LONGEST: u64 = 1 << 20;

/// The text of what comes with the program by this name or, if nothing does, of a file. `what` names such files.
///
/// # Errors
/// If there is neither, or the file cannot be read.
pub(crate) fn text_of(path: &Path, shipped: &[Template], what: &str) -> Result<String, ScenarioError> {
    let shown = path.display().to_string();
    let refused = |problem: String, help: Option<String>| ScenarioError::File { path: shown.clone(), problem, help };
    // First, so that a folder or file that happens to have this name stands for nothing else.
    if let Some(template) = shipped.iter().find(|t| t.name == shown) {
        return Ok(template.text.to_string());
    }
    files::read_text(path, LONGEST).map_err(|e| match e.kind() {
        ErrorKind::NotFound => {
            let names: Vec<&str> = shipped.iter().map(|t| t.name).collect();
            let known = format!("{what} that come with the program: {}", names.join(", "));
            refused("there is no such file".to_string(), Some(known))
        }
        _ => refused(format!("cannot be read: {e}"), None),
    })
}

/// A file that a file beside it names; what is no file there is a name.
pub(crate) fn beside(path: &Path, named: &str) -> PathBuf {
    let beside = path.parent().unwrap_or(Path::new("")).join(named);
    if beside.is_file() { beside } else { PathBuf::from(named) }
}

/// The name of a file without its ending.
pub(crate) fn stem(path: &Path) -> String {
    path.file_stem().map_or_else(|| path.display().to_string(), |s| s.to_string_lossy().into_owned())
}
