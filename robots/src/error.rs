//! What can be wrong with a robot before a run starts.

/// Setup error.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RobotError {
    /// A file could not be read.
    #[error("{path}: {problem}")]
    File {
        /// The file.
        path: String,
        /// What is wrong with it; names the element.
        problem: String,
    },
    /// A field is outside what the model can do.
    #[error("{field}: {problem}")]
    Invalid {
        /// Path of the field, as in the scenario file.
        field: String,
        /// What is wrong, and what would be legal.
        problem: String,
    },
}

impl RobotError {
    /// A field that is wrong.
    pub fn invalid(field: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::Invalid { field: field.into(), problem: problem.into() }
    }
}

/// What must hold for a field.
///
/// # Errors
/// If it does not hold.
pub fn require(holds: bool, field: impl Into<String>, problem: impl Into<String>) -> Result<(), RobotError> {
    if holds { Ok(()) } else { Err(RobotError::invalid(field, problem)) }
}

/// What must hold in a vehicle's files.
///
/// # Errors
/// What is wrong, if it does not hold.
pub(crate) fn ensure(holds: bool, problem: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(problem()) }
}
