//! `report.html`: one self-contained file.

use super::film::FILM_STYLE;
use super::page::Page;
use crate::charts::escaped;
use crate::results::GantrySummary;
use crate::results::ShownPicture;
use crate::results::{DeclarationSummary, DeclaredKind, Summary};
use robots::handoff::Verdict;
use std::fmt::Write as _;

const TEXT: &str = "writing to a String succeeds";

/// The page: summary, animation (its data), figures (title and SVG), a camera's pictures, scenario.
pub(super) fn page(
    summary: &Summary,
    film: Option<&str>,
    figures: &[(String, String)],
    pictures: &[ShownPicture],
    scenario_text: &str,
) -> String {
    let name = format!("{}, seed {}", summary.scenario, summary.seed);
    let mut page = Page::new(&name, &summary.title, film.map_or("", |_| FILM_STYLE));
    page.html(&format!(
        "<p>{}. Success: {}.<br>Outcome: <span class=\"outcome\">{}</span>.</p>\n",
        escaped(&name),
        escaped(&summary.success_rule),
        summary.outcome.label()
    ));
    if let Some(e) = &summary.error {
        page.paragraph(&format!("Error: {e}"));
    }
    if !summary.abnormal.is_empty() {
        let rows: Vec<(&str, String)> = summary.abnormal.iter().map(|a| (a.robot.as_str(), a.line.clone())).collect();
        page.facts("What went wrong", &rows);
    }
    for r in &summary.robots {
        page.facts(&format!("Robot {}", r.id), &robot_rows(r));
    }
    for g in &summary.gantries {
        page.facts(&format!("Gantry {}", g.id), &gantry_rows(g));
    }
    page.facts("Run", &run_rows(summary));
    if let Some(film) = film {
        page.film("Mission in motion", film);
    }
    for (title, svg) in figures {
        page.html(&format!("<figure><h2>{}</h2>\n{svg}</figure>\n", escaped(title)));
    }
    if !pictures.is_empty() {
        page.heading("Pictures");
        page.html("<div class=\"pictures\">\n");
        for p in pictures {
            let (html, title) = (p.html(), escaped(&p.title()));
            page.html(&format!("<figure>{html}<figcaption>{title}</figcaption></figure>\n"));
        }
        page.html("</div>\n");
    }
    page.heading("Scenario");
    page.html(&format!("<pre>{}</pre>\n", escaped(scenario_text)));
    page.end()
}

fn declaration_rows(d: &DeclarationSummary, several: bool, rows: &mut Vec<(String, String)>) {
    let place = |p: crate::results::Position| format!("{:.1} m east, {:.1} m north", p.east_m, p.north_m);
    let in_region = d.region_name.as_deref();
    if d.kind == DeclaredKind::UpFlowEdge {
        // This declaration does not claim a source here, so the distance to the nearest one is no error.
        let what = format!("the plume leads on over it, {} at {:.0} s", place(d.position), d.t_s);
        let of = in_region.unwrap_or("the area");
        rows.push((format!("Up-flow edge of subregion {of}"), what));
        return;
    }
    let which = if several { d.name.trim_start_matches("source") } else { "" };
    let region = in_region.map_or_else(String::new, |k| format!(", in subregion {k}"));
    let what = format!("{} at {:.0} s ({}){region}", place(d.position), d.t_s, d.rule);
    rows.push((format!("Declared source{which}"), what));
    if d.verdict != Verdict::Unchecked {
        rows.push((format!("Looked at{which}"), looked(d)));
    }
    if let Some(p) = d.surveyed {
        let error =
            (d.surveyed_error.as_ref()).map_or_else(String::new, |e| format!("; {:.1} m from {}", e.total_m, e.source));
        rows.push((format!("Found by the survey{which}"), format!("{}{error}", place(p))));
    }
    if let Some(e) = &d.error {
        let source = format!("{} ({})", place(e.position), e.source);
        rows.push(("Nearest true source".to_owned(), source));
        let mut error = format!("{:.1} m", e.total_m);
        if let (Some(a), Some(b)) = (e.along_flow_m, e.across_flow_m) {
            write!(error, ": {a:+.1} m along the flow (down-flow positive), {b:+.1} m across").expect(TEXT);
        }
        rows.push(("Error".to_owned(), error));
    }
    if let Some(m) = d.fix_m {
        let what = format!("moved its own position by {m:.1} m in the minute before");
        rows.push(("Position fixes".to_owned(), what));
    }
}

/// What a look at a declared place said, and by which pictures.
fn looked(d: &DeclarationSummary) -> String {
    let mut said = d.verdict.label().to_owned();
    if let Some(l) = &d.looked {
        write!(
            said,
            " by {} pictures from {} lines, the lowest {:.1} m above the bed: ln of the Bayes factor {:+.1}",
            l.pictures, l.lines, l.lowest_m, l.log_factor
        )
        .expect(TEXT);
        if let Some(m) = l.visibility_m {
            write!(said, ", visibility {m:.1} m").expect(TEXT);
        }
        if l.useless > 0 {
            write!(said, "; {} more showed nothing", l.useless).expect(TEXT);
        }
    }
    said
}

fn robot_rows(r: &crate::results::RobotSummary) -> Vec<(String, String)> {
    let mut rows = Vec::new();
    let several = r.sources_declared > 1;
    if r.sources_declared == 0 {
        rows.push(("Declared source".to_owned(), "none".to_owned()));
    }
    for d in &r.declarations {
        declaration_rows(d, several, &mut rows);
    }
    if let Some(remark) = r.map.as_ref().and_then(|m| m.remark.as_ref()) {
        rows.push(("Beware".to_owned(), remark.clone()));
    }
    for region in &r.regions {
        let mut what = region.state.label().to_owned();
        if let (Some(from), Some(until)) = (region.from_s, region.until_s) {
            write!(what, ", searched from {from:.0} to {until:.0} s").expect(TEXT);
        }
        rows.push((format!("Subregion {}", region.name), what));
    }
    rows.extend(way_rows(r).map(|(k, v)| (k.to_owned(), v)));
    rows
}

fn way_rows(r: &crate::results::RobotSummary) -> impl Iterator<Item = (&'static str, String)> {
    let mut rows = Vec::new();
    if let Some(t) = r.first_detection_s {
        rows.push(("First detection", format!("{t:.1} s")));
    }
    rows.push(("Detections", r.detections.to_string()));
    if let Some(m) = r.traced_m {
        rows.push(("Traced", format!("{m:.0} m from the first detection to the first declaration")));
    }
    rows.push(("Travelled", format!("{:.0} m", r.travelled_m)));
    let own = format!("{:.1} m at the end, {:.1} m at most", r.final_position_error_m, r.greatest_position_error_m);
    rows.push(("Error of its own position", own));
    let times: Vec<String> = r.behaviour_s.iter().map(|(b, s)| format!("{b} {s:.0} s")).collect();
    rows.push(("Time in behaviours", times.join(", ")));
    rows.into_iter()
}

fn gantry_rows(g: &GantrySummary) -> Vec<(&'static str, String)> {
    let stopped = match g.stopped {
        Some(true) => "declared a source",
        Some(false) => "gave up",
        None => "did not stop",
    };
    let mut rows = vec![("Stopped", stopped.to_owned())];
    if let Some(d) = &g.declaration {
        let mut what = format!("at {:.1} s", d.t_s);
        if let Some(e) = &d.error {
            write!(what, ", {:.1} cm from {}", 100.0 * e.total_m, e.source).expect(TEXT);
            if let (Some(a), Some(b)) = (e.along_flow_m, e.across_flow_m) {
                write!(what, ": {:+.1} cm along the flow (down-flow positive), {:+.1} cm across", 100.0 * a, 100.0 * b)
                    .expect(TEXT);
            }
        }
        rows.push(("Declared", what));
    }
    let seconds = |t: Option<f64>| t.map_or_else(|| "never".to_owned(), |t| format!("{t:.1} s"));
    rows.push(("First sweep over", seconds(g.sweep_s)));
    let spikes = format!("{} scans, the first at {}", g.spikes, seconds(g.first_spike_s));
    rows.push(("Scans with a spike", spikes));
    let [steps, casts, sweeps] = g.moves;
    let moves = format!("{steps} steps up-stream, {casts} casts, {sweeps} full sweeps");
    rows.push(("Motions", moves));
    let tracked = g.tracked_m.map(|m| format!("; {m:.2} m from the first step up-stream"));
    let way = format!("{:.2} m{}", g.travelled_m, tracked.unwrap_or_default());
    rows.push(("Path", way));
    if let (Some(v), Some(ngdr)) = (g.speed_m_s, g.ngdr) {
        let what = format!("{:.1} cm/s; straight way over path (NGDR) {ngdr:.2}", 100.0 * v);
        rows.push(("From the first step up-stream", what));
    }
    let pair = |p: [Option<f64>; 2], unit: &str| {
        let one = |v: Option<f64>| v.map_or_else(|| "–".to_owned(), |v| format!("{:.1} {unit}", 100.0 * v));
        format!("{} at 100–50 cm, {} at 50–0 cm", one(p[0]), one(p[1]))
    };
    rows.push(("Speed", pair(g.speed_far_near_m_s, "cm/s")));
    rows.push(("From the centreline", pair(g.offset_far_near_m, "cm")));
    if g.blocked {
        rows.push(("Blocked", "a drive gave up against something in the way".to_owned()));
    }
    rows
}

fn run_rows(s: &Summary) -> Vec<(&'static str, String)> {
    let t = &s.run.totals;
    let mut rows = vec![
        ("Mission", format!("{:.1} s in {} steps, {:.1} s of wall time", t.mission_s, t.steps, t.mission_wall_s)),
        (
            "Spin-up",
            format!(
                "{:.0} s, {:.1} s of wall time{}",
                t.spin_up_s,
                t.spin_up_wall_s,
                if t.spin_up_kept { ", taken from the cache" } else { "" }
            ),
        ),
    ];
    if let (Some(a), Some(b)) = (s.run.real_time_factor, s.run.real_time_factor_with_spin_up) {
        rows.push(("Speed", format!("{a:.0} × real time; {b:.0} × with the spin-up's wall time")));
    }
    rows.push(("Filaments at the end", t.filaments.to_string()));
    if let Some(m) = t.mass {
        let what = format!(
            "released {:.4} kg, in the water {:.4} kg, carried out {:.4} kg, imbalance {:.1e} kg",
            m.released_kg, m.in_water_kg, m.left_kg, m.imbalance_kg
        );
        rows.push(("Chemical", what));
    }
    let v = &s.versions;
    let versions = format!("rheotaxis {}, scenario format {}, rapier3d {}", v.rheotaxis, v.scenario, v.rapier3d);
    rows.push(("Versions", versions));
    rows.push(("Digest", s.digest.clone()));
    rows
}
