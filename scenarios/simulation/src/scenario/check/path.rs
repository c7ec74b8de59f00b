//! Paths and names in findings, which all checks share.

use crate::scenario::fault::UnplacedFault;
use crate::scenario::id::Id;
use robots::error::RobotError;

/// An error of a part of a robot or gantry, with the path from the scenario's root.
pub(super) fn robot_error(robot: &str, part: &str, error: RobotError) -> UnplacedFault {
    match error {
        RobotError::File { .. } => UnplacedFault::error(format!("{robot}.{part}.urdf"), error.to_string())
            .hint("paths are relative to the scenario file"),
        RobotError::Invalid { field, problem } => UnplacedFault::error(within(robot, part, &field), problem),
    }
}

/// Checks names that become parts of keys and file names.
pub(super) fn names(list: &str, ids: &[&str], found: &mut Vec<UnplacedFault>) {
    for (i, id) in ids.iter().enumerate() {
        if let Err(problem) = Id::try_from((*id).to_string()) {
            found.push(UnplacedFault::error(format!("{list}[{i}].id"), problem));
        }
    }
}

/// Checks that no two things of a list have the same name.
pub(super) fn twins(list: &str, ids: &[&str], found: &mut Vec<UnplacedFault>) {
    for (i, id) in ids.iter().enumerate() {
        if let Some(twin) = ids[..i].iter().position(|other| other == id) {
            found.push(UnplacedFault::error(
                format!("{list}[{i}].id"),
                format!("\"{id}\" is already the name of {list}[{twin}]"),
            ));
        }
    }
}

/// The path of a part's field from the scenario's root. Parts name their fields by as much of the path as they know.
pub(super) fn within(whole: &str, part: &str, field: &str) -> String {
    // A variant (`OpenLoop` in `strategy.OpenLoop.table`) is a value and no part of a path.
    let fields = field.split('.').filter(|f| !f.starts_with(|c: char| c.is_ascii_uppercase()));
    let field = fields.collect::<Vec<_>>().join(".");
    let list = whole.split('[').next().unwrap_or(whole);
    if field.starts_with(&format!("{list}[")) {
        field
    } else if field.is_empty() {
        format!("{whole}.{part}")
    } else if field == part || field.starts_with(&format!("{part}.")) {
        format!("{whole}.{field}")
    } else {
        format!("{whole}.{part}.{field}")
    }
}
