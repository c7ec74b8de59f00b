//! The helm with a vehicle that does exactly as told.

use super::*;
use crate::handoff::testing::seen;
use crate::handoff::{Setpoint, TurnLimit};
use nalgebra::Vector2;
use world::units::Heading;

fn limits() -> RateLimits {
    RateLimits { speed_m_s: 2.0, turn: TurnLimit::Rate(10f64.to_radians()), climb_m_s: 0.5, lag_s: 0.0 }
}

fn helm(limits: RateLimits) -> Helm {
    Helm::new(limits, &AutopilotSpec::default(), 0.0)
}

/// It steers by what it is set, not by the flow.
fn at(heading: Heading, depth_m: f64, altitude_m: Option<f64>) -> Estimate {
    let flow = Some(Vector2::new(0.7, -0.3));
    Estimate { depth_m, altitude_m, ..seen(0.0, Vector2::zeros(), heading.deg(), flow).estimate }
}

fn steer(heading_deg: f64, water_speed_m_s: f64, vertical: Vertical) -> Command {
    Command::Steer(Setpoint { heading: Heading::from_deg(heading_deg), water_speed_m_s, vertical })
}

/// Heading (from north, rad) and depth after so many steps, and all rates, with readings every `every` steps.
fn follow(helm: &mut Helm, command: &Command, steps: u32, every: u32) -> (f64, f64, Vec<RateCommand>) {
    let dt_s = 0.1;
    let (mut heading, mut depth_m) = (0.0, 5.0);
    let mut read = (heading, depth_m);
    let mut all = Vec::new();
    for k in 0..steps {
        if k % every == 0 {
            read = (heading, depth_m);
        }
        let rates = helm.step(command, &at(Heading::from_rad(read.0), read.1, None), dt_s);
        heading += rates.turn_rad_s * dt_s;
        depth_m -= rates.climb_m_s * dt_s;
        all.push(rates);
    }
    (heading, depth_m, all)
}

#[test]
fn turns_and_dives_at_its_limits_and_then_stops() {
    let (heading, depth_m, rates) = follow(&mut helm(limits()), &steer(90.5, 9.0, Vertical::Depth(7.02)), 120, 1);
    assert!((heading - 90.5f64.to_radians()).abs() < 1e-12);
    assert!((depth_m - 7.02).abs() < 1e-12);
    // Nine seconds and a half step at 10 degrees/s; four seconds and a bit at 0.5 m/s.
    for r in &rates[..90] {
        assert!((r.turn_rad_s - 10f64.to_radians()).abs() < 1e-12);
    }
    assert!((rates[90].turn_rad_s - 5f64.to_radians()).abs() < 1e-9);
    for r in &rates[..40] {
        assert!((r.climb_m_s + 0.5).abs() < 1e-12);
    }
    for r in &rates[91..] {
        assert!(r.turn_rad_s.abs() < 1e-9 && r.climb_m_s.abs() < 1e-9);
        assert_eq!(r.speed_m_s, 2.0);
    }
}

/// Between two readings it counts what it has commanded: it neither turns on past its set-point nor hunts about it.
#[test]
fn slow_readings_change_nothing_where_they_do_not_err() {
    let command = steer(-77.0, 1.0, Vertical::Depth(3.0));
    let often = follow(&mut helm(limits()), &command, 100, 1);
    let seldom = follow(&mut helm(limits()), &command, 100, 7);
    assert!((often.0 - seldom.0).abs() < 1e-12 && (often.1 - seldom.1).abs() < 1e-12);
    for (a, b) in often.2.iter().zip(&seldom.2) {
        assert!((a.turn_rad_s - b.turn_rad_s).abs() < 1e-9, "{a:?} {b:?}");
        assert!((a.climb_m_s - b.climb_m_s).abs() < 1e-9, "{a:?} {b:?}");
    }
}

/// Held by a wall, with a compass that does not change: after a second the reading counts again.
#[test]
fn a_reading_that_stays_is_believed_in_the_end() {
    let mut helm = helm(limits());
    let command = steer(5.0, 1.0, Vertical::Depth(5.0));
    let stuck = at(Heading::from_deg(0.0), 5.0, None);
    let tries = (0..100).filter(|_| helm.step(&command, &stuck, 0.1).turn_rad_s > 0.1);
    assert!(tries.count() > 20);
}

/// The error falls by 1/e in the lag, whatever the step, and the way ahead is that of a first-order lag.
#[test]
fn the_lag_is_its_time_constant() {
    let lag_s = 1.5;
    for dt_s in [0.02, 0.1, 0.5] {
        let mut helm = helm(RateLimits { turn: TurnLimit::Rate(10.0), climb_m_s: 10.0, lag_s, ..limits() });
        let command = steer(60.0, 2.0, Vertical::Depth(7.0));
        let (mut heading, mut depth_m, mut way_m) = (0.0, 5.0, 0.0);
        let steps = (lag_s / dt_s).round() as u32;
        for _ in 0..steps {
            let rates = helm.step(&command, &at(Heading::from_rad(heading), depth_m, None), dt_s);
            heading += rates.turn_rad_s * dt_s;
            depth_m -= rates.climb_m_s * dt_s;
            way_m += rates.speed_m_s * dt_s;
        }
        let t_s = f64::from(steps) * dt_s;
        let left = math::exp(-t_s / lag_s);
        assert!((heading - 60f64.to_radians() * (1.0 - left)).abs() < 1e-9, "{dt_s}");
        assert!((depth_m - (7.0 - 2.0 * left)).abs() < 1e-9, "{dt_s}");
        assert!((helm.speed_m_s - 2.0 * (1.0 - left)).abs() < 1e-12, "{dt_s}");
        assert!((way_m - 2.0 * (t_s - lag_s * (1.0 - left))).abs() < 1e-9, "{dt_s}");
    }
}

#[test]
fn a_dubins_vehicle_turns_no_faster_than_its_speed_and_radius_allow() {
    let dubins = RateLimits { turn: TurnLimit::Radius(12.5), ..limits() };
    for speed_m_s in [0.5, 1.0, 2.0] {
        let command = steer(170.0, speed_m_s, Vertical::Depth(5.0));
        let (.., rates) = follow(&mut helm(dubins), &command, 20, 1);
        for r in rates {
            assert!((r.turn_rad_s - speed_m_s / 12.5).abs() < 1e-12, "{r:?}");
        }
    }
    // At rest it does not turn at all.
    let (heading, ..) = follow(&mut helm(dubins), &steer(90.0, 0.0, Vertical::Depth(5.0)), 50, 1);
    assert_eq!(heading, 0.0);
}

#[test]
fn altitude_is_kept_by_its_readings_and_without_one_the_height() {
    let mut helm = helm(limits());
    let heading = Heading::from_deg(0.0);
    let command = steer(0.0, 1.0, Vertical::Altitude(2.0));
    let low = helm.step(&command, &at(heading, 5.0, Some(1.99)), 0.1);
    assert!((low.climb_m_s - 0.1).abs() < 1e-12, "{low:?}");
    let none = helm.step(&command, &at(heading, 5.0, None), 0.1);
    assert_eq!(none.climb_m_s, 0.0);
}

#[test]
fn a_table_of_fins_is_read_in_shares() {
    let mut helm = helm(limits());
    let spec = AutopilotSpec::default();
    let fin = spec.fin_limit_deg.get().to_radians();
    let mut step = |rudder_rad, stern_rad, rpm| {
        let table = Command::Direct(ActuatorCommand { rudder_rad, stern_rad, rpm });
        helm.step(&table, &at(Heading::from_deg(0.0), 5.0, None), 0.1)
    };
    let half = step(fin / 2.0, fin / 5.0, spec.rpm_limit.get() / 4.0);
    assert!((half.turn_rad_s - 5f64.to_radians()).abs() < 1e-12);
    assert!((half.climb_m_s + 0.1).abs() < 1e-12);
    assert!((half.speed_m_s - 0.5).abs() < 1e-12);
    let beyond = step(-9.0 * fin, -9.0 * fin, -1000.0);
    assert!((beyond.turn_rad_s + 10f64.to_radians()).abs() < 1e-12);
    assert_eq!((beyond.climb_m_s, beyond.speed_m_s), (0.5, 0.0));
}
