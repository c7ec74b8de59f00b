//! The names of machines in a scenario.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Longest name: a file's name of 255 bytes has room for it and for what it is of.
const LONGEST_ID: usize = 64;

/// What a name may be.
const LEGAL_ID: &str = "made of a-z, 0-9 and _, and not empty";

/// A name that can be part of keys and file names.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "String", into = "String")]
#[schemars(extend("pattern" = "^[a-z0-9_]+$", "x-legal" = LEGAL_ID, "maxLength" = LONGEST_ID))]
pub struct Id(String);

impl Id {
    /// The name.
    pub fn as_str(&self) -> &str {
        &self.0
    }
}

impl TryFrom<String> for Id {
    type Error = String;
    fn try_from(s: String) -> Result<Self, String> {
        let fits = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        if s.len() > LONGEST_ID {
            let n = s.len();
            Err(format!("must have at most {LONGEST_ID} characters, because names of files are made of it, got {n}"))
        } else if !s.is_empty() && s.chars().all(fits) {
            Ok(Self(s))
        } else {
            Err(format!("must be {LEGAL_ID}, got {s:?}"))
        }
    }
}

impl From<Id> for String {
    fn from(id: Id) -> String {
        id.0
    }
}
