//! The estimator that a scenario chose.

use super::{DeadReckoning, DeadReckoningSpec, Start};
use crate::handoff::Need;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;

/// Which estimator, with its parameters.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum EstimatorSpec {
    /// Compass, Doppler log and long-baseline jumps.
    #[default]
    DeadReckoning(DeadReckoningSpec),
}

impl EstimatorSpec {
    /// The instruments that it needs to tell heading, place, depth and water layer; paths below `estimator`. The flow
    /// needs an ADCP, too, and the altitude an altimeter, for those who ask for them.
    pub fn needs(&self) -> Vec<Need> {
        let Self::DeadReckoning(spec) = self;
        let mut needs = vec![
            Need::wish("", "compass", "never knows its heading"),
            Need::wish("", "dvl", "never knows how it moves"),
            Need::wish("", "depth", "never knows its depth"),
        ];
        if spec.layer_aware.is_some() {
            let so = "cannot tell water layers apart by their density";
            needs.push(Need::vital("layer_aware", "ctd", so));
        }
        needs
    }

    /// The estimator, which begins at `start` and steps by `dt_s`.
    pub fn build(&self, start: Start, dt_s: f64) -> DeadReckoning {
        let Self::DeadReckoning(spec) = self;
        DeadReckoning::new(spec, start, dt_s)
    }
}

#[cfg(test)]
mod tests {
    /// The types inside a searcher hold no true states, only readings.
    #[test]
    fn no_truth_reaches_the_estimate() {
        for (file, text) in [
            ("dead_reckoning.rs", include_str!("dead_reckoning.rs")),
            ("estimator.rs", include_str!("estimator.rs")),
            ("layers.rs", include_str!("layers.rs")),
            ("readings.rs", include_str!("../handoff/readings.rs")),
            ("estimate.rs", include_str!("../handoff/estimate.rs")),
        ] {
            let code = text.split("#[cfg(test)]").next().unwrap_or_default();
            for word in ["Truth", "world::frames", "world::fields", "world::terrain"] {
                assert!(!code.contains(word), "{file} names {word}");
            }
        }
    }
}
