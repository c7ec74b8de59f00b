//! An instrument that a part of a robot needs on board.

/// What a part of a robot needs, as far as its parameters tell.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Need {
    /// The field that asks for it, below the part that says so; empty if all of the part does.
    pub field: String,
    /// Name of the instrument in `sensors`.
    pub instrument: &'static str,
    /// What the robot cannot do without it: "never knows its heading".
    pub so: &'static str,
    /// Whether the run means nothing without it.
    pub vital: bool,
}

impl Need {
    /// An instrument without which the run means nothing.
    pub fn vital(field: impl Into<String>, instrument: &'static str, so: &'static str) -> Self {
        let field = field.into();
        Self { field, instrument, so, vital: true }
    }

    /// An instrument without which the robot does worse.
    pub fn wish(field: impl Into<String>, instrument: &'static str, so: &'static str) -> Self {
        Self { vital: false, ..Self::vital(field, instrument, so) }
    }

    /// The same as a need of a part within another one, below its field.
    #[must_use]
    pub fn within(mut self, path: &str) -> Self {
        self.field = match (path, self.field.as_str()) {
            ("", field) => field.to_string(),
            (path, "") => path.to_string(),
            (path, field) => format!("{path}.{field}"),
        };
        self
    }
}
