//! What a map cannot know of flow and source: one map for each of a few possibilities, weighted by what they predict.
//!
//! *Source*: five errors of the flow and their weights: Julier & Uhlmann 1997, Proc. SPIE 3068, 182 (unscented
//! transform of two dimensions, κ = 1: mean, covariance and fourth moments of the Gaussian). Weights of models from
//! what each predicted, with forgetting: Raftery, Kárný & Ettler 2010, Technometrics 52, 52, eqs. 15 and 16 (dynamic
//! model averaging).
//!
//! *Parameters*: standard deviation of the flow's error in each horizontal axis, `flow_m_s`; how long an error lasts,
//! `flow_lasts_s`; possible strengths of the source, `strengths`.
//!
//! *Deviations*: none of the mappers' papers has this. `TrajectorySpec::flow_error_m_s` is an error that each release
//! has for itself: it widens the plume. This one is an error u that all have: it moves the plume as a whole, the place
//! of a release by u times its age. The papers' source makes one release in a time unit; of a stronger one dye is met
//! farther aside, and a map that does not know of it takes a near source for a far one. Each map believes that one
//! possibility held all along; the belief is their mean, weighted by w_j Z_j, where Z_j is the probability that map j
//! gave to all readings. With `flow_lasts_s` T the logarithm of Z_j decays by exp(−Δt/T), as the error that a map
//! stands for does. Raftery's forgetting goes towards equal weights, ours towards those of the possibilities.
//! `Bayesian` makes its likelihoods of detections sum to 1 in every map, so its weights come from readings without
//! detection alone.

use super::evidence::DoubtSpec;
use crate::error::RobotError;
use crate::handoff::{Belief, Outlook, WaysAhead};
use crate::map::log_belief::LogBelief;
use crate::map::mapper::Mapper;
use crate::map::watch::MapObservation;
use nalgebra::Vector2;
use std::sync::Arc;
use world::math;
use world::ranges::Positive;

/// √3.
const FAR: f64 = 1.732_050_807_568_877_2;
/// The errors in standard deviations along the map's axes, and their weights.
const NODES: [([f64; 2], f64); 5] = [
    ([0.0, 0.0], 1.0 / 3.0),
    ([FAR, 0.0], 1.0 / 6.0),
    ([-FAR, 0.0], 1.0 / 6.0),
    ([0.0, FAR], 1.0 / 6.0),
    ([0.0, -FAR], 1.0 / 6.0),
];

impl DoubtSpec {
    /// How many maps are kept.
    pub(in crate::map) fn maps(&self) -> usize {
        self.errors().len() * self.strengths.len().max(1)
    }

    /// Errors of the flow, in standard deviations, with their weights.
    fn errors(&self) -> &'static [([f64; 2], f64)] {
        let flow = self.flow_m_s.get() > 0.0;
        if flow { &NODES } else { &NODES[..1] }
    }
}

/// A map that believes in one possibility.
#[derive(Debug)]
struct Member {
    mapper: Box<dyn Mapper>,
    /// The flow's error (east, north), m/s.
    flow: Vector2<f64>,
    ln_prior: f64,
    /// Logarithm of Z_j, with forgetting, and of that without at the last update.
    ln_weight: f64,
    told: f64,
}

/// State of the mapper.
#[derive(Debug)]
pub(in crate::map) struct Alternatives {
    members: Vec<Member>,
    lasts_s: Option<f64>,
    belief: LogBelief,
    updates: u64,
    mass: Vec<f64>,
}

impl Alternatives {
    /// A mapper as `make` makes it of these doubts, or one for each possibility if there are several.
    ///
    /// # Errors
    /// Those of `make`.
    pub(in crate::map) fn around(
        doubt: &DoubtSpec,
        make: impl Fn(&DoubtSpec) -> Result<Box<dyn Mapper>, RobotError>,
    ) -> Result<Box<dyn Mapper>, RobotError> {
        if doubt.maps() == 1 {
            return make(doubt);
        }
        let u = doubt.flow_m_s.get();
        let mut members = Vec::new();
        let strengths: Vec<Vec<Positive>> = match doubt.strengths.as_slice() {
            [] => vec![Vec::new()],
            some => some.iter().map(|s| vec![*s]).collect(),
        };
        // All strengths must be legal before one of them is taken.
        make(doubt)?;
        for strengths in strengths {
            let one = DoubtSpec { strengths, ..doubt.clone() };
            for (at, weight) in doubt.errors() {
                let mapper = make(&one)?;
                let axes = mapper.belief().grid.axes;
                members.push(Member {
                    flow: (axes[0] * at[0] + axes[1] * at[1]) * u,
                    mapper,
                    ln_prior: math::ln(*weight),
                    ln_weight: 0.0,
                    told: 0.0,
                });
            }
        }
        let grid = members[0].mapper.belief().grid.clone();
        Ok(Box::new(Self {
            lasts_s: doubt.flow_lasts_s.map(Positive::get),
            mass: vec![0.0; grid.len()],
            belief: LogBelief::uniform(&grid),
            updates: 0,
            members,
        }))
    }

    /// Weights of the maps after an update `dt` after the one before.
    fn weigh(&mut self, dt: f64) -> Vec<f64> {
        let keep = self.lasts_s.map_or(1.0, |t| math::exp(-dt / t));
        for m in &mut self.members {
            let told = m.mapper.ln_evidence();
            m.ln_weight = keep * m.ln_weight + told - m.told;
            m.told = told;
        }
        let of = |m: &Member| m.ln_prior + m.ln_weight;
        let most = self.members.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        let weights: Vec<f64> = (self.members.iter()).map(|m| math::exp(of(m) - most)).collect();
        let total: f64 = weights.iter().sum();
        weights.iter().map(|w| w / total).collect()
    }
}

impl Mapper for Alternatives {
    fn step(&mut self, seen: &MapObservation) {
        for m in &mut self.members {
            m.mapper.step(&MapObservation { flow: seen.flow.map(|v| v + m.flow), ..*seen });
        }
        let first = self.members[0].mapper.belief();
        if first.updates == self.updates {
            return;
        }
        self.updates = first.updates;
        let (t_s, informed, odour) = (first.t_s, first.informed, first.odour.clone());
        let weights = self.weigh(t_s - self.belief.belief().t_s);
        self.mass.fill(0.0);
        for (m, w) in self.members.iter().zip(weights) {
            for (mass, p) in self.mass.iter_mut().zip(m.mapper.belief().p.iter()) {
                *mass += w * p;
            }
        }
        self.belief.replace(t_s, informed, &self.mass);
        if let Some(odour) = odour {
            self.belief.say(Arc::unwrap_or_clone(odour));
        }
    }

    fn belief(&self) -> &Belief {
        self.belief.belief()
    }

    /// That of the most credible possibility.
    fn outlook(&mut self, ways: &WaysAhead) -> Option<Outlook> {
        let credible = |m: &Member| m.ln_prior + m.ln_weight;
        let most = self.members.iter_mut().max_by(|a, b| credible(a).total_cmp(&credible(b)))?;
        most.mapper.outlook(ways)
    }

    fn ln_evidence(&self) -> f64 {
        let all = self.members.iter().map(|m| m.ln_prior + m.told);
        let most = all.clone().fold(f64::NEG_INFINITY, f64::max);
        most + math::ln(all.map(|v| math::exp(v - most)).sum::<f64>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_errors_have_the_gaussians_moments() {
        let mean = |f: &dyn Fn([f64; 2]) -> f64| -> f64 { NODES.iter().map(|(u, w)| w * f(*u)).sum() };
        for (got, want) in [
            (mean(&|_| 1.0), 1.0),
            (mean(&|u| u[0]), 0.0),
            (mean(&|u| u[0] * u[1]), 0.0),
            (mean(&|u| u[0] * u[0]), 1.0),
            (mean(&|u| u[1] * u[1]), 1.0),
            (mean(&|u| u[0].powi(4)), 3.0),
        ] {
            assert!((got - want).abs() < 1e-12, "{got} {want}");
        }
    }
}
