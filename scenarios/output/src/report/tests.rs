//! A whole report of a made-up run, and of runs in which little or nothing happened.

use super::write_all;
use crate::record::Recorder;
use crate::results::{
    BeliefTrack, MassBalance, RunReport, Summary, SummaryBuilder, SummaryEnd, Totals, Track, TrackTable,
};
use crate::sample::{area, folder, frames, info, plume, robots, scored, source, terrain};
use image::RgbImage;
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use rheotaxis::frame::{Frame, PictureFrame, PlumeFrame};
use rheotaxis::outcome::RunOutcome;
use robots::handoff::{Declaration, Picture, Region, RegionState, Regions, Verdict};
use std::fs;
use std::sync::Arc;
use world::area::Area;
use world::terrain::Terrain;
use world::units::Heading;

fn end(outcome: RunOutcome, frames: &[Frame]) -> SummaryEnd {
    SummaryEnd {
        outcome,
        error: None,
        digest: "00ff".into(),
        score: scored(frames),
        totals: Totals {
            mission_s: 100.0,
            spin_up_s: 50.0,
            mission_wall_s: 1.0,
            spin_up_wall_s: 1.0,
            spin_up_kept: false,
            steps: 5000,
            filaments: 40_000,
            mass: Some(MassBalance::new(0.3, 0.2, 0.1)),
        },
    }
}

pub(super) fn told(frames: &[Frame]) -> (Summary, Track) {
    let mut builder = SummaryBuilder::new(&info());
    let mut table = TrackTable::in_memory(robots());
    for f in frames {
        builder.observe(f);
        table.push(f).unwrap();
    }
    (builder.finish(&end(RunOutcome::Found, frames), &[source()]), table.finish())
}

#[test]
fn summary_measures_along_and_across_the_flow() {
    let (s, _) = told(&frames(400));
    let r = &s.robots[0];
    let d = &r.declarations[0];
    assert_eq!((r.declarations.len(), d.fix_m), (1, Some(7.0)));
    assert_eq!(d.traced_m, r.traced_m);
    let e = d.error.as_ref().unwrap();
    assert!((e.total_m - 13.0).abs() < 1e-9);
    assert!((e.along_flow_m.unwrap() - 12.0).abs() < 1e-9);
    assert!((e.across_flow_m.unwrap() - 5.0).abs() < 1e-9);
    assert!(r.first_detection_s.unwrap() > 0.0 && r.detections > 100);
    assert!((700.0..900.0).contains(&r.traced_m.unwrap()));
    assert!(r.travelled_m > 1800.0);
    assert_eq!(s.run.real_time_factor, Some(100.0));
    assert_eq!(s.run.real_time_factor_with_spin_up, Some(50.0));
    let spent: f64 = r.behaviour_s.iter().map(|b| b.1).sum();
    assert!((spent - 399.9).abs() < 1e-6);
    let json: serde_json::Value = serde_json::from_str(&s.json()).unwrap();
    assert_eq!(json["outcome"], "found");
    assert_eq!(json["run"]["mission_s"], 100.0);
    assert_eq!(json["robots"][0]["declarations"][0]["rule"], "along_flow");
}

#[test]
fn table_has_a_column_for_each_value_and_is_on_disk_at_once() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("track.csv");
    let mut table = TrackTable::create(&path, robots()).unwrap();
    let run = frames(10);
    for f in &run {
        table.push(f).unwrap();
    }
    // The table is still open, as if the program were killed here.
    let text = fs::read_to_string(&path).unwrap();
    let columns = text.lines().next().unwrap().split(',').count();
    assert_eq!(text.lines().count(), 101);
    assert!(text.lines().all(|l| l.split(',').count() == columns));
    let row: Vec<&str> = text.lines().nth(1).unwrap().split(',').collect();
    assert_eq!(row[..2], ["0.000", "auv0"]);
    assert_eq!(row[columns - 2..], ["go_to", "find"]);
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
    let mut builder = SummaryBuilder::new(&info());
    for (k, f) in run.iter_mut().enumerate() {
        let r = &mut f.robots[0];
        r.shown.regions = Regions { all: all.clone(), now: (k > 50).then_some(1) };
        if let Some(first) = r.declarations.first().copied() {
            r.declarations.push(Declaration { number: 1, region: Some(1), verdict: Verdict::Verified, ..first });
        }
        table.push(f).unwrap();
        builder.observe(f);
    }
    let text = fs::read_to_string(&path).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines[0].ends_with(",behaviour,region,layer"));
    assert!(lines[1].contains(",go_to,,") && lines[100].contains(",B,"));
    let summary = builder.finish(&end(RunOutcome::Found, &run), &[source()]);
    let of = &summary.robots[0];
    assert_eq!((of.declarations.len(), of.regions.len()), (2, 2));
    assert_eq!(of.declarations[1].region, Some(1));
    let json: serde_json::Value = serde_json::from_str(&summary.json()).unwrap();
    assert_eq!(json["robots"][0]["declarations"][1]["verdict"], "verified");
    assert_eq!(json["robots"][0]["regions"][0]["state"], "source_free");
    let track = table.finish();
    let names = report_of(&summary, &track, &run, Some(&plume()), &area(), &terrain());
    assert!(names.contains(&"map.svg".to_owned()));
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
    let even = rows.windows(2).all(|w| (w[1].t_s - w[0].t_s - step).abs() < 1e-6);
    assert!(even);
}

#[test]
fn recording_holds_every_topic() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("run.mcap");
    let mut rec = Recorder::create(&path, &info()).unwrap();
    for f in &frames(20) {
        rec.frame(f).unwrap();
    }
    rec.plume(&plume()).unwrap();
    let robot = &frames(1)[0].robots[0];
    let taken = PictureFrame {
        t_s: 2.0,
        robot: robot.id.clone(),
        picture: Picture {
            image: Arc::new(RgbImage::new(4, 2)),
            p_BC: Vector3::new(0.5, 0.0, -0.1),
            R_BC: UnitQuaternion::identity(),
            view_rad: 1.0,
        },
        truth: robot.truth.pose,
        estimate: robot.estimate,
    };
    rec.picture(&taken, b"a file").unwrap();
    rec.finish("00ff", 1).unwrap();
    let bytes = fs::read(&path).unwrap();
    for part in [
        "run",
        "result",
        "scenario.ron",
        "/auv0/declaration",
        "/auv0/layers",
        "/auv0/map",
        "/plume",
        "the masses of a message sum to what is in the water",
        "stands_for",
        "/auv0/camera/compressed",
        "sensor_msgs/msg/CompressedImage",
    ] {
        let found = bytes.windows(part.len()).any(|w| w == part.as_bytes());
        assert!(found, "{part}");
    }
}

fn report_of(
    summary: &Summary,
    track: &Track,
    frames: &[Frame],
    plume: Option<&PlumeFrame>,
    area: &Area,
    terrain: &Terrain,
) -> Vec<String> {
    let dir = tempfile::tempdir().unwrap();
    let out = dir.path().join("out");
    let sources = [source()];
    let info = info();
    let mut beliefs = BeliefTrack::default();
    if let Some(plume) = plume {
        beliefs.plume(plume);
    }
    for f in frames {
        beliefs.push(f);
    }
    let run = RunReport {
        pictures: &[],
        echoes: &crate::results::Echoes::default(),
        summary,
        track,
        gantries: &[],
        beliefs: &beliefs,
        plume,
        plume_film: &crate::results::PlumeFilm::default(),
        dye: None,
        area,
        terrain,
        sources: if plume.is_some() { &sources } else { &[] },
        interfaces: &[],
        obstacles: &[],
        solids: None,
        scenario_text: &info.scenario_text,
    };
    let written = write_all(&folder(&out), &run).unwrap();
    let mut names = Vec::new();
    for path in &written {
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
        names.push(name);
    }
    names
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
    let (summary, track) = told(&run);
    let plume = plume();
    let names = report_of(&summary, &track, &run, Some(&plume), &area(), &terrain());
    assert_eq!(
        names,
        [
            "summary.json",
            "plume.csv",
            "belief-auv0.csv",
            "odour-auv0.csv",
            "map.svg",
            "map.png",
            "series-auv0.svg",
            "series-auv0.png",
            "belief-auv0.svg",
            "belief-auv0.png",
            "odour-auv0.svg",
            "odour-auv0.png",
            "convergence.svg",
            "convergence.png",
            "report.html"
        ]
    );
}

#[test]
fn runs_in_which_nothing_happened() {
    let nobody = SummaryBuilder::new(&info()).finish(&end(RunOutcome::Failed, &[]), &[]);
    let none = Track::default();
    assert_eq!(report_of(&nobody, &none, &[], None, &area(), &terrain()).len(), 4);
    // No frames, and a robot known beforehand.
    let track = TrackTable::in_memory(robots()).finish();
    report_of(&nobody, &track, &[], None, &area(), &terrain());
    // One frame; an empty plume.
    let one = &frames(600)[..1];
    let (summary, track) = told(one);
    let empty = PlumeFrame::default();
    report_of(&summary, &track, one, Some(&empty), &area(), &terrain());
}

#[test]
fn areas_from_a_flume_to_an_ocean() {
    for (length_m, width_m, depth_m) in [(24.0, 1.07, 0.2), (2e5, 1e5, 4000.0)] {
        let area = Area { centre: Vector2::zeros(), length_m, width_m, axis: Heading::from_deg(90.0) };
        let nobody = SummaryBuilder::new(&info()).finish(&end(RunOutcome::Completed, &[]), &[]);
        report_of(&nobody, &Track::default(), &[], None, &area, &Terrain::Level { depth_m });
    }
}
