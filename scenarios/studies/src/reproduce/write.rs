//! The reproduction table on the screen and in REPRODUCTION.md, and its runs as CSV.

use super::compare::{FigureComparison, Standing};
use super::joint::joint;
use super::published::Published;
use super::row::Paper;
use super::run::RowResult;
use crate::campaign::as_csv;
use crate::campaign::report::{Reliability, Table, TableColumn, Walls, range, reliability, reliable, wrapped};
use crate::campaign::stats::Interval;
use output::files::{ReportError, csv_number, make_folder, write_whole};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

const TEXT: &str = "writing to a String succeeds";

/// The figures of a row beside the paper's.
fn figures(r: &RowResult) -> Table {
    Table::new(["figure", "ours", "95 % interval", "n", "paper", "the paper's is"], r.figures.iter().map(cells))
}

/// A row of the table; all its values have one unit.
fn cells(c: &FigureComparison) -> [String; 6] {
    let paper = c.figure.paper.map(Paper::value);
    let ends = |i: Option<Interval>| i.map_or([None; 2], |i| [Some(i.low), Some(i.high)]);
    let intervals = [ends(c.ours.interval), ends(c.papers_interval)];
    let values = [c.ours.value, paper].into_iter().chain(intervals.into_iter().flatten());
    let unit = c.figure.quantity.unit().scale(values.flatten());
    let ours = match (c.ours.value, c.ours.count) {
        (Some(v), Some(k)) => format!("{k}/{} = {}", c.ours.n, unit.show(v)),
        (Some(v), None) => unit.show(v),
        (None, _) => "none".to_string(),
    };
    let interval = match (c.ours.interval, c.ours.count) {
        (Some(share), Some(_)) => unit.show_interval(share),
        (i, _) => range(c.ours.n, i, |i| unit.show_interval(i)),
    };
    let mut paper = match c.figure.paper {
        Some(Paper::Value(v) | Paper::MeanOf(v, _)) => unit.show(v),
        Some(Paper::Measured(v, error)) => format!("{} +- {}", unit.show(v), unit.show(error)),
        Some(Paper::AtLeast(v, _)) => format!("at least {}", unit.show(v)),
        Some(Paper::Run(v)) => format!("{}, one run", unit.show(v)),
        Some(Paper::Count(k, n)) => format!("{k}/{n} = {}", unit.show(k as f64 / n as f64)),
        Some(Paper::RunCount(k, n)) => format!("{k} of {n}"),
        None => "-".to_string(),
    };
    if let Some(i) = c.papers_interval {
        write!(paper, " [{}]", unit.show_interval(i)).expect(TEXT);
    }
    let standing = c.standing.label().to_string();
    [c.figure.name.clone(), ours, interval, c.ours.n.to_string(), paper, standing]
}

fn runs_line(r: &RowResult) -> String {
    let failed = r.runs.iter().filter(|x| x.error.is_some()).count();
    let last = r.runs.iter().map(|x| x.seed).max().unwrap_or(0);
    let first = r.runs.iter().map(|x| x.seed).min().unwrap_or(0);
    let mut line = format!("{} runs, seeds {first} to {last}", r.runs.len());
    if r.row.arms.len() > 1 {
        write!(line, ", {} arms", r.row.arms.len()).expect(TEXT);
    }
    if failed > 0 {
        write!(line, ", {failed} of them FAILED (counted as not declared)").expect(TEXT);
    }
    line
}

/// For each arm of whose published figures the errors are known: whether all of them come out together.
fn together(r: &RowResult) -> Vec<String> {
    let of = |arm: &str| {
        let figures = Published::of(&r.row.figures, Some(arm));
        let runs: Vec<_> = r.runs.iter().filter(|run| run.arm == arm).cloned().collect();
        let found = joint(&figures, &runs).filter(|_| figures.len() > 1)?;
        let apart = figures.iter().zip(&found.above).map(|(f, z)| format!("{} {z:+.1}", f.name));
        Some(format!(
            "{arm}: the paper's {} figures together are {} the region of 95 % of papers about such runs (squared \
             distance {:.1}; farther: {:.2} % of papers). Standard errors above ours: {}.",
            figures.len(),
            if found.is_inside() { "inside" } else { "outside" },
            found.squared,
            100.0 * found.farther,
            apart.collect::<Vec<_>>().join("; ")
        ))
    };
    r.row.arms.iter().filter_map(|arm| of(&arm.name)).collect()
}

/// The first error of a failed run, for people.
fn first_error(r: &RowResult) -> Option<String> {
    let bad = r.runs.iter().find(|x| x.error.is_some())?;
    Some(format!("seed {}: {}", bad.seed, bad.error.as_deref()?))
}

/// The table of a row as plain text, in at most `columns` characters where there is such a limit.
pub fn table(r: &RowResult, columns: Option<usize>) -> String {
    let line = |words: &str| wrapped(words, columns).trim_end().to_string();
    let mut out = line(&format!("{}: {}", r.row.id, r.row.what));
    let runs = line(&format!("{} [{}]", runs_line(r), r.row.source));
    writeln!(out, "\n{runs}\n").expect(TEXT);
    out.push_str(&figures(r).text(columns));
    for words in together(r) {
        writeln!(out, "\n{}", line(&words)).expect(TEXT);
    }
    let maps = maps(r);
    if !maps.is_empty() {
        out.push('\n');
        out.push_str(&reliable::table(&maps).text(columns));
        writeln!(out, "\n{}", line(&reliable::notes(&maps))).expect(TEXT);
    }
    if let Some(error) = first_error(r) {
        writeln!(out, "\n{}", line(&format!("first failure: {error}"))).expect(TEXT);
    }
    writeln!(out, "\n{}", line(&Walls::sum(&r.runs).describe())).expect(TEXT);
    out
}

/// How reliable the maps of a row's arms are, in the order of the arms; none if the row does not show it.
fn maps(r: &RowResult) -> Vec<Reliability> {
    if !r.row.reliability {
        return Vec::new();
    }
    let of = |arm: &String| {
        let runs: Vec<_> = r.runs.iter().filter(|run| run.arm == *arm).collect();
        reliability(arm, &runs)
    };
    r.row.arms.iter().flat_map(|a| of(&a.name)).collect()
}

/// Writes REPRODUCTION.md, figures.csv, rows.csv and declarations.csv into a folder, which is made if necessary. The first
/// says by which command all of it came about.
///
/// # Errors
/// If the folder or a file cannot be written; all other files are written.
pub fn write(dir: &Path, all: &[RowResult], command: &str) -> Result<Vec<PathBuf>, ReportError> {
    make_folder(dir)?;
    let runs: Vec<_> = all.iter().flat_map(|r| r.runs.iter().cloned()).collect();
    let [rows, declarations] = as_csv(&runs);
    let files = [
        ("REPRODUCTION.md", markdown(all, command)),
        ("figures.csv", figures_csv(all)),
        ("rows.csv", rows),
        ("declarations.csv", declarations),
    ];
    // If one file cannot be written, the others are not affected.
    let mut failures = Vec::new();
    let mut written = Vec::new();
    let mut files = files.map(|(name, text)| (name.to_string(), text)).to_vec();
    for r in all {
        let maps = maps(r);
        if !maps.is_empty() {
            files.push((format!("{}.csv", r.row.id), reliable::csv(&maps)));
            let svg = reliable::picture(&maps);
            files.push((format!("{}.svg", r.row.id), svg));
        }
    }
    for (name, text) in files {
        match write_whole(&dir.join(name), text.as_bytes()) {
            Ok(path) => written.push(path),
            Err(error) => failures.push(error),
        }
    }
    ReportError::combine(failures).map_or(Ok(written), Err)
}

fn markdown(all: &[RowResult], command: &str) -> String {
    let mut out = format!(
        "# Reproduction\n\nWritten by `{command}`, version {}. Every run is in rows.csv, every declaration in \
         declarations.csv, every figure in figures.csv.\n\n\
         Shares come with Wilson's 95 % interval (in brackets the paper's own, from its counts); quantiles (linear \
         between order statistics) with a 95 % bootstrap interval of the quantile (percentile, {} resamples, seed 1); means with Student's, of \
         quantities that cannot be below 0 on the scale of the logarithm; of fewer than 5 values there is none. Errors are of those \
         runs that declared: n says how many. A paper's figure marked \"one run\" is a single mission: \"among our single \
         runs\" says that 95 % of ours lie about it, though it lies outside the interval of our median.\n",
        env!("CARGO_PKG_VERSION"),
        crate::campaign::stats::RESAMPLES
    );
    for r in all {
        writeln!(out, "\n## {}\n\n{}.\n", r.row.id, r.row.what).expect(TEXT);
        writeln!(
            out,
            "Source: {}. Scenario `{}` (hash {}). {}.\n",
            r.row.source,
            r.scenario.0,
            r.scenario.1,
            runs_line(r)
        )
        .expect(TEXT);
        writeln!(out, "{}", figures(r).markdown()).expect(TEXT);
        for c in r.figures.iter().filter(|c| !c.figure.note.is_empty()) {
            writeln!(out, "- {}: {}.", c.figure.name, c.figure.note).expect(TEXT);
        }
        for words in together(r) {
            writeln!(out, "- {words}").expect(TEXT);
        }
        let maps = maps(r);
        if !maps.is_empty() {
            let (table, notes) = (reliable::table(&maps).markdown(), reliable::notes(&maps));
            writeln!(out, "\n{table}\n{notes}\n\n![]({}.svg)\n", r.row.id).expect(TEXT);
        }
        if let Some(error) = first_error(r) {
            writeln!(out, "- First failure: {error}.").expect(TEXT);
        }
        writeln!(out, "\n{}", Walls::sum(&r.runs).describe()).expect(TEXT);
    }
    out
}

fn figures_csv(all: &[RowResult]) -> String {
    let low = |i: Option<Interval>| csv_number(i.map(|i| i.low));
    let high = |i: Option<Interval>| csv_number(i.map(|i| i.high));
    let standing = |c: &FigureComparison| match c.standing {
        Standing::None => String::new(),
        standing => standing.label().to_string(),
    };
    let columns: [TableColumn<'_, (&RowResult, &FigureComparison)>; 13] = [
        ("row", &|(r, _)| r.row.id.clone()),
        ("figure", &|(_, c)| c.figure.name.clone()),
        ("n", &|(_, c)| c.ours.n.to_string()),
        ("count", &|(_, c)| c.ours.count.map_or(String::new(), |k| k.to_string())),
        ("ours", &|(_, c)| csv_number(c.ours.value)),
        ("low", &|(_, c)| low(c.ours.interval)),
        ("high", &|(_, c)| high(c.ours.interval)),
        ("runs_low", &|(_, c)| low(c.ours.spread)),
        ("runs_high", &|(_, c)| high(c.ours.spread)),
        ("paper", &|(_, c)| csv_number(c.figure.paper.map(Paper::value))),
        ("paper_low", &|(_, c)| low(c.papers_interval)),
        ("paper_high", &|(_, c)| high(c.papers_interval)),
        ("standing", &|(_, c)| standing(c)),
    ];
    Table::of(all.iter().flat_map(|r| r.figures.iter().map(move |c| (r, c))), &columns).csv()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::row::Figure;
    use crate::reproduce::{Estimate, Measure, Quantity};

    /// Values on both sides of a metre are compared in one unit.
    #[test]
    fn a_row_has_one_unit() {
        let figure = Figure {
            name: "error".into(),
            arm: None,
            among: None,
            quantity: Quantity::Median(Measure::ErrorM),
            paper: Some(Paper::Value(0.5)),
            note: String::new(),
        };
        let ours = Estimate {
            n: 20,
            count: None,
            value: Some(0.8),
            interval: Some(Interval { low: 0.4, high: 1.1 }),
            spread: None,
        };
        let compared = FigureComparison { figure, ours, papers_interval: None, standing: Standing::None };
        let row = cells(&compared);
        assert_eq!(row[1..5], ["0.80 m", "0.40 to 1.10 m", "20", "0.50 m"]);
    }
}
