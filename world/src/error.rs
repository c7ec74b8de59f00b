//! Faults of the space itself, found before a run starts.

/// Setup error.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum WorldError {
    /// A file could not be used.
    #[error("{path}{place}: {problem}")]
    File {
        /// The file.
        path: String,
        /// Where in it, beginning with a colon (":12", ": triangle 3"); empty for the file as a whole.
        place: String,
        /// What is wrong, and what would be right.
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
