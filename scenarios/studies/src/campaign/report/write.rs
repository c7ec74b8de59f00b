//! Writes all parts of a campaign's report into one folder.

use super::arms::{self, ConditionFigures, arm_names, of_arm};
use super::restricted::SuccessTime;
use super::screen::Shown;
use super::text::Table;
use super::tracks::{self, RemadeRun};
use super::walls::Walls;
use super::{curves, pairs, plots, reliability, tables};
use crate::campaign::RunRow;
use output::files::{PendingFiles, ReportError, begin_folder};
use std::path::{Path, PathBuf};

/// What the report says about the campaign in addition to its rows.
#[derive(Clone, Copy, Debug)]
pub struct About<'a> {
    /// Name of the campaign.
    pub name: &'a str,
    /// What it compares, in one line; this is the page's title.
    pub title: &'a str,
    /// What each arm sets, in the order of `arms`.
    pub sets: &'a [String],
    /// The runs' seeds, for people.
    pub seeds: &'a str,
    /// What counts as a success, in words: one rule, or those of arms and conditions that differ in it.
    pub success: &'a [String],
    /// The arm with which each other one is compared; without it, each is compared with each, or with the first of many.
    pub against: Option<&'a str>,
    /// Width of the terminal for which the text is written, characters; without it, lines are as long as they are.
    pub columns: Option<usize>,
    /// The shortest time limit of its scenarios, s; without it, the longest mission counts.
    pub limit_s: Option<f64>,
    /// How near a declaration has to be for success, m, if success asks for any.
    pub within_m: Option<f64>,
    /// Base scenario.
    pub scenario: &'a str,
    /// Hash of what was run.
    pub hash: &'a str,
    /// Version that ran it.
    pub version: &'a str,
    /// Arms in the order in which to show them; others follow in the order of their rows.
    pub arms: &'a [String],
    /// Number of runs planned; if there are fewer rows, the report says that it shows a part.
    pub planned: u64,
    /// The runs whose tracks are shown.
    pub shown: &'a [RemadeRun],
}

/// A report that was written.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenReport {
    /// The tables as plain text.
    pub text: String,
    /// The files.
    pub files: Vec<PathBuf>,
    /// Names of files of an earlier report that were removed.
    pub removed: Vec<String>,
}

const NOTES: &str = "Shares: Wilson's 95 % interval; a failed run counts as neither declared nor successful. Time and \
    error are of runs that declared, the path of all that did not fail: median and 90 % quantile (linear between order \
    statistics) with 95 % bootstrap intervals (percentile, 4000 resamples, seed 1). With fewer than 36 values the 90 % quantile's \
    upper end covers less than it says; of fewer than 5 values there is no interval.";

const RESTRICTED_NOTES: &str = "The restricted mean is of all runs that did not fail: the time to success, or the limit where \
    there was none by then. Its interval is on the scale of the logarithm.";

const PAIR_NOTES: &str = "Pairs are runs of the same seed and condition. Success: interval of Agresti and Min (2005). Time, \
    path, error: median of the differences within pairs where both arms have it, with its bootstrap interval; less is \
    better. Each comparison holds for itself: of twenty, one finds something by chance.";

/// Writes tables (CSV), figures (SVG and PNG) and `report.html` of a campaign's rows into a folder, which is made if
/// necessary. The order of the rows makes no difference.
///
/// # Errors
/// If the folder cannot be made or files cannot be written; names each such file. All others are written.
pub fn write(dir: &Path, about: &About<'_>, rows: &[RunRow]) -> Result<WrittenReport, ReportError> {
    let folder = begin_folder(dir, "report")?;
    let names = arm_names(about.arms, rows);
    let grouped: Vec<(&String, Vec<&RunRow>)> = names.iter().map(|name| (name, of_arm(rows, name))).collect();
    let longest = (rows.iter().map(|r| r.mission_s)).fold(0.0, f64::max);
    let limit_s = about.limit_s.unwrap_or(longest);
    let success = SuccessTime { limit_s, within_m: about.within_m };
    let figures: Vec<_> = grouped.iter().map(|(name, rows)| arms::figures(name, rows, success)).collect();
    let conditions = arms::conditions(&names, rows);
    let comparisons = pairs::comparisons(&names, rows, success, about.against);
    let waiting: Vec<_> = grouped.iter().map(|(name, rows)| curves::not_yet_declared(name, rows)).collect();
    let errors: Vec<_> = grouped.iter().map(|(name, rows)| curves::errors(name, rows)).collect();

    let mut kept = PendingFiles::new(&folder);
    kept.write("arms.csv", tables::arms_csv(&figures).as_bytes());
    let csv = tables::curves_csv("t_s", &waiting);
    kept.write("not_yet_declared.csv", csv.as_bytes());
    let csv = tables::curves_csv("error_m", &errors);
    kept.write("errors.csv", csv.as_bytes());
    if !comparisons.is_empty() {
        let csv = tables::pairs_csv(&comparisons);
        kept.write("differences.csv", csv.as_bytes());
    }
    if !conditions.is_empty() {
        let csv = tables::conditions_csv(&conditions);
        kept.write("conditions.csv", csv.as_bytes());
    }

    let reliable: Vec<_> = (grouped.iter()).flat_map(|(name, rows)| reliability::reliability(name, rows)).collect();
    if !reliable.is_empty() {
        let csv = reliability::csv(&reliable);
        kept.write("reliability.csv", csv.as_bytes());
        let svg = reliability::picture(&reliable);
        kept.figure("reliability", &svg);
    }

    let mut drawn = vec![
        ("success", plots::success(&figures)),
        (
            "not_yet_declared",
            plots::curves(
                "waiting",
                "Not yet declared, with pointwise 95 % band (Kaplan–Meier)",
                "Mission time (s)",
                "Share of runs",
                &waiting,
                true,
            ),
        ),
        (
            "errors",
            plots::curves(
                "errors",
                "Declared within a distance of the source, with pointwise 95 % band",
                "Error of the declaration (m)",
                "Share of all runs",
                &errors,
                false,
            ),
        ),
    ];
    if !comparisons.is_empty() {
        drawn.push(("differences", plots::differences(&comparisons)));
    }
    for (name, svg) in &drawn {
        kept.figure(name, svg);
    }

    let title = if about.title.is_empty() { about.name } else { about.title };
    let mut shown = Shown::new(title, about.columns);
    for words in std::iter::once(heading(about, rows.len())).chain(success_words(about, &conditions)) {
        shown.page.paragraph(&words);
        shown.line(&words);
    }
    let sets = about.arms.iter().zip(about.sets);
    let sets = Table::of(sets, &[("arm", &|s| s.0.clone()), ("sets in the scenario", &|s| s.1.clone())]);
    if !sets.rows.is_empty() {
        shown.page.heading("Arms");
        shown.page.table(&sets.head, &sets.rows, true);
        sets.rows.iter().for_each(|row| shown.line(&format!("  arm {}: {}", row[0], row[1])));
    }
    shown.page.heading("Success");
    shown.table("", &tables::success(&figures));
    shown.page.html(&drawn[0].1);
    shown.page.heading("Time, path, error");
    shown.tables(&tables::measured(&figures), "");
    shown.page.paragraph(NOTES);
    shown.page.html(&drawn[1].1);
    shown.page.heading(&format!("Time to success, at most {limit_s:.0} s"));
    shown.table(&format!("The limit is {limit_s:.0} s"), &tables::restricted(&figures));
    shown.page.paragraph(RESTRICTED_NOTES);
    shown.page.html(&drawn[2].1);
    if !comparisons.is_empty() {
        shown.page.heading("Arm against arm");
        if let Some(arm) = about.against {
            shown.page.paragraph(&format!("Each arm is compared with {arm}."));
        } else if names.len() > pairs::EACH_WITH_EACH {
            shown.page.paragraph("With so many arms each is compared with the first.");
        }
        shown.tables(&tables::pairs(&comparisons), ", arm against arm");
        for warning in comparisons.iter().filter_map(|c| c.warning.as_ref()) {
            shown.paragraph(&format!("Warning: {warning}"));
        }
        shown.page.paragraph(PAIR_NOTES);
        shown.page.html(&drawn[3].1);
    }
    if !conditions.is_empty() {
        let table = tables::conditions(&conditions);
        shown.page.heading("Conditions");
        shown.page.table(&table.head, &table.rows, false);
    }
    if !reliable.is_empty() {
        let title = "How sure the maps are";
        shown.page.heading(title);
        shown.table(title, &reliability::table(&reliable));
        shown.paragraph(&reliability::notes(&reliable));
        shown.page.html(&reliability::picture(&reliable));
    }
    tracks::section(&mut shown, about.shown, names.len());
    shown.page.heading("Where the time goes");
    shown.paragraph(&Walls::sum(rows).describe());
    if let Some(r) = rows.iter().filter(|r| r.error.is_some()).min_by_key(|r| r.run) {
        shown.paragraph(&format!("First failure: run {}: {}", r.run, r.error.as_deref().unwrap_or_default()));
    }
    kept.write("report.html", shown.page.end().as_bytes());
    Ok(WrittenReport { text: shown.text, files: kept.done()?, removed: folder.removed().to_vec() })
}

/// What counts as a success, and whether figures of several conditions are pooled.
fn success_words(about: &About<'_>, conditions: &[ConditionFigures]) -> Vec<String> {
    let mut said = Vec::new();
    match about.success {
        [] => {}
        [rule] => said.push(format!("Success: {rule}.")),
        rules => said.push(format!("Success is not the same in all arms and conditions: {}.", rules.join("; or "))),
    }
    let mut names: Vec<&str> = conditions.iter().map(|c| c.condition.as_str()).collect();
    names.dedup();
    if names.len() > 1 {
        said.push(format!(
            "Pooled: each figure of an arm is over all {} conditions; conditions.csv and report.html have the success \
             under each.",
            names.len()
        ));
    }
    said
}

fn heading(about: &About<'_>, done: usize) -> String {
    let part = if (done as u64) < about.planned {
        format!("{done} of {} runs: a part of the campaign", about.planned)
    } else {
        format!("{done} runs")
    };
    format!(
        "Campaign {}: scenario {}, {part}{}; version {}, hash {}.",
        about.name,
        about.scenario,
        if about.seeds.is_empty() { String::new() } else { format!(", {}", about.seeds) },
        about.version,
        about.hash
    )
}
