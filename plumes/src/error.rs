//! Faults of water or sources, found before a run starts.

/// Setup error, with the field it concerns.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlumeError {
    /// A field is outside what the model can do.
    #[error("{field}: {problem}")]
    Invalid {
        /// Path of the field, as in the scenario file.
        field: String,
        /// What is wrong and what would be legal.
        problem: String,
    },
}

impl PlumeError {
    /// A field that is outside what the model can do, and what would be legal.
    pub(crate) fn new(field: impl Into<String>, problem: impl Into<String>) -> Self {
        Self::Invalid { field: field.into(), problem: problem.into() }
    }
}
