//! `docs/vehicles.md` as printed: its commands run, and what they write can search.

use crate::common::{read, rheotaxis_in, says, scenario, write};
use rheotaxis::scenario::FolderFiles;
use robots::vehicles::{SHIPPED, Vehicle, VehicleSpec};
use std::path::Path;
use studies::trials::{Trial, trials};

#[test]
fn bring_your_own_works_as_printed() {
    let page = read("docs/vehicles.md");
    let dir = tempfile::tempdir().expect("a folder");
    let mut ran = 0;
    for line in page.lines().filter(|l| l.starts_with("rheotaxis ")) {
        let args: Vec<&str> = line.split_whitespace().skip(1).collect();
        rheotaxis_in(dir.path(), &args).with(0);
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
    write(dir.path(), "mine.ron", &scenario("lauv_bay", &[("robots[0].vehicle", "File(\"my_auv/\")")]));
    rheotaxis_in(dir.path(), &["check", "mine.ron"]).with(0);
}

/// A folder that is wrong: the error names the file, and the place in it.
#[test]
fn a_broken_folder_gets_a_plain_error() {
    let dir = tempfile::tempdir().expect("a folder");
    let run = |code: i32, args: &str| {
        let args: Vec<&str> = args.split(' ').collect();
        rheotaxis_in(dir.path(), &args).with(code).err
    };
    says(&run(1, "vehicle check nowhere"), &["nowhere", "no such folder", "lauv"]);
    run(0, "vehicle init lauv mine");
    says(&run(1, "vehicle init lauv mine"), &["exists already"]);
    let file = dir.path().join("mine/vehicle.ron");
    let text = std::fs::read_to_string(&file).expect("it was written");
    std::fs::write(&file, text.replace("lag_s: 0.05", "lag_s: -0.05")).expect("a file");
    says(&run(1, "vehicle trials mine"), &["mine/vehicle.ron", "drives[0].lag_s", "must be >= 0"]);
}

/// A table of set-points gives a table of states; a wrong one is told with its line.
#[test]
fn a_table_flies_it() {
    let dir = tempfile::tempdir().expect("a folder");
    const FLY: &str = "vehicle fly lauv --table tank.csv --velocity 1.5,0,0 --water 0.2,0,0 --lasts-s 20 --every-s 1";
    let run = |code: i32, table: &str| {
        std::fs::write(dir.path().join("tank.csv"), table).expect("a file");
        rheotaxis_in(dir.path(), &FLY.split(' ').collect::<Vec<_>>()).with(code).err
    };
    let header = "t_s,propeller,fin_top,fin_bottom,fin_port,fin_starboard";
    run(0, &format!("{header}\n0,8,0,0,0,0\n10,0,0,0,0,0\n"));
    let text = std::fs::read_to_string(dir.path().join("flown.csv")).expect("the states");
    let rows: Vec<Vec<f64>> =
        (text.lines().skip(1)).map(|l| l.split(',').map(|n| n.parse().expect("a number")).collect()).collect();
    assert_eq!(rows.len(), 21);
    // Nose to the north, carried to the east with the water; it coasts when the propeller stops.
    let [start, middle, end] = [&rows[0], &rows[10], &rows[20]];
    assert!((start[1], start[2], start[3]) == (0.0, 0.0, -10.0), "{start:?}");
    assert!(middle[2] > 12.0 && (middle[1] - 2.0).abs() < 0.3, "{middle:?}");
    assert!(end[8] < middle[8] - 0.2, "{end:?}");
    says(&run(1, &format!("{header}\n0,8,0,0,0,fast\n")), &["tank.csv", "line 2, fin_starboard"]);
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
    let page = read("docs/vehicles.md");
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
