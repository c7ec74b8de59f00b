//! Which of many drawn variants of a scenario come nearest to the figures that a paper prints.
//!
//! *Source*: approximate Bayesian computation by rejection (Beaumont, Zhang & Balding 2002, Genetics 162, 2025): the draws
//! whose runs come nearest to the figures are accepted. In rounds: what a first few trials leave possible gets more
//! (Toni et al. 2009, J. R. Soc. Interface 6, 187).
//!
//! *Parameters*: the share of draws that is accepted, a hundredth; the share that a further round has, a tenth.
//!
//! *Deviations*: a distance is the root of the sum of squares of (ours − the paper's), each over the figure's standard
//! error. So figures count as independent of each other; whether all come out together is asked of fresh runs, jointly
//! (see [`joint`](crate::reproduce::joint)). A draw that lacks a figure, such as a time of runs of which none arrived, is
//! infinitely far away.

mod draws;
mod marginal;
mod next;
mod pairs;
mod write;

pub use draws::{Draw, Draws, Unknown};
pub use next::next_round;
pub use write::{IdentificationText, text, write};

use crate::reproduce::Published;
use marginal::{Marginal, marginals};

/// Share of the draws that is accepted: the nearest.
const ACCEPTED: f64 = 0.01;
/// Share of the draws that a further round has.
const NEXT: f64 = 0.1;

/// What the figures say about the draws.
#[derive(Clone, Debug)]
pub struct Identification {
    /// The figures.
    pub figures: Vec<Published>,
    /// The draws, the nearest first.
    pub draws: Vec<JudgedDraw>,
    /// How many of them are accepted.
    pub accepted: usize,
    /// What is known of each unknown.
    pub marginals: Vec<Marginal>,
}

/// A draw and how near it comes.
#[derive(Clone, Debug)]
pub struct JudgedDraw {
    /// The draw.
    pub draw: Draw,
    /// Its distance from the paper's figures.
    pub distance: f64,
    /// Its own value of each figure.
    pub ours: Vec<Option<f64>>,
}

/// Judges draws by the figures. Only those of the last round are accepted, for their runs are the most.
pub fn identify(draws: Draws, figures: &[Published]) -> Identification {
    let usual = |f: &Published| f.usual_spread(draws.draws.iter().map(|d| d.runs.as_slice()));
    let errors: Vec<f64> = figures.iter().map(|f| f.value_and_error(usual(f)).1).collect();
    let all = draws.draws.len();
    let last = draws.draws.iter().map(|d| d.round).max().unwrap_or(0);
    let judge = |draw: Draw| {
        let ours: Vec<Option<f64>> = figures.iter().map(|f| f.mean(&draw.runs)).collect();
        let each = figures.iter().zip(&errors).zip(&ours);
        let squares = each.map(|((f, error), ours)| ours.map_or(f64::INFINITY, |v| (f.short_by(v) / error).powi(2)));
        let distance = if draw.round == last { squares.sum::<f64>().sqrt() } else { f64::INFINITY };
        JudgedDraw { draw, distance, ours }
    };
    let mut judged: Vec<JudgedDraw> = draws.draws.into_iter().map(judge).collect();
    judged.sort_by(|a, b| a.distance.total_cmp(&b.distance).then(a.draw.name.cmp(&b.draw.name)));
    let near = judged.iter().take_while(|d| d.distance.is_finite()).count();
    let accepted = near.min((ACCEPTED * all as f64).ceil() as usize);
    let marginals = marginals(&draws.unknowns, &judged[..accepted]);
    Identification { figures: figures.to_vec(), draws: judged, accepted, marginals }
}

#[cfg(test)]
mod tests;
