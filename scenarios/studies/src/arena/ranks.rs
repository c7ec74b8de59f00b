//! Ranks with their intervals.
//!
//! *Source*: confidence sets for the rank of one population among many, Mogstad, Romano, Shaikh & Wilhelm 2024 (Rev.
//! Econ. Stud. 91, 476): i ranks behind all that are better by more than chance, and before all that are worse by more
//! than chance, where chance is the 95 % quantile of the greatest of i's studentised differences. That quantile by a
//! bootstrap of whole seeds within each family, so that runs of one seed stay together.
//!
//! *Parameters*: 95 %; resamples, `RESAMPLES`.
//!
//! *Deviations*: one step, where the paper has a refinement in several. A difference without any spread is separable
//! if it is one. Of fewer than five seeds in a family nothing is said: they show almost nothing of their spread. Who
//! cannot be told apart shares ranks: a tie is shown as a tie.

use crate::campaign::stats::{LEAST_VALUES, quantile};
use world::seeds::Stream;

/// Resamples of the bootstrap.
pub(super) const RESAMPLES: usize = 2000;

/// The rank of a searcher: 1 is the best.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rank {
    /// Mean score; less is better.
    pub score: f64,
    /// The best rank that it can have, and the worst one.
    pub interval: [usize; 2],
}

/// Scores of one family: a row for each seed, in it a score for each searcher.
pub(super) type Scores = Vec<Vec<f64>>;

/// The ranks of searchers by their mean scores over families that count alike; empty without a seed.
pub(super) fn ranks(families: &[Scores]) -> Vec<Rank> {
    let Some(searchers) = families.iter().find_map(|scores| scores.first()).map(Vec::len) else {
        return Vec::new();
    };
    let families: Vec<&Scores> = families.iter().filter(|scores| !scores.is_empty()).collect();
    let mean = mean_of(&families, |scores| (0..scores.len()).collect());
    let enough = families.iter().all(|scores| scores.len() >= LEAST_VALUES);
    let error = |i: usize, j: usize| if enough { standard_error(&families, i, j) } else { f64::INFINITY };
    let errors: Vec<Vec<f64>> = (0..searchers).map(|i| (0..searchers).map(|j| error(i, j)).collect()).collect();
    let mut rng = Stream::new(1, "arena", "ranks");
    let mut greatest = vec![Vec::with_capacity(RESAMPLES); searchers];
    for _ in 0..RESAMPLES {
        let again = mean_of(&families, |scores| {
            let n = scores.len();
            (0..n).map(|_| ((rng.uniform() * n as f64) as usize).min(n - 1)).collect()
        });
        for (i, greatest) in greatest.iter_mut().enumerate() {
            let apart = |j: usize| {
                let off = (again[i] - again[j]) - (mean[i] - mean[j]);
                if errors[i][j] > 0.0 { (off / errors[i][j]).abs() } else { 0.0 }
            };
            greatest.push((0..searchers).map(apart).fold(0.0, f64::max));
        }
    }
    (greatest.iter_mut().enumerate())
        .map(|(i, greatest)| {
            greatest.sort_by(f64::total_cmp);
            let chance = quantile(greatest, 0.95).unwrap_or(f64::INFINITY);
            // The small number is the rounding of sums.
            let beyond = |j: usize| (mean[i] - mean[j]).abs() > chance * errors[i][j] + 1e-12;
            let better = (0..searchers).filter(|j| mean[*j] < mean[i] && beyond(*j)).count();
            let worse = (0..searchers).filter(|j| mean[*j] > mean[i] && beyond(*j)).count();
            Rank { score: mean[i], interval: [1 + better, searchers - worse] }
        })
        .collect()
}

/// The mean score of each searcher over the seeds that are drawn of each family.
fn mean_of(families: &[&Scores], mut drawn: impl FnMut(&Scores) -> Vec<usize>) -> Vec<f64> {
    let searchers = families[0][0].len();
    let mut mean = vec![0.0; searchers];
    for scores in families {
        let seeds = drawn(scores);
        let share = 1.0 / (seeds.len() * families.len()) as f64;
        for seed in seeds {
            mean.iter_mut().zip(&scores[seed]).for_each(|(m, score)| *m += share * score);
        }
    }
    mean
}

/// The standard error of the mean difference of two searchers.
fn standard_error(families: &[&Scores], i: usize, j: usize) -> f64 {
    let of = |scores: &Scores| {
        let n = scores.len() as f64;
        let differences = scores.iter().map(|of_seed| of_seed[i] - of_seed[j]);
        let mean = differences.clone().sum::<f64>() / n;
        differences.map(|d| (d - mean) * (d - mean)).sum::<f64>() / (n - 1.0).max(1.0) / n
    };
    families.iter().map(|scores| of(scores)).sum::<f64>().sqrt() / families.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Searchers whose scores are normal about these means, correlated within a seed.
    fn scores(means: &[f64], n: u64, seed: u64) -> Scores {
        let mut rng = Stream::new(seed, "scores", "test");
        let mut one = |of_seed: f64| means.iter().map(|m| m + of_seed + 0.1 * rng.normal()).collect();
        let mut weather = Stream::new(seed, "weather", "test");
        (0..n).map(|_| one(weather.normal())).collect()
    }

    #[test]
    fn who_is_clearly_better_is_before_and_who_is_alike_shares_ranks() {
        let all = ranks(&[scores(&[0.2, 0.2, 0.5, 0.9], 100, 1)]);
        let intervals: Vec<[usize; 2]> = all.iter().map(|r| r.interval).collect();
        assert_eq!(intervals, [[1, 2], [1, 2], [3, 3], [4, 4]]);
        // Four seeds separate nothing, and of none there are no ranks.
        assert!(ranks(&[scores(&[0.2, 0.25, 0.9], 4, 1)]).iter().all(|r| r.interval == [1, 3]));
        assert_eq!(ranks(&[Vec::new()]), []);
    }

    #[test]
    fn families_count_alike_whatever_their_seeds() {
        let (few, many) = (vec![vec![1.0, 0.0]; 10], vec![vec![0.0, 0.5]; 1000]);
        let all = ranks(&[few, many]);
        assert!((all[0].score - 0.5).abs() < 1e-12 && (all[1].score - 0.25).abs() < 1e-12);
        assert_eq!((all[0].interval, all[1].interval), ([2, 2], [1, 1]), "differences without any spread");
    }

    /// The true rank of the middle one of five searchers, 0.05 apart, is within its interval in at least 95 % of 200
    /// contests, less 3 standard errors (4.6 %).
    #[test]
    fn covers_as_often_as_it_says() {
        let held = (0..200).filter(|seed| {
            let all = ranks(&[scores(&[0.0, 0.05, 0.1, 0.15, 0.2], 20, 100 + seed)]);
            let [best, worst] = all[2].interval;
            (best..=worst).contains(&3)
        });
        let held = held.count();
        assert!(held >= 181, "{held} of 200");
    }
}
