//! Writes the results of the arena: a page, tables and figures.

use super::standing::{Estimated, Figures, Standing};
use super::total::{Total, totals};
use super::{picture, searcher::SearcherSpec};
use crate::campaign::report::Table;
use output::files::{PendingFiles, ReportError, begin_folder};
use output::report::Page;
use std::path::{Path, PathBuf};

/// The results that were written.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenArena {
    /// The tables as text.
    pub text: String,
    /// The files.
    pub files: Vec<PathBuf>,
}

const NOTES: &str = "All searchers of a family have the same machine, instruments and limits, and those of a seed one \
    and the same plume. Success: the source is declared within the family's radius by the limit; false declaration: \
    another place is. Time: restricted mean, where a run without success counts as the limit. SPL: success weighted \
    by the path of the oracle over the searcher's (Anderson et al. 2018). Cost: wall time of one core a simulated \
    second beyond that of the oracle, which decides nothing; a few tenths of a millisecond are caches and other work. \
    Intervals of 95 %: Wilson; of the mean on the scale of the logarithm; bootstrap of the median. Rank: by the mean \
    time, as the range of ranks that cannot be excluded (Mogstad et al. 2024, 2000 resamples of whole seeds), each \
    range by itself. With fewer than five seeds nobody is told apart. Only the first declaration of a run counts, and \
    a run that failed counts as one without success. Two searchers are compared by their paired difference: \
    `rheotaxis campaign report`.";

/// Writes `report.html`, `RANKING.md`, `arena.csv` and figures into a folder; `made` is the command that makes the runs
/// and `key` the mark of their key.
///
/// # Errors
/// If files cannot be written; names each such file. All others are written.
pub fn write(
    dir: &Path,
    standings: &[Standing],
    searchers: &[SearcherSpec],
    key: Option<&str>,
    made: &str,
) -> Result<WrittenArena, ReportError> {
    let folder = begin_folder(dir, "arena")?;
    let mut kept = PendingFiles::new(&folder);
    let title = "Searchers side by side";
    let mut page = Page::new(title, title, "");
    let mut text = String::new();
    let sealed = match key {
        Some(mark) => format!("Sealed seeds, under the key with the mark {mark}."),
        None => "Public seeds: anybody can have looked at them before.".to_string(),
    };
    let head = format!("{sealed} By `{made}`.");
    let mut markdown = format!("# {title}\n\n{head}\n\n{NOTES}\n");
    page.paragraph(&head);
    page.paragraph(NOTES);
    let totals = totals(standings);
    for total in &totals {
        let of: Vec<&Standing> = total.families.iter().map(|k| &standings[*k]).collect();
        let ending = if totals.len() > 1 { format!("_{}", of[0].family) } else { String::new() };
        for (name, svg) in [
            ("ranking", picture::ranking(&of, total)),
            ("declared_by", picture::curves(&of, total)),
            ("profile", picture::profile(&of, total)),
        ] {
            // Over one family, the profile is its curve.
            if name != "profile" || of.len() > 1 {
                kept.figure(&format!("{name}{ending}"), &svg);
                page.html(&svg);
            }
        }
        if of.len() > 1 {
            let names: Vec<&str> = of.iter().map(|s| s.family.as_str()).collect();
            section(
                &format!("All of {}", names.join(", ")),
                "",
                &over_families(total),
                &mut page,
                &mut markdown,
                &mut text,
            );
        }
    }
    for s in standings {
        let about = format!(
            "Success: {}. Limit {:.0} s; {}; {} of {} seeds are whole.",
            s.rule, s.limit_s, s.seeds, s.done[0], s.done[1]
        );
        section(&format!("{}: {}", s.family, s.title), &about, &of_family(s), &mut page, &mut markdown, &mut text);
    }
    let sources = Table::of(searchers, &[("searcher", &|s| s.name.clone()), ("source", &|s| s.source.clone())]);
    section("Sources", "", &sources, &mut page, &mut markdown, &mut String::new());
    kept.write("arena.csv", csv(standings).as_bytes());
    kept.write("RANKING.md", markdown.as_bytes());
    kept.write("report.html", page.end().as_bytes());
    Ok(WrittenArena { text, files: kept.done()? })
}

fn section(title: &str, about: &str, table: &Table, page: &mut Page, markdown: &mut String, text: &mut String) {
    page.heading(title);
    let about = if about.is_empty() { String::new() } else { format!("{about}\n\n") };
    if !about.is_empty() {
        page.paragraph(about.trim_end());
    }
    page.table(&table.head, &table.rows, false);
    markdown.push_str(&format!("\n## {title}\n\n{about}{}", table.markdown()));
    text.push_str(&format!("\n{title}\n{about}{}", table.text(None)));
}

fn ranks([best, worst]: [usize; 2]) -> String {
    if best == worst { best.to_string() } else { format!("{best} to {worst}") }
}

fn over_families(total: &Total) -> Table {
    let rows = total.searchers.iter();
    Table::of(
        rows,
        &[
            ("searcher", &|(name, _)| name.clone()),
            ("rank", &|(_, rank)| ranks(rank.interval)),
            ("mean time, share of the limit", &|(_, rank)| format!("{:.3}", rank.score)),
        ],
    )
}

/// A figure with its interval, times a factor.
fn estimated(figure: Option<Estimated>, times: f64, decimals: usize) -> String {
    let Some((value, interval)) = figure else { return "–".to_string() };
    let shown = |v: f64| format!("{:.decimals$}", times * v);
    match interval {
        Some(i) => format!("{} ({}–{})", shown(value), shown(i.low), shown(i.high)),
        None => shown(value),
    }
}

fn share(count: super::standing::Count) -> String {
    let (share, i) = count.share();
    format!("{:.0} % ({:.1}–{:.1})", 100.0 * share, 100.0 * i.low, 100.0 * i.high)
}

fn of_family(s: &Standing) -> Table {
    let mut rows: Vec<&Figures> = s.figures.iter().collect();
    let score = |f: &Figures| f.rank.map_or(f64::NEG_INFINITY, |rank| rank.score);
    rows.sort_by(|a, b| score(a).total_cmp(&score(b)));
    Table::of(
        rows,
        &[
            ("searcher", &|f| f.searcher.clone()),
            ("rank", &|f| f.rank.map_or("told the source".to_string(), |rank| ranks(rank.interval))),
            ("success", &|f| if f.privileged { "–".to_string() } else { share(f.success) }),
            ("false declarations", &|f| if f.privileged { "–".to_string() } else { share(f.false_declarations) }),
            ("failed", &|f| f.failed.to_string()),
            ("time, s", &|f| {
                let mean = f.restricted.mean_s.filter(|_| !f.privileged);
                estimated(mean.map(|m| (m, f.restricted.interval)), 1.0, 0)
            }),
            ("error, m", &|f| estimated(f.error_m, 1.0, if s.limit_s < 600.0 { 2 } else { 1 })),
            ("SPL", &|f| estimated(f.spl, 1.0, 2)),
            ("cost, ms/s", &|f| f.cost_ms.map_or("–".to_string(), |ms| format!("{ms:.2}"))),
        ],
    )
}

fn csv(standings: &[Standing]) -> String {
    let number = |v: Option<f64>| output::files::csv_number(v);
    let rows = standings.iter().flat_map(|s| {
        s.figures.iter().map(move |f| {
            let [success, wrong] = [f.success.share(), f.false_declarations.share()];
            let spl = f.spl.map(|(v, _)| v);
            let error = f.error_m.map(|(v, _)| v);
            let rank = f.rank.map(|rank| rank.interval);
            vec![
                s.family.clone(),
                f.searcher.clone(),
                f.privileged.to_string(),
                f.success.n.to_string(),
                f.success.of.to_string(),
                number(Some(success.1.low)),
                number(Some(success.1.high)),
                f.false_declarations.of.to_string(),
                number(Some(wrong.1.low)),
                number(Some(wrong.1.high)),
                f.failed.to_string(),
                number(f.restricted.mean_s),
                number(f.restricted.interval.map(|i| i.low)),
                number(f.restricted.interval.map(|i| i.high)),
                number(error),
                number(spl),
                number(f.cost_ms),
                rank.map_or_else(String::new, |[best, _]| best.to_string()),
                rank.map_or_else(String::new, |[_, worst]| worst.to_string()),
            ]
        })
    });
    output::files::csv_text(
        "family,searcher,privileged,n,success,success_low,success_high,false_declarations,false_low,false_high,failed,\
         time_s,time_low_s,time_high_s,error_m,spl,cost_ms,rank_best,rank_worst",
        rows,
    )
}
