//! What a kinematic vehicle is refused for, and what is warned of.

use super::with;
use rheotaxis::registry::Registry;
use rheotaxis::scenario::{check, load_text, template};

/// The one error of a scenario with this vehicle, after its place.
fn error(vehicle: &str) -> String {
    let text = template("uniform_channel").expect("in the catalogue").text;
    let text = text.replace("Remus100()", vehicle);
    let error = load_text(&Registry::default(), "bad", &text).expect_err("this is wrong");
    let mut lines = error.lines();
    let line = lines.pop().expect("a line");
    assert!(lines.is_empty(), "{lines:?}");
    let row = text.lines().position(|l| l.contains("vehicle:")).expect("it has one") + 1;
    let (place, said) = line.split_once(": ").expect("a place");
    assert!(place.contains(&format!(":{row}:")), "{place} is not in line {row}");
    said.to_string()
}

#[test]
fn numbers_without_meaning_are_refused_with_their_range() {
    for (vehicle, said) in [
        ("Kinematic(turn: Radius(radius_m: 0))", "turn.radius_m: must be from 0.01 to 10000 m, got 0"),
        ("Kinematic(turn: Radius(radius_m: -3))", "turn.radius_m: must be from 0.01 to 10000 m, got -3"),
        ("Kinematic(turn: Radius(radius_m: NaN))", "turn.radius_m: must be from 0.01 to 10000 m, got NaN"),
        ("Kinematic(turn: Radius(radius_m: 0.001))", "turn.radius_m: must be from 0.01 to 10000 m, got 0.001"),
        ("Kinematic(turn: Rate(deg_s: 1e6))", "turn.deg_s: must be from 0.01 to 720 degrees/s, got 1e6"),
        ("Kinematic(turn: Rate(deg_s: 0))", "turn.deg_s: must be from 0.01 to 720 degrees/s, got 0"),
        ("Kinematic(max_speed_m_s: -2)", "max_speed_m_s: must be > 0 and <= 15 m/s, got -2"),
        ("Kinematic(max_speed_m_s: NaN)", "max_speed_m_s: must be > 0 and <= 15 m/s, got NaN"),
        ("Kinematic(max_speed_m_s: 99)", "max_speed_m_s: must be > 0 and <= 15 m/s, got 99"),
        ("Kinematic(climb_m_s: 0)", "climb_m_s: must be > 0 and <= 15 m/s, got 0"),
        ("Kinematic(lag_s: -1)", "lag_s: must be from 0 to 1000 s, got -1"),
        ("Kinematic(lag_s: inf)", "lag_s: must be from 0 to 1000 s, got inf"),
    ] {
        assert_eq!(error(vehicle), format!("robots[0].vehicle.{said}"), "{vehicle}");
    }
    let misspelt = error("Kinematic(turn: Radius(radius: 5))");
    assert!(misspelt.contains("there is no field `radius`"), "{misspelt}");
    let unknown = error("Kinematic(moves: InAir)");
    assert!(unknown.contains("InAir"), "{unknown}");
}

/// What `check` says of a channel with this vehicle.
fn told(vehicle: &str, changes: &[(&str, &str)]) -> Vec<String> {
    let loaded = with("uniform_channel", vehicle, changes);
    let found = check(&loaded.scenario, &loaded.base_dir);
    found.iter().map(|f| format!("{}: {}", f.path, f.message)).collect()
}

#[test]
fn what_it_cannot_do_is_warned_of() {
    assert_eq!(told("Kinematic()", &[]), [""; 0]);
    assert_eq!(told("Kinematic(moves: OverGround)", &[]), [""; 0]);
    // The channel's water moves at 0.2 m/s.
    let limit = ("estimator: DeadReckoning()", "estimator: DeadReckoning(), guidance: (water_speed_limit_m_s: 0.1)");
    let slow = told("Kinematic(max_speed_m_s: 0.1)", &[limit]);
    assert!(
        slow[0]
            .starts_with("robots[0].vehicle: the water carries it away: it reaches at most 0.10 m/s through the water"),
        "{slow:?}"
    );
    // Over ground that is merely slow.
    let slow = told("Kinematic(max_speed_m_s: 0.1, moves: OverGround)", &[limit]);
    assert!(slow.iter().all(|s| !s.contains("carries it away")), "{slow:?}");
    assert!(slow.iter().any(|s| s.contains("it reaches at most 0.10 m/s over ground")), "{slow:?}");
    let nimble = told("Kinematic(turn: Rate(deg_s: 60))", &[]);
    assert_eq!(
        nimble,
        ["robots[0].guidance.heading_rate_deg_s: the guidance asks for at most 10 degrees/s, so the vehicle never \
             turns at the 60.0 degrees/s that it can"]
    );
}

/// Between two steps nobody sees and decides, so steps end at 1 s.
#[test]
fn steps_may_be_long_without_dynamics() {
    let each = "fluorometer: (), dvl: (), adcp: (), compass: (), depth: (), altimeter: (), lbl";
    let slow = each.replace(": ()", ": (rate_hz: 0.5)");
    let said = |vehicle: &str, step_s: &str| -> Vec<String> {
        let text = template("uniform_channel").expect("in the catalogue").text;
        let times = format!("record: (frame_period_s: 2),\n    time: (step_s: {step_s}, ");
        let text = text.replace("Remus100()", vehicle).replace("time: (", &times);
        assert!(text.contains(each));
        let text = text.replace(each, &slow);
        let loaded = load_text(&Registry::default(), "long", &text).expect("it can be read");
        let found = check(&loaded.scenario, &loaded.base_dir);
        let lines = found.iter().map(|f| format!("{}: {}", f.path, f.message));
        lines.collect()
    };
    assert_eq!(said("Kinematic()", "1"), Vec::<String>::new());
    for (vehicle, step_s, longest) in [("Remus100()", "1", "0.1"), ("Kinematic()", "1.5", "1")] {
        let range = format!("time.step_s: must be from 0.001 to {longest} s, got {step_s}");
        assert_eq!(said(vehicle, step_s), [range]);
    }
}
