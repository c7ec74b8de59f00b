//! Which of many drawn variants of a scenario give the figures that a paper prints.
//!
//! *Source*: approximate Bayesian computation whose kernel is the sampling error of the figures themselves (Wilkinson
//! 2013, Stat. Appl. Genet. Mol. Biol. 12, 129), so that a weight is a likelihood of synthetic summaries (Wood 2010,
//! Nature 466, 1102; Price et al. 2018, J. Comput. Graph. Stat. 27, 1). In rounds: what a first few trials leave
//! possible gets more (Toni et al. 2009, J. R. Soc. Interface 6, 187).
//!
//! *Parameters*: [`LOST`], the weight that a further round may lose; [`LEAST`], the share of draws that it has at least,
//! because a few trials rank draws badly.
//!
//! *Deviations*: figures count as independent of each other given the draw; whether all come out together is asked of
//! fresh runs, jointly (see [`joint`](crate::reproduce::joint)).

mod draws;
mod marginal;
mod next;
mod pairs;
mod write;

pub use draws::{Draw, Draws, Unknown};
pub use next::next_round;
pub use write::{IdentificationText, text, write};

use crate::campaign::stats::Interval;
use crate::reproduce::Published;
use marginal::{Marginal, marginals};
use world::math;

/// Share of the weight that the draws may have which a further round leaves out.
const LOST: f64 = 1e-3;
/// Share of the draws that a further round has at least.
const LEAST: f64 = 0.1;

/// What the figures say about the draws.
#[derive(Clone, Debug)]
pub struct Identification {
    /// The figures.
    pub figures: Vec<Published>,
    /// The draws, the likeliest first.
    pub draws: Vec<WeightedDraw>,
    /// What is known of each unknown.
    pub marginals: Vec<Marginal>,
    /// Number of draws that would say as much if all had the same weight (Kish).
    pub effective: f64,
}

/// A draw and what speaks for it.
#[derive(Clone, Debug)]
pub struct WeightedDraw {
    /// The draw.
    pub draw: Draw,
    /// Its share of the weight of all.
    pub weight: f64,
    /// Logarithm of its likelihood.
    pub ln_likelihood: f64,
    /// Its own value of each figure, and the figure's with the sampling error of both (95 %).
    pub figures: Vec<(Option<f64>, Option<Interval>)>,
}

/// Weighs draws by the figures.
pub fn identify(draws: Draws, figures: &[Published]) -> Identification {
    let spreads: Vec<f64> = {
        let usual = |f: &Published| f.usual_spread(draws.draws.iter().map(|d| d.runs.as_slice()));
        figures.iter().map(usual).collect()
    };
    let of = |draw: Draw| {
        let each: Vec<_> = figures.iter().zip(&spreads).map(|(f, s)| f.fit(&draw.runs, *s)).collect();
        let ln_likelihood = each.iter().map(|fit| fit.ln_likelihood).sum();
        let figures = each.into_iter().map(|fit| (fit.ours, fit.papers)).collect();
        WeightedDraw { draw, weight: 0.0, ln_likelihood, figures }
    };
    let mut weighted: Vec<WeightedDraw> = draws.draws.into_iter().map(of).collect();
    weighted.sort_by(|a, b| b.ln_likelihood.total_cmp(&a.ln_likelihood).then(a.draw.name.cmp(&b.draw.name)));
    let best = weighted.first().map_or(0.0, |d| d.ln_likelihood);
    let mut sum = 0.0;
    for d in &mut weighted {
        d.weight = math::exp(d.ln_likelihood - best);
        sum += d.weight;
    }
    weighted.iter_mut().for_each(|d| d.weight /= sum);
    let squares: f64 = weighted.iter().map(|d| d.weight * d.weight).sum();
    Identification {
        figures: figures.to_vec(),
        marginals: marginals(&draws.unknowns, &weighted),
        draws: weighted,
        effective: 1.0 / squares,
    }
}

#[cfg(test)]
mod tests;
