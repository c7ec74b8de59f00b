//! Failures to read a value: which value, and why.

use super::scalar;
use super::tree::WantedKind;
use std::fmt::{self, Display};

/// A value could not be read.
#[derive(Clone, Debug)]
pub(super) struct Fail {
    /// Which value. The innermost reader that knows it sets it.
    pub at: Option<usize>,
    /// Why.
    pub what: What,
}

/// Why a value could not be read.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum What {
    /// A type refuses the value, in its own words.
    Refused(Refusal),
    /// Something of another kind belongs here.
    Misfit(Misfit),
    /// There is no such field.
    Field(String, &'static [&'static str]),
    /// A field is missing; `0`: the value in a choice's parentheses.
    Missing(&'static str),
    /// A field is given twice.
    Twice(&'static str),
    /// There is no such choice.
    Variant(String, &'static [&'static str]),
    /// The name of a choice is missing.
    Unnamed(&'static [&'static str]),
    /// A choice needs parentheses.
    Parentheses(String),
    /// A choice has no parentheses.
    Bare(String),
    /// A value lacks the name of its field.
    Nameless {
        /// Its index among the values.
        place: usize,
        /// The fields there are.
        legal: &'static [&'static str],
    },
    /// A value has a name, and none belongs there.
    Named(String),
}

/// A type's own words about a value that it refuses. serde passes them on as text, `must be > 0, got -1`; they are
/// taken apart here and nowhere else.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Refusal {
    /// What is legal.
    pub legal: String,
    /// What was found, if the type says it.
    pub got: Option<String>,
}

impl Refusal {
    fn parse(said: &str) -> Self {
        let (legal, got) = match said.rsplit_once(", got ") {
            Some((legal, got)) => (legal, Some(got)),
            None => (said, None),
        };
        Self { legal: legal.to_string(), got: got.map(str::to_string) }
    }

    /// The legal range, if it has two ends.
    pub(super) fn bounds(&self) -> Option<(f64, f64)> {
        scalar::bounds(&self.legal)
    }

    /// Whether the value is a number without being finite.
    pub(super) fn is_not_finite(&self) -> bool {
        let got = self.got.as_ref().and_then(|got| got.parse::<f64>().ok());
        got.is_some_and(|v| !v.is_finite())
    }
}

impl Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.got {
            Some(got) => write!(f, "{}, got {got}", self.legal),
            None => f.write_str(&self.legal),
        }
    }
}

/// Why what stands in a place does not fit there.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Misfit {
    /// Something of this kind belongs there.
    Kind(WantedKind),
    /// The same, in the words of the type that is read.
    Said(String),
    /// So many values belong in the parentheses, and there are others.
    Count {
        /// How many belong there.
        wanted: usize,
        /// How many there are.
        got: usize,
    },
    /// Fields have a name before their parentheses.
    Name(String),
    /// A number has a fraction.
    Fraction,
    /// A number is zero.
    Zero,
    /// A text has an escape that RON does not know.
    Escape(char),
}

impl Misfit {
    /// Whether its words say the whole legal range.
    pub(super) fn says_range(&self) -> bool {
        matches!(self, Misfit::Kind(WantedKind::Whole(..)) | Misfit::Zero)
    }

    /// The legal range, if it has two ends.
    pub(super) fn bounds(&self) -> Option<(f64, f64)> {
        match self {
            Misfit::Kind(WantedKind::Whole(least, most)) => Some((*least as f64, *most as f64)),
            _ => None,
        }
    }
}

impl Display for Misfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Misfit::Kind(WantedKind::Plain(kind)) => write!(f, "expected {kind}"),
            Misfit::Kind(WantedKind::Whole(least, most)) => {
                write!(f, "must be a whole number from {least} to {most}")
            }
            Misfit::Kind(WantedKind::Fields) => f.write_str("expected fields in parentheses"),
            Misfit::Kind(WantedKind::Tuple(n)) => write!(f, "expected {n} values in parentheses"),
            Misfit::Kind(WantedKind::List) => f.write_str("expected a list in square brackets"),
            Misfit::Kind(WantedKind::Choice(_)) => f.write_str("expected the name of a choice"),
            Misfit::Said(words) => write!(f, "expected {words}"),
            Misfit::Count { wanted, got } => {
                write!(f, "expected {wanted} values in parentheses, not {got}")
            }
            Misfit::Name(name) => {
                write!(f, "expected fields in parentheses without the name `{name}`")
            }
            Misfit::Fraction => f.write_str("must be a whole number"),
            Misfit::Zero => f.write_str("must be at least 1"),
            Misfit::Escape(escape) => write!(f, "the text has the unknown escape `\\{escape}`"),
        }
    }
}

impl Fail {
    /// Sets the value that the failure is about, unless it is about one inside it.
    pub(super) fn about(mut self, id: usize) -> Self {
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
        Self::new(What::Refused(Refusal::parse(&message.to_string())))
    }

    fn invalid_type(_: serde::de::Unexpected<'_>, expected: &dyn serde::de::Expected) -> Self {
        Self::new(What::Misfit(Misfit::Said(expected.to_string())))
    }

    fn invalid_value(_: serde::de::Unexpected<'_>, expected: &dyn serde::de::Expected) -> Self {
        let expected = expected.to_string();
        // serde's whole numbers without zero say so in their name, and in no other way.
        Self::new(What::Misfit(if expected.contains("nonzero") { Misfit::Zero } else { Misfit::Said(expected) }))
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
