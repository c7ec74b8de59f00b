//! What no computer could bear, or no physics, is said by `check` before anything of it is built: place, value and
//! legal range.

use crate::common::{rheotaxis, says, scenario};
use rheotaxis::scenario::{CATALOG, Scenario, check_within, cost, parse};
use std::path::Path;

/// What reading and checking say of a scenario that comes with the program, with a value at a path.
fn said(name: &str, path: &str, value: &str) -> Vec<String> {
    let loaded = scenario(name, &[]);
    match loaded.set(path, value) {
        Err(error) => error.lines(),
        Ok(changed) => within(&changed.scenario, &loaded.base_dir, cost::MEMORY),
    }
}

/// What checking says where so many bytes are allowed.
fn within(scenario: &Scenario, base_dir: &Path, bytes: f64) -> Vec<String> {
    check_within(scenario, base_dir, bytes).iter().map(ToString::to_string).collect()
}

/// A scenario, a path in it and its value; the part of the value that is refused, and what is legal there.
const REFUSED: [(&str, &str, &str, &str, &str); 30] = [
    // Infinite loops and tables.
    ("duck_st", "time.flow_period_s", "0.0002", "", "0 (at each step of the plume) or at least time.step_s, 0.05"),
    ("duck_st", "water.currents[1].omega_rad_s", "1e6", "", "from 1e-7 to 6 rad/s, got 1e6"),
    ("duck_st", "water.currents[1].diffusivity_m2_s", "1e300", "", "from 0 to 100000 m2/s, got 1e300"),
    ("moth_eyes", "robots[0].map.trajectory.sigma_x_m_rts", "65536", "", "from 1e-6 to 100 m/s^0.5, got 65536"),
    ("moth_eyes", "robots[0].map", GRID_OF_MANY, ".grid", "at most 1000000 cells, got 4000000"),
    ("moth_eyes", "robots[0].map", WALK_OVER_MANY, ".trajectory.sigma_y_m_rts", "at most 0.0379"),
    ("moth_eyes", "robots[0].map", GRID_BEYOND_COUNTING, ".grid", "cells"),
    ("moth_eyes", "robots[0].map.step_s", "1e-6", "", "at least 0.006 to look back 600 s in 100000 steps, got 1e-6"),
    ("moth_eyes", "robots[0].map.step_s", "1e-4", "", "at least 0.006"),
    ("moth_eyes", "robots[0].sensors.sidescan", "(range_m: 1e8, rate_hz: 1e-6)", ".range_m", "from 0.01 to 5000 m"),
    ("harbour_3d", "robots[0].sensors.ranging.max_range_m", "1e6", "", "from 0.01 to 5000 m, got 1e6"),
    ("reef_mesh", "robots[0].strategy.evade.look_m", "1e300", "", "from 0.01 to 100000 m, got 1e300"),
    ("wp_laminar", "robots[0].strategy.planner", "PotentialField(step_m: 1e-6)", ".step_m", "at least 0.05"),
    // Beyond physics.
    ("flume_crab", "sources[0].release.nozzle.speed_m_s", "1e306", "", "got 1e306"),
    ("flume_crab", "sources[0].release.nozzle.diameter_m", "5e-324", "", "from 1e-5 to 10 m, got 5e-324"),
    ("flume_crab", "sources[0].release.nozzle.diameter_m", "1e-9", "", "from 1e-5 to 10 m, got 1e-9"),
    ("flume_crab", "water.currents[0].mean_m_s", "1e154", "", "got 1e154"),
    ("flume_crab", "water.density_kg_m3", "1e6", "", "from 900 to 1400 kg/m3, got 1e6"),
    ("harbour_3d", "obstacles[0].shape.size_m", "(2e9, 6, 12)", "", "from 0.001 to 1000000 m, got 2e9"),
    ("harbour_3d", "obstacles[0].shape.size_m", "(1e200, 6, 12)", "", "got 1e200"),
    ("harbour_3d", "robots[0].strategy.room.cell_m", "(200, 0.5, 0.5)", "", "at most 100-fold, got 0.5 and 200 m"),
    ("harbour_3d", "robots[0].start.speed_m_s", "1000", "", "from 0 to 15 m/s, got 1000"),
    ("duck_st", "water.currents[1].std_m_s", "1e39", "", "got 1e39"),
    ("duck_st", "water.currents[1].std_m_s", "1e9", "", "from 0 to 5 m/s, got 1e9"),
    ("duck_st", "water.mixing.background_vertical_m2_s", "1e12", "", "from 0 to 100 m2/s, got 1e12"),
    ("duck_st", LENGTH_OF_A_WAVE, "0.01", "", "from 0.6283185307179586 (a slope of 45 degrees) to 21750 m (15 m/s)"),
    ("duck_st", "sources[0].rate_g_s", "1e17", "", "from 1e-12 to 1000000 g/s, got 1e17"),
    // Waves of no sea.
    ("uniform_channel", SECOND_CURRENT, LONG_WAVES, ".spectrum.peak_period_s", "from 0.05 to 60 s, got 1e17"),
    ("uniform_channel", SECOND_CURRENT, NARROW_WAVES, ".spectrum.spreading", "from 0 to 1000, got 1e12"),
    ("uniform_channel", SECOND_CURRENT, MIXING_WAVES, ".mixing", "from 0 to 10, got 1e12"),
];

const GRID_OF_MANY: &str = "Hmm(grid: (along: 40, across: 100000), trajectory: (sigma_y_m_rts: 1))";
const WALK_OVER_MANY: &str = "Hmm(grid: (along: 5, across: 100000), trajectory: (sigma_y_m_rts: 1))";
const GRID_BEYOND_COUNTING: &str =
    "Pomdp(grid: (along: 4194304, across: 4194304, vertical: 1048576, bottom_depth_m: 10))";
const LENGTH_OF_A_WAVE: &str = "water.currents[0].interfaces[0].waves[1].length_m";
const SECOND_CURRENT: &str = "water.currents[1]";
const LONG_WAVES: &str = "Waves(spectrum: (significant_height_m: 0.2, heading_deg: 90, peak_period_s: 1e17))";
const NARROW_WAVES: &str =
    "Waves(spectrum: (significant_height_m: 0.2, heading_deg: 90, peak_period_s: 3, spreading: 1e12))";
const MIXING_WAVES: &str = "Waves(mixing: 1e12, trains: [(height_m: 0.2, period_s: 3, heading_deg: 90)])";

#[test]
fn numbers_beyond_computers_and_physics_are_refused_where_they_stand() {
    for (name, path, value, part, legal) in REFUSED {
        let (said, place) = (said(name, path, value), format!("{path}{part}"));
        let refused = said.iter().any(|s| s.contains(&place) && s.contains(legal));
        assert!(refused, "{name}, {value}: wanted {place}: {legal}, said {said:#?}");
    }
}

#[test]
fn memory_beyond_what_is_allowed_names_the_field_and_what_would_fit() {
    let said = |hz: &str, bytes: f64| {
        let changed = scenario("wp_laminar", &[("sources[0].release.rate_hz", hz)]);
        within(&changed.scenario, Path::new(""), bytes)
    };
    let refused = said("40000", 5e8);
    assert_eq!(refused.len(), 1, "{refused:#?}");
    let path = "sources[0].release.rate_hz: must be at most ";
    assert!(refused[0].starts_with(path), "{refused:#?}");
    says(&refused[0], &["got 40000", "500 MB"]);
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
    for (name, values, part) in [
        (
            "wp_laminar",
            &[
                ("sources[0].release.rate_hz", "49000"),
                ("time.spin_up_period_s", "0.02"),
                ("time.drift_period_s", "0.02"),
            ][..],
            "sources[0].release.rate_hz: ",
        ),
        (
            "flume_crab",
            &[
                ("sources[0].release.nozzle", "(diameter_m: 0.00001, speed_m_s: 0.5)"),
                ("time.step_s", "0.001"),
                ("time.drift_period_s", "0.005"),
            ],
            "sources[0].release.nozzle.diameter_m: ",
        ),
        ("moth_eyes", &[("robots[0].map", "Hmm(step_s: 0.02, grid: (along: 300, across: 300))")], "robots[0].map"),
    ] {
        let changed = scenario(name, values);
        let said = within(&changed.scenario, &changed.base_dir, cost::MEMORY);
        let warned = |s: &String| s.starts_with(part) && s.contains("will take hours");
        assert!(said.iter().any(warned), "{values:?}: {said:#?}");
    }
}

#[test]
fn no_scenario_that_comes_with_the_program_is_too_much() {
    for template in CATALOG {
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
    says(&rheotaxis(&["check", "duck_st"]).out, &["\n  a run takes about ", "record.frame_period_s"]);
    says(&rheotaxis(&["check", "duck_st", "--memory", "20M"]).with(1).err, &["20 MB"]);
}
