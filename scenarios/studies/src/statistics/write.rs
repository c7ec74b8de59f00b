//! The figures as a table to read and as CSV.

use super::figure::{PlumeFigure, Statistics};
use crate::campaign::report::{Table, TableColumn};
use output::files::{ReportError, csv_number, make_folder, write_whole};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// The table: figure, ours, expected, ratio, source; `!` marks a ratio outside 0.5 to 2.
pub fn table(statistics: &Statistics) -> String {
    let s = statistics;
    let mut out = format!("{}: plume statistics, seed {}, {} s after the spin-up\n\n", s.name, s.seed, s.watched_s);
    let mark = |f: &PlumeFigure| if f.flagged() { "!" } else { "" };
    let columns: [TableColumn<'_, &PlumeFigure>; 6] = [
        ("figure", &|f| f.name.clone()),
        ("unit", &|f| f.unit.to_string()),
        ("ours", &|f| number(f.ours)),
        ("expected", &|f| f.expected.map_or(String::new(), number)),
        ("ratio", &|f| f.ratio().map_or(String::new(), |r| format!("{r:.2}{}", mark(f)))),
        ("source", &|f| f.source.to_string()),
    ];
    out.push_str(&Table::of(&s.figures, &columns).text(None));
    let flagged = s.figures.iter().filter(|f| f.flagged()).count();
    let _ = writeln!(
        out,
        "\n{flagged} of {} figures with an expectation lie outside a factor of 0.5 to 2 (marked !)",
        s.figures.iter().filter(|f| f.expected.is_some()).count()
    );
    out
}

fn number(v: f64) -> String {
    if v != 0.0 && !(0.001..10_000.0).contains(&v.abs()) { format!("{v:.2e}") } else { format!("{v:.4}") }
}

/// Writes `statistics.csv` into a folder.
///
/// # Errors
/// If the folder or the file cannot be written.
pub fn write(folder: &Path, statistics: &Statistics) -> Result<PathBuf, ReportError> {
    let columns: [TableColumn<'_, &PlumeFigure>; 7] = [
        ("figure", &|f| f.name.clone()),
        ("unit", &|f| f.unit.to_string()),
        ("ours", &|f| f.ours.to_string()),
        ("expected", &|f| csv_number(f.expected)),
        ("ratio", &|f| csv_number(f.ratio())),
        ("outside_factor_2", &|f| f.flagged().to_string()),
        ("source", &|f| f.source.to_string()),
    ];
    let csv = Table::of(&statistics.figures, &columns).csv();
    make_folder(folder)?;
    write_whole(&folder.join("statistics.csv"), csv.as_bytes())
}

#[cfg(test)]
mod tests {
    use super::super::figure::PlumeFigure;
    use super::*;

    fn statistics() -> Statistics {
        let figure = |name: &str, ours, expected| PlumeFigure {
            name: name.into(),
            unit: "m",
            ours,
            expected,
            source: "somewhere",
        };
        Statistics {
            name: "pond".into(),
            seed: 3,
            watched_s: 60.0,
            figures: vec![
                figure("width", 0.05, Some(0.04)),
                figure("far off", 0.05, Some(0.2)),
                figure("ours alone", 2.5e-5, None),
            ],
        }
    }

    #[test]
    fn what_is_off_is_marked() {
        let text = table(&statistics());
        assert!(text.contains("width       m     0.0500   0.0400    1.25   somewhere"), "{text}");
        assert!(text.contains("0.25!"), "{text}");
        assert!(text.contains("ours alone  m     2.50e-5                   somewhere"), "{text}");
        assert!(text.contains("1 of 2 figures"), "{text}");
    }

    #[test]
    fn csv_has_a_row_for_each() {
        let folder = tempfile::tempdir().unwrap();
        let path = write(folder.path(), &statistics()).unwrap();
        let text = std::fs::read_to_string(path).unwrap();
        assert_eq!(text.lines().count(), 4);
        assert_eq!(text.lines().nth(2).unwrap(), "far off,m,0.05,0.2,0.25,true,somewhere");
    }
}
