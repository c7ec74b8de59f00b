//! What a kinematic vehicle is refused for, and what is warned of.

use super::{VEHICLE, with};
use crate::common::{says, scenario, set};
use rheotaxis::scenario::Loaded;

#[test]
fn numbers_without_meaning_are_refused_with_their_range() {
    let channel = scenario("uniform_channel", &[]);
    let radius = "turn.radius_m: must be from 0.01 to 10000 m";
    let rate = "turn.deg_s: must be from 0.01 to 720 degrees/s";
    let speed = "max_speed_m_s: must be > 0 and <= 15 m/s";
    let lag = "lag_s: must be from 0 to 1000 s";
    for (vehicle, said, got) in [
        ("turn: Radius(radius_m: 0)", radius, "got 0"),
        ("turn: Radius(radius_m: -3)", radius, "got -3"),
        ("turn: Radius(radius_m: NaN)", radius, "got NaN"),
        ("turn: Radius(radius_m: 0.001)", radius, "got 0.001"),
        ("turn: Rate(deg_s: 1e6)", rate, "got 1e6"),
        ("turn: Rate(deg_s: 0)", rate, "got 0"),
        ("max_speed_m_s: -2", speed, "got -2"),
        ("max_speed_m_s: NaN", speed, "got NaN"),
        ("max_speed_m_s: 99", speed, "got 99"),
        ("climb_m_s: 0", "climb_m_s: must be > 0 and <= 15 m/s", "got 0"),
        ("lag_s: -1", lag, "got -1"),
        ("lag_s: inf", lag, "got inf"),
        ("turn: Radius(radius: 5)", "", "`radius`"),
        ("moves: InAir", "", "InAir"),
    ] {
        let error = channel.set(VEHICLE, &format!("Kinematic({vehicle})")).expect_err("this is wrong");
        let lines = error.lines();
        assert_eq!(lines.len(), 1, "{lines:?}");
        says(&lines[0], &[format!("robots[0].vehicle.{said}").trim_end_matches('.'), got]);
    }
}

/// What `check` says.
fn told(loaded: &Loaded) -> Vec<String> {
    loaded.check().map_or_else(|e| e.lines(), |warnings| warnings.iter().map(ToString::to_string).collect())
}

#[test]
fn what_it_cannot_do_is_warned_of() {
    let with = |vehicle: &str| with("uniform_channel", vehicle);
    for fine in ["Kinematic()", "Kinematic(moves: OverGround)"] {
        assert_eq!(told(&with(fine)), [""; 0]);
    }
    // The channel's water moves at 0.2 m/s; over ground that is merely slow.
    for (slow, carried) in
        [("Kinematic(max_speed_m_s: 0.1)", true), ("Kinematic(max_speed_m_s: 0.1, moves: OverGround)", false)]
    {
        let loaded = set(with(slow), &[("robots[0].guidance.water_speed_limit_m_s", "0.1")]);
        let said = told(&loaded).join("\n");
        assert_eq!(said.contains("carries it away"), carried, "{said}");
        says(&said, &[if carried { "0.10 m/s through the water" } else { "0.10 m/s over ground" }]);
    }
    let nimble = told(&with("Kinematic(turn: Rate(deg_s: 60))"));
    assert_eq!(nimble.len(), 1, "{nimble:?}");
    says(&nimble[0], &["robots[0].guidance.heading_rate_deg_s", "10 degrees/s", "60.0 degrees/s"]);
}

/// Between two steps nobody sees and decides, so steps end at 1 s.
#[test]
fn steps_may_be_long_without_dynamics() {
    let slow =
        ["fluorometer", "dvl", "adcp", "compass", "depth", "altimeter"].map(|of| format!("{of}: (rate_hz: 0.5)"));
    let slow = format!("({}, lbl: (noise_m: 1))", slow.join(", "));
    let said = |vehicle: &str, step_s: &str| {
        let values = [
            (VEHICLE, vehicle),
            ("robots[0].sensors", slow.as_str()),
            ("record.frame_period_s", "2"),
            ("time.step_s", step_s),
        ];
        told(&scenario("uniform_channel", &values)).join("\n")
    };
    assert_eq!(said("Kinematic()", "1"), "");
    for (vehicle, step_s, longest) in [("Remus100()", "1", "0.1"), ("Kinematic()", "1.5", "1")] {
        says(&said(vehicle, step_s), &[&format!("time.step_s: must be from 0.001 to {longest} s, got {step_s}")]);
    }
}
