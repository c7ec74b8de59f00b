//! Trials by rudder: against models that can be solved by hand, and what must hold of every hull.

use super::*;
use crate::trials::{has_rudder, trials};
use rheotaxis::scenario::FolderFiles;
use robots::vehicles::{KinematicSpec, RemusSpec, Vehicle, VehicleSpec};
use std::path::Path;
use world::math;

fn craft(spec: &VehicleSpec) -> Vehicle {
    Vehicle::load(spec, &FolderFiles(Path::new(""))).expect("a vehicle of the program")
}

fn remus() -> Vehicle {
    craft(&VehicleSpec::Remus100(RemusSpec::default()))
}

fn value(trial: &Trial, what: &str) -> f64 {
    let found = trial.found.iter().find(|f| f.what == what);
    (found.and_then(|f| f.value)).unwrap_or_else(|| panic!("{}: no {what}", trial.name))
}

fn trial<'a>(all: &'a [Trial], name: &str) -> &'a Trial {
    all.iter().find(|t| t.name == name).expect("it was made")
}

/// A vehicle of Nomoto's first order, T r' + r = K delta, with a rudder that follows at once: its overshoot can be
/// written down.
#[test]
fn the_zigzag_of_nomotos_model_overshoots_as_it_must() {
    let (lag_s, gain, dt_s) = (3.0, 0.9, 1e-3);
    for angle in [10.0f64, 20.0] {
        let mut orders = Zigzag::new(angle);
        let mut rows = Vec::new();
        let (mut heading, mut rate) = (0.0, 0.0);
        let mut k = 0u32;
        loop {
            let t_s = f64::from(k) * dt_s;
            let Some(side) = orders.side(t_s, heading) else {
                break;
            };
            rows.push(SteeringRow { t_s, heading_deg: heading, ..SteeringRow::default() });
            // Exact over a step of constant rudder.
            let steady: f64 = gain * side * angle;
            let decay = math::exp(-dt_s / lag_s);
            heading += steady * dt_s + (rate - steady) * lag_s * (1.0 - decay);
            rate = steady + (rate - steady) * decay;
            k += 1;
        }
        // From rest to the angle: K delta (t - T (1 - exp(-t / T))) = angle, by bisection.
        let gone = |t: f64| gain * (t - lag_s * (1.0 - math::exp(-t / lag_s))) - 1.0;
        let (mut low, mut high) = (0.0, 100.0);
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            if gone(middle) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        let r = gain * angle * (1.0 - math::exp(-low / lag_s));
        let check = lag_s * math::ln(1.0 + r / (gain * angle));
        let over = lag_s * r - gain * angle * check;
        let (found, when) = orders.overshoot(&rows, 1).expect("it came back");
        assert!((orders.times_s[1] - low).abs() < 2.0 * dt_s, "{angle}: {orders:?}");
        assert!((found - over).abs() < 0.02, "{angle}: {found} of {over}");
        assert!((when - check).abs() < 3.0 * dt_s, "{angle}: {when} of {check}");
        // The second swing comes with more way on: it goes farther.
        assert!(orders.overshoot(&rows, 2).expect("it came back").0 > found);
    }
}

/// A point that turns at once on a circle of 10 m.
#[test]
fn a_circle_has_its_radius_as_advance_and_its_diameter_as_tactical_diameter() {
    let radius = 10.0;
    let rows: Vec<SteeringRow> = (0..=5400)
        .map(|k| {
            let (sin, cos) = math::sin_cos((f64::from(k) * 0.1).to_radians());
            SteeringRow {
                t_s: f64::from(k) * 0.02,
                ahead_m: radius * sin,
                starboard_m: radius * (1.0 - cos),
                heading_deg: f64::from(k) * 0.1,
                ..SteeringRow::default()
            }
        })
        .collect();
    let found = circled(&rows);
    for (measured, wanted) in found.iter().zip([10.0, 10.0, 20.0, 20.0, 18.0]) {
        let value = measured.value.expect("it turned");
        assert!((value - wanted).abs() < 0.03, "{measured:?}");
    }
    // One that never comes round has no such numbers.
    assert!(circled(&rows[..800]).iter().take(4).all(|m| m.value.is_none()));
}

#[test]
fn hulls_with_a_rudder_overshoot_and_those_without_have_no_such_trial() {
    for (spec, length_m) in [
        (VehicleSpec::Remus100(RemusSpec::default()), 1.6),
        (VehicleSpec::Shipped("lauv".into()), 1.8),
        (VehicleSpec::Shipped("glider".into()), 1.5),
    ] {
        let craft = craft(&spec);
        let able = craft.capabilities(11.0);
        let rudder = Rudder::fitted(&craft).expect("it has one");
        let full = circle(&craft, &able, &rudder, 2000.0);
        let diameter = value(&full, "tactical diameter");
        // IMO's limits for ships: tactical diameter 5 lengths and advance 4.5; these hulls have small fins.
        assert!(diameter > length_m && diameter < 20.0 * length_m, "{spec:?}: {diameter}");
        // In a steady turn at constant speed, way and turn agree with the diameter of the last circle.
        let steady = value(&full, "steady diameter");
        assert!((steady / diameter - 1.0).abs() < 0.1, "{spec:?}: {steady}, {diameter}");
        for angle in [10.0, 20.0] {
            let zigzag = zigzag(&craft, &able, &rudder, angle, 2000.0);
            let over = value(&zigzag, "first overshoot angle");
            assert!(over > 0.1 && over < 25.0, "{spec:?}: {over}");
            assert!(value(&zigzag, "time to check yaw") > 0.0);
            // The rudder goes where it is told, and the heading to both sides.
            let most = |of: fn(&SteeringRow) -> f64| {
                let all = || zigzag.rows.iter().map(of);
                [all().fold(0.0, f64::min), all().fold(0.0, f64::max)]
            };
            let helm = value(&zigzag, "rudder");
            for side in most(|r| r.rudder_deg) {
                assert!((side.abs() - helm).abs() < 0.5, "{spec:?}: {side} of {helm}");
            }
            let [port, starboard] = most(|r| r.heading_deg);
            assert!(port < -angle && starboard > angle, "{spec:?}: {port}, {starboard}");
        }
    }
    for spec in [
        VehicleSpec::Kinematic(KinematicSpec::default()),
        VehicleSpec::Shipped("bluerov2".into()),
        VehicleSpec::Shipped("surface_craft".into()),
    ] {
        assert!(!has_rudder(&craft(&spec)), "{spec:?}");
    }
    let without = trials(&craft(&VehicleSpec::Shipped("surface_craft".into())));
    assert!(without.iter().all(|t| t.rows.is_empty() && !t.name.starts_with("zigzag")));
}

/// A hull that is alike on both sides turns alike to both; less rudder makes a wider circle.
#[test]
fn a_circle_is_wider_with_less_rudder_and_the_same_to_port() {
    let craft = remus();
    let able = craft.capabilities(11.0);
    let rudder = Rudder::fitted(&craft).expect("it has one");
    let diameter = |angle_deg: f64| {
        let rows = steered(&craft, &able, &rudder, 200.0, |row| (row.heading_deg.abs() < 190.0).then_some(angle_deg));
        let half = rows.iter().find(|r| r.heading_deg.abs() >= 180.0);
        half.expect("it turned").starboard_m
    };
    let [wide, narrow, port] = [8.0, 15.0, -15.0].map(diameter);
    assert!(wide > 1.3 * narrow, "{wide}, {narrow}");
    // The propeller's torque makes a small difference.
    assert!((port / narrow + 1.0).abs() < 0.05, "{port}, {narrow}");
}

/// The propeller stays as it was, so that a turn costs speed, as it does a ship; depth is held.
#[test]
fn a_turn_costs_speed() {
    let craft = remus();
    let able = craft.capabilities(11.0);
    let rudder = Rudder::fitted(&craft).expect("it has one");
    let full = circle(&craft, &able, &rudder, 240.0);
    let [first, last] = [full.rows.first(), full.rows.last()].map(|r| r.expect("rows").speed_m_s);
    assert!(last < 0.999 * first && last > 0.3 * first, "{first}, {last}");
    let zigzag = trial(&trials(&craft), "zigzag 10/10").clone();
    assert_eq!(zigzag.curve.rudder.len(), zigzag.curve.points.len());
}
