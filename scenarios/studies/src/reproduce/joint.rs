//! Whether all published figures come out together.
//!
//! *Source*: Mahalanobis's distance between a paper's means and those of our runs, with the covariance of the paper's
//! and our sampling; it is χ² of as many degrees of freedom as there are figures.
//!
//! *Parameters*: 95 %.
//!
//! *Deviations*: a count does not go along with the means of those that it counts. A bound that is kept adds nothing.

use super::published::Published;
use crate::campaign::RunRow;
use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ChiSquared, ContinuousCDF};

/// All figures of a paper beside those of runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// By figure: how many standard errors the paper's lies above ours.
    pub above: Vec<f64>,
    /// The squared distance.
    pub squared: f64,
    /// Share of papers about our runs that would be at least as far away.
    pub farther: f64,
}

impl Joint {
    /// Whether the paper lies in the region of 95 % of papers.
    pub fn is_inside(&self) -> bool {
        self.farther >= 0.05
    }
}

/// Compares all figures with runs; `None` if the runs lack one, or there are too few.
pub fn joint(figures: &[Published], runs: &[RunRow]) -> Option<Joint> {
    let values: Vec<Vec<Option<f64>>> = figures.iter().map(|f| f.by_run(runs)).collect();
    let n = figures.len();
    let (mut errors, mut above) = (Vec::new(), DVector::zeros(n));
    for (k, figure) in figures.iter().enumerate() {
        let (count, mean, variance) = moments(values[k].iter().flatten().copied());
        if count < 5.0 {
            return None;
        }
        let (_, papers_error) = figure.value_and_error(variance.sqrt());
        let error = (papers_error * papers_error + variance / count).sqrt();
        errors.push(error);
        above[k] = if error > 0.0 { figure.short_by(mean) / error } else { 0.0 };
    }
    let together = DMatrix::from_fn(n, n, |a, b| {
        if a == b {
            1.0
        } else if figures[a].is_count() || figures[b].is_count() {
            0.0
        } else {
            correlation(&values[a], &values[b])
        }
    });
    let squared = above.dot(&together.cholesky()?.solve(&above));
    let law = ChiSquared::new(n as f64).ok()?;
    Some(Joint { above: above.iter().copied().collect(), squared, farther: law.sf(squared) })
}

fn moments(values: impl Iterator<Item = f64> + Clone) -> (f64, f64, f64) {
    let n = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / n;
    (n, mean, values.map(|v| (v - mean) * (v - mean)).sum::<f64>() / (n - 1.0))
}

fn correlation(a: &[Option<f64>], b: &[Option<f64>]) -> f64 {
    let both: Vec<(f64, f64)> = a.iter().zip(b).filter_map(|(a, b)| (*a).zip(*b)).collect();
    let (n, a_mean, a_variance) = moments(both.iter().map(|p| p.0));
    let (_, b_mean, b_variance) = moments(both.iter().map(|p| p.1));
    let covariance = both.iter().map(|(a, b)| (a - a_mean) * (b - b_mean)).sum::<f64>() / (n - 1.0);
    let scale = (a_variance * b_variance).sqrt();
    // Two figures may be nearly the same one, but not to the last bit.
    if scale > 0.0 { (covariance / scale).clamp(-0.999, 0.999) } else { 0.0 }
}
