//! What a type finds wrong with its value, on the way to the format that knows the place.

use serde::de::{Error, Expected, Unexpected};
use std::fmt::{self, Display};

/// An error of serde, by its kind. In a box, for every value that is read may be one.
#[derive(Debug)]
pub(super) struct SourceError(Box<Fault>);

#[derive(Debug)]
enum Fault {
    Custom(String),
    InvalidType { unexpected: String, expected: String },
    InvalidValue { unexpected: String, expected: String },
    UnknownVariant(String, &'static [&'static str]),
    UnknownField(String, &'static [&'static str]),
    MissingField(&'static str),
    DuplicateField(&'static str),
}

impl SourceError {
    /// A format has not failed, and has given nothing.
    #[cold]
    pub(super) fn nothing_given() -> Self {
        Fault::Custom("no value".to_string()).into()
    }

    /// The same error of another format.
    pub(super) fn into_other<E: Error>(self) -> E {
        match *self.0 {
            Fault::Custom(said) => E::custom(said),
            Fault::InvalidType { unexpected, expected } => {
                E::invalid_type(Unexpected::Other(&unexpected), &expected.as_str())
            }
            Fault::InvalidValue { unexpected, expected } => {
                E::invalid_value(Unexpected::Other(&unexpected), &expected.as_str())
            }
            Fault::UnknownVariant(name, legal) => E::unknown_variant(&name, legal),
            Fault::UnknownField(name, legal) => E::unknown_field(&name, legal),
            Fault::MissingField(name) => E::missing_field(name),
            Fault::DuplicateField(name) => E::duplicate_field(name),
        }
    }
}

impl From<Fault> for SourceError {
    fn from(fault: Fault) -> Self {
        Self(Box::new(fault))
    }
}

impl Error for SourceError {
    fn custom<T: Display>(said: T) -> Self {
        Fault::Custom(said.to_string()).into()
    }

    fn invalid_type(unexpected: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Fault::InvalidType { unexpected: unexpected.to_string(), expected: expected.to_string() }.into()
    }

    fn invalid_value(unexpected: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Fault::InvalidValue { unexpected: unexpected.to_string(), expected: expected.to_string() }.into()
    }

    fn unknown_variant(variant: &str, legal: &'static [&'static str]) -> Self {
        Fault::UnknownVariant(variant.to_string(), legal).into()
    }

    fn unknown_field(field: &str, legal: &'static [&'static str]) -> Self {
        Fault::UnknownField(field.to_string(), legal).into()
    }

    fn missing_field(field: &'static str) -> Self {
        Fault::MissingField(field).into()
    }

    fn duplicate_field(field: &'static str) -> Self {
        Fault::DuplicateField(field).into()
    }
}

impl Display for SourceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &*self.0 {
            Fault::Custom(said) => f.write_str(said),
            Fault::InvalidType { unexpected, expected } => write!(f, "invalid type: {unexpected}, expected {expected}"),
            Fault::InvalidValue { unexpected, expected } => {
                write!(f, "invalid value: {unexpected}, expected {expected}")
            }
            Fault::UnknownVariant(name, _) => write!(f, "unknown variant `{name}`"),
            Fault::UnknownField(name, _) => write!(f, "unknown field `{name}`"),
            Fault::MissingField(name) => write!(f, "missing field `{name}`"),
            Fault::DuplicateField(name) => write!(f, "duplicate field `{name}`"),
        }
    }
}

impl std::error::Error for SourceError {}
