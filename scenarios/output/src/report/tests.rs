//! A whole report of a made-up run, and of runs in which little or nothing happened.

use super::write_all;
use crate::record::Recorder;
use crate::results::{Track, TrackTable};
use crate::sample::{self, area, folder, frames, info, plume, robots, source};
use crate::sample_gantry::gantry;
use crate::sample_run::{Told, summary, told};
use nalgebra::Vector2;
use rheotaxis::frame::{Frame, PlumeFrame};
use rheotaxis::outcome::RunOutcome;
use robots::handoff::{Behaviour, Declaration, Region, RegionState, Regions, Verdict};
use std::fs;
use world::area::Area;
use world::terrain::Terrain;
use world::units::Heading;

#[test]
fn summary_measures_along_and_across_the_flow() {
    let (s, _) = told(&frames(400));
    let r = &s.robots[0];
    let d = &r.declarations[0];
    assert_eq!((r.declarations.len(), d.fix_m), (1, Some(7.0)));
    assert_eq!(d.traced_m, r.traced_m);
    let e = d.error.as_ref().unwrap();
    for (is, should) in [e.total_m, e.along_flow_m.unwrap(), e.across_flow_m.unwrap()].iter().zip([13.0, 12.0, 5.0]) {
        assert!((is - should).abs() < 1e-9, "{e:?}");
    }
    assert!(r.first_detection_s.unwrap() > 0.0 && r.detections > 100);
    assert!((700.0..900.0).contains(&r.traced_m.unwrap()));
    assert!(r.travelled_m > 1800.0);
    assert_eq!(s.run.real_time_factor, Some(100.0));
    assert_eq!(s.run.real_time_factor_with_spin_up, Some(50.0));
    let spent: f64 = r.behaviour_s.iter().map(|b| b.1).sum();
    assert!((spent - 399.9).abs() < 1e-6);
    let json: serde_json::Value = serde_json::from_str(&s.json()).unwrap();
    assert_eq!((&json["outcome"], &json["run"]["mission_s"]), (&"found".into(), &100.0.into()));
    assert_eq!(json["robots"][0]["declarations"][0]["rule"], "along_flow");
}

#[test]
fn table_has_a_column_for_each_value_and_is_on_disk_at_once() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("track.csv");
    let mut table = TrackTable::create(&path, robots()).unwrap();
    frames(10).iter().for_each(|f| table.push(f).unwrap());
    // The table is still open, as if the program were killed here.
    let text = fs::read_to_string(&path).unwrap();
    let columns = text.lines().next().unwrap().split(',').count();
    assert_eq!(text.lines().count(), 101);
    assert!(text.lines().all(|l| l.split(',').count() == columns));
    let row: Vec<&str> = text.lines().nth(1).unwrap().split(',').collect();
    assert_eq!((&row[..2], &row[columns - 2..]), (&["0.000", "auv0"][..], &["go_to", "find"][..]));
    // Nose up in both, whatever the axes are: the believed pitch is 0.1 rad.
    assert_eq!(row[12], "5.730");
    assert_eq!(table.finish().robots[0].rows.len(), 100);
}

#[test]
fn a_mission_over_subregions_has_a_column_for_them_and_a_row_for_each_declaration() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("track.csv");
    let mut known = robots();
    known[0].regions = true;
    let mut table = TrackTable::create(&path, known).unwrap();
    let mut run = frames(20);
    let half = Area { length_m: 500.0, ..area() };
    let region = |state| Region { area: half, state, from_s: Some(1.0), until_s: None };
    let all = vec![region(RegionState::SourceFree), region(RegionState::Searching)];
    for (k, f) in run.iter_mut().enumerate() {
        let r = &mut f.robots[0];
        r.shown.regions = Regions { all: all.clone(), now: (k > 50).then_some(1) };
        if let Some(first) = r.declarations.first().copied() {
            r.declarations.push(Declaration { number: 1, region: Some(1), verdict: Verdict::Verified, ..first });
        }
        table.push(f).unwrap();
    }
    let text = fs::read_to_string(&path).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines[0].ends_with(",behaviour,region,layer"));
    assert!(lines[1].contains(",go_to,,") && lines[100].contains(",B,"));
    let told = Told { track: table.finish(), plume: Some(plume()), ..Told::new(&run, &[source()]) };
    let of = &told.summary.robots[0];
    assert_eq!((of.declarations.len(), of.regions.len()), (2, 2));
    assert_eq!(of.declarations[1].region, Some(1));
    let json: serde_json::Value = serde_json::from_str(&told.summary.json()).unwrap();
    assert_eq!(json["robots"][0]["declarations"][1]["verdict"], "verified");
    assert_eq!(json["robots"][0]["regions"][0]["state"], "source_free");
    assert!(report_of(told, &run).contains(&"map.svg".to_owned()));
}

#[test]
fn long_tracks_are_thinned_evenly() {
    let one = frames(1);
    let mut table = TrackTable::in_memory(robots());
    for k in 0..90_000u32 {
        let mut f = one[0].clone();
        f.t_s = f64::from(k) * 0.1;
        table.push(&f).unwrap();
    }
    let rows = &table.finish().robots[0].rows;
    assert!(rows.len() <= 40_001, "{}", rows.len());
    let step = rows[1].t_s - rows[0].t_s;
    assert!(rows.windows(2).all(|w| (w[1].t_s - w[0].t_s - step).abs() < 1e-6));
}

/// What the layouts of `docs` show is held by a test of whole missions.
#[test]
fn a_recording_holds_what_no_layout_shows() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("run.mcap");
    let mut rec = Recorder::create(&path, &info()).unwrap();
    let mut run = frames(20);
    for f in &mut run {
        let declarations = f.robots[0].declarations.clone();
        f.gantries.push(rheotaxis::gantry::GantryFrame { declarations, ..gantry(1.0, 0.0, Behaviour::Done) });
        rec.frame(f).unwrap();
    }
    rec.plume(&plume()).unwrap();
    rec.picture(&sample::picture(&run[0].robots[0], 2.0), b"a file").unwrap();
    rec.finish("00ff", 1).unwrap();
    let bytes = fs::read(&path).unwrap();
    for part in [
        "result",
        "scenario.ron",
        "/auv0/declaration",
        "/auv0/layers",
        "/crab0/declaration",
        "the masses of a message sum to what is in the water",
        "stands_for",
        "sensor_msgs/msg/CompressedImage",
    ] {
        assert!(bytes.windows(part.len()).any(|w| w == part.as_bytes()), "{part}");
    }
}

/// Writes the report, with the maps of these frames, and looks into each file; their names.
fn report_of(mut told: Told, frames: &[Frame]) -> Vec<String> {
    if let Some(plume) = &told.plume {
        told.beliefs.plume(plume);
    }
    frames.iter().for_each(|f| told.beliefs.push(f));
    let dir = tempfile::tempdir().unwrap();
    let written = write_all(&folder(&dir.path().join("out")), &told.report()).unwrap();
    let look = |path: &std::path::PathBuf| {
        let bytes = fs::read(path).unwrap();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if name.ends_with(".svg") || name.ends_with(".html") {
            let text = String::from_utf8(bytes).unwrap();
            assert!(!text.contains("NaN") && !text.contains("inf\""), "{name}");
            assert!(!text.contains("<&>"), "{name} holds raw markup");
        } else if name.ends_with(".csv") {
            described(&name, &String::from_utf8(bytes).unwrap());
        } else {
            assert!(!bytes.is_empty(), "{name}");
        }
        name
    };
    written.iter().map(look).collect()
}

/// Every column of a table has a description, and every row has a field for each.
fn described(name: &str, text: &str) {
    let tables = super::tables();
    let table = tables.iter().find(|table| table.is_in(name));
    let table = table.unwrap_or_else(|| panic!("{name} has no description"));
    let fields = |line: &str| line.split(',').map(str::to_string).collect::<Vec<_>>();
    let names = fields(text.lines().next().unwrap());
    for column in &names {
        let known = table.columns.iter().any(|c| c.name == column);
        assert!(known, "{name}: {column} has no description");
    }
    assert!(text.lines().all(|line| fields(line).len() == names.len()));
}

#[test]
fn whole_report_of_a_run() {
    let run = frames(600);
    let names = report_of(Told { plume: Some(plume()), ..Told::new(&run, &[source()]) }, &run);
    let figures = ["map", "series-auv0", "belief-auv0", "odour-auv0", "convergence"];
    let figures = figures.iter().flat_map(|figure| [format!("{figure}.svg"), format!("{figure}.png")]);
    let tables = ["summary.json", "plume.csv", "belief-auv0.csv", "odour-auv0.csv"].map(String::from);
    let all: Vec<String> = tables.into_iter().chain(figures).chain(["report.html".into()]).collect();
    assert_eq!(names, all);
}

#[test]
fn runs_in_which_nothing_happened() {
    let nobody = || Told { summary: summary(RunOutcome::Failed, &[], &[]), ..Told::new(&[], &[]) };
    assert_eq!(report_of(Told { track: Track::default(), ..nobody() }, &[]).len(), 4);
    // No frames, and a robot known beforehand.
    report_of(nobody(), &[]);
    // One frame; an empty plume.
    let one = &frames(600)[..1];
    report_of(Told { plume: Some(PlumeFrame::default()), ..Told::new(one, &[source()]) }, one);
}

#[test]
fn areas_from_a_flume_to_an_ocean() {
    for (length_m, width_m, depth_m) in [(24.0, 1.07, 0.2), (2e5, 1e5, 4000.0)] {
        let area = Area { centre: Vector2::zeros(), length_m, width_m, axis: Heading::from_deg(90.0) };
        let (track, terrain) = (Track::default(), Terrain::Level { depth_m });
        report_of(Told { track, area, terrain, ..Told::new(&[], &[]) }, &[]);
    }
}
