//! The searchers over all families that have the same ones.

use super::ranks::{Rank, Scores, ranks};
use super::standing::Standing;

/// Families with the same searchers, and these by their mean score over the families.
#[derive(Clone, Debug)]
pub(super) struct Total {
    /// Indices of the families.
    pub(super) families: Vec<usize>,
    /// Names and ranks, the best first.
    pub(super) searchers: Vec<(String, Rank)>,
}

/// One for each set of searchers, in the order of the families. Families without a whole seed are left out.
pub(super) fn totals(standings: &[Standing]) -> Vec<Total> {
    let names = |s: &Standing| -> Vec<String> {
        s.figures.iter().filter(|f| !f.privileged).map(|f| f.searcher.clone()).collect()
    };
    let mut sets: Vec<(Vec<String>, Vec<usize>)> = Vec::new();
    for (k, s) in standings.iter().enumerate().filter(|(_, s)| !s.scores.of_seeds.is_empty()) {
        match sets.iter_mut().find(|(searchers, _)| *searchers == names(s)) {
            Some((_, families)) => families.push(k),
            None => sets.push((names(s), vec![k])),
        }
    }
    let one = |(names, families): (Vec<String>, Vec<usize>)| {
        let scores: Vec<Scores> = families.iter().map(|k| standings[*k].scores.clone()).collect();
        let mut searchers: Vec<(String, Rank)> = names.into_iter().zip(ranks(&scores)).collect();
        searchers.sort_by(|a, b| a.1.score.total_cmp(&b.1.score));
        Total { families, searchers }
    };
    sets.into_iter().map(one).collect()
}
