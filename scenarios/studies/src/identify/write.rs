//! What was identified, for people and for programs.

use super::marginal::After;
use super::next::{HEAD, next_round};
use super::pairs::pairs;
use super::{Identification, JudgedDraw};
use crate::campaign::CampaignSpec;
use crate::campaign::report::{Table, TableColumn};
use crate::distribution::Distribution as Prior;
use output::files::{PendingFiles, ReportError, begin_folder, csv_number, write_whole};
use std::io;
use std::path::{Path, PathBuf};
use world::files::{self, OutputError};

/// Draws that the text shows.
const SHOWN: usize = 10;
/// Longest campaign file, bytes.
const LONGEST: u64 = 1 << 20;
/// Seeds of the next round.
const SEEDS: u64 = 20;

/// The tables as text for a terminal, or as Markdown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IdentificationText {
    /// For a terminal.
    Plain,
    /// For a page.
    Markdown,
}

/// What was identified in words and tables.
pub fn text(found: &Identification, title: &str, form: IdentificationText) -> String {
    let shown = |table: &Table| match form {
        IdentificationText::Plain => table.text(None),
        IdentificationText::Markdown => table.markdown(),
    };
    let runs: usize = found.draws.iter().map(|d| d.draw.runs.len()).sum();
    let distance = |n: usize| found.draws.get(n).map_or(f64::NAN, |d| d.distance);
    format!(
        "{title}\n\n{} draws, {runs} runs. Accepted are the {} nearest, at distances from {:.1} to {:.1} standard errors. A \
         paper about the truth lies at about {:.1}.\n\n{}\n{}",
        found.draws.len(),
        found.accepted,
        distance(0),
        distance(found.accepted.saturating_sub(1)),
        (found.figures.len() as f64).sqrt(),
        shown(&unknowns(found)),
        shown(&nearest(found)),
    )
}

fn unknowns(found: &Identification) -> Table {
    let rows = found.marginals.iter().map(|m| {
        let before = match &m.unknown.prior {
            Prior::Uniform(a, b) => format!("{a} to {b}"),
            Prior::LogUniform(a, b) => format!("{a} to {b}, in the logarithm"),
            Prior::Choice(all) => all.join(", "),
        };
        let after = match &m.after {
            After::Number(median, i) => format!("{median:.4} ({:.4} to {:.4})", i.low, i.high),
            After::Choice(all) => {
                let each = all.iter().map(|(value, share)| format!("{value}: {:.0} %", 100.0 * share));
                each.collect::<Vec<_>>().join(", ")
            }
        };
        [m.unknown.path.clone(), before, after]
    });
    let columns: [TableColumn<'_, [String; 3]>; 3] = [
        ("unknown", &|r| r[0].clone()),
        ("before", &|r| r[1].clone()),
        ("after: median (95 %), or shares", &|r| r[2].clone()),
    ];
    Table::of(rows, &columns)
}

fn nearest(found: &Identification) -> Table {
    let mut heads: Vec<String> = vec!["draw".into(), "standard errors away".into(), "runs".into()];
    heads.extend(found.figures.iter().map(|f| f.name.clone()));
    let row = |d: &JudgedDraw| {
        let mut cells = vec![d.draw.name.clone(), format!("{:.1}", d.distance), d.draw.runs.len().to_string()];
        cells.extend(found.figures.iter().zip(&d.ours).map(|(f, ours)| {
            let unit = f.figure.quantity.unit();
            ours.map_or("-".to_string(), |v| unit.scale([v]).show(v))
        }));
        cells
    };
    let mut papers = vec!["the paper".to_string(), String::new(), String::new()];
    papers.extend(found.figures.iter().map(|f| {
        let (value, _) = f.value_and_error(0.0);
        let shown = f.figure.quantity.unit().scale([value]).show(value);
        if f.is_bound() { format!("at least {shown}") } else { shown }
    }));
    let rows: Vec<Vec<String>> = found.draws.iter().take(SHOWN).map(row).chain([papers]).collect();
    Table { head: heads, rows }
}

/// Writes `IDENTIFICATION.md`, `draws.csv`, `pairs.svg` and `.png`, and the campaign of the next round, `next.ron`.
///
/// # Errors
/// If the folder or a file cannot be written.
pub fn write(
    dir: &Path,
    found: &Identification,
    last: &CampaignSpec,
    command: &str,
) -> Result<Vec<PathBuf>, ReportError> {
    let folder = begin_folder(dir, "campaign identify")?;
    let mut written = PendingFiles::new(&folder);
    let page = text(found, &format!("# {}", last.title), IdentificationText::Markdown);
    written.write("IDENTIFICATION.md", format!("{page}\nBy `{command}`.\n\n![pairs](pairs.svg)\n").as_bytes());
    written.write("draws.csv", draws(found).as_bytes());
    written.figure("pairs", &pairs(found));
    if let Some(next) = next_round(found, last, SEEDS) {
        // A scenario's ending: what is no campaign of ours is somebody's.
        let path = dir.join("next.ron");
        let there = files::read_text(&path, LONGEST);
        let ours = there.map_or_else(|e| e.kind() == io::ErrorKind::NotFound, |text| text.starts_with(HEAD));
        written.take(if ours { write_whole(&path, next.as_bytes()) } else { Err(somebodys(&path)) });
    }
    written.done()
}

fn somebodys(path: &Path) -> ReportError {
    let source =
        io::Error::other("it is there and is no campaign of this command: move it away, or name another folder");
    OutputError::new(path, source).into()
}

fn draws(found: &Identification) -> String {
    let mut heads = ["draw", "standard_errors_away", "runs"].map(str::to_string).to_vec();
    heads.extend(found.marginals.iter().map(|m| m.unknown.path.clone()));
    heads.extend(found.figures.iter().map(|f| f.name.replace(',', ";")));
    let row = |d: &JudgedDraw| {
        let numbers = [d.distance.to_string(), d.draw.runs.len().to_string()];
        let mut cells = [vec![d.draw.name.clone()], numbers.to_vec()].concat();
        cells.extend(found.marginals.iter().map(|m| d.draw.value(&m.unknown.path).unwrap_or_default().to_string()));
        cells.extend(d.ours.iter().map(|ours| csv_number(*ours)));
        cells
    };
    Table { head: heads, rows: found.draws.iter().map(row).collect() }.csv()
}
