//! Forces that no step can follow are told, refused, or end in an error, never in numbers that are none.

use crate::common;
use rheotaxis::scenario::FolderFiles;
use robots::vehicles::{ShippedVehicle, Vehicle, VehicleSpec};
use std::path::Path;

/// A LAUV's folder `lauv` with its `vehicle.ron` changed, and a scenario with it.
fn folder(changes: &[(&str, &str)]) -> tempfile::TempDir {
    let lauv = ShippedVehicle::named("lauv").expect("it is shipped");
    let dir = tempfile::tempdir().expect("a folder");
    let mut text = lauv.file.to_string();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    let at = |name: &str| dir.path().join(name);
    std::fs::create_dir(at("lauv")).expect("a folder");
    std::fs::write(at("lauv/vehicle.ron"), text).expect("a file");
    std::fs::write(at("lauv").join(lauv.urdf.0), lauv.urdf.1).expect("a file");
    std::fs::write(at("sea.ron"), SEA).expect("a file");
    let table = "t_s,propeller,fin_top,fin_bottom,fin_port,fin_starboard\n0,50,0,0,0,0\n";
    std::fs::write(at("table.csv"), table).expect("a file");
    dir
}

const SEA: &str = "(
    version: 2,
    title: \"A torpedo ahead\",
    citation: \"own\",
    area: (length_m: 400, width_m: 120, axis_heading_deg: 90),
    terrain: Level(depth_m: 30),
    water: (currents: [Uniform(speed_m_s: 0.2, heading_deg: 90)]),
    sources: [(id: \"s1\", east_m: -150, north_m: 0, height_m: 1, rate_g_s: 0.02, release: (rate_hz: 5))],
    robots: [
        (
            id: \"auv0\",
            vehicle: File(\"lauv\"),
            start: (east_m: 150, north_m: -30, altitude_m: 2, heading_deg: 0, speed_m_s: 1.5),
            sensors: (fluorometer: (), dvl: (), adcp: (), compass: (), depth: (), altimeter: (), lbl: (noise_m: 1)),
            estimator: DeadReckoning(),
            strategy: Amp(speed_m_s: 1.5, vertical: Altitude(2)),
        ),
    ],
    time: (spin_up_s: 1, limit_s: 1),
    success: Declared(within_m: 20),
)";

/// Exit code and messages of a command.
fn ran(dir: &Path, args: &[&str]) -> (Option<i32>, String) {
    let ended = common::rheotaxis_in(dir, args);
    let said = String::from_utf8_lossy(&ended.stderr).into_owned();
    assert!(!said.contains("panicked"), "{said}");
    (ended.status.code(), said)
}

const FLY: &[&str] = &[
    "vehicle",
    "fly",
    "lauv",
    "--table",
    "table.csv",
    "--lasts-s",
    "1",
    "--velocity",
    "1.5,0,0",
    "--out",
    "flown.csv",
];

/// Drag ahead and across, a hundred times and a million times too large.
const DRAG: &str = "(2.4, 0, 0, 0, 0, 0),
            (0, 80, 0, 0, 0, -0.3)";

fn drag(times: f64) -> String {
    let [ahead, across] = [2.4 * times, 80.0 * times];
    DRAG.replace("(2.4,", &format!("({ahead},")).replace("80,", &format!("{across},"))
}

#[test]
fn damping_beyond_that_of_hulls_is_doubted() {
    let told = |times: f64| {
        let dir = folder(&[(DRAG, &drag(times))]);
        let craft = Vehicle::load(&VehicleSpec::File("lauv".into()), &FolderFiles(dir.path()));
        craft.expect("legal").doubts().join("; ")
    };
    assert_eq!(told(10.0), "");
    let doubt = told(1000.0);
    assert!(doubt.starts_with("hydrodynamics: at 1 m/s its motion decays") && doubt.contains("units"), "{doubt}");
}

/// It is steady at rest, and not at the speed at which it starts.
#[test]
fn damping_that_no_step_follows_is_refused() {
    let dir = folder(&[(DRAG, &drag(1e6))]);
    for (args, place) in [
        (&["check", "sea.ron"][..], "robots[0].vehicle"),
        (&["run", "sea.ron", "--out", "out"][..], "robots[0].vehicle"),
        (FLY, "--step-s"),
    ] {
        let (code, said) = ran(dir.path(), args);
        assert_eq!(code, Some(1), "{args:?}: {said}");
        let words = said.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(words.contains("are too long for this hull"), "{said}");
        assert!(words.contains(place), "{said}");
    }
    assert!(!dir.path().join("flown.csv").exists());
}

/// A reaction torque that overflows after some parts of a step.
#[test]
fn a_state_that_is_no_number_is_an_error() {
    let dir = folder(&[("lag_s: 0.05", "torque_m: 1e18, lag_s: 0.05")]);
    let (code, said) = ran(dir.path(), FLY);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("is not a number"), "{said}");
    assert!(!dir.path().join("flown.csv").exists());
    let (code, said) = ran(dir.path(), &["run", "sea.ron", "--quiet", "--out", "out"]);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("no longer finite"), "{said}");
}
