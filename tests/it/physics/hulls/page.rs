//! `docs/vehicles.md` as printed: its commands run, and what they write can search.

use crate::common;
use rheotaxis::scenario::{FolderFiles, template};
use robots::vehicles::{SHIPPED, Vehicle, VehicleSpec};
use std::path::Path;
use studies::trials::{Trial, trials};

#[test]
fn bring_your_own_works_as_printed() {
    let page = std::fs::read_to_string(common::root().join("docs/vehicles.md")).expect("the page");
    let dir = tempfile::tempdir().expect("a folder");
    let mut ran = 0;
    for line in page.lines().filter(|l| l.starts_with("rheotaxis ")) {
        let args: Vec<&str> = line.split_whitespace().skip(1).collect();
        let ended = common::rheotaxis_in(dir.path(), &args);
        let said = String::from_utf8_lossy(&ended.stderr).into_owned();
        assert!(ended.status.success(), "{line}: {said}");
        ran += 1;
    }
    assert_eq!(ran, 3, "commands in the page");
    for file in [
        "my_auv/vehicle.ron",
        "my_auv/lauv.urdf",
        "my_auv.png",
        "my_auv_trials/trials.csv",
        "my_auv_trials/steering.csv",
        "my_auv_trials/trials.svg",
        "my_auv_trials/trials.png",
    ] {
        let bytes = std::fs::read(dir.path().join(file)).unwrap_or_default();
        assert!(bytes.len() > 200, "{file}");
    }
    let text = template("lauv_bay").expect("in the catalogue").text;
    let own = text.replace("Shipped(\"lauv\")", "File(\"my_auv/\")");
    assert_ne!(own, text);
    std::fs::write(dir.path().join("mine.ron"), own).expect("a file");
    let checked = common::rheotaxis_in(dir.path(), &["check", "mine.ron"]);
    assert!(checked.status.success());
}

/// A folder that is wrong: the error names the file, and the place in it.
#[test]
fn a_broken_folder_gets_a_plain_error() {
    let dir = tempfile::tempdir().expect("a folder");
    let run = |args: &[&str]| {
        let ended = common::rheotaxis_in(dir.path(), args);
        (ended.status.code(), String::from_utf8_lossy(&ended.stderr).into_owned())
    };
    let (code, said) = run(&["vehicle", "check", "nowhere"]);
    assert_eq!(code, Some(1));
    assert!(said.contains("there is no such folder") && said.contains("lauv"), "{said}");
    assert_eq!(run(&["vehicle", "init", "lauv", "mine"]).0, Some(0));
    let (code, said) = run(&["vehicle", "init", "lauv", "mine"]);
    assert!(code == Some(1) && said.contains("exists already"), "{said}");
    let file = dir.path().join("mine/vehicle.ron");
    let text = std::fs::read_to_string(&file).expect("it was written");
    std::fs::write(&file, text.replace("lag_s: 0.05", "lag_s: -0.05")).expect("a file");
    let (code, said) = run(&["vehicle", "trials", "mine"]);
    assert_eq!(code, Some(1));
    assert!(said.contains("mine/vehicle.ron") && said.contains("drives[0].lag_s"), "{said}");
    assert!(said.contains("must be >= 0"), "{said}");
}

/// A table of set-points gives a table of states; a wrong one is told with its line.
#[test]
fn a_table_flies_it() {
    let dir = tempfile::tempdir().expect("a folder");
    let run = |table: &str| {
        std::fs::write(dir.path().join("tank.csv"), table).expect("a file");
        let args = [
            "vehicle",
            "fly",
            "lauv",
            "--table",
            "tank.csv",
            "--velocity",
            "1.5,0,0",
            "--water",
            "0.2,0,0",
            "--lasts-s",
            "20",
            "--every-s",
            "1",
        ];
        let ended = common::rheotaxis_in(dir.path(), &args);
        (ended.status.code(), String::from_utf8_lossy(&ended.stderr).into_owned())
    };
    let header = "t_s,propeller,fin_top,fin_bottom,fin_port,fin_starboard";
    let (code, said) = run(&format!("{header}\n0,8,0,0,0,0\n10,0,0,0,0,0\n"));
    assert_eq!(code, Some(0), "{said}");
    let text = std::fs::read_to_string(dir.path().join("flown.csv")).expect("the states");
    let rows: Vec<Vec<f64>> =
        (text.lines().skip(1)).map(|l| l.split(',').map(|n| n.parse().expect("a number")).collect()).collect();
    assert_eq!(rows.len(), 21);
    // Nose to the north, carried to the east with the water; it coasts when the propeller stops.
    let [start, middle, end] = [&rows[0], &rows[10], &rows[20]];
    assert!((start[1], start[2], start[3]) == (0.0, 0.0, -10.0), "{start:?}");
    assert!(middle[2] > 12.0 && (middle[1] - 2.0).abs() < 0.3, "{middle:?}");
    assert!(end[8] < middle[8] - 0.2, "{end:?}");
    let (code, said) = run(&format!("{header}\n0,8,0,0,0,fast\n"));
    assert_eq!(code, Some(1));
    assert!(said.contains("tank.csv: line 2, fin_starboard: not a number"), "{said}");
    let (code, said) = run("t_s,propeller\n0,8\n");
    assert!(code == Some(1) && said.contains("no column \"fin_top\""), "{said}");
}

/// Columns of the page's tables, and what the trials call it.
const COLUMNS: &[(&str, &str, &str)] = &[
    ("speed at full ahead, m/s", "speed", "steady speed at full ahead"),
    ("turn, °/s", "turn by the autopilot", "turn rate"),
    ("radius of the turn, m", "turn by the autopilot", "radius"),
    ("5 m down (90 %), s", "dive", "time to 90 % of 5 m"),
    ("error of depth, m", "dive", "error after 150 s"),
    ("way to a tenth of the speed, m", "stop", "way until then"),
    ("off its place in 0.25 m/s, m", "station keeping", "distance, root mean square after 30 s"),
    ("advance, m", "turning circle", "advance"),
    ("transfer, m", "turning circle", "transfer"),
    ("tactical diameter, m", "turning circle", "tactical diameter"),
    ("steady diameter, m", "turning circle", "steady diameter"),
    ("10/10: first overshoot, °", "zigzag 10/10", "first overshoot angle"),
    ("second, °", "zigzag 10/10", "second overshoot angle"),
    ("20/20: first overshoot, °", "zigzag 20/20", "first overshoot angle"),
    ("second overshoot, °", "zigzag 20/20", "second overshoot angle"),
    ("time to check yaw, s", "zigzag 20/20", "time to check yaw"),
    ("rudder, °", "zigzag 20/20", "rudder"),
];

/// Every figure of the page's tables of trials is the one that the trials give now.
#[test]
fn the_figures_of_the_shipped_vehicles_are_those_of_their_trials() {
    let page = std::fs::read_to_string(common::root().join("docs/vehicles.md")).expect("the page");
    let cells = |line: &str| -> Vec<String> {
        let bare = line.trim().trim_matches('|');
        bare.split('|').map(|c| c.trim().to_string()).collect()
    };
    let lines: Vec<&str> = page.lines().collect();
    let tables = lines.split(|l| !l.starts_with('|'));
    let tables: Vec<(Vec<String>, Vec<Vec<String>>)> = tables
        .filter(|t| {
            t.first().is_some_and(|head| cells(head)[1..].iter().any(|c| c == "advance, m" || c == "turn, °/s"))
        })
        .map(|t| (cells(t[0]), t[2..].iter().map(|l| cells(l)).collect()))
        .collect();
    assert_eq!(tables.len(), 2);
    let names: Vec<&str> = tables[0].1.iter().map(|row| row[0].as_str()).collect();
    let shipped: Vec<&str> = SHIPPED.iter().map(|s| s.folder).collect();
    assert_eq!(names, shipped);
    let made: Vec<Vec<Trial>> = std::thread::scope(|scope| {
        let one = |name: &str| {
            let spec = VehicleSpec::Shipped(name.to_string());
            trials(&Vehicle::load(&spec, &FolderFiles(Path::new(""))).expect("a vehicle"))
        };
        let all: Vec<_> = (names.iter()).map(|name| scope.spawn(move || one(name))).collect();
        all.into_iter().map(|t| t.join().expect("trials")).collect()
    });
    for (head, rows) in &tables {
        for row in rows {
            let k = names.iter().position(|n| *n == row[0]).expect("in the first table");
            for (column, printed) in head.iter().zip(row).skip(1) {
                let known = COLUMNS.iter().find(|c| c.0 == column);
                let (_, trial, what) = known.unwrap_or_else(|| panic!("column {column}"));
                let trial = made[k].iter().find(|t| t.name == *trial);
                let found = trial.and_then(|t| t.found.iter().find(|f| f.what == *what));
                let decimals = printed.split_once('.').map_or(0, |(_, d)| d.len());
                let now = match found.map(|f| f.value) {
                    None => "–".to_string(),
                    Some(None) => "not reached".to_string(),
                    Some(Some(value)) => format!("{:.decimals$}", value.abs()),
                };
                assert_eq!(printed, &now, "{}: {column}", row[0]);
            }
        }
    }
}
