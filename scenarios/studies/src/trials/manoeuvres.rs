//! The trials: speed, turning circle, zigzags, turns by the autopilot, dive, stop, station keeping; of a glider its
//! sawtooth.
//!
//! *Source*: International Maritime Organization, "Standards for ship manoeuvrability", MSC.137(76), 2002: turning
//! circle, zigzag, stopping; dive and station keeping likewise for vehicles under water.
//!
//! *Parameters*: beside each trial.
//!
//! *Deviations*: those of circle and zigzag stand in `steering.rs`. In all others the vehicle's own autopilot steers, as
//! in a mission.

use super::kinds::{sawtooth, station};
use super::rudder::Rudder;
use super::steering::{circle, zigzag};
use super::straight::{dive, speed, stop};
use super::trial::{Trial, glides, patience_s};
use super::turns::{headings, turn};
use robots::guide::GuidanceSpec;
use robots::vehicles::Vehicle;

/// All trials that make sense for a vehicle. One without a rudder has no turning circle and no zigzag.
pub fn trials(craft: &Vehicle) -> Vec<Trial> {
    let able = craft.capabilities(GuidanceSpec::default().tightest_turn_m());
    let mut all = Vec::new();
    if glides(&able) {
        all.push(sawtooth(craft, &able));
    } else {
        all.push(speed(craft, &able));
    }
    if let Some(rudder) = Rudder::fitted(craft) {
        let most_s = patience_s(&able);
        all.push(circle(craft, &able, &rudder, most_s));
        for angle_deg in [10.0, 20.0] {
            all.push(zigzag(craft, &able, &rudder, angle_deg, most_s));
        }
    }
    all.push(turn(craft, &able));
    if glides(&able) {
        return all;
    }
    all.push(headings(craft, &able));
    if able.dives {
        all.push(dive(craft, &able));
    }
    all.push(stop(craft, &able));
    if able.hovers {
        all.push(station(craft, &able));
    }
    all
}

/// Whether a vehicle has a rudder, which turning circle and zigzag need.
pub fn has_rudder(craft: &Vehicle) -> bool {
    Rudder::fitted(craft).is_some()
}
