//! Faults of robots: what they do to a mission, from when on, and what is said of them.

use crate::common::{lasting, mission, read, says, scenario};
use rheotaxis::frame::RobotFrame;
use rheotaxis::outcome::RunOutcome;
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{Event, Observer, RunEnd, Trial};
use robots::handoff::Actuation;

const FAULTS: &str = "robots[0].faults";

/// The channel with these faults, for so long.
#[track_caller]
fn channel(faults: &str, limit_s: f64) -> Loaded {
    let faulty = scenario("uniform_channel", &[(FAULTS, &format!("[{faults}]"))]);
    let loaded = lasting(faulty, 60.0, limit_s);
    assert!(loaded.check().is_ok(), "{:?}", loaded.check());
    loaded
}

/// All states of the one robot.
#[derive(Default)]
struct States(Vec<(f64, RobotFrame)>);

impl Observer for States {
    fn see(&mut self, event: &Event) {
        if let Event::Frame(frame) = event {
            self.0.push((frame.t_s, frame.robots[0].clone()));
        }
    }
}

fn flown(loaded: &Loaded) -> (RunEnd, Vec<(f64, RobotFrame)>) {
    let mut states = States::default();
    let ended = Trial::assemble(loaded, 3).unwrap().run(&mut states);
    (ended, states.0)
}

/// Whether something is so of every state after a time.
fn after(states: &[(f64, RobotFrame)], t_s: f64, so: impl Fn(&RobotFrame) -> bool) -> bool {
    states.iter().filter(|(t, _)| *t >= t_s).all(|(_, r)| so(r))
}

#[test]
fn a_fault_changes_nothing_before_its_time() {
    let (well, healthy) = flown(&lasting(scenario("uniform_channel", &[]), 60.0, 30.0));
    assert_eq!(flown(&channel("", 30.0)).0, well, "an empty list");
    assert_eq!(flown(&channel("(at_s: 31, what: Compass(Stuck))", 30.0)).0, well, "after the end");
    for what in [
        "Fluorometer(Biased(1))",
        "Compass(Stuck)",
        "Depth(Drifting(0.1))",
        "Dvl(Silent)",
        "Fixes(Silent)",
        "Rudder(StuckAt(5))",
        "Propeller(Dead)",
        "Drive(link: \"stern_plane\", how: Weak(0.2))",
    ] {
        let (ended, faulty) = flown(&channel(&format!("(at_s: 20, what: {what})"), 30.0));
        // A frame at 20 s is taken at the end of a step that began before.
        for ((t_s, well), (_, ill)) in healthy.iter().zip(&faulty).filter(|((t_s, _), _)| *t_s <= 20.0) {
            assert_eq!(well, ill, "{what} at {t_s}");
        }
        // Within these ten seconds no fix was due.
        let same = what == "Fixes(Silent)";
        assert_eq!(ended.digest == well.digest, same, "{what}");
    }
}

#[test]
fn a_vehicle_with_a_stuck_rudder_goes_round_in_circles() {
    for how in ["Rudder(StuckAt(10))", "Drive(link: \"rudder\", how: StuckAt(10))"] {
        let (_, states) = flown(&channel(&format!("(at_s: 10, what: {how})"), 160.0));
        let angle = 10_f64.to_radians();
        let is_stuck = |r: &RobotFrame| match r.actuators {
            Actuation::Fins(set) => set.rudder_rad == angle,
            _ => false,
        };
        assert!(after(&states, 10.1, is_stuck));
        // It turns to starboard all the time, more than twice round.
        let headings = states.iter().map(|(_, r)| r.truth.pose.heading());
        let turned = headings.clone().zip(headings.skip(1));
        let turned: f64 = turned.skip(150).map(|(a, b)| a.turn_to(b)).sum();
        assert!(turned > 2.0 * std::f64::consts::TAU, "{turned} rad");
        // The circles drift with the water, 0.2 m/s, and are narrower than 60 m.
        let at = |n: usize| states[n].1.truth.pose.p_WB.xy();
        let far = (150..states.len()).map(|n| (at(n) - at(150)).norm()).fold(0.0, f64::max);
        assert!(far < 60.0 + 0.2 * 150.0, "{far} m");
    }
}

#[test]
fn a_vehicle_with_a_dead_propeller_drifts_with_the_water() {
    let current = "(currents: [Uniform(speed_m_s: 0.3, heading_deg: 90)])";
    let values = [("water", current), (FAULTS, "[(at_s: 20, what: Propeller(Dead))]")];
    let (_, states) = flown(&scenario("remus_turning_circle", &values));
    assert!(states.iter().any(|(_, r)| r.truth.v_world().norm() > 1.5));
    let drifts = |r: &RobotFrame| {
        let v = r.truth.v_world();
        (v.x - 0.3).abs() < 0.03 && v.y.abs() < 0.03
    };
    assert!(after(&states, 200.0, drifts));
}

#[test]
fn a_search_without_smell_ends_at_its_limit_and_declares_nothing() {
    let (ended, states) = flown(&channel("(at_s: 0, what: Fluorometer(Silent))", 400.0));
    assert_eq!(ended.outcome, RunOutcome::TimeOut);
    assert!(ended.declarations.values().all(Vec::is_empty));
    assert!(after(&states, 0.0, |r| r.chemical.is_none() && !r.detected));
}

#[test]
fn fixes_that_lie_move_the_estimate() {
    let off = |lie: &str| {
        let faults = format!("(at_s: 100, what: Fixes(Lie(east_m: 30, north_m: -20{lie})))");
        let (_, states) = flown(&channel(&faults, 300.0));
        [95.0, 290.0].map(|t_s| {
            let (_, r) = states.iter().find(|(t, _)| *t >= t_s).unwrap();
            r.estimate.position - r.truth.pose.p_WB.xy()
        })
    };
    // Fixes are good to 1 m; between them the estimate drifts by some metres.
    let [before, jumped] = off("");
    assert!(before.norm() < 8.0, "{before}");
    assert!((jumped - nalgebra::Vector2::new(30.0, -20.0)).norm() < 8.0, "{jumped}");
    let [same, grown] = off(", over_s: 2000");
    assert_eq!(same, before);
    assert!(grown.norm() < 12.0, "{grown}");
}

/// Whatever is wrong with whatever, and by how much, a mission goes on.
#[test]
fn a_mission_survives_every_fault() {
    for faults in [
        "Compass(Silent)",
        "Compass(Drifting(-10))",
        "Depth(Silent)",
        "Depth(Biased(-100000))",
        "Depth(Biased(100000))",
        "Altimeter(Biased(-100000))",
        "Altimeter(Stuck)",
        "Dvl(Biased(15))",
        "Adcp(Drifting(-1))",
        "Adcp(Silent)",
        "Fixes(Lie(east_m: 100000, north_m: -100000))",
        "Fluorometer(Biased(1000000))",
        "Fluorometer(Stuck)",
        "SternPlane(StuckAt(90))",
        "Propeller(StuckAt(-10000))",
    ] {
        for at_s in ["0", "40"] {
            let fault = format!("(at_s: {at_s}, what: {faults})");
            let (ended, _) = flown(&channel(&fault, 120.0));
            assert!(ended.t_s > 0.0, "{faults}");
        }
    }
}

const TWO: &str = "(at_s: 3, until_s: 5, what: Compass(Biased(5))), (at_s: 4, what: Propeller(Dead))";

/// On the terminal, in the summary and on the page.
#[test]
fn faults_are_told() {
    let dir = tempfile::tempdir().unwrap();
    let (ended, summary) = mission(dir.path(), "odd", &channel(TWO, 8.0).text());
    let events = summary["abnormal"].as_array().unwrap();
    let told = [("compass off by 5 degrees", 3.0, 2.0, true), ("propeller dead", 4.0, 3.98, false)];
    assert_eq!(events.len(), told.len(), "{events:?}");
    for (event, (words, t_s, lasted_s, over)) in events.iter().zip(told) {
        for (field, value) in [("robot", "auv0"), ("what", "fault"), ("fault", words)] {
            assert_eq!(event[field], value);
        }
        assert_eq!(event["over"], over);
        assert!((event["t_s"].as_f64().unwrap() - t_s).abs() < 1e-9);
        assert!((event["lasted_s"].as_f64().unwrap() - lasted_s).abs() < 1e-9);
    }
    let [compass, propeller] =
        ["! auv0: fault: compass off by 5 degrees at 3.0 s", "! auv0: fault: propeller dead at 4"];
    says(&(ended.err + &ended.out), &[compass, ", for 2.0 s", propeller]);
    let page = std::fs::read_to_string(dir.path().join("odd/report.html")).unwrap();
    assert!(page.contains("fault: propeller dead"));
}

/// What is published says which faults hold now.
#[test]
fn faults_are_published_while_they_hold() {
    let mut trial = Trial::assemble(&channel(TWO, 10.0), 3).unwrap();
    let said = [2.5, 3.5, 4.5, 5.5].map(|t_s| {
        trial.until(t_s);
        let all = rheotaxis::registry::messages(trial.frame().unwrap());
        let (_, doing) = all.iter().find(|(k, _)| k == "auv/auv0/behaviour").unwrap();
        doing["abnormal"].as_array().cloned().unwrap_or_default()
    });
    let (compass, propeller) = ("fault: compass off by 5 degrees", "fault: propeller dead");
    assert_eq!(said, [vec![], vec![compass], vec![compass, propeller], vec![propeller]]);
}

/// The example of the documents is a scenario.
#[test]
fn the_example_in_docs_is_legal() {
    let page = read("docs/faults.md");
    let example = page.split("```ron\n").nth(1).unwrap().split("```").next().unwrap();
    let faults = example.trim().strip_prefix("faults: [").unwrap();
    let loaded = channel(faults.strip_suffix("],").unwrap(), 2000.0);
    assert_eq!(loaded.check().unwrap().len(), 0);
    assert!(loaded.scenario.robots[0].faults.len() > 5);
}
