//! Ranks with their intervals.
//!
//! *Source*: confidence sets for the rank of one population among many, Mogstad, Romano, Shaikh & Wilhelm 2024 (Rev.
//! Econ. Stud. 91, 476): i ranks behind all that are better by more than chance, and before all that are worse by more
//! than chance, where chance is the 95 % quantile of the greatest of i's studentised differences. That quantile by a
//! bootstrap of whole seeds, so that runs of one seed stay together; families with the same seeds, whose draws have
//! places in common, keep together what is of one seed.
//!
//! *Parameters*: 95 %; resamples, `RESAMPLES`.
//!
//! *Deviations*: one step, where the paper has a refinement in several. The quantile, which the bootstrap gives for
//! a known spread, is that of Student's t with the same level, for the spread is that of n seeds. A difference
//! without any spread is separable if it is one. Of fewer than five seeds in a family nothing is said: they show
//! almost nothing of their spread. Who cannot be told apart shares ranks: a tie is shown as a tie.

use crate::campaign::stats::{LEAST_VALUES, quantile};
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};
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

/// Scores of one family.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Scores {
    /// Name of the family.
    pub(super) family: String,
    /// Indices of its seeds.
    pub(super) seeds: Vec<u64>,
    /// For each seed a score for each searcher.
    pub(super) of_seeds: Vec<Vec<f64>>,
}

impl Scores {
    fn n(&self) -> usize {
        self.of_seeds.len()
    }
}

/// The ranks of searchers by their mean scores over families that count alike; empty without a seed.
pub(super) fn ranks(families: &[Scores]) -> Vec<Rank> {
    let families: Vec<&Scores> = families.iter().filter(|scores| scores.n() > 0).collect();
    let Some(searchers) = families.first().map(|scores| scores.of_seeds[0].len()) else {
        return Vec::new();
    };
    let one = together(&families);
    let families = one.as_ref().map_or(families, |one| vec![one]);
    let mean = mean_of(&families, |_, scores| (0..scores.n()).collect());
    let n = families.iter().map(|scores| scores.n()).min().unwrap_or(0);
    let enough = n >= LEAST_VALUES;
    let error = |i: usize, j: usize| if enough { standard_error(&families, i, j) } else { f64::INFINITY };
    let errors: Vec<Vec<f64>> = (0..searchers).map(|i| (0..searchers).map(|j| error(i, j)).collect()).collect();
    let mut rngs: Vec<Stream> = families.iter().map(|scores| Stream::new(1, &scores.family, "ranks")).collect();
    let mut greatest = vec![Vec::with_capacity(RESAMPLES); searchers];
    for _ in 0..RESAMPLES {
        let again = mean_of(&families, |k, scores| {
            let n = scores.n();
            (0..n).map(|_| ((rngs[k].uniform() * n as f64) as usize).min(n - 1)).collect()
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
            let chance = quantile(greatest, 0.95).map_or(f64::INFINITY, |chance| of_few(chance, n));
            // The small number is the rounding of sums.
            let beyond = |j: usize| (mean[i] - mean[j]).abs() > chance * errors[i][j] + 1e-12;
            let better = (0..searchers).filter(|j| mean[*j] < mean[i] && beyond(*j)).count();
            let worse = (0..searchers).filter(|j| mean[*j] > mean[i] && beyond(*j)).count();
            Rank { score: mean[i], interval: [1 + better, searchers - worse] }
        })
        .collect()
}

/// Families with the same seeds as one, in which a seed's score is the mean over the families.
fn together(families: &[&Scores]) -> Option<Scores> {
    let (first, others) = families.split_first()?;
    if others.is_empty() || others.iter().any(|scores| scores.seeds != first.seeds) {
        return None;
    }
    let share = 1.0 / families.len() as f64;
    let mean = |seed: usize, k: usize| families.iter().map(|scores| share * scores.of_seeds[seed][k]).sum();
    let of_seed = |seed: usize| (0..first.of_seeds[seed].len()).map(|k| mean(seed, k)).collect();
    let of_seeds = (0..first.n()).map(of_seed).collect();
    Some(Scores { family: "all".to_string(), seeds: first.seeds.clone(), of_seeds })
}

/// The quantile of n seeds instead of one of a known spread. The resamples' variance is (n - 1) / n of that of seeds.
fn of_few(chance: f64, n: usize) -> f64 {
    let freedom = (n as f64 - 1.0).max(1.0);
    let (normal, t) = (Normal::standard(), StudentsT::new(0.0, 1.0, freedom).expect("freedom above 0"));
    let level = normal.cdf(chance * (n as f64 / freedom).sqrt());
    if level < 1.0 { t.inverse_cdf(level) } else { f64::INFINITY }
}

/// The mean score of each searcher over the seeds that are drawn of each family.
fn mean_of(families: &[&Scores], mut drawn: impl FnMut(usize, &Scores) -> Vec<usize>) -> Vec<f64> {
    let mut mean = vec![0.0; families[0].of_seeds[0].len()];
    for (k, scores) in families.iter().enumerate() {
        let seeds = drawn(k, scores);
        let share = 1.0 / (seeds.len() * families.len()) as f64;
        for seed in seeds {
            mean.iter_mut().zip(&scores.of_seeds[seed]).for_each(|(m, score)| *m += share * score);
        }
    }
    mean
}

/// The standard error of the mean difference of two searchers.
fn standard_error(families: &[&Scores], i: usize, j: usize) -> f64 {
    let of = |scores: &Scores| {
        let n = scores.n() as f64;
        let differences = scores.of_seeds.iter().map(|of_seed| of_seed[i] - of_seed[j]);
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
        of("a", (0..n).map(|_| one(weather.normal())).collect())
    }

    fn of(family: &str, of_seeds: Vec<Vec<f64>>) -> Scores {
        Scores { family: family.to_string(), seeds: (0..of_seeds.len() as u64).collect(), of_seeds }
    }

    #[test]
    fn who_is_clearly_better_is_before_and_who_is_alike_shares_ranks() {
        let all = ranks(&[scores(&[0.2, 0.2, 0.5, 0.9], 100, 1)]);
        let intervals: Vec<[usize; 2]> = all.iter().map(|r| r.interval).collect();
        assert_eq!(intervals, [[1, 2], [1, 2], [3, 3], [4, 4]]);
        // Four seeds separate nothing, and of none there are no ranks.
        assert!(ranks(&[scores(&[0.2, 0.25, 0.9], 4, 1)]).iter().all(|r| r.interval == [1, 3]));
        assert_eq!(ranks(&[Scores::default()]), []);
    }

    #[test]
    fn families_count_alike_whatever_their_seeds() {
        let (few, many) = (of("few", vec![vec![1.0, 0.0]; 10]), of("many", vec![vec![0.0, 0.5]; 1000]));
        let all = ranks(&[few, many]);
        assert!((all[0].score - 0.5).abs() < 1e-12 && (all[1].score - 0.25).abs() < 1e-12);
        assert_eq!((all[0].interval, all[1].interval), ([2, 2], [1, 1]), "differences without any spread");
    }

    /// What is of one seed stays together over families: differences that cancel there have no spread.
    #[test]
    fn families_with_the_same_seeds_are_resampled_together_in_any_order() {
        let mut rng = Stream::new(1, "cancel", "test");
        let noise: Vec<f64> = (0..30).map(|_| rng.normal()).collect();
        let family = |name, sign: f64| of(name, noise.iter().map(|n| vec![sign * n, 0.01]).collect());
        let all = ranks(&[family("a", 1.0), family("b", -1.0)]);
        assert_eq!((all[0].interval, all[1].interval), ([1, 1], [2, 2]));
        let [few, many] = [12, 20].map(|n| Scores { family: n.to_string(), ..scores(&[0.1, 0.12, 0.14], n, n) });
        let intervals = |of: [&Scores; 2]| ranks(&of.map(Scores::clone)).iter().map(|r| r.interval).collect::<Vec<_>>();
        assert_eq!(intervals([&few, &many]), intervals([&many, &few]));
    }

    /// Of 24 searchers that are alike, one is set apart from any other in at most 5 % of contests; 40 of them have a
    /// standard error of 3.4 %, and three of these are allowed.
    #[test]
    fn many_that_are_alike_are_seldom_set_apart() {
        let apart = (0..40).filter(|seed| ranks(&[scores(&[0.5; 24], 10, 900 + seed)])[0].interval != [1, 24]);
        let apart = apart.count();
        assert!(apart <= 6, "{apart} of 40");
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
