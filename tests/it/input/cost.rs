//! What no computer could bear, or no physics, is said by `check` before anything of it is built: place, value and legal range.

use crate::common;
use rheotaxis::scenario::{check_within, cost, parse, template};
use std::path::Path;

/// What reading and checking say of a scenario that comes with the program, with pieces of its text changed: "path: message".
#[track_caller]
fn said(name: &str, changes: &[(&str, &str)]) -> Vec<String> {
    let template = template(name).expect("in the catalogue");
    let folder = template.unpack().expect("a folder for its files");
    let mut text = template.text.to_string();
    for (from, to) in changes {
        assert!(text.contains(from), "{name} has no {from}");
        text = text.replacen(from, to, 1);
    }
    match parse(name, &text) {
        Err(error) => error.lines(),
        Ok(scenario) => (check_within(&scenario, &folder, cost::MEMORY).iter()).map(ToString::to_string).collect(),
    }
}

/// One of the things said holds both the place and what is legal there.
#[track_caller]
fn refuses(name: &str, from: &str, to: &str, path: &str, legal: &str) {
    let said = said(name, &[(from, to)]);
    assert!(
        said.iter().any(|s| s.contains(path) && s.contains(legal)),
        "{name}, {to}: wanted {path}: {legal}, said {said:#?}"
    );
}

#[test]
fn numbers_that_make_infinite_loops_and_tables_are_refused() {
    for (name, from, to, path, legal) in [
        (
            "duck_st",
            "flow_period_s: 10",
            "flow_period_s: 0.0002",
            "time.flow_period_s",
            "must be 0 (at each step of the plume) or at least time.step_s, 0.05, got 0.0002",
        ),
        (
            "duck_st",
            "omega_rad_s: 0.02",
            "omega_rad_s: 1e6",
            "water.currents[1].omega_rad_s",
            "must be from 1e-7 to 6 rad/s, got 1e6",
        ),
        (
            "moth_eyes",
            "map: Hmm()",
            "map: Hmm(trajectory: (sigma_x_m_rts: 65536))",
            "robots[0].map.trajectory.sigma_x_m_rts",
            "must be from 1e-6 to 100 m/s^0.5, got 65536",
        ),
        (
            "moth_eyes",
            "map: Hmm()",
            "map: Hmm(grid: (along: 40, across: 100000), trajectory: (sigma_y_m_rts: 1))",
            "robots[0].map.grid",
            "must have at most 1000000 cells, got 4000000",
        ),
        (
            "moth_eyes",
            "map: Hmm()",
            "map: Hmm(grid: (along: 5, across: 100000), trajectory: (sigma_y_m_rts: 1))",
            "robots[0].map.trajectory.sigma_y_m_rts",
            "must be at most 0.0379",
        ),
        (
            "moth_eyes",
            "map: Hmm()",
            "map: Hmm(step_s: 1e-6)",
            "robots[0].map.step_s",
            "must be at least 0.006 to look back 600 s in 100000 steps, got 1e-6",
        ),
        ("moth_eyes", "map: Hmm()", "map: Hmm(step_s: 1e-4)", "robots[0].map.step_s", "must be at least 0.006"),
        (
            "moth_eyes",
            "sidescan: ()",
            "sidescan: (range_m: 1e8, rate_hz: 1e-6)",
            "robots[0].sensors.sidescan.range_m",
            "must be from 0.01 to 5000 m, got 1e8",
        ),
        (
            "moth_eyes",
            "map: Hmm()",
            "map: Pomdp(grid: (along: 4194304, across: 4194304, vertical: 1048576, bottom_depth_m: 10))",
            "robots[0].map.grid",
            "cells",
        ),
        (
            "harbour_3d",
            "max_range_m: 30",
            "max_range_m: 1e6",
            "robots[0].sensors.ranging.max_range_m",
            "must be from 0.01 to 5000 m, got 1e6",
        ),
        (
            "reef_mesh",
            "evade: ()",
            "evade: (look_m: 1e300)",
            "robots[0].strategy.evade.look_m",
            "must be from 0.01 to 100000 m, got 1e300",
        ),
        (
            "wp_laminar",
            "planner: AStar(cost: Metric)",
            "planner: PotentialField(step_m: 1e-6)",
            "robots[0].strategy.planner.step_m",
            "must be at least 0.05",
        ),
        (
            "duck_st",
            "std_m_s: 0.02",
            "std_m_s: 0.02, diffusivity_m2_s: 1e300",
            "water.currents[1].diffusivity_m2_s",
            "must be from 0 to 100000 m2/s, got 1e300",
        ),
    ] {
        refuses(name, from, to, path, legal);
    }
}

#[test]
fn numbers_beyond_physics_are_refused_where_they_stand() {
    for (name, from, to, path, legal) in [
        ("flume_crab", "speed_m_s: 0.05),", "speed_m_s: 1e306),", "sources[0].release.nozzle.speed_m_s", "got 1e306"),
        (
            "flume_crab",
            "diameter_m: 0.0042",
            "diameter_m: 5e-324",
            "sources[0].release.nozzle.diameter_m",
            "must be from 1e-5 to 10 m, got 5e-324",
        ),
        (
            "flume_crab",
            "diameter_m: 0.0042",
            "diameter_m: 1e-9",
            "sources[0].release.nozzle.diameter_m",
            "must be from 1e-5 to 10 m, got 1e-9",
        ),
        (
            "harbour_3d",
            "size_m: (200, 6, 12)",
            "size_m: (2e9, 6, 12)",
            "obstacles[0].shape.size_m",
            "must be from 0.001 to 1000000 m, got 2e9",
        ),
        ("harbour_3d", "size_m: (200, 6, 12)", "size_m: (1e200, 6, 12)", "obstacles[0].shape.size_m", "got 1e200"),
        ("flume_crab", "mean_m_s: 0.05", "mean_m_s: 1e154", "water.currents[0].mean_m_s", "got 1e154"),
        ("duck_st", "std_m_s: 0.02", "std_m_s: 1e39", "water.currents[1].std_m_s", "got 1e39"),
        ("duck_st", "std_m_s: 0.02", "std_m_s: 1e9", "water.currents[1].std_m_s", "must be from 0 to 5 m/s, got 1e9"),
        (
            "duck_st",
            "background_vertical_m2_s: 0.00001",
            "background_vertical_m2_s: 1e12",
            "water.mixing.background_vertical_m2_s",
            "must be from 0 to 100 m2/s, got 1e12",
        ),
        (
            "duck_st",
            "length_m: 260",
            "length_m: 0.01",
            "water.currents[0].interfaces[0].waves[1].length_m",
            "must be from 0.6283185307179586 (a slope of 45 degrees) to 21750 m (15 m/s), got 0.01",
        ),
        (
            "harbour_3d",
            "cell_m: (1, 1, 1)",
            "cell_m: (200, 0.5, 0.5)",
            "robots[0].strategy.room.cell_m",
            "must have sides that differ at most 100-fold, got 0.5 and 200 m",
        ),
        (
            "duck_st",
            "rate_g_s: 0.025",
            "rate_g_s: 1e17",
            "sources[0].rate_g_s",
            "must be from 1e-12 to 1000000 g/s, got 1e17",
        ),
        (
            "harbour_3d",
            "heading_deg: 0, speed_m_s: 1.5",
            "heading_deg: 0, speed_m_s: 1000",
            "robots[0].start.speed_m_s",
            "must be from 0 to 15 m/s, got 1000",
        ),
        (
            "flume_crab",
            "density_kg_m3: 998.2",
            "density_kg_m3: 1e6",
            "water.density_kg_m3",
            "must be from 900 to 1400 kg/m3, got 1e6",
        ),
    ] {
        refuses(name, from, to, path, legal);
    }
}

#[test]
fn waves_of_no_sea_are_refused() {
    let wave = "Uniform(speed_m_s: 0.2, heading_deg: 90),";
    for (given, path, legal) in [
        ("peak_period_s: 1e17", "water.currents[1].spectrum.peak_period_s", "must be from 0.05 to 60 s, got 1e17"),
        (
            "peak_period_s: 3, spreading: 1e12",
            "water.currents[1].spectrum.spreading",
            "must be from 0 to 1000, got 1e12",
        ),
    ] {
        let sea = format!("{wave} Waves(spectrum: (significant_height_m: 0.2, heading_deg: 90, {given})),");
        refuses("uniform_channel", wave, &sea, path, legal);
    }
    let train = format!("{wave} Waves(mixing: 1e12, trains: [(height_m: 0.2, period_s: 3, heading_deg: 90)]),");
    let (path, legal) = ("water.currents[1].mixing", "must be from 0 to 10, got 1e12");
    refuses("uniform_channel", wave, &train, path, legal);
}

#[test]
fn memory_beyond_what_is_allowed_names_the_field_and_what_would_fit() {
    let text = template("wp_laminar").expect("in the catalogue").text;
    let with = |hz: &str| {
        let text = text.replacen("rate_hz: 10,", &format!("rate_hz: {hz},"), 1);
        parse("changed", &text).unwrap_or_else(|e| panic!("{:?}", e.lines()))
    };
    let said = |hz: &str, bytes: f64| -> Vec<String> {
        let found = check_within(&with(hz), Path::new(""), bytes);
        found.iter().map(ToString::to_string).collect()
    };
    let refused = said("40000", 5e8);
    assert_eq!(refused.len(), 1, "{refused:#?}");
    let [path, legal] = ["sources[0].release.rate_hz: must be at most ", ", got 40000: "];
    assert!(refused[0].starts_with(path), "{refused:#?}");
    assert!(refused[0].contains(legal), "{refused:#?}");
    assert!(refused[0].contains("at most 500 MB are allowed"), "{refused:#?}");
    // What it calls legal is.
    let rest = &refused[0][path.len()..];
    let most = &rest[..rest.find(',').expect("a comma after the number")];
    let over = |hz: &str| said(hz, 5e8).iter().any(|s| s.contains("are allowed"));
    assert!(!over(most), "{most}");
    let more = 1.1 * most.parse::<f64>().expect("a number");
    assert!(over(&more.to_string()), "{more}");
    // More memory, no error: hours are a warning.
    let warned = said("40000", 1e11);
    assert!(warned.iter().all(|s| s.contains("will take hours")), "{warned:#?}");
}

#[test]
fn hours_are_a_warning_that_names_what_takes_them() {
    for (name, edits, part) in [
        (
            "wp_laminar",
            &[
                ("rate_hz: 10,", "rate_hz: 49000,"),
                ("spin_up_s: 120,", "spin_up_s: 120, spin_up_period_s: 0.02, drift_period_s: 0.02,"),
            ][..],
            "sources[0].release.rate_hz: the run will take hours",
        ),
        (
            "flume_crab",
            &[
                ("diameter_m: 0.0042, speed_m_s: 0.05", "diameter_m: 0.00001, speed_m_s: 0.5"),
                ("step_s: 0.01,", "step_s: 0.001,"),
                ("drift_period_s: 0.05", "drift_period_s: 0.005"),
            ][..],
            "sources[0].release.nozzle.diameter_m: the run will take hours",
        ),
        (
            "moth_eyes",
            &[("map: Hmm()", "map: Hmm(step_s: 0.02, grid: (along: 300, across: 300))")][..],
            "robots[0].map",
        ),
    ] {
        let said = said(name, edits);
        let warned = |s: &String| s.starts_with(part) && s.contains("will take hours");
        assert!(said.iter().any(warned), "{edits:?}: {said:#?}");
    }
}

#[test]
fn no_scenario_that_comes_with_the_program_is_too_much() {
    for template in rheotaxis::scenario::CATALOG {
        let scenario = parse(template.name, template.text).expect("a readable scenario");
        let cost = cost::cost(&scenario);
        let (bytes, seconds) = (cost.bytes(), cost.seconds());
        assert!(cost.fits(5e8), "{}: {bytes} bytes", template.name);
        assert!(seconds < 3600.0, "{}: {seconds} s", template.name);
        assert!(cost.seconds() > 0.2 && cost.bytes() > 2e7, "{}", template.name);
    }
}

/// The command prints the estimate and heeds `--memory`.
#[test]
fn the_command_says_what_a_run_takes_and_refuses_what_does_not_fit() {
    let output = common::rheotaxis_in(Path::new("."), &["check", "duck_st"]);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(said.contains("\n  a run takes about "), "{said}");
    assert!(said.contains(" frames (record.frame_period_s)"), "{said}");
    let args = ["check", "duck_st", "--memory", "20M"];
    let output = common::rheotaxis_in(Path::new("."), &args);
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("at most 20 MB are allowed"), "{said}");
}
