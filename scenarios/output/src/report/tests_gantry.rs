//! Table, recording and figures of a made-up gantry: a sweep, a few steps up a plume, a stop.

use super::write_all;
use crate::files::ReportError;
use crate::results::{GantryInfo, ProbeTables, SourceTruth, Track};
use crate::sample::folder;
use crate::sample_gantry as sample;
use crate::sample_run::Told;
use nalgebra::{Vector2, Vector3};
use rheotaxis::frame::Frame;
use robots::handoff::{Behaviour, Declaration, MAX_PROBES, Outcome, ProbeScan};
use std::fs;
use std::path::{Path, PathBuf};
use world::area::Area;
use world::fields::Concentration;
use world::math;
use world::terrain::Terrain;
use world::units::Heading;

/// A straight plume from the origin eastward, 47 kg/m³ at its source.
struct Straight;
impl Concentration for Straight {
    fn concentration(&self, p: &Vector3<f64>) -> f64 {
        let sd = 0.01 + 0.05 * p.x.max(0.0);
        let r2 = p.y * p.y + (p.z + 0.125) * (p.z + 0.125);
        let c = 47.0 * math::exp(-0.5 * r2 / (sd * sd)) * 1e-4 / (sd * sd);
        if p.x > 0.0 { c } else { 0.0 }
    }
}

fn gantries() -> Vec<GantryInfo> {
    vec![GantryInfo {
        id: "crab0".into(),
        probes: vec!["probe_left".into()],
        range_v: [-5.0, 5.0],
        full_scale_kg_m3: 4.7,
        effluent_kg_m3: Some(47.0),
    }]
}

fn source() -> SourceTruth {
    SourceTruth { id: "nozzle".into(), position: Vector3::new(0.0, 0.0, -0.162), flow: Vector2::new(0.05, 0.0) }
}

fn flume() -> Area {
    Area { centre: Vector2::new(0.85, 0.0), length_m: 2.5, width_m: 1.07, axis: Heading::from_deg(90.0) }
}

const DT_S: f64 = 0.025;
const DECLARED_S: f64 = 38.0;

/// Forty frames a second, a scan in every other one: 20 s of sweep, then a metre up-stream to the stop; every tenth
/// scan has a spike.
fn frames() -> Vec<Frame> {
    (0..1600_u32)
        .map(|k| {
            let t_s = f64::from(k) * DT_S;
            let (x, y, behaviour) = if t_s < 20.0 {
                (1.14, -0.3 + 0.03 * t_s, Behaviour::Sweep)
            } else if t_s < DECLARED_S {
                let s = (t_s - 20.0) / (DECLARED_S - 20.0);
                (1.14 - s, 0.3 * (1.0 - s), Behaviour::StepUp)
            } else {
                (0.14, 0.0, Behaviour::Done)
            };
            let mut g = sample::gantry(x, y, behaviour);
            let scan = k / 2;
            let mut volts = [-5.0; MAX_PROBES];
            volts[0] += if scan % 10 == 9 { 0.4 } else { 0.02 };
            g.scan = Some(ProbeScan { t_s: f64::from(scan) * 2.0 * DT_S, volts, count: 1 });
            g.goal.id = match behaviour {
                Behaviour::Sweep => 1,
                Behaviour::StepUp => 2 + (t_s - 20.0) as u32 / 3,
                _ => 99,
            };
            let w = &mut g.shown;
            w.threshold_v[0] = -4.9;
            w.spike[0] = scan > 0 && scan % 10 == 0;
            w.spike_hz = 2.0;
            g.outcome = (behaviour == Behaviour::Done).then_some(Outcome::Completed);
            let declared = Declaration::first(DECLARED_S, Vector2::new(0.14, 0.0), "stop");
            g.declarations = g.outcome.map(|_| declared).into_iter().collect();
            Frame { t_s, step: u64::from(k), gantries: vec![g], ..Frame::default() }
        })
        .collect()
}

#[test]
fn probes_table_is_on_disk_at_once_with_a_column_for_each_value() {
    let dir = tempfile::tempdir().unwrap();
    let mut tables = ProbeTables::create(&folder(dir.path()), gantries()).unwrap();
    let run = frames();
    run.iter().for_each(|f| tables.push(f).unwrap());
    // The table is still open, as if the program were killed here.
    let text = fs::read_to_string(dir.path().join("probes-crab0.csv")).unwrap();
    let header: Vec<&str> = text.lines().next().unwrap().split(',').collect();
    assert_eq!(text.lines().count(), run.len() + 1);
    assert!(text.lines().all(|l| l.split(',').count() == header.len()));
    let column = |name: &str| header.iter().position(|h| *h == name).unwrap();
    let of = |row: usize, name: &str| -> String {
        let line = text.lines().nth(row + 1).unwrap();
        line.split(',').nth(column(name)).unwrap().to_string()
    };
    for (row, name, value) in [
        (0, "behaviour", "sweep"),
        (1000, "behaviour", "step_up"),
        (18, "probe_left_v", "-4.6000"),
        (18, "probe_left_threshold_v", "-4.9000"),
    ] {
        assert_eq!(of(row, name), value);
    }
    // A spike is known one scan later, and reported once although two rows show that scan.
    let spikes = [18, 19, 20, 21, 22].map(|row| of(row, "probe_left_spike"));
    assert_eq!(spikes, ["0", "0", "1", "0", "0"]);
    let counted = tables.finish()[0].rows.iter().filter(|r| r.spike[0]).count();
    assert_eq!(counted, 79);
}

#[test]
fn a_long_record_is_thinned_and_keeps_its_spikes() {
    let mut tables = ProbeTables::in_memory(gantries());
    let mut f = frames()[0].clone();
    for k in 0..100_000_u32 {
        f.t_s = 0.05 * f64::from(k);
        let g = &mut f.gantries[0];
        g.scan.as_mut().unwrap().t_s = f.t_s;
        g.shown.spike[0] = k % 1000 == 7;
        tables.push(&f).unwrap();
    }
    let track = &tables.finish()[0];
    assert!(track.rows.len() <= 40_001, "{}", track.rows.len());
    assert_eq!(track.rows.iter().filter(|r| r.spike[0]).count(), 100);
    let step = track.rows[1].t_s - track.rows[0].t_s;
    let mut pairs = track.rows.windows(2);
    assert!(pairs.all(|w| (w[1].t_s - w[0].t_s - step).abs() < 1e-6));
}

/// A concentration that may be looked at.
type Dye = Option<&'static dyn Concentration>;

fn write_into(dir: &Path, frames: &[Frame], dye: Dye, sources: &[SourceTruth]) -> Result<Vec<PathBuf>, ReportError> {
    let mut tables = ProbeTables::in_memory(gantries());
    frames.iter().for_each(|f| tables.push(f).unwrap());
    let told = Told {
        track: Track::default(),
        gantries: tables.finish(),
        dye,
        area: flume(),
        terrain: Terrain::Level { depth_m: 0.2 },
        sources: sources.to_vec(),
        ..Told::new(frames, &[source()])
    };
    write_all(&folder(dir), &told.report())
}

fn written(frames: &[Frame], dye: Dye, sources: &[SourceTruth]) -> Vec<(String, String)> {
    let dir = tempfile::tempdir().unwrap();
    let files = write_into(dir.path(), frames, dye, sources);
    let text = |path: &PathBuf| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        let bytes = fs::read(path).unwrap();
        assert!(!bytes.is_empty(), "{name}");
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let drawn = name.ends_with(".svg") || name.ends_with(".html");
        assert!(!drawn || !(text.contains("NaN") || text.contains("inf\"")), "{name}");
        (name, text)
    };
    files.unwrap().iter().map(text).collect()
}

#[test]
fn figures_of_a_flume_stand_in_for_the_map() {
    let files = written(&frames(), Some(&Straight), &[source()]);
    let names: Vec<&str> = files.iter().map(|f| f.0.as_str()).collect();
    let figures = ["flume", "probes", "approach"];
    let figures = figures.iter().flat_map(|figure| ["svg", "png"].map(|end| format!("{figure}-crab0.{end}")));
    let all: Vec<String> = ["summary.json".into()].into_iter().chain(figures).chain(["report.html".into()]).collect();
    assert_eq!(names, all);
    for (file, words) in [
        ("flume-crab0.svg", ["C/C0", "7.5 cm above the bed", "5.0 cm/s", "20 cm"].as_slice()),
        ("probes-crab0.svg", &["79 spikes"]),
        // Path of √(1 + 0.3²) m in 18 s.
        ("approach-crab0.svg", &["mean 50–100 cm: 5.8 cm/s"]),
        ("report.html", &["14.0 cm from nozzle"]),
    ] {
        let (_, text) = files.iter().find(|f| f.0 == file).unwrap();
        assert!(words.iter().all(|w| text.contains(w)), "{file}: {words:?}");
    }
}

/// A concentration that panics when asked, as a mistake in a figure would.
struct Broken;

impl Concentration for Broken {
    fn concentration(&self, _: &Vector3<f64>) -> f64 {
        panic!("no such place")
    }
}

#[test]
fn a_figure_that_fails_is_an_error_of_that_figure_alone() {
    let dir = tempfile::tempdir().unwrap();
    let said = write_into(dir.path(), &frames(), Some(&Broken), &[source()]).unwrap_err();
    let said = said.to_string();
    assert!(said.ends_with("flume-crab0.png: no such place"), "{said}");
    let there = |name: &str| dir.path().join(name).is_file();
    for name in ["summary.json", "probes-crab0.png", "approach-crab0.svg", "report.html"] {
        assert!(there(name), "{name}");
    }
    assert!(!there("flume-crab0.svg") && !there("flume-crab0.png"));
}

#[test]
fn a_gantry_of_which_little_is_known_breaks_no_figure() {
    let run = frames();
    // Without source or chemical; with one moment; with none at all.
    assert!(written(&run, None, &[]).iter().any(|f| f.0 == "flume-crab0.png"));
    written(&run[..1], Some(&Straight), &[source()]);
    let nothing = written(&[], Some(&Straight), &[source()]);
    assert_eq!(nothing.len(), 2, "summary and report");
}

/// A start computed backwards from the end of a run may lie slightly before its beginning.
#[test]
fn a_run_shorter_than_the_window_of_its_probes_is_drawn() {
    let run = frames();
    let rounded = |w: &&[Frame]| {
        let (begin, end) = (w[0].t_s, w[w.len() - 1].t_s);
        end - (end - begin) < begin
    };
    let short = run.windows(60).find(rounded).expect("1 of 3 is rounded so");
    let files = written(short, Some(&Straight), &[source()]);
    assert!(files.iter().any(|f| f.0 == "probes-crab0.png"));
}
