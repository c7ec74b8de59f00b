//! How the searchers of a family did.
//!
//! *Source*: restricted mean time, Royston & Parmar 2013 (see `campaign::report`); success weighted by path length,
//! SPL, Anderson et al. 2018 (arXiv:1807.06757): the mean over all runs of S · L / max(L, P), where L is the path of
//! the oracle, which is told where the source is, in the same water from the same start.
//!
//! *Deviations*: L is the path that the oracle went on the same vehicle, not a shortest path by computation. It may
//! end within the radius in which a way point counts as reached. A seed on which the oracle did not arrive is left
//! out. Only the first declaration counts, whatever a searcher declares later. A run that failed counts as one
//! without success.

use super::load::Family;
use super::ranks::{Rank, Scores, ranks};
use super::searcher::SearcherSpec;
use crate::campaign::report::{RestrictedMean, SuccessTime, restricted};
use crate::campaign::stats::{
    Interval, LEAST_VALUES, finite_sorted, positive_mean_interval, quantile, quantile_interval, wilson,
};
use crate::campaign::{Campaign, CampaignError, RunRow};
use std::collections::BTreeMap;

/// A count of runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Count {
    /// In which it happened.
    pub of: u64,
    /// All.
    pub n: u64,
}

impl Count {
    /// The share, and its 95 % interval (Wilson).
    pub fn share(self) -> (f64, Interval) {
        (self.of as f64 / (self.n as f64).max(1.0), wilson(self.of, self.n))
    }
}

/// A figure and its 95 % interval, if there are enough runs.
pub(super) type Estimated = (f64, Option<Interval>);

/// The figures of a searcher in a family.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// Its name.
    pub searcher: String,
    /// It was told what no searcher can know.
    pub privileged: bool,
    /// Runs that declared the source within the family's radius.
    pub success: Count,
    /// Runs that declared another place.
    pub false_declarations: Count,
    /// Runs that failed: they count as neither.
    pub failed: u64,
    /// Mean time to success, at most the limit.
    pub restricted: RestrictedMean,
    /// Median distance of the declaration from the source, of runs that declared, m.
    pub error_m: Option<Estimated>,
    /// Success weighted by path length, if there is an oracle.
    pub spl: Option<Estimated>,
    /// Wall time a simulated second beyond that of the oracle, which decides nothing: what maps and decisions cost, ms.
    pub cost_ms: Option<f64>,
    /// Its rank by the restricted mean; none of a privileged one.
    pub rank: Option<Rank>,
    /// Time to success, s, of the runs that had any, in order.
    pub times_s: Vec<f64>,
}

/// A family and how its searchers did.
#[derive(Clone, Debug)]
pub struct Standing {
    /// Name of the family.
    pub family: String,
    /// What it is.
    pub title: String,
    /// What counts as success.
    pub rule: String,
    /// The time limit, s.
    pub limit_s: f64,
    /// The seeds, in words.
    pub seeds: String,
    /// Seeds of which every searcher has a row, and those planned.
    pub done: [u64; 2],
    /// The searchers, in the order in which they were asked for.
    pub figures: Vec<Figures>,
    /// Restricted time as a share of the limit: a row for each such seed, a score for each searcher that is ranked.
    pub(super) scores: Scores,
}

/// From the rows of a family's campaign. Only seeds of which every searcher has a row count, for the searchers that end
/// first are no fair sample.
///
/// # Errors
/// If the campaign's scenarios cannot be read.
pub fn standing(
    family: &Family,
    searchers: &[SearcherSpec],
    campaign: &Campaign,
    rows: &[RunRow],
) -> Result<Standing, CampaignError> {
    let time = campaign.success_time()?;
    let limit_s = time.limit_s;
    let mut by_seed: BTreeMap<u64, Vec<RunRow>> = BTreeMap::new();
    rows.iter().for_each(|row| by_seed.entry(row.seed_index).or_default().push(judged(row, time)));
    by_seed.retain(|_, rows| rows.len() as u64 == campaign.n_arms());
    by_seed.values_mut().for_each(|rows| rows.sort_by_key(|row| row.run));
    let arms = campaign.spec.arms.iter().map(|arm| &arm.name);
    let privileged = |name: &String| searchers.iter().any(|s| s.name == *name && s.privileged);
    let oracle = arms.clone().position(privileged);
    let mut figures: Vec<Figures> = Vec::new();
    for (k, name) in arms.clone().enumerate() {
        let own: Vec<&RunRow> = by_seed.values().map(|rows| &rows[k]).collect();
        let told: Option<Vec<&RunRow>> = oracle.map(|o| by_seed.values().map(|rows| &rows[o]).collect());
        figures.push(one(name, privileged(name), &own, told.as_deref(), time));
    }
    let ranked: Vec<usize> = (0..figures.len()).filter(|k| !figures[*k].privileged).collect();
    let score = |row: &RunRow| time.of(row).unwrap_or(limit_s) / limit_s;
    let scores = Scores {
        family: family.name.clone(),
        seeds: by_seed.keys().copied().collect(),
        of_seeds: by_seed.values().map(|rows| ranked.iter().map(|k| score(&rows[*k])).collect()).collect(),
    };
    for (k, rank) in ranked.iter().zip(ranks(std::slice::from_ref(&scores))) {
        figures[*k].rank = Some(rank);
    }
    Ok(Standing {
        family: family.name.clone(),
        title: family.spec.title.clone(),
        rule: campaign.success_rules()?.join("; or "),
        limit_s,
        seeds: campaign.spec.seeds.describe(),
        done: [by_seed.len() as u64, campaign.spec.seeds.count()],
        figures,
        scores,
    })
}

/// A run as the arena sees it: by the first declaration that the searcher has not taken back.
fn judged(row: &RunRow, time: SuccessTime) -> RunRow {
    let first_m = row.declarations.iter().find(|d| d.stands()).map_or(row.error_m, |d| d.error_m);
    let first_is_near = time.within_m.zip(first_m).is_none_or(|(most, error_m)| error_m <= most);
    RunRow { success: row.success && first_is_near && row.error.is_none(), error_m: first_m, ..row.clone() }
}

/// Wall time of the runs' own parts for each simulated second, ms; `None` if nothing was simulated.
fn own_ms(rows: &[&RunRow]) -> Option<f64> {
    let own_s: f64 = rows.iter().filter_map(|row| row.own_wall_s).sum();
    let simulated_s: f64 = rows.iter().filter(|row| row.own_wall_s.is_some()).map(|row| row.mission_s).sum();
    (simulated_s > 0.0).then(|| 1000.0 * own_s / simulated_s)
}

/// The figures of a searcher, beside the runs of the oracle, if there is one.
fn one(name: &str, privileged: bool, rows: &[&RunRow], told: Option<&[&RunRow]>, time: SuccessTime) -> Figures {
    let count = |what: &dyn Fn(&RunRow) -> bool| Count {
        of: rows.iter().filter(|row| what(row)).count() as u64,
        n: rows.len() as u64,
    };
    let errors = finite_sorted(rows.iter().filter_map(|row| row.error_m));
    let spl: Option<Vec<f64>> = told.map(|told| {
        let arrived = |oracle: &RunRow| oracle.error.is_none() && oracle.mission_s < time.limit_s;
        let each = rows.iter().zip(told.iter()).filter(|(_, oracle)| arrived(oracle));
        let weighed = |(row, oracle): (&&RunRow, &&RunRow)| {
            let path = oracle.travelled_m;
            if row.success { path / path.max(row.travelled_m) } else { 0.0 }
        };
        each.map(weighed).collect()
    });
    let found = rows.iter().filter(|row| row.success);
    let whole: Vec<RunRow> = rows.iter().map(|row| RunRow { error: None, ..(*row).clone() }).collect();
    Figures {
        searcher: name.to_string(),
        privileged,
        success: count(&|row| row.success),
        false_declarations: count(&|row| !row.success && row.declared_s.is_some()),
        failed: count(&|row| row.error.is_some()).of,
        restricted: restricted(&whole.iter().collect::<Vec<_>>(), time),
        error_m: quantile(&errors, 0.5).map(|m| {
            let enough = errors.len() >= LEAST_VALUES;
            (m, quantile_interval(&errors, 0.5, 1, name).filter(|_| enough))
        }),
        spl: spl.filter(|spl| !spl.is_empty() && !privileged).map(|spl| {
            let mean = spl.iter().sum::<f64>() / spl.len() as f64;
            let interval = positive_mean_interval(&spl).filter(|_| mean > 0.0);
            (mean, interval.map(|i| Interval { high: i.high.min(1.0), ..i }))
        }),
        cost_ms: told.and_then(|told| Some(own_ms(rows)? - own_ms(told)?)).filter(|_| !privileged),
        rank: None,
        times_s: finite_sorted(found.filter_map(|row| time.of(row)).filter(|t| *t < time.limit_s)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arena::load::families;
    use crate::arena::{Contest, campaign, searchers};
    use crate::campaign::report::sample::row;
    use std::path::PathBuf;
    use world::registry::Registry;
    use world::seeds::Key;

    /// Three seeds, of the last of which a searcher has no row yet: found after 910 and 940 s, declared elsewhere, not
    /// declared.
    #[test]
    fn figures_by_hand_of_whole_seeds() {
        let asked = ["oracle", "surge-cast", "QMDP"].map(String::from);
        let family = families(&Registry::default(), &[PathBuf::from("uniform")]).unwrap().remove(0);
        let searchers = searchers(&asked).unwrap();
        let contest = Contest { seeds: Some(3), first_seed: 1, key: Key::public() };
        let planned = campaign(&family, &searchers, &contest).unwrap();
        let of = |run: u64, found: Option<(f64, f64)>, travelled_m: f64, own_s: f64| RunRow {
            run,
            seed_index: run / 3,
            travelled_m,
            mission_s: 1000.0,
            own_wall_s: Some(own_s),
            ..row(run, found)
        };
        let (near, far) = (Some((3.0, 4.0)), Some((500.0, 0.0)));
        let rows = [
            of(0, None, 300.0, 0.1),
            of(1, near, 600.0, 0.1),
            // Whatever it declares later.
            RunRow { success: true, ..of(2, far, 900.0, 1.1) },
            of(3, None, 200.0, 0.1),
            of(4, near, 150.0, 0.1),
            of(5, None, 900.0, 1.1),
            of(6, None, 300.0, 0.1),
            of(7, near, 600.0, 0.1),
        ];
        let s = standing(&family, &searchers, &planned, &rows).unwrap();
        assert_eq!((s.done, s.limit_s, &s.scores.seeds[..]), ([2, 3], 1800.0, &[0, 1][..]));
        let [told, cast, qmdp] = &s.figures[..] else { panic!("three searchers") };
        assert!(told.privileged && told.rank.is_none() && told.spl.is_none());
        assert_eq!(
            (cast.success.of, cast.false_declarations.of, qmdp.success.of, qmdp.false_declarations.of),
            (2, 0, 0, 1)
        );
        // 300 of 600 m, and a path that is not longer than the oracle's counts as its own.
        assert_eq!((cast.spl.unwrap().0, qmdp.spl.unwrap().0), (0.75, 0.0));
        assert_eq!((cast.restricted.mean_s, qmdp.restricted.mean_s), (Some(925.0), Some(1800.0)));
        assert_eq!((cast.error_m.unwrap().0, cast.times_s.len()), (5.0, 2));
        assert!((qmdp.cost_ms.unwrap() - 1.0).abs() < 1e-9 && cast.cost_ms.unwrap().abs() < 1e-9);
        assert_eq!(s.scores.of_seeds, [[910.0 / 1800.0, 1.0], [940.0 / 1800.0, 1.0]]);
    }
}
