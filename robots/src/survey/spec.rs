//! Parameters of the search for objects in a sidescan picture.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::ranges::Positive;

/// When a bright return with a shadow behind it counts as an object.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DetectSpec {
    /// Least contrast of highlight over shadow, in standard errors of the bed's own speckle.
    pub contrast: Positive,
    /// The highlight is at least this much above the bed around it, dB.
    pub highlight_db: Positive,
    /// The shadow is at least this much below the bed around it, dB.
    pub shadow_db: Positive,
    /// Least width and length of the highlight, m.
    pub least_m: Positive,
    /// Greatest width and length of it, m.
    pub most_m: Positive,
    /// Objects of two passes nearer to each other than this are the same, m; navigation fixes occur between passes.
    pub merge_m: Positive,
}

impl Default for DetectSpec {
    fn default() -> Self {
        Self {
            contrast: Positive::new(12.0),
            highlight_db: Positive::new(4.0),
            shadow_db: Positive::new(3.0),
            least_m: Positive::new(0.3),
            most_m: Positive::new(5.0),
            merge_m: Positive::new(12.0),
        }
    }
}
