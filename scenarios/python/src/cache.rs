//! The kept spin-ups that a run uses: those of the command, unless it is told otherwise.

use pyo3::exceptions::PyRuntimeWarning;
use pyo3::prelude::*;
use rheotaxis::cache::{CacheFault, MOST, SpinUps};
use std::path::PathBuf;

/// What a caller says about kept spin-ups: `None` or `True` for the user's folder, `False` for none, or a folder.
#[derive(FromPyObject)]
pub(crate) enum Cache {
    /// Whether to use the user's folder.
    Use(bool),
    /// A folder.
    Folder(PathBuf),
}

/// Values of `RHEOTAXIS_NO_CACHE` that do not switch the cache off, as for the command.
const NO: [&str; 7] = ["", "0", "f", "false", "n", "no", "off"];

/// The kept spin-ups to use, if any. As for the command, `RHEOTAXIS_CACHE` names another folder and
/// `RHEOTAXIS_NO_CACHE` switches them off.
pub(crate) fn opened(py: Python<'_>, cache: Option<Cache>) -> PyResult<Option<SpinUps>> {
    let set = |name: &str| std::env::var_os(name);
    let off = set("RHEOTAXIS_NO_CACHE").is_some_and(|v| !NO.contains(&&*v.to_string_lossy().to_lowercase()));
    let kept = match cache {
        Some(Cache::Use(false)) => None,
        Some(Cache::Folder(dir)) => Some(SpinUps::new(dir, MOST)),
        None if off => None,
        _ => match set("RHEOTAXIS_CACHE") {
            Some(dir) => Some(SpinUps::new(dir.into(), MOST)),
            None => SpinUps::of_user(MOST),
        },
    };
    // The program that makes the states is this module, not the interpreter.
    let module = py.import("rheotaxis._rheotaxis")?.getattr("__file__")?;
    let file: PathBuf = module.extract()?;
    Ok(kept.map(|kept| kept.made_by(file)))
}

/// Warns if spin-ups could not be kept; the run went on without.
pub(crate) fn tell_fault(py: Python<'_>, fault: Option<CacheFault>) -> PyResult<()> {
    let category = py.get_type::<PyRuntimeWarning>();
    match fault {
        Some(fault) => super::error::warn(py, &category, &fault.to_string()),
        None => Ok(()),
    }
}
