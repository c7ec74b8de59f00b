//! Numbers that a file may only give within a legal range; the reader points at the place and says the range.

#![allow(
    clippy::manual_range_contains,
    reason = "`contains` cannot be called where a constant is made"
)]

use serde::{Deserialize, Serialize};

macro_rules! ranged {
    ($($(#[$doc:meta])* $name:ident: $says:literal, |$v:ident| $ok:expr;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, PartialOrd, Serialize, Deserialize)]
        #[serde(try_from = "f64", into = "f64")]
        pub struct $name(f64);

        impl $name {
            /// The number.
            #[inline]
            #[must_use]
            pub const fn get(self) -> f64 {
                self.0
            }

            /// A default written in code.
            ///
            /// # Panics
            /// If the number is out of range: a slip in the code, not in a file.
            #[must_use]
            pub const fn new($v: f64) -> Self {
                assert!($ok, $says);
                Self($v)
            }
        }

        impl TryFrom<f64> for $name {
            type Error = String;
            fn try_from($v: f64) -> Result<Self, String> {
                if $ok { Ok(Self($v)) } else { Err(format!(concat!($says, ", got {}"), $v)) }
            }
        }

        impl From<$name> for f64 {
            fn from(v: $name) -> f64 {
                v.0
            }
        }
    )*};
}

ranged! {
    /// Any finite number.
    Finite: "must be a finite number", |v| v.is_finite();
    /// Greater than zero.
    Positive: "must be > 0", |v| v > 0.0 && v.is_finite();
    /// Zero or greater.
    NonNegative: "must be >= 0", |v| v >= 0.0 && v.is_finite();
    /// From 0 to 1.
    Fraction: "must be from 0 to 1", |v| v >= 0.0 && v <= 1.0;
    /// A compass direction in degrees.
    HeadingDeg: "must be a heading from 0 to 360 degrees", |v| v >= 0.0 && v <= 360.0;
}

impl HeadingDeg {
    /// As a heading.
    #[must_use]
    pub fn heading(self) -> crate::units::Heading {
        crate::units::Heading::from_deg(self.0)
    }
}
