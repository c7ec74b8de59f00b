//! Numbers that must lie in a legal range. The reader points at the place in the file and states the range.

#![allow(clippy::manual_range_contains, reason = "`contains` cannot be called where a constant is made")]

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Smallest number above zero that a file may give. No quantity of this program is smaller, and its powers do not
/// underflow, in `f32` either.
pub const SMALLEST: f64 = 1e-18;
/// Largest number that a file may give; its powers do not overflow. Physics narrows many ranges: see [`crate::limits`].
pub const LARGEST: f64 = 1e18;

/// A number as a person would write it.
pub fn shown(v: f64) -> String {
    let size = v.abs();
    if size != 0.0 && !(1e-4..1e7).contains(&size) { format!("{v:e}") } else { format!("{v}") }
}

macro_rules! ranged {
    ($($(#[$doc:meta])* $name:ident: $says:literal, $bounds:literal, $schema:tt, |$v:ident| $ok:expr, |$w:ident| $within:expr;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, PartialOrd, Serialize, Deserialize)]
        #[serde(try_from = "f64", into = "f64")]
        pub struct $name(f64);

        impl $name {
            /// The number.
            #[inline]
            pub const fn get(self) -> f64 {
                self.0
            }

            /// A default in code.
            ///
            /// # Panics
            /// If the number is out of range: a mistake in the code, not in a file.
            pub const fn new($v: f64) -> Self {
                assert!($ok, $says);
                let $w = $v;
                assert!($within, $bounds);
                Self($v)
            }
        }

        impl TryFrom<f64> for $name {
            type Error = String;
            fn try_from($v: f64) -> Result<Self, String> {
                if !($ok) {
                    return Err(format!(concat!($says, ", got {}"), shown($v)));
                }
                let $w = $v;
                if $within { Ok(Self($v)) } else { Err(format!(concat!($bounds, ", got {:e}"), $v)) }
            }
        }

        impl From<$name> for f64 {
            fn from(v: $name) -> f64 {
                v.0
            }
        }

        /// Inline: a number and its bounds.
        impl JsonSchema for $name {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                json_schema!($schema)
            }
        }
    )*};
}

ranged! {
    /// Any finite number of either sign up to [`LARGEST`].
    Finite: "must be a finite number", "must be from -1e18 to 1e18",
        { "type": "number", "minimum": -LARGEST, "maximum": LARGEST },
        |v| v.is_finite(), |v| v <= LARGEST && v >= -LARGEST;
    /// Greater than zero, from [`SMALLEST`] to [`LARGEST`].
    Positive: "must be > 0", "must be from 1e-18 to 1e18",
        { "type": "number", "exclusiveMinimum": 0.0, "maximum": LARGEST },
        |v| v > 0.0 && v.is_finite(), |v| v >= SMALLEST && v <= LARGEST;
    /// Zero, or from [`SMALLEST`] to [`LARGEST`].
    NonNegative: "must be >= 0", "must be 0 or from 1e-18 to 1e18",
        { "type": "number", "minimum": 0.0, "maximum": LARGEST },
        |v| v >= 0.0 && v.is_finite(), |v| v == 0.0 || (v >= SMALLEST && v <= LARGEST);
    /// From 0 to 1.
    Fraction: "must be from 0 to 1", "must be from 0 to 1",
        { "type": "number", "minimum": 0.0, "maximum": 1.0 },
        |v| v >= 0.0 && v <= 1.0, |v| v <= 1.0;
    /// A compass direction in degrees.
    HeadingDeg: "must be a heading from 0 to 360 degrees", "must be a heading from 0 to 360 degrees",
        { "type": "number", "minimum": 0.0, "maximum": 360.0, "x-unit": "degrees" },
        |v| v >= 0.0 && v <= 360.0, |v| v <= 360.0;
}

impl HeadingDeg {
    /// The same direction as a [`Heading`](crate::units::Heading).
    pub fn heading(self) -> crate::units::Heading {
        crate::units::Heading::from_deg(self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_powers_would_make_infinite_or_zero_is_refused_with_the_range() {
        assert_eq!(Positive::try_from(1e154), Err("must be from 1e-18 to 1e18, got 1e154".into()));
        assert_eq!(Positive::try_from(5e-324), Err("must be from 1e-18 to 1e18, got 5e-324".into()));
        assert_eq!(NonNegative::try_from(1e-300), Err("must be 0 or from 1e-18 to 1e18, got 1e-300".into()));
        assert_eq!(Finite::try_from(-1e39), Err("must be from -1e18 to 1e18, got -1e39".into()));
        assert_eq!(Positive::try_from(-1.0), Err("must be > 0, got -1".into()));
        assert_eq!(Positive::try_from(f64::NAN), Err("must be > 0, got NaN".into()));
        assert_eq!(NonNegative::try_from(0.0).map(NonNegative::get), Ok(0.0));
        assert_eq!(Finite::try_from(1e-300).map(Finite::get), Ok(1e-300));
    }
}
