//! Why a value could not be read, and which.

use std::fmt::Display;

/// A value could not be read.
#[derive(Clone, Debug)]
pub(super) struct Fail {
    /// Which; known from the innermost on.
    pub at: Option<usize>,
    /// Why.
    pub what: What,
}

/// Why a value could not be read.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum What {
    /// A type refuses the value, in its own words.
    Refused(String),
    /// Something of another kind belongs here.
    Wanted(String),
    /// There is no such field.
    Field(String, &'static [&'static str]),
    /// A field is missing; `0`: the value in a choice's parentheses.
    Missing(&'static str),
    /// A field is given twice.
    Twice(&'static str),
    /// There is no such choice.
    Variant(String, &'static [&'static str]),
    /// A choice is meant, and its name is missing.
    Unnamed(&'static [&'static str]),
    /// A choice needs parentheses.
    Parentheses(String),
    /// A choice has no parentheses.
    Bare(String),
    /// A value without its field's name.
    Nameless {
        /// Its place among the values.
        place: usize,
        /// The fields there are.
        legal: &'static [&'static str],
    },
    /// A value has a name where none belongs.
    Named(String),
}

impl Fail {
    /// About this value, if it is not about one within it.
    pub(super) fn at(mut self, id: usize) -> Self {
        self.at.get_or_insert(id);
        self
    }

    fn new(what: What) -> Self {
        Self { at: None, what }
    }
}

impl Display for Fail {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:?}", self.what)
    }
}

impl std::error::Error for Fail {}

impl serde::de::Error for Fail {
    fn custom<T: Display>(message: T) -> Self {
        Self::new(What::Refused(message.to_string()))
    }

    fn invalid_type(_: serde::de::Unexpected<'_>, expected: &dyn serde::de::Expected) -> Self {
        Self::new(What::Wanted(format!("expected {expected}")))
    }

    fn invalid_value(_: serde::de::Unexpected<'_>, expected: &dyn serde::de::Expected) -> Self {
        let expected = expected.to_string();
        Self::new(What::Wanted(if expected.contains("nonzero") {
            "must be at least 1".to_string()
        } else {
            format!("expected {expected}")
        }))
    }

    fn unknown_variant(variant: &str, legal: &'static [&'static str]) -> Self {
        Self::new(What::Variant(variant.to_string(), legal))
    }

    fn unknown_field(field: &str, legal: &'static [&'static str]) -> Self {
        Self::new(What::Field(field.to_string(), legal))
    }

    fn missing_field(field: &'static str) -> Self {
        Self::new(What::Missing(field))
    }

    fn duplicate_field(field: &'static str) -> Self {
        Self::new(What::Twice(field))
    }
}
