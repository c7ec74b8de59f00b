//! The mappers by name.

use super::bayesian::BayesianSpec;
use super::hmm::HmmSpec;
use super::mapper::MapParams;
use super::particle_filter::ParticleFilterSpec;
use super::pomdp::PomdpSpec;
use world::kind;

kind! {
    /// Maps of where the source may be, which a robot updates from detections, silence and flow. Strategies that plan
    /// on a map need one.
    pub MapSpec = Maps of MapParams {
        heading: "Source maps",
        rows: [PomdpSpec, BayesianSpec, HmmSpec, ParticleFilterSpec],
    }
}
