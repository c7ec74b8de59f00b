//! Bad input: each mistake with the exact message it gets.

use crate::common;
use std::net::TcpListener;
use std::path::Path;
use std::process::Output;

/// A whole scenario in which each test breaks one thing.
const POND: &str = r#"(
    version: 1,
    title: "Pond",
    source: "none: made for these tests",
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

/// Writes `text` as `pond.ron` into a fresh folder and runs the command there.
fn in_folder(text: &[u8], args: &[&str]) -> Output {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("pond.ron"), text).unwrap();
    common::rheotaxis_in(dir.path(), args)
}

/// `check` and `run` both refuse the text with exactly this message and exit code 1.
#[track_caller]
fn refused(text: impl AsRef<[u8]>, message: &str) {
    for args in [
        &["check", "pond.ron"][..],
        &["run", "pond.ron", "--no-zenoh", "--quiet"],
    ] {
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
    assert_eq!(
        String::from_utf8_lossy(&output.stdout),
        "pond.ron: fine: Pond (1 robot, 1 source, 1 obstacle)\n"
    );
}

#[test]
fn missing_file() {
    for command in ["check", "run"] {
        let output = common::rheotaxis_in(Path::new("."), &[command, "nowhere/pond.ron"]);
        assert_eq!(output.status.code(), Some(1));
        assert_eq!(stderr(&output), r#"  × nowhere/pond.ron: there is no such file
  help: `rheotaxis list scenarios` names those that come with the program, `rheotaxis init NAME` writes one to change

"#);
    }
}

#[test]
fn a_folder() {
    let dir = tempfile::tempdir().unwrap();
    std::fs::create_dir(dir.path().join("ponds")).unwrap();
    let output = common::rheotaxis_in(dir.path(), &["check", "ponds"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(stderr(&output), "  × ponds: is a folder\n  help: name the scenario files in it\n\n");
}

#[test]
fn empty_file() {
    refused("\n", r#"  × pond.ron: the file is empty, or holds only comments
  help: `rheotaxis init duck_st` writes a whole scenario to start from

"#);
}

#[test]
fn not_utf_8() {
    refused(b"(\n  version: 1, // \xff\n)", r#"  × pond.ron: is not UTF-8 text: line 2, byte 19
  help: save it as UTF-8

"#);
}

#[test]
fn too_long() {
    refused(POND.to_string() + &" ".repeat(1 << 20), r#"  × pond.ron: is longer than 1 MiB
  help: a scenario is text of a few kilobytes; is this the right file?

"#);
}

#[test]
fn truncated() {
    let cut = POND.find("estimator").unwrap();
    refused(&POND[..cut], r#"  × robots[0]: the file ends at line 22 before this `(` is closed
    ╭─[pond.ron:18:9]
 17 │     robots: [
 18 │         (
    ·         ┬
    ·         ╰── opened here
 19 │             id: "auv0",
    ╰────
  help: the file may have been cut off, or a closing bracket is missing

"#);
}

#[test]
fn truncated_anywhere_says_that_the_file_ends_too_early() {
    for cut in 1..POND.trim_end().len() {
        let error = rheotaxis::scenario::parse("pond.ron", &POND[..cut]).unwrap_err();
        let line = error.lines().remove(0);
        assert!(
            line.contains("the file ends at line"),
            "cut at {cut}: {line}"
        );
    }
}

#[test]
fn another_version() {
    refused(pond("version: 1", "version: 2"), r#"  × version: this program reads version 1, got 2
   ╭─[pond.ron:2:5]
 1 │ (
 2 │     version: 2,
   ·     ─────┬────
   ·          ╰── here
 3 │     title: "Pond",
   ╰────
  help: take the program that wrote the file, or start anew from `rheotaxis init`

"#);
}

#[test]
fn no_version() {
    refused(pond("version: 1,", ""), r#"  × version: the first field must be `version: 1`
   ╭─[pond.ron:3:5]
 2 │     
 3 │     title: "Pond",
   ·     ──────┬──────
   ·           ╰── here
 4 │     source: "none: made for these tests",
   ╰────
  help: the file begins with `title`

"#);
}

#[test]
fn misspelt_field() {
    refused(pond("length_m", "lenght_m"), r#"  × area: there is no field `lenght_m`
   ╭─[pond.ron:5:12]
 4 │     source: "none: made for these tests",
 5 │     area: (lenght_m: 100, width_m: 50, axis_heading_deg: 0),
   ·            ────┬───
   ·                ╰── here
 6 │     terrain: Level(depth_m: 10),
   ╰────
  help: did you mean `length_m`? fields here: length_m, width_m, axis_heading_deg, east_m, north_m

"#);
}

#[test]
fn misspelt_variant() {
    refused(pond("OpenLoop", "OpnLoop"), r#"  × robots[0].strategy: there is no choice `OpnLoop`
    ╭─[pond.ron:23:23]
 22 │             estimator: DeadReckoning(),
 23 │             strategy: OpnLoop(table: [(t_s: 0, rpm: 0)], end_s: 1),
    ·                       ───┬───
    ·                          ╰── here
 24 │         ),
    ╰────
  help: did you mean `OpenLoop`? choices here: Amp, OpenLoop

"#);
}

#[test]
fn missing_field() {
    refused(pond(", rate_g_s: 0.025", ""), r#"  × sources[0]: the field `rate_g_s` is missing
    ╭─[pond.ron:12:9]
 11 │     sources: [
 12 │         (id: "s1", east_m: 0, north_m: 40, height_m: 0.2),
    ·         ────────────────────────┬────────────────────────
    ·                                 ╰── here
 13 │     ],
    ╰────
  help: add `rate_g_s: ...`

"#);
}

#[test]
fn missing_comma() {
    refused(pond("width_m: 50,", "width_m: 50"), r#"  × area.axis_heading_deg: expected a comma
   ╭─[pond.ron:5:39]
 4 │     source: "none: made for these tests",
 5 │     area: (length_m: 100, width_m: 50 axis_heading_deg: 0),
   ·                                       ▲
   ·                                       ╰── here
 6 │     terrain: Level(depth_m: 10),
   ╰────
  help: fields and elements are separated by `,`

"#);
}

#[test]
fn text_for_a_number() {
    refused(
        pond("limit_s: 2", "limit_s: \"2\""),
        r#"  × time.limit_s: expected a number, got "2"
    ╭─[pond.ron:26:21]
 25 │     ],
 26 │     time: (limit_s: "2"),
    ·                     ─┬─
    ·                      ╰── here
 27 │ )
    ╰────

"#,
    );
}

#[test]
fn number_out_of_range() {
    refused(
        pond("heading_deg: 180", "heading_deg: 361"),
        r#"  × water.currents[0].heading_deg: must be a heading from 0 to 360 degrees, got 361
   ╭─[pond.ron:8:57]
 7 │     water: (
 8 │         currents: [Uniform(speed_m_s: 0.1, heading_deg: 361)],
   ·                                                         ─┬─
   ·                                                          ╰── here
 9 │         mixing: (horizontal_m2_s: 0.01),
   ╰────

"#,
    );
}

#[test]
fn depth_that_is_not_positive() {
    refused(
        pond("Level(depth_m: 10)", "Level(depth_m: -10)"),
        r#"  × terrain.depth_m: must be > 0, got -10
   ╭─[pond.ron:6:29]
 5 │     area: (length_m: 100, width_m: 50, axis_heading_deg: 0),
 6 │     terrain: Level(depth_m: -10),
   ·                             ─┬─
   ·                              ╰── here
 7 │     water: (
   ╰────

"#,
    );
}

#[test]
fn negative_diffusivity() {
    refused(
        pond("horizontal_m2_s: 0.01", "horizontal_m2_s: -0.01"),
        r#"  × water.mixing.horizontal_m2_s: must be >= 0, got -0.01
    ╭─[pond.ron:9:35]
  8 │         currents: [Uniform(speed_m_s: 0.1, heading_deg: 180)],
  9 │         mixing: (horizontal_m2_s: -0.01),
    ·                                   ──┬──
    ·                                     ╰── here
 10 │     ),
    ╰────

"#,
    );
}

#[test]
fn nan() {
    refused(
        pond("horizontal_m2_s: 0.01", "horizontal_m2_s: NaN"),
        r#"  × water.mixing.horizontal_m2_s: must be >= 0, got NaN
    ╭─[pond.ron:9:35]
  8 │         currents: [Uniform(speed_m_s: 0.1, heading_deg: 180)],
  9 │         mixing: (horizontal_m2_s: NaN),
    ·                                   ─┬─
    ·                                    ╰── here
 10 │     ),
    ╰────
  help: give a finite number

"#,
    );
}

#[test]
fn infinite() {
    refused(pond("limit_s: 2", "limit_s: 1e999"), r#"  × time.limit_s: must be > 0, got inf
    ╭─[pond.ron:26:21]
 25 │     ],
 26 │     time: (limit_s: 1e999),
    ·                     ──┬──
    ·                       ╰── here
 27 │ )
    ╰────
  help: give a finite number

"#);
}

#[test]
fn zero_layers() {
    let text = pond(
        "Uniform(speed_m_s: 0.1, heading_deg: 180)",
        "Layered(layers: [])",
    );
    refused(text, r#"  × water.currents[0].layers: needs from 1 to 4 layers, got 0
   ╭─[pond.ron:8:28]
 7 │     water: (
 8 │         currents: [Layered(layers: [])],
   ·                            ─────┬────
   ·                                 ╰── here
 9 │         mixing: (horizontal_m2_s: 0.01),
   ╰────

"#);
}

#[test]
fn source_outside_the_area() {
    refused(
        pond("north_m: 40", "north_m: 400"),
        r#"  × sources[0].north_m: source "s1" at east 0 m, north 400 m lies 350.0 m outside the area; bring it inside
    ╭─[pond.ron:12:31]
 11 │     sources: [
 12 │         (id: "s1", east_m: 0, north_m: 400, height_m: 0.2, rate_g_s: 0.025),
    ·                               ──────┬─────
    ·                                     ╰── here
 13 │     ],
    ╰────

"#,
    );
}

#[test]
fn source_under_the_bottom() {
    refused(
        pond("height_m: 0.2", "height_m: -0.2"),
        r#"  × sources[0].height_m: source "s1" is 0.2 m under the bottom; must be from 0 (on the bed) to 10.00 (the water's depth there)
    ╭─[pond.ron:12:44]
 11 │     sources: [
 12 │         (id: "s1", east_m: 0, north_m: 40, height_m: -0.2, rate_g_s: 0.025),
    ·                                            ───────┬──────
    ·                                                   ╰── here
 13 │     ],
    ╰────

"#,
    );
}

#[test]
fn source_above_the_surface() {
    refused(
        pond("height_m: 0.2", "height_m: 10.2"),
        r#"  × sources[0].height_m: source "s1" is 0.20 m above the surface; the water is 10.00 m deep there, so must be from 0 to 10.00
    ╭─[pond.ron:12:44]
 11 │     sources: [
 12 │         (id: "s1", east_m: 0, north_m: 40, height_m: 10.2, rate_g_s: 0.025),
    ·                                            ───────┬──────
    ·                                                   ╰── here
 13 │     ],
    ╰────

"#,
    );
}

#[test]
fn start_inside_an_obstacle() {
    let text = pond("east_m: 10, north_m: -30", "east_m: 1, north_m: 0");
    refused(text, r#"  × robots[0].start: robot "auv0" starts inside obstacle "pile", 1.00 m from its surface
    ╭─[pond.ron:21:13]
 20 │             vehicle: Remus100(),
 21 │             start: (east_m: 1, north_m: 0, depth_m: 5, heading_deg: 0),
    ·             ─────────────────────────────┬────────────────────────────
    ·                                          ╰── here
 22 │             estimator: DeadReckoning(),
    ╰────
  help: move the start or the obstacle

"#);
}

#[test]
fn start_outside_the_area() {
    refused(
        pond("east_m: 10,", "east_m: 30,"),
        r#"  × robots[0].start: robot "auv0" at east 30 m, north -30 m starts 5.0 m outside the area
    ╭─[pond.ron:21:13]
 20 │             vehicle: Remus100(),
 21 │             start: (east_m: 30, north_m: -30, depth_m: 5, heading_deg: 0),
    ·             ──────────────────────────────┬──────────────────────────────
    ·                                           ╰── here
 22 │             estimator: DeadReckoning(),
    ╰────
  help: bring it inside, or make the area larger

"#,
    );
}

#[test]
fn start_under_the_bed() {
    refused(
        pond("depth_m: 5", "depth_m: 15"),
        r#"  × robots[0].start.depth_m: robot "auv0" starts 5.00 m under the bed; must be from 0 (the surface) to 10.00 (the water's depth there), got 15
    ╭─[pond.ron:21:47]
 20 │             vehicle: Remus100(),
 21 │             start: (east_m: 10, north_m: -30, depth_m: 15, heading_deg: 0),
    ·                                               ─────┬─────
    ·                                                    ╰── here
 22 │             estimator: DeadReckoning(),
    ╰────

"#,
    );
}

#[test]
fn start_at_depth_and_altitude() {
    refused(
        pond("depth_m: 5", "depth_m: 5, altitude_m: 5"),
        r#"  × robots[0].start: give either depth_m or altitude_m; both are given
    ╭─[pond.ron:21:13]
 20 │             vehicle: Remus100(),
 21 │             start: (east_m: 10, north_m: -30, depth_m: 5, altitude_m: 5, heading_deg: 0),
    ·             ──────────────────────────────────────┬─────────────────────────────────────
    ·                                                   ╰── here
 22 │             estimator: DeadReckoning(),
    ╰────

"#,
    );
}

#[test]
fn robots_of_one_name() {
    let start = POND.find("        (\n            id").unwrap();
    let end = POND.find("    ],\n    time").unwrap();
    let robot = &POND[start..end];
    refused(
        POND.replacen(robot, &robot.repeat(2), 1),
        r#"  × robots[1].id: "auv0" is already the name of robots[0]
    ╭─[pond.ron:26:13]
 25 │         (
 26 │             id: "auv0",
    ·             ─────┬────
    ·                  ╰── here
 27 │             vehicle: Remus100(),
    ╰────

"#,
    );
}

#[test]
fn missing_urdf() {
    refused(
        pond("Remus100()", "Remus100(urdf: \"hull.urdf\")"),
        r#"  × robots[0].vehicle.urdf: hull.urdf: No such file or directory (os error 2)
    ╭─[pond.ron:20:31]
 19 │             id: "auv0",
 20 │             vehicle: Remus100(urdf: "hull.urdf"),
    ·                               ────────┬────────
    ·                                       ╰── here
 21 │             start: (east_m: 10, north_m: -30, depth_m: 5, heading_deg: 0),
    ╰────
  help: paths are relative to the scenario file

"#,
    );
}

#[test]
fn missing_mesh() {
    let text = pond(
        "Cylinder(radius_m: 2, height_m: 8)",
        "Mesh(file: \"pile.stl\")",
    );
    refused(text, r#"  × obstacles[0].shape.file: pile.stl: No such file or directory (os error 2)
    ╭─[pond.ron:15:34]
 14 │     obstacles: [
 15 │         (id: "pile", shape: Mesh(file: "pile.stl"), east_m: 0, north_m: 0),
    ·                                  ────────┬───────
    ·                                          ╰── here
 16 │     ],
    ╰────
  help: paths are relative to the scenario file

"#);
}

#[test]
fn several_mistakes_are_all_shown() {
    let text = pond("height_m: 0.2", "height_m: -0.2").replace("\"pile\"", "\"Pile\"");
    refused(text, r#"  × sources[0].height_m: source "s1" is 0.2 m under the bottom; must be from 0 (on the bed) to 10.00 (the water's depth there)
    ╭─[pond.ron:12:44]
 11 │     sources: [
 12 │         (id: "s1", east_m: 0, north_m: 40, height_m: -0.2, rate_g_s: 0.025),
    ·                                            ───────┬──────
    ·                                                   ╰── here
 13 │     ],
    ╰────

  × obstacles[0].id: must be made of a-z, 0-9 and _, and not empty, got "Pile"
    ╭─[pond.ron:15:10]
 14 │     obstacles: [
 15 │         (id: "Pile", shape: Cylinder(radius_m: 2, height_m: 8), east_m: 0, north_m: 0),
    ·          ─────┬────
    ·               ╰── here
 16 │     ],
    ╰────

"#);
}

#[test]
fn a_search_without_a_source_is_a_warning() {
    let start = POND.find("        (id: \"s1\"").unwrap();
    let end = POND.find("    ],\n    obstacles").unwrap();
    let text = POND
        .replace(&POND[start..end], "")
        .replace("time:", "success: Declared(within_m: 5),\n    time:");
    let output = in_folder(text.as_bytes(), &["check", "pond.ron"]);
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(
        stderr(&output),
        r#"  ⚠ success: a declaration near a source is asked for, but the scenario has no source
    ╭─[pond.ron:25:5]
 24 │     ],
 25 │     success: Declared(within_m: 5),
    ·     ───────────────┬──────────────
    ·                    ╰── here
 26 │     time: (limit_s: 2),
    ╰────

  ⚠ success: a declaration is asked for, but no robot searches
    ╭─[pond.ron:25:5]
 24 │     ],
 25 │     success: Declared(within_m: 5),
    ·     ───────────────┬──────────────
    ·                    ╰── here
 26 │     time: (limit_s: 2),
    ╰────

"#
    );
}

#[test]
fn unwritable_out_folder() {
    // Permissions do not bind root; a folder below a regular file cannot be made by anyone.
    let args = [
        "run",
        "pond.ron",
        "--no-zenoh",
        "--quiet",
        "--out",
        "pond.ron/out",
    ];
    let output = in_folder(POND.as_bytes(), &args);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(stderr(&output), r#"  × cannot create the folder pond.ron/out: Not a directory (os error 20)

"#);
}

#[test]
fn busy_port() {
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port();
    let endpoint = format!("tcp/127.0.0.1:{port}");
    let args = ["run", "pond.ron", "--quiet", "--zenoh-listen", &endpoint];
    let output = in_folder(POND.as_bytes(), &args);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(
        stderr(&output).replace(&port.to_string(), "PORT"),
        r#"  × zenoh cannot listen on tcp/127.0.0.1:PORT: port PORT is already in use; choose another with --zenoh-listen, or run with --no-zenoh

"#
    );
}

#[test]
fn init_does_not_overwrite() {
    let output = in_folder(POND.as_bytes(), &["init", "duck_st", "pond.ron"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(stderr(&output), r#"  × pond.ron: is there already and is not overwritten
  help: name another PATH

"#);
}

#[test]
fn wrong_usage_has_an_exit_code_of_its_own() {
    let output = common::rheotaxis(&["run", "duck_st", "--speed", "fast"]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(
        stderr(&output),
        r#"error: invalid value 'fast' for '--speed <max|realtime|X>': must be `max`, `realtime` or a number > 0

For more information, try '--help'.
"#
    );
}
