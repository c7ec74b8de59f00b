//! Parameters of the search for objects in a sidescan picture.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::ranges::Positive;

/// When a bright return with a shadow behind it counts as an object.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct DetectSpec {
    /// Least contrast of highlight over shadow, in standard errors of the bed's own speckle.
    #[default(Positive::new(12.0))]
    pub contrast: Positive,
    /// The highlight is at least this much above the bed around it, dB.
    #[default(Positive::new(4.0))]
    pub highlight_db: Positive,
    /// The shadow is at least this much below the bed around it, dB.
    #[default(Positive::new(3.0))]
    pub shadow_db: Positive,
    /// Least width and length of the highlight, m.
    #[default(Positive::new(0.3))]
    pub least_m: Positive,
    /// Greatest width and length of it, m.
    #[default(Positive::new(5.0))]
    pub most_m: Positive,
    /// Objects of two passes nearer to each other than this are the same, m; navigation fixes occur between passes.
    #[default(Positive::new(12.0))]
    pub merge_m: Positive,
}
