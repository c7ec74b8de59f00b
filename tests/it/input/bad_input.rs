//! Bad input: each mistake with the exact message it gets.

mod faults;
mod odd;
mod releases;
mod rounds;
mod verifiers;

use crate::common;
use std::net::TcpListener;
use std::path::Path;
use std::process::Output;

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

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).expect("messages are UTF-8")
}

/// The exact message a test expects: `tests/golden/bad_input/<test>.txt`.
fn golden(name: &str) -> String {
    let file = common::root().join(format!("tests/golden/bad_input/{name}.txt"));
    std::fs::read_to_string(&file).unwrap_or_else(|e| panic!("{}: {e}", file.display()))
}

/// Writes `text` as `pond.ron` into a fresh folder and runs the command there.
fn in_folder(text: &[u8], args: &[&str]) -> Output {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("pond.ron"), text).unwrap();
    common::rheotaxis_in(dir.path(), args)
}

/// `check` and `run` both refuse the text with exactly this message and exit code 1.
#[track_caller]
fn refused(text: impl AsRef<[u8]>, message: &str) {
    for args in [&["check", "pond.ron"][..], &["run", "pond.ron", "--no-zenoh", "--quiet"]] {
        let output = in_folder(text.as_ref(), args);
        assert_eq!(stderr(&output), message, "{args:?}");
        assert_eq!(output.status.code(), Some(1), "{args:?}");
    }
}

/// The pond with one thing changed.
#[track_caller]
fn pond(from: &str, to: &str) -> String {
    assert_eq!(POND.matches(from).count(), 1, "{from}");
    POND.replace(from, to)
}

#[test]
fn the_pond_itself_is_fine() {
    let output = in_folder(POND.as_bytes(), &["check", "pond.ron"]);
    assert_eq!(stderr(&output), "");
    assert_eq!(output.status.code(), Some(0));
    let said = String::from_utf8_lossy(&output.stdout);
    let (first, estimate) = said.split_once('\n').expect("two lines");
    assert_eq!(first, "pond.ron: fine: Pond (1 robot, 1 source, 1 obstacle)");
    assert!(estimate.starts_with("  a run takes about "), "{estimate}");
}

#[test]
fn missing_file() {
    for command in ["check", "run"] {
        let output = common::rheotaxis_in(Path::new("."), &[command, "nowhere/pond.ron"]);
        assert_eq!(output.status.code(), Some(1));
        assert_eq!(stderr(&output), golden("missing_file"));
    }
}

#[test]
fn a_folder() {
    let dir = tempfile::tempdir().unwrap();
    std::fs::create_dir(dir.path().join("ponds")).unwrap();
    let output = common::rheotaxis_in(dir.path(), &["check", "ponds"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(stderr(&output), golden("a_folder"));
}

#[test]
fn empty_file() {
    refused("\n", &golden("empty_file"));
}

#[test]
fn not_utf_8() {
    refused(b"(\n  version: 1, // \xff\n)", &golden("not_utf_8"));
}

#[test]
fn too_long() {
    refused(POND.to_string() + &" ".repeat(1 << 20), &golden("too_long"));
}

#[test]
fn truncated() {
    let cut = POND.find("estimator").unwrap();
    refused(&POND[..cut], &golden("truncated"));
}

#[test]
fn truncated_anywhere_says_that_the_file_ends_too_early() {
    for cut in 1..POND.trim_end().len() {
        let error = rheotaxis::scenario::parse("pond.ron", &POND[..cut]).unwrap_err();
        let line = error.lines().remove(0);
        assert!(line.contains("the file ends at line"), "cut at {cut}: {line}");
    }
}

#[test]
fn another_version() {
    refused(pond("version: 2", "version: 3"), &golden("another_version"));
}

#[test]
fn no_version() {
    refused(pond("version: 2,", ""), &golden("no_version"));
}

#[test]
fn misspelt_field() {
    refused(pond("length_m", "lenght_m"), &golden("misspelt_field"));
}

#[test]
fn misspelt_variant() {
    refused(pond("OpenLoop", "OpnLoop"), &golden("misspelt_variant"));
}

#[test]
fn missing_field() {
    refused(pond(", rate_g_s: 0.025", ""), &golden("missing_field"));
}

#[test]
fn missing_comma() {
    refused(pond("width_m: 50,", "width_m: 50"), &golden("missing_comma"));
}

#[test]
fn text_for_a_number() {
    refused(pond("limit_s: 2", "limit_s: \"2\""), &golden("text_for_a_number"));
}

#[test]
fn number_out_of_range() {
    refused(pond("heading_deg: 180", "heading_deg: 361"), &golden("number_out_of_range"));
}

#[test]
fn depth_that_is_not_positive() {
    refused(pond("Level(depth_m: 10)", "Level(depth_m: -10)"), &golden("depth_that_is_not_positive"));
}

#[test]
fn negative_diffusivity() {
    refused(pond("horizontal_m2_s: 0.01", "horizontal_m2_s: -0.01"), &golden("negative_diffusivity"));
}

#[test]
fn nan() {
    refused(pond("horizontal_m2_s: 0.01", "horizontal_m2_s: NaN"), &golden("nan"));
}

#[test]
fn infinite() {
    refused(pond("limit_s: 2", "limit_s: 1e999"), &golden("infinite"));
}

#[test]
fn zero_layers() {
    let text = pond("Uniform(speed_m_s: 0.1, heading_deg: 180)", "Layered(layers: [])");
    refused(text, &golden("zero_layers"));
}

#[test]
fn source_outside_the_area() {
    refused(pond("north_m: 40", "north_m: 400"), &golden("source_outside_the_area"));
}

#[test]
fn source_under_the_bottom() {
    refused(pond("height_m: 0.2", "height_m: -0.2"), &golden("source_under_the_bottom"));
}

#[test]
fn source_above_the_surface() {
    refused(pond("height_m: 0.2", "height_m: 10.2"), &golden("source_above_the_surface"));
}

#[test]
fn start_inside_an_obstacle() {
    let text = pond("east_m: 10, north_m: -30", "east_m: 1, north_m: 0");
    refused(text, &golden("start_inside_an_obstacle"));
}

#[test]
fn start_outside_the_area() {
    refused(pond("east_m: 10,", "east_m: 30,"), &golden("start_outside_the_area"));
}

#[test]
fn start_under_the_bed() {
    refused(pond("depth_m: 5", "depth_m: 15"), &golden("start_under_the_bed"));
}

#[test]
fn start_at_depth_and_altitude() {
    refused(pond("depth_m: 5", "depth_m: 5, altitude_m: 5"), &golden("start_at_depth_and_altitude"));
}

#[test]
fn robots_of_one_name() {
    let start = POND.find("        (\n            id").unwrap();
    let end = POND.find("    ],\n    time").unwrap();
    let robot = &POND[start..end];
    refused(POND.replacen(robot, &robot.repeat(2), 1), &golden("robots_of_one_name"));
}

#[test]
fn missing_urdf() {
    refused(pond("Remus100()", "Remus100(urdf: \"hull.urdf\")"), &golden("missing_urdf"));
}

#[test]
fn missing_mesh() {
    let text = pond("Cylinder(radius_m: 2, height_m: 8)", "Mesh(file: \"pile.stl\")");
    refused(text, &golden("missing_mesh"));
}

#[test]
fn several_mistakes_are_all_shown() {
    let text = pond("height_m: 0.2", "height_m: -0.2").replace("\"pile\"", "\"Pile\"");
    refused(text, &golden("several_mistakes_are_all_shown"));
}

#[test]
fn a_search_without_a_source_is_a_warning() {
    let start = POND.find("        (id: \"s1\"").unwrap();
    let end = POND.find("    ],\n    obstacles").unwrap();
    let text = POND.replace(&POND[start..end], "").replace("time:", "success: Declared(within_m: 5),\n    time:");
    let output = in_folder(text.as_bytes(), &["check", "pond.ron"]);
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(stderr(&output), golden("a_search_without_a_source_is_a_warning"));
}

#[test]
fn unwritable_out_folder() {
    // Permissions do not bind root; a folder below a regular file cannot be made by anyone.
    let args = ["run", "pond.ron", "--no-zenoh", "--quiet", "--out", "pond.ron/out"];
    let output = in_folder(POND.as_bytes(), &args);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(stderr(&output), golden("unwritable_out_folder"));
}

#[test]
fn busy_port() {
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port();
    let endpoint = format!("tcp/127.0.0.1:{port}");
    let args = ["run", "pond.ron", "--quiet", "--zenoh-listen", &endpoint];
    let output = in_folder(POND.as_bytes(), &args);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(stderr(&output).replace(&port.to_string(), "PORT"), golden("busy_port"));
}

#[test]
fn init_does_not_overwrite() {
    let output = in_folder(POND.as_bytes(), &["init", "duck_st", "pond.ron"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(stderr(&output), golden("init_does_not_overwrite"));
}

#[test]
fn wrong_usage_has_an_exit_code_of_its_own() {
    let output = common::rheotaxis(&["run", "duck_st", "--speed", "fast"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(stderr(&output), golden("wrong_usage_has_an_exit_code_of_its_own"));
}
