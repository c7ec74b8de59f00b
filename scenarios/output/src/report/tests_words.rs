//! The words and numbers of a report: kinds of declarations, ends of searches, title and rule, masses.

use crate::record::Recorder;
use crate::results::{DeclaredKind, RobotInfo, Summary, TrackTable};
use crate::sample::{area, frames, info, plume, robots};
use crate::sample_run::told;
use nalgebra::Vector2;
use rheotaxis::frame::{Frame, TimedReading};
use rheotaxis::outcome::RunOutcome;
use robots::handoff::{Declaration, Region, RegionState, Regions, UP_FLOW_EDGE};

/// A mission over two subregions: the first ended at the plume's edge, the second timed out.
fn over_subregions() -> Vec<Frame> {
    let mut run = frames(20);
    let region = |state| Region { area: area(), state, from_s: Some(1.0), until_s: Some(9.0) };
    let all = vec![region(RegionState::UpFlowEdge), region(RegionState::TimedOut)];
    let edge = Declaration { region: Some(0), ..Declaration::first(9.0, Vector2::new(150.0, 100.0), UP_FLOW_EDGE) };
    for f in &mut run {
        let r = &mut f.robots[0];
        r.declarations = vec![edge];
        r.shown.regions = Regions { all: all.clone(), now: None };
    }
    run
}

/// The page of a summary alone.
fn page(summary: &Summary) -> String {
    super::html::page(summary, None, &[], &[], "()")
}

fn json(summary: &Summary) -> serde_json::Value {
    serde_json::from_str(&summary.json()).unwrap()
}

#[test]
fn an_edge_is_no_declared_source_and_a_time_out_no_freedom_from_sources() {
    let (summary, _) = told(&over_subregions());
    let robot = &json(&summary)["robots"][0];
    for (field, value) in [("sources_declared", 0), ("up_flow_edges", 1), ("regions_timed_out", 1)] {
        assert_eq!(robot[field], value, "{field}");
    }
    for (of, field, value) in [
        (&robot["declarations"][0], "kind", "up_flow_edge"),
        (&robot["declarations"][0], "name", "edge of A"),
        (&robot["declarations"][0], "region_name", "A"),
        (&robot["regions"][1], "name", "B"),
        (&robot["regions"][1], "state", "timed_out"),
    ] {
        assert_eq!(of[field], value);
    }
    let page = page(&summary);
    for words in [
        "<th>Declared source</th><td>none",
        "<th>Up-flow edge of subregion A</th>",
        "<th>Subregion A</th><td>plume to up-flow edge",
        "<th>Subregion B</th><td>timed out",
    ] {
        assert!(page.contains(words), "{words}");
    }
    // The distance from the edge to the nearest source is no error of a declaration.
    assert!(!page.contains("Nearest true source") && !page.contains("source free"));
}

#[test]
fn the_page_says_what_it_is_about_and_when_that_is_a_success() {
    let (summary, _) = told(&frames(400));
    let page = page(&summary);
    let top = &page[page.find("<h1>").unwrap()..page.find("<table").unwrap()];
    assert!(top.contains("<h1>A sample &lt;&amp;&gt;</h1>"), "{top}");
    assert!(top.contains("Success: a source is declared within 20 m of a true one"), "{top}");
    // For paper and telephone: figures whole on a sheet, and nothing wider than the screen.
    for rule in
        ["initial-scale=1", "@media print", "break-inside:avoid", "@media(max-width:600px)", "img{max-width:100%"]
    {
        assert!(page.contains(rule), "{rule}");
    }
    let json = json(&summary);
    assert_eq!(json["title"], "A sample <&>");
    // The map of the sample ends on the source.
    let map = &json["robots"][0]["map"];
    assert!(map["remark"].is_null() && map["probability"].as_f64().unwrap() > 0.0);
}

/// A cell that may be broken anywhere is squeezed until its words are: only prose and values of a list may be.
#[test]
fn words_in_cells_are_not_broken() {
    let rules = super::page::STYLE.split('}').filter_map(|r| r.split_once('{'));
    let anywhere = rules.filter(|(_, what)| what.contains("overflow-wrap:anywhere"));
    let of: Vec<&str> = anywhere.flat_map(|(of, _)| of.split(',')).collect();
    assert_eq!(of, ["p", ".facts td:not(:first-child)"]);
}

#[test]
fn the_tables_masses_sum_to_what_is_in_the_water() {
    let text = super::write::plume_csv(&plume(), &area());
    let mut lines = text.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let column = |name: &str| header.iter().position(|h| *h == name).unwrap();
    let (mass, n) = (column("mass_kg"), column("stands_for"));
    let sums = lines.fold([0.0, 0.0], |[a, b], line| {
        let v: Vec<f64> = line.split(',').map(|v| v.parse().unwrap()).collect();
        [a + v[mass], b + v[n]]
    });
    // 4000 shown of 40 000 filaments of 5 mg.
    assert!((sums[0] / 0.2 - 1.0).abs() < 1e-4 && (sums[1] / 4e4 - 1.0).abs() < 1e-6);
}

#[test]
fn without_robots_there_is_no_table_of_tracks() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("track.csv");
    let mut table = TrackTable::create(&path, Vec::new()).unwrap();
    let mut nobody = frames(1)[0].clone();
    nobody.robots.clear();
    table.push(&nobody).unwrap();
    assert!(!path.exists());
}

#[test]
fn a_headline_says_how_the_run_ended() {
    let (mut summary, _) = told(&frames(400));
    summary.scenario = "duck_st".into();
    summary.run.totals.mission_s = 2000.0;
    let sample = summary.robots[0].declarations[0].clone();
    let declared = |kind: DeclaredKind, t_s: f64, error_m: f64| {
        let mut one = sample.clone();
        (one.kind, one.t_s) = (kind, t_s);
        one.error.as_mut().expect("an error").total_m = error_m;
        one
    };
    let first = declared(DeclaredKind::Source, 1234.4, 2.1);
    let second = declared(DeclaredKind::Source, 1500.0, 0.25);
    // An edge of a subregion is no source.
    let edge = declared(DeclaredKind::UpFlowEdge, 1234.4, 2.1);
    for (outcome, declarations, how) in [
        (RunOutcome::NotFound, vec![], "not found in 2000 s"),
        (RunOutcome::TimeOut, vec![], "time limit reached after 2000 s"),
        (RunOutcome::Found, vec![], "found after 2000 s"),
        (RunOutcome::Found, vec![first.clone()], "found after 1234 s, 2.1 m off"),
        (RunOutcome::NotFound, vec![first.clone()], "not found: declared after 1234 s, 2.1 m off"),
        (RunOutcome::Found, vec![first, second], "2 declarations, found after 1500 s, at most 2.1 m off"),
        (RunOutcome::Found, vec![edge], "found after 2000 s"),
    ] {
        summary.outcome = outcome;
        summary.robots[0].declarations = declarations;
        assert_eq!(summary.headline(), format!("duck_st, seed {}: {how}", summary.seed));
    }
}

/// A sensor of another crate: its number is in table, recording, summary and page.
#[test]
fn a_number_of_another_crate_is_told_everywhere() {
    let mut run = frames(20);
    for f in &mut run {
        f.robots[0].readings.other.insert("pressure_pa", TimedReading { t_s: f.t_s, value: 80_198.5 });
    }
    let dir = tempfile::tempdir().unwrap();
    let (csv, mcap) = (dir.path().join("track.csv"), dir.path().join("run.mcap"));
    let [robot] = robots().try_into().expect("one robot");
    let mut table = TrackTable::create(&csv, vec![RobotInfo { numbers: vec!["pressure_pa"], ..robot }]).unwrap();
    let mut recorder = Recorder::create(&mcap, &info()).unwrap();
    for f in &run {
        table.push(f).unwrap();
        recorder.frame(f).unwrap();
    }
    table.finish();
    recorder.finish("00ff", 1).unwrap();

    let text = std::fs::read_to_string(&csv).unwrap();
    let (head, rows) = text.split_once('\n').unwrap();
    assert!(head.ends_with(",pressure_pa"), "{head}");
    assert!(rows.lines().count() == run.len() && rows.lines().all(|row| row.ends_with(",80198.500000")), "{rows}");
    let topic = b"/auv0/readings/pressure_pa";
    assert!(std::fs::read(&mcap).unwrap().windows(topic.len()).any(|bytes| bytes == topic));
    let (summary, _) = told(&run);
    assert_eq!(json(&summary)["robots"][0]["last_numbers"]["pressure_pa"], 80_198.5);
    assert!(page(&summary).contains("<th>Last pressure_pa</th><td>80198.5"));
}
