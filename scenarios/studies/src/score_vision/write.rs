//! The results as a table, CSV, JSON and figures.

use super::figures::{Figures, curves, figures, range_words, shares};
use super::methods::Method;
use super::pixels::Ratio;
use super::roc::Roc;
use super::run::{ScenePlan, SceneRow};
use crate::campaign::report::{Table, TableColumn};
use crate::campaign::stats::Interval;
use output::files::{PendingFiles, ReportError, csv_number, csv_text};
use serde::Serialize;
use world::files::Folder;

/// The figures as a table, with 95 % intervals.
pub fn table(rows: &[SceneRow]) -> String {
    let share = |(n, k): (u64, u64), i: &Interval| format!("{k}/{n} ({:.0}–{:.0} %)", 100.0 * i.low, 100.0 * i.high);
    let area = |v: &Roc| match (v.area, &v.area_interval) {
        (Some(a), Some(i)) => format!("{a:.2} ({:.2}–{:.2})", i.low, i.high),
        _ => "–".to_string(),
    };
    let columns: [TableColumn<'_, Figures>; 9] = [
        ("way", &|f| f.method.name().to_string()),
        ("visibility", &|f| range_words(f.visibility_m)),
        ("dye: precision", &|f| percent(&f.dye_precision)),
        ("recall", &|f| percent(&f.dye_recall)),
        ("source: precision", &|f| percent(&f.source_precision)),
        ("recall", &|f| percent(&f.source_recall)),
        ("verified of those with a source", &|f| share(f.verification.with, &f.verification.true_share)),
        ("of those without", &|f| share(f.verification.without, &f.verification.false_share)),
        ("area under the curve", &|f| area(&f.verification)),
    ];
    Table::of(figures(rows), &columns).markdown()
}

fn percent(r: &Ratio) -> String {
    match (r.value, &r.interval) {
        (Some(v), Some(i)) => format!("{:.0} % ({:.0}–{:.0})", 100.0 * v, 100.0 * i.low, 100.0 * i.high),
        (Some(v), None) => format!("{:.0} %", 100.0 * v),
        _ => "–".to_string(),
    }
}

/// Writes `scores.md`, `scores.csv`, `scores.json`, `scenes.csv` and the figures into a folder.
///
/// # Errors
/// If files cannot be written; names each such file. All others are written.
pub fn write(out: &Folder, plan: &ScenePlan, rows: &[SceneRow]) -> Result<(), ReportError> {
    let mut kept = PendingFiles::new(out);
    let all = figures(rows);
    let head = format!(
        "{} scenes of {} x {} px, seed {}; intervals 95 %\n\n",
        plan.scenes, plan.size_px[0], plan.size_px[1], plan.seed
    );
    kept.write("scores.md", (head + &table(rows)).as_bytes());
    kept.write("scores.csv", scores_csv(&all).as_bytes());
    kept.write("scenes.csv", scenes_csv(rows).as_bytes());
    #[derive(Serialize)]
    struct Scores<'a> {
        plan: &'a ScenePlan,
        figures: &'a [Figures],
    }
    let json = serde_json::to_string_pretty(&Scores { plan, figures: &all }).expect("plain numbers");
    kept.write("scores.json", json.as_bytes());
    for (name, canvas) in [("pixels", shares(&all)), ("roc", curves(&all))] {
        kept.figure(name, &canvas.svg(name));
    }
    kept.done().map(drop)
}

/// The name without the commas, so that simple readers of CSV get along.
fn plain(method: Method) -> String {
    method.name().replace(',', "")
}

fn scores_csv(all: &[Figures]) -> String {
    let of_method = |f: &Figures| {
        let (low_m, high_m) = f.visibility_m.unzip();
        let v = &f.verification;
        let line = |name: &str, n: u64, count: Option<u64>, value, i: Option<Interval>| {
            [
                plain(f.method),
                csv_number(low_m),
                csv_number(high_m),
                name.to_string(),
                n.to_string(),
                count.map_or(String::new(), |c| c.to_string()),
                csv_number(value),
                csv_number(i.map(|i| i.low)),
                csv_number(i.map(|i| i.high)),
            ]
        };
        let of_pixels = f.shares().map(|(name, r)| line(name, r.pictures as u64, None, r.value, r.interval));
        let of_verdicts =
            [("verified_with_source", v.with, v.true_share), ("verified_without_source", v.without, v.false_share)]
                .map(|(name, (n, k), i)| {
                    let share = (n > 0).then(|| k as f64 / n as f64);
                    line(name, n, Some(k), share, Some(i))
                });
        let both = v.with.0 + v.without.0;
        let area = line("area_under_curve", both, None, v.area, v.area_interval);
        of_pixels.into_iter().chain(of_verdicts).chain([area])
    };
    csv_text("method,visibility_low_m,visibility_high_m,figure,n,count,value,low,high", all.iter().flat_map(of_method))
}

fn scenes_csv(rows: &[SceneRow]) -> String {
    let columns: [TableColumn<'_, &SceneRow>; 19] = [
        ("scene", &|r| r.scene.n.to_string()),
        ("content", &|r| r.scene.content.name().to_string()),
        ("visibility_m", &|r| format!("{:.3}", r.scene.visibility_m)),
        ("illuminance_klx", &|r| format!("{:.2}", r.scene.illuminance_klx)),
        ("sun_elevation_deg", &|r| format!("{:.1}", r.scene.sun_elevation_deg)),
        ("current_m_s", &|r| r.scene.current_m_s.to_string()),
        ("dye_g_min", &|r| format!("{:.3}", r.scene.dye_g_min)),
        ("albedo", &|r| format!("{:.4}", r.scene.albedo)),
        ("range_m", &|r| format!("{:.3}", r.scene.range_m)),
        ("height_m", &|r| format!("{:.3}", r.scene.height_m)),
        ("method", &|r| plain(r.method)),
        ("dye_hit", &|r| r.dye.hit.to_string()),
        ("dye_false", &|r| r.dye.false_alarm.to_string()),
        ("dye_missed", &|r| r.dye.missed.to_string()),
        ("source_hit", &|r| r.source.hit.to_string()),
        ("source_false", &|r| r.source.false_alarm.to_string()),
        ("source_missed", &|r| r.source.missed.to_string()),
        ("score", &|r| r.score.to_string()),
        ("verified", &|r| r.verified.to_string()),
    ];
    Table::of(rows, &columns).csv()
}

#[cfg(test)]
mod tests {
    use super::super::draw::{BINS, draw};
    use super::super::methods::METHODS;
    use super::super::pixels::Counts;
    use super::*;
    use robots::strategy::VerifierSpec;

    fn rows() -> Vec<SceneRow> {
        (0..24)
            .flat_map(|n| METHODS.map(|method| (n, method)))
            .map(|(n, method)| {
                let scene = draw(1, n);
                let there = scene.content == super::super::Content::Source;
                let counts = |hit| Counts { hit, false_alarm: 5, missed: 5 };
                SceneRow {
                    dye: counts(15),
                    source: if there { counts(5) } else { Counts::default() },
                    score: if there { 2.0 } else { 0.5 },
                    verified: there,
                    scene,
                    method,
                }
            })
            .collect()
    }

    #[test]
    fn every_way_and_range_has_its_line() {
        let text = table(&rows());
        assert_eq!(text.lines().count(), 2 + METHODS.len() * (1 + BINS.len()));
        let line = "| clusters | 1.5–3 m | 75 % (75–75) | 75 % (75–75) | 50 % (50–50) | 50 % (50–50) | 3/3 (44–100 %) | 0/3 (0–56 %) | 1.00 (1.00–1.00) |";
        assert!(text.contains(line), "{text}");
    }

    #[test]
    fn all_files_are_written() {
        let folder = tempfile::tempdir().unwrap();
        let plan = ScenePlan { seed: 1, scenes: 24, size_px: [320, 240], verifier: VerifierSpec::default() };
        let out = output::files::begin_folder(folder.path(), "score-vision").unwrap();
        write(&out, &plan, &rows()).unwrap();
        for name in
            ["scores.md", "scores.csv", "scores.json", "scenes.csv", "pixels.svg", "pixels.png", "roc.svg", "roc.png"]
        {
            assert!(folder.path().join(name).is_file(), "{name}");
        }
        let csv = std::fs::read_to_string(folder.path().join("scores.csv")).unwrap();
        assert!(csv.contains("given back,6,12,verified_with_source,3,3,1,"), "{csv}");
        for name in ["scores.csv", "scenes.csv"] {
            let csv = std::fs::read_to_string(folder.path().join(name)).unwrap();
            let fields = |line: &str| line.split(',').count();
            let head = csv.lines().next().map(fields);
            assert!(csv.lines().all(|l| Some(fields(l)) == head), "{name}: {csv}");
        }
    }
}
