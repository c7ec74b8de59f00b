//! Numbers of strategies, sensors and currents of other crates that nobody can use.

use super::{Trial, Unwatched};
use crate::lanes::caught;
use crate::scenario::{Loaded, Severity, check};
use crate::testing::with;
use nalgebra::Vector2;
use plumes::error::PlumeError;
use plumes::flow::{CurrentParams, CurrentSlot, Currents, FreeWater, PlaneCurrent};
use robots::error::RobotError;
use robots::handoff::{
    Behaviour, Decision, Declaration, DepthReading, Goal, Manoeuvre, Observation, Readings, Vertical,
};
use robots::sense::{Fitting, Sensor, SensorParams, Sensors, Surroundings};
use robots::strategy::{Setting, Strategies, Strategy, StrategyParams};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::catalogue::Entry;
use world::registry::{Listed, Registry};
use world::seeds::Stream;
use world::units::Heading;

/// Which number is bad, and how.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
enum Bad {
    #[default]
    Fine,
    SpeedNan,
    SpeedNegative,
    SpeedHuge,
    CourseNan,
    DeclaredNan,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Wild {
    bad: Bad,
}

impl Listed for Wild {
    const ENTRY: Entry = Entry { name: "Wild", what: "decides nonsense", source: "a test" };
}

impl StrategyParams for Wild {
    fn build(&self, _: &Setting) -> Result<Box<dyn Strategy>, RobotError> {
        Ok(Box::new(self.clone()))
    }
}

impl Strategy for Wild {
    fn step(&mut self, seen: &Observation, _: &mut Stream) -> Decision {
        let nan = f64::NAN;
        let course = match self.bad {
            Bad::CourseNan => Heading::from_rad(nan),
            _ => Heading::from_deg(270.0),
        };
        let goal = Goal {
            id: 1,
            manoeuvre: Manoeuvre::Course { course },
            vertical: Vertical::Depth(5.0),
            speed_m_s: match self.bad {
                Bad::SpeedNan => nan,
                Bad::SpeedNegative => -3.0,
                Bad::SpeedHuge => 1e9,
                _ => 1.5,
            },
        };
        let declares = self.bad == Bad::DeclaredNan;
        Decision {
            declared: declares.then(|| Declaration::first(seen.t_s, Vector2::new(0.0, nan), "wild")),
            ..Decision::new(Behaviour::Other("wild"), goal)
        }
    }
}

/// A depth sensor that says nothing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Mute {}

impl Listed for Mute {
    const ENTRY: Entry = Entry { name: "mute", what: "a depth that is no number", source: "a test" };
}

impl SensorParams for Mute {
    fn build(&self, _: &Fitting) -> Result<Box<dyn Sensor>, RobotError> {
        Ok(Box::new(self.clone()))
    }

    fn stands_for(&self) -> &'static [&'static str] {
        &["depth"]
    }
}

impl Sensor for Mute {
    fn sense(&mut self, _: &Surroundings, readings: &mut Readings) {
        readings.depth = Some(DepthReading { depth_m: f64::NAN });
    }
}

/// A current that bursts at some time, or always has.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Burst {
    at_s: f64,
}

impl Listed for Burst {
    const ENTRY: Entry = Entry { name: "Burst", what: "faster than any water", source: "a test" };
}

impl CurrentParams for Burst {
    fn join(&self, water: &mut FreeWater, _: &CurrentSlot) -> Result<(), PlumeError> {
        water.add(self.clone());
        Ok(())
    }
}

impl PlaneCurrent for Burst {
    fn velocity(&self, _: Vector2<f64>, t_s: f64) -> Vector2<f64> {
        Vector2::new(if t_s >= self.at_s { 1e6 } else { 0.1 }, 0.0)
    }
}

/// What a run of two seconds says at its end; empty if it comes to it.
fn said(values: &[(&str, &str)]) -> String {
    let loaded = wild(values);
    let found = check(&loaded.scenario, &loaded.base_dir);
    match found.iter().find(|f| f.severity == Severity::Error) {
        Some(told) => format!("{}: {}", told.path, told.message),
        None => ended(&loaded),
    }
}

/// What a run says at its end without having been checked; empty if it comes to it.
fn ended(loaded: &Loaded) -> String {
    let run = || drop(Trial::assemble(loaded, 1).expect("legal").run(&mut Unwatched));
    caught(run).err().unwrap_or_default()
}

/// A channel with a strategy, a sensor or a current of its own.
fn wild(values: &[(&str, &str)]) -> Loaded {
    let registry = (Registry::default().with::<Strategies, Wild>())
        .and_then(|r| r.with::<Sensors, Mute>())
        .and_then(|r| r.with::<Currents, Burst>())
        .expect("new names");
    let short = [("time", "(spin_up_s: 20, limit_s: 2)"), ("robots[0].strategy", "Wild(bad: Fine)")];
    with(&registry, "uniform_channel", &[&short, values].concat()).expect("of the right form")
}

#[test]
fn what_a_strategy_decides_is_checked_and_the_strategy_named() {
    assert_eq!(said(&[]), "");
    for (bad, fault) in [
        ("SpeedNan", "`speed_m_s` must be from 0 to 100, got NaN"),
        ("SpeedNegative", "`speed_m_s` must be from 0 to 100, got -3"),
        ("SpeedHuge", "`speed_m_s` must be from 0 to 100, got 1000000000"),
        ("CourseNan", "`heading_rad` must be within ±1000000, got NaN"),
        ("DeclaredNan", "`declare.position_m` must be within ±1000000, got NaN"),
    ] {
        let said = said(&[("robots[0].strategy.bad", bad)]);
        assert!(said.starts_with("robot \"auv0\": its strategy Wild ") && said.contains(fault), "{said}");
    }
}

#[test]
fn what_a_sensor_reads_is_checked_and_the_sensor_named() {
    // It stands for the depth sensor, so that none is missed.
    let sensors = "(fluorometer: (), dvl: (), adcp: (), compass: (), mute: (), altimeter: (), lbl: (noise_m: 1))";
    let said = said(&[("robots[0].sensors", sensors)]);
    assert!(said.starts_with("robot \"auv0\": its sensor mute "), "{said}");
    assert!(said.contains("`depth.depth_m` must be within ±1000000000, got NaN"), "{said}");
}

#[test]
fn a_current_faster_than_any_water_ends_the_run_and_is_named() {
    let currents = |at_s: &str| format!("[Uniform(speed_m_s: 0.2, heading_deg: 90), Burst(at_s: {at_s})]");
    let with = |at_s: &str| said(&[("water.currents", &currents(at_s))]);
    assert_eq!(with("1e9"), "");
    // Where the check looks it is refused with the scenario, from the start or later, and otherwise where the water is
    // asked.
    for at_s in ["0", "10", "21.9"] {
        let refused = with(at_s);
        assert!(refused.contains("water.currents: the current Burst flows at (1000000, 0) m/s"), "{at_s}: {refused}");
    }
    let ended = ended(&wild(&[("water.currents", &currents("10"))]));
    assert!(ended.starts_with("the current Burst flows at (1000000, 0) m/s"), "{ended}");
}
