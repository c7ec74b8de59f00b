//! Everything a campaign's report consists of, written into one folder.

use super::arms::{self, arm_names, of_arm};
use super::page::Page;
use super::text::align;
use super::walls::Walls;
use super::{curves, pairs, plots, tables};
use crate::campaign::RunRow;
use crate::report::figures::png;
use crate::report::{ReportError, make_folder, write_whole};
use std::path::{Path, PathBuf};

/// What the report says about the campaign beside its rows.
#[derive(Clone, Copy, Debug)]
pub struct About<'a> {
    /// Name of the campaign.
    pub name: &'a str,
    /// Base scenario.
    pub scenario: &'a str,
    /// Hash of what was run.
    pub hash: &'a str,
    /// Version that ran it.
    pub version: &'a str,
    /// Arms in the order to show them; others follow in the order of their rows.
    pub arms: &'a [String],
    /// Runs planned; fewer rows are said to be a part.
    pub planned: u64,
}

/// What a report came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Written {
    /// The tables as plain text.
    pub text: String,
    /// The files.
    pub files: Vec<PathBuf>,
}

const NOTES: &str = "Shares: Wilson's 95 % interval; a failed run counts as neither declared nor successful. Time and \
    error are of runs that declared, the path of all that did not fail: median and 90 % quantile (linear between order \
    statistics) with 95 % bootstrap intervals. With fewer than 36 values the 90 % quantile's upper end covers less than \
    it says.";

const PAIR_NOTES: &str = "Pairs are runs of the same seed and condition. Success: interval of Agresti and Min (2005). Time, \
    path, error: median of the differences within pairs where both arms have it, with its bootstrap interval; less is \
    better. Each comparison holds for itself: of twenty, one finds something by chance.";

/// Writes tables (CSV), figures (SVG and PNG) and `report.html` of a campaign's rows into a folder, making it if
/// need be. The order of the rows changes nothing.
///
/// # Errors
/// If the folder or a file cannot be written.
pub fn write(dir: &Path, about: &About<'_>, rows: &[RunRow]) -> Result<Written, ReportError> {
    make_folder(dir)?;
    let names = arm_names(about.arms, rows);
    let grouped: Vec<(&String, Vec<&RunRow>)> = names
        .iter()
        .map(|name| (name, of_arm(rows, name)))
        .collect();
    let figures: Vec<_> = grouped
        .iter()
        .map(|(name, rows)| arms::figures(name, rows))
        .collect();
    let conditions = arms::conditions(&names, rows);
    let comparisons = pairs::comparisons(&names, rows);
    let waiting: Vec<_> = grouped
        .iter()
        .map(|(name, rows)| curves::not_yet_declared(name, rows))
        .collect();
    let errors: Vec<_> = grouped
        .iter()
        .map(|(name, rows)| curves::errors(name, rows))
        .collect();

    let mut files = Vec::new();
    let mut keep = |name: &str, bytes: &[u8]| -> Result<(), ReportError> {
        files.push(write_whole(&dir.join(name), bytes)?);
        Ok(())
    };
    keep("arms.csv", tables::arms_csv(&figures).as_bytes())?;
    keep(
        "not_yet_declared.csv",
        tables::curves_csv("t_s", &waiting).as_bytes(),
    )?;
    keep(
        "errors.csv",
        tables::curves_csv("error_m", &errors).as_bytes(),
    )?;
    if !comparisons.is_empty() {
        keep(
            "differences.csv",
            tables::pairs_csv(&comparisons).as_bytes(),
        )?;
    }
    if !conditions.is_empty() {
        keep(
            "conditions.csv",
            tables::conditions_csv(&conditions).as_bytes(),
        )?;
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
        keep(&format!("{name}.svg"), svg.as_bytes())?;
        let path = dir.join(format!("{name}.png"));
        let picture = png(svg).map_err(|cause| ReportError::Draw { path, cause })?;
        keep(&format!("{name}.png"), &picture)?;
    }

    let success = tables::success(&figures);
    let measured = tables::measured(&figures);
    let compared = tables::pairs(&comparisons);
    let walls = Walls::of(rows).words();
    let first_error = rows
        .iter()
        .filter(|r| r.error.is_some())
        .min_by_key(|r| r.run)
        .map(|r| {
            format!(
                "First failure: run {}: {}",
                r.run,
                r.error.as_deref().unwrap_or_default()
            )
        });

    let mut page = Page::new(about.name);
    page.paragraph(&heading(about, rows.len()));
    page.heading("Success");
    page.table(&tables::SUCCESS, &success);
    page.svg(&drawn[0].1);
    page.heading("Time, path, error");
    page.table(&tables::MEASURED, &measured);
    page.paragraph(NOTES);
    page.svg(&drawn[1].1);
    page.svg(&drawn[2].1);
    if !comparisons.is_empty() {
        page.heading("Arm against arm");
        page.table(&tables::PAIRS, &compared);
        page.paragraph(PAIR_NOTES);
        if names.len() > pairs::EACH_WITH_EACH {
            page.paragraph("With so many arms each is compared with the first.");
        }
        page.svg(&drawn[3].1);
    }
    if !conditions.is_empty() {
        page.heading("Conditions");
        page.table(&tables::CONDITIONS, &tables::conditions(&conditions));
    }
    page.heading("Where the time goes");
    page.paragraph(&walls);
    if let Some(error) = &first_error {
        page.paragraph(error);
    }
    keep("report.html", page.end().as_bytes())?;

    let mut text = format!("{}\n\n", heading(about, rows.len()));
    text.push_str(&align(&tables::SUCCESS, &success));
    text.push('\n');
    text.push_str(&align(&tables::MEASURED, &measured));
    if !comparisons.is_empty() {
        text.push('\n');
        text.push_str(&align(&tables::PAIRS, &compared));
    }
    text.push('\n');
    text.push_str(&walls);
    text.push('\n');
    if let Some(error) = first_error {
        text.push_str(&error);
        text.push('\n');
    }
    Ok(Written { text, files })
}

fn heading(about: &About<'_>, done: usize) -> String {
    let part = if (done as u64) < about.planned {
        format!("{done} of {} runs: a part of the campaign", about.planned)
    } else {
        format!("{done} runs")
    };
    format!(
        "Campaign {}: scenario {}, {part}; version {}, hash {}.",
        about.name, about.scenario, about.version, about.hash
    )
}
