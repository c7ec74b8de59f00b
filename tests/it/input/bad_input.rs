//! Bad input: each mistake with the exact message it gets.

mod releases;
mod rounds;

use crate::common::{Ended, read, rheotaxis_in};
use std::net::TcpListener;

/// A whole scenario in which each test breaks one thing.
const POND: &str = r#"(
    version: 2,
    title: "Pond",
    citation: "none: made for these tests",
    area: (length_m: 100, width_m: 50, axis_heading_deg: 0),
    terrain: Level(depth_m: 10),
    water: (
        currents: [Uniform(speed_m_s: 0.1, heading_deg: 180)],
        mixing: (horizontal_m2_s: 0.01),
    ),
    sources: [
        (id: "s1", east_m: 0, north_m: 40, height_m: 0.2, rate_g_s: 0.025),
    ],
    obstacles: [
        (id: "pile", shape: Cylinder(radius_m: 2, height_m: 8), east_m: 0, north_m: 0),
    ],
    robots: [
        (
            id: "auv0",
            vehicle: Remus100(),
            start: (east_m: 10, north_m: -30, depth_m: 5, heading_deg: 0),
            estimator: DeadReckoning(),
            strategy: OpenLoop(table: [(t_s: 0, rpm: 0)], end_s: 1),
        ),
    ],
    time: (limit_s: 2),
)
"#;

/// The exact message a test expects: `tests/golden/bad_input/<name>.txt`.
fn golden(name: &str) -> String {
    read(&format!("tests/golden/bad_input/{name}.txt"))
}

/// Writes `text` as `pond.ron` into a fresh folder and runs the command there.
fn in_folder(text: &[u8], args: &[&str]) -> Ended {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("pond.ron"), text).unwrap();
    rheotaxis_in(dir.path(), args)
}

/// `check` and `run` both refuse the text with exactly the message of this name and exit code 1.
#[track_caller]
fn refused(text: impl AsRef<[u8]>, name: &str) {
    for args in [&["check", "pond.ron"][..], &["run", "pond.ron", "--no-zenoh", "--quiet"]] {
        let ended = in_folder(text.as_ref(), args);
        assert_eq!(ended.err, golden(name), "{name} {args:?}");
        assert_eq!(ended.code, Some(1), "{name} {args:?}");
    }
}

/// The pond with these things changed.
#[track_caller]
fn pond(changes: &[(&str, &str)]) -> String {
    changes.iter().fold(POND.to_string(), |text, (from, to)| {
        assert_eq!(text.matches(from).count(), 1, "{from}");
        text.replace(from, to)
    })
}

#[test]
fn the_pond_itself_is_fine() {
    for text in [POND.to_string(), format!("\u{feff}{POND}")] {
        let ended = in_folder(text.as_bytes(), &["check", "pond.ron"]).with(0);
        assert_eq!(ended.err, "");
        let (first, estimate) = ended.out.split_once('\n').expect("two lines");
        assert_eq!(first, "pond.ron: fine: Pond (1 robot, 1 source, 1 obstacle)");
        assert!(estimate.starts_with("  a run takes about "), "{estimate}");
    }
}

const UNIFORM: &str = "Uniform(speed_m_s: 0.1, heading_deg: 180)";
const OPEN_LOOP: &str = "OpenLoop(table: [(t_s: 0, rpm: 0)], end_s: 1)";
const ESTIMATOR: &str = "estimator: DeadReckoning(),";
const EYES: &str = "sensors: (fluorometer: (), dvl: (), adcp: (), compass: (), depth: (), altimeter: (), sidescan: (), \
    camera: ()),\n            estimator: DeadReckoning(),";
const SURVEY: &str = "Amp(
                after_declaration: Survey(camera: (verifier: (least_dye: 0.8)), verify: Camera),
            )";
const SUBSUMPTION: &str = "Subsumption(
                layers: [Find(ZigZag()), Maintain(), Declare(SizF())],
                eyes: (verifier: (colours: (alpha2: 300))),
            )";
const FAULTS_THAT_DO_NOT_FIT: &str = "sensors: (compass: ()),\n            estimator: DeadReckoning(),
            faults: [
                (at_s: 0.5, until_s: 0.4, what: Compass(Stuck)),
                (at_s: 1, what: Fluorometer(Silent)),
                (at_s: 1, what: Drive(link: \"ruder\", how: Dead)),
                (at_s: 0, until_s: 1, what: Rudder(Stuck)),
                (at_s: 0.9, what: Drive(link: \"rudder\", how: StuckAt(100))),
            ],";
const FAULTS_THAT_MAKE_NO_SENSE: &str = "sensors: (compass: ()),\n            estimator: DeadReckoning(),
            faults: [
                (at_s: -1, what: Compass(Stuck)),
                (at_s: 1, what: Compass(StuckAt(10))),
                (at_s: 1, what: Gyroscope(Silent)),
                (at_s: 1, what: Propeller(Weak(1.5))),
                (at_s: 1, what: Compass(Biased(200))),
                (at_s: 1, what: Depth),
            ],";

/// Each message and what leads to it.
const MISTAKES: [(&str, &[(&str, &str)]); 36] = [
    ("another_version", &[("version: 2", "version: 3")]),
    ("no_version", &[("version: 2,", "")]),
    ("misspelt_field", &[("length_m", "lenght_m")]),
    ("misspelt_variant", &[("OpenLoop", "OpnLoop")]),
    ("missing_field", &[(", rate_g_s: 0.025", "")]),
    ("missing_comma", &[("width_m: 50,", "width_m: 50")]),
    ("text_for_a_number", &[("limit_s: 2", "limit_s: \"2\"")]),
    ("number_out_of_range", &[("heading_deg: 180", "heading_deg: 361")]),
    ("depth_that_is_not_positive", &[("Level(depth_m: 10)", "Level(depth_m: -10)")]),
    ("negative_diffusivity", &[("horizontal_m2_s: 0.01", "horizontal_m2_s: -0.01")]),
    ("nan", &[("horizontal_m2_s: 0.01", "horizontal_m2_s: NaN")]),
    ("infinite", &[("limit_s: 2", "limit_s: 1e999")]),
    ("zero_layers", &[(UNIFORM, "Layered(layers: [])")]),
    ("source_outside_the_area", &[("north_m: 40", "north_m: 400")]),
    ("source_under_the_bottom", &[("height_m: 0.2", "height_m: -0.2")]),
    ("source_above_the_surface", &[("height_m: 0.2", "height_m: 10.2")]),
    ("start_inside_an_obstacle", &[("east_m: 10, north_m: -30", "east_m: 1, north_m: 0")]),
    ("start_outside_the_area", &[("east_m: 10,", "east_m: 30,")]),
    ("start_under_the_bed", &[("depth_m: 5", "depth_m: 15")]),
    ("start_at_depth_and_altitude", &[("depth_m: 5", "depth_m: 5, altitude_m: 5")]),
    ("missing_urdf", &[("Remus100()", "Remus100(urdf: \"hull.urdf\")")]),
    ("missing_mesh", &[("Cylinder(radius_m: 2, height_m: 8)", "Mesh(file: \"pile.stl\")")]),
    ("several_mistakes_are_all_shown", &[("height_m: 0.2", "height_m: -0.2"), ("\"pile\"", "\"Pile\"")]),
    ("a_minus_sign_from_a_document", &[("north_m: -30", "north_m: \u{2212}30")]),
    ("water_too_large_for_any_computer", &[("length_m: 100, width_m: 50", "length_m: 1e7, width_m: 1e7")]),
    ("a_list_of_no_points", &[(OPEN_LOOP, "Amp(lost_points: 0)")]),
    ("a_variant_without_its_parentheses", &[("estimator: DeadReckoning()", "estimator: DeadReckoning")]),
    ("a_variant_without_its_parentheses_and_fields", &[("Level(depth_m: 10)", "Level")]),
    ("values_without_their_names", &[("(length_m: 100, width_m: 50, axis_heading_deg: 0)", "(100, 50, 0)")]),
    (
        "a_bracket_that_is_not_closed",
        &[("axis_heading_deg: 0),", "axis_heading_deg: 0,"), ("limit_s: 2", "limit_s: -2")],
    ),
    ("a_missing_block", &[("    time: (limit_s: 2),\n", "")]),
    ("faults_that_do_not_fit", &[(ESTIMATOR, FAULTS_THAT_DO_NOT_FIT)]),
    ("faults_that_make_no_sense", &[(ESTIMATOR, FAULTS_THAT_MAKE_NO_SENSE)]),
    ("verifier_of_survey", &[(ESTIMATOR, EYES), (OPEN_LOOP, SURVEY)]),
    ("verifier_of_eyes", &[(ESTIMATOR, EYES), (OPEN_LOOP, SUBSUMPTION)]),
    (
        "mistakes_of_all_kinds_in_one_round",
        &[
            ("length_m: 100", "lenght_m: 100"),
            ("horizontal_m2_s: 0.01", "horizontal_m2_s: -0.01"),
            ("north_m: 40", "north_m: 400"),
            ("radius_m: 2", "radius_m: \"2\""),
            ("id: \"auv0\"", "id: \"AUV\""),
            (ESTIMATOR, "estimator: DeadReckoning,"),
            ("OpenLoop(", "OpnLoop("),
            ("limit_s: 2", "spin_up_s: 2"),
        ],
    ),
];

#[test]
fn each_mistake_has_its_message() {
    for (name, changes) in MISTAKES {
        refused(pond(changes), name);
    }
}

#[test]
fn what_is_no_whole_text_has_its_message() {
    refused("\n", "empty_file");
    refused(b"(\n  version: 1, // \xff\n)", "not_utf_8");
    refused(POND.to_string() + &" ".repeat(1 << 20), "too_long");
    refused(&POND[..POND.find("estimator").unwrap()], "truncated");
    for cut in 1..POND.trim_end().len() {
        let error = rheotaxis::scenario::parse("pond.ron", &POND[..cut]).unwrap_err();
        let line = error.lines().remove(0);
        assert!(line.contains("the file ends at line"), "cut at {cut}: {line}");
    }
}

#[test]
fn two_robots_of_one_name_or_in_one_place_have_their_message() {
    let start = POND.find("        (\n            id").unwrap();
    let end = POND.find("    ],\n    time").unwrap();
    let robot = &POND[start..end];
    for (second, name) in
        [(robot.to_string(), "robots_of_one_name"), (robot.replace("auv0", "auv1"), "hulls_in_one_another")]
    {
        refused(POND.replacen(robot, &format!("{robot}{second}"), 1), name);
    }
}

#[test]
fn a_search_without_a_source_is_a_warning() {
    let source = "        (id: \"s1\", east_m: 0, north_m: 40, height_m: 0.2, rate_g_s: 0.025),\n";
    let text = pond(&[(source, ""), ("time:", "success: Declared(within_m: 5),\n    time:")]);
    let ended = in_folder(text.as_bytes(), &["check", "pond.ron"]).with(0);
    assert_eq!(ended.err, golden("a_search_without_a_source_is_a_warning"));
}

/// Permissions do not bind root; a folder below a regular file cannot be made by anyone.
#[test]
fn commands_that_cannot_do_what_they_are_told_have_their_message() {
    for (name, code, args) in [
        ("missing_file", 1, &["check", "nowhere/pond.ron"][..]),
        ("missing_file", 1, &["run", "nowhere/pond.ron"]),
        ("unwritable_out_folder", 1, &["run", "pond.ron", "--no-zenoh", "--quiet", "--out", "pond.ron/out"]),
        ("init_does_not_overwrite", 1, &["init", "duck_st", "pond.ron"]),
        ("wrong_usage_has_an_exit_code_of_its_own", 2, &["run", "duck_st", "--speed", "fast"]),
    ] {
        assert_eq!(in_folder(POND.as_bytes(), args).with(code).err, golden(name), "{name}");
    }
    let dir = tempfile::tempdir().unwrap();
    std::fs::create_dir(dir.path().join("ponds")).unwrap();
    assert_eq!(rheotaxis_in(dir.path(), &["check", "ponds"]).with(1).err, golden("a_folder"));
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port();
    let endpoint = format!("tcp/127.0.0.1:{port}");
    let args = ["run", "pond.ron", "--quiet", "--zenoh-listen", &endpoint];
    let said = in_folder(POND.as_bytes(), &args).with(1).err;
    assert_eq!(said.replace(&port.to_string(), "PORT"), golden("busy_port"));
}
