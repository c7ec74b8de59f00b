//! What a type finds wrong with its value, on the way to the format that knows the place.

use serde::de::{Error, Expected, Unexpected};
use std::fmt::{self, Display};

/// An error of serde, by its kind.
#[derive(Debug)]
pub(super) enum SourceError {
    Custom(String),
    InvalidType {
        unexpected: String,
        expected: String,
    },
    InvalidValue {
        unexpected: String,
        expected: String,
    },
    UnknownVariant(String, &'static [&'static str]),
    UnknownField(String, &'static [&'static str]),
    MissingField(&'static str),
    DuplicateField(&'static str),
}

impl SourceError {
    /// The same error of another format.
    pub(super) fn into_other<E: Error>(self) -> E {
        match self {
            Self::Custom(said) => E::custom(said),
            Self::InvalidType {
                unexpected,
                expected,
            } => E::invalid_type(Unexpected::Other(&unexpected), &expected.as_str()),
            Self::InvalidValue {
                unexpected,
                expected,
            } => E::invalid_value(Unexpected::Other(&unexpected), &expected.as_str()),
            Self::UnknownVariant(name, legal) => E::unknown_variant(&name, legal),
            Self::UnknownField(name, legal) => E::unknown_field(&name, legal),
            Self::MissingField(name) => E::missing_field(name),
            Self::DuplicateField(name) => E::duplicate_field(name),
        }
    }
}

impl Error for SourceError {
    fn custom<T: Display>(said: T) -> Self {
        Self::Custom(said.to_string())
    }

    fn invalid_type(unexpected: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::InvalidType {
            unexpected: unexpected.to_string(),
            expected: expected.to_string(),
        }
    }

    fn invalid_value(unexpected: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::InvalidValue {
            unexpected: unexpected.to_string(),
            expected: expected.to_string(),
        }
    }

    fn unknown_variant(variant: &str, legal: &'static [&'static str]) -> Self {
        Self::UnknownVariant(variant.to_string(), legal)
    }

    fn unknown_field(field: &str, legal: &'static [&'static str]) -> Self {
        Self::UnknownField(field.to_string(), legal)
    }

    fn missing_field(field: &'static str) -> Self {
        Self::MissingField(field)
    }

    fn duplicate_field(field: &'static str) -> Self {
        Self::DuplicateField(field)
    }
}

impl Display for SourceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Custom(said) => f.write_str(said),
            Self::InvalidType {
                unexpected,
                expected,
            } => write!(f, "invalid type: {unexpected}, expected {expected}"),
            Self::InvalidValue {
                unexpected,
                expected,
            } => {
                write!(f, "invalid value: {unexpected}, expected {expected}")
            }
            Self::UnknownVariant(name, _) => write!(f, "unknown variant `{name}`"),
            Self::UnknownField(name, _) => write!(f, "unknown field `{name}`"),
            Self::MissingField(name) => write!(f, "missing field `{name}`"),
            Self::DuplicateField(name) => write!(f, "duplicate field `{name}`"),
        }
    }
}

impl std::error::Error for SourceError {}
