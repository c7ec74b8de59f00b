//! The best, the median and the worst run of each arm: which ones they are, and how the page shows them.
//!
//! The runs of an arm in order: those with success by the time of their declaration (or of their mission), then those
//! that declared something else by their error, then the rest by the time of their mission. Runs that broke off are
//! left out. The best is the first, the worst the last, and the median the one in the middle.

use super::arms::{arm_names, of_arm};
use super::screen::{Film, Shown};
use super::text::Table;
use crate::campaign::RunRow;

/// Arms whose tracks are shown; more would make a page that nobody can send.
const MOST_ARMS: usize = 3;

const NOTES: &str = "Runs with success are in the order of their times, then come those that declared elsewhere in the \
    order of their errors, then those without a declaration. Best is the first run, median the middle one, worst the last.";
const STILL: &str = "The tracks move here in a browser with JavaScript; without it, and in print, they are pictures. \
    `rheotaxis campaign rerun DIR --run N` makes a run anew, with all its pictures.";

/// Where a run stands among those of its arm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rank {
    /// The first.
    Best,
    /// The one in the middle.
    Median,
    /// The last.
    Worst,
}

impl Rank {
    /// Its name for people.
    pub fn label(self) -> &'static str {
        match self {
            Self::Best => "best",
            Self::Median => "median",
            Self::Worst => "worst",
        }
    }
}

/// A run to show.
#[derive(Clone, Debug, PartialEq)]
pub struct Pick {
    /// Where it stands in its arm.
    pub rank: Rank,
    /// Its row.
    pub row: RunRow,
}

/// A run that was made anew to show its track.
#[derive(Clone, Debug, PartialEq)]
pub struct RemadeRun {
    /// Which one.
    pub pick: Pick,
    /// How it moved, or why that is not known.
    pub film: Result<Film, String>,
}

/// The runs to show: of each of the first arms at most three, none of them twice. `arms` gives the order of the arms;
/// others follow in the order of their rows.
pub fn picks(arms: &[String], rows: &[RunRow]) -> Vec<Pick> {
    let names = arm_names(arms, rows);
    let shown = names.iter().take(MOST_ARMS);
    shown.flat_map(|name| of_one(of_arm(rows, name))).collect()
}

fn of_one(mut rows: Vec<&RunRow>) -> Vec<Pick> {
    rows.retain(|row| row.error.is_none() && !row.digest.is_empty());
    rows.sort_by(|a, b| place(a).partial_cmp(&place(b)).expect("numbers"));
    let n = rows.len();
    let ranks = [(Rank::Best, 0), (Rank::Median, n / 2), (Rank::Worst, n.wrapping_sub(1))];
    let mut picks: Vec<Pick> = Vec::new();
    for (rank, k) in ranks {
        let known = |row: &RunRow| picks.iter().any(|p| p.row.run == row.run);
        if let Some(row) = rows.get(k).filter(|row| !known(row)) {
            let row = RunRow::clone(row);
            picks.push(Pick { rank, row });
        }
    }
    picks
}

/// Sorts the runs of an arm; what is no number stands last in its group.
fn place(row: &RunRow) -> (u8, f64, u64) {
    let (group, value) = match (row.success, row.declared_s, row.error_m) {
        (true, declared_s, _) => (0, declared_s.unwrap_or(row.mission_s)),
        (false, Some(_), Some(error_m)) => (1, error_m),
        (false, ..) => (2, row.mission_s),
    };
    let value = if value.is_nan() { f64::INFINITY } else { value };
    (group, value, row.run)
}

/// The section of the page; `arms` is their number in all.
pub(super) fn section(report: &mut Shown, shown: &[RemadeRun], arms: usize) {
    if shown.is_empty() {
        return;
    }
    report.page.heading("Best, median and worst run");
    let time_s = |row: &RunRow| row.declared_s.unwrap_or(row.mission_s);
    let table = Table::of(
        shown.iter().map(|s| (s.pick.rank, &s.pick.row)),
        &[
            ("arm", &|(_, row)| row.arm.clone()),
            ("", &|(rank, _)| rank.label().to_string()),
            ("run", &|(_, row)| row.run.to_string()),
            ("seed", &|(_, row)| row.seed.to_string()),
            ("outcome", &|(_, row)| row.outcome.replace('_', " ")),
            ("time, s", &|(_, row)| format!("{:.0}", time_s(row))),
            ("error, m", &|(_, row)| row.error_m.map_or_else(String::new, |e| format!("{e:.1}"))),
        ],
    );
    report.page.table(&table.head, &table.rows, false);
    report.page.paragraph(NOTES);
    if arms > MOST_ARMS {
        report.page.paragraph(&format!("Of {arms} arms the first {MOST_ARMS} are shown."));
    }
    report.page.html(&format!("<noscript><style>.still{{display:block}}</style><p>{STILL}</p></noscript>\n"));
    for RemadeRun { pick, film } in shown {
        let title = title(pick);
        match film {
            Ok(film) => report.film(&title, film),
            Err(why) => report.page.paragraph(&format!("{title}: {why}.")),
        }
    }
}

fn title(pick: &Pick) -> String {
    let row = &pick.row;
    let under = if row.condition.is_empty() { String::new() } else { format!(", {}", row.condition) };
    let (arm, rank) = (&row.arm, pick.rank.label());
    format!("{arm}{under}: {rank} run, number {}", row.run)
}

#[cfg(test)]
mod tests {
    use super::super::sample::row;
    use super::*;

    fn runs(picks: &[Pick]) -> Vec<(Rank, u64)> {
        picks.iter().map(|p| (p.rank, p.row.run)).collect()
    }

    #[test]
    fn successes_come_first_then_errors_then_missions() {
        // Successes in the order 1, 2, 4; then 5 with the lesser error before 3; then 0 without a declaration.
        let errors = [None, Some(5.0), Some(30.0), Some(90.0), Some(1.0), Some(60.0)];
        let rows: Vec<RunRow> = (0..).zip(errors).map(|(k, m)| row(k, m.map(|m| (m, 0.0)))).collect();
        let three = runs(&picks(&[], &rows));
        assert_eq!(three, [(Rank::Best, 1), (Rank::Median, 5), (Rank::Worst, 0)]);
        let mut other_way = rows.clone();
        other_way.reverse();
        assert_eq!(runs(&picks(&[], &other_way)), three);
        // The worst is the wrong declaration that is farthest off, when all have declared.
        assert_eq!(runs(&picks(&[], &rows[1..])).last(), Some(&(Rank::Worst, 3)));
    }

    #[test]
    fn few_runs_are_not_shown_twice_and_broken_ones_not_at_all() {
        let broken = RunRow { error: Some("panicked".to_string()), ..row(7, None) };
        assert_eq!(picks(&[], std::slice::from_ref(&broken)), []);
        let one = runs(&picks(&[], &[broken, row(1, None)]));
        assert_eq!(one, [(Rank::Best, 1)]);
        let two = runs(&picks(&[], &[row(1, None), row(2, Some((1.0, 1.0)))]));
        assert_eq!(two, [(Rank::Best, 2), (Rank::Median, 1)]);
        let nan = RunRow { error_m: Some(f64::NAN), success: false, ..row(3, Some((1.0, 0.0))) };
        let last = runs(&picks(&[], &[nan, row(4, Some((90.0, 0.0)))]));
        assert_eq!(last, [(Rank::Best, 4), (Rank::Median, 3)]);
    }

    #[test]
    fn of_many_arms_the_first_are_shown() {
        let of = |arm: &str| RunRow { arm: arm.to_string(), ..row(1, None) };
        let rows = ["d", "c", "b", "a"].map(of);
        let order = ["a", "b"].map(String::from);
        let arms: Vec<String> = (picks(&order, &rows).into_iter().map(|p| p.row.arm)).collect();
        assert_eq!(arms, ["a", "b", "d"]);
    }
}
