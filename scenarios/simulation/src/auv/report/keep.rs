//! What is kept of one robot.

use crate::auv::{Hull, Log, Mapping};
use crate::frame::{PictureFrame, PingFrame};
use crate::incidents::{Incident, IncidentKind, IncidentMonitor, OUTSIDE_M};
use crate::ocean::Ocean;
use crate::outbox::Outbox;
use crate::score::Score;
use crate::searchers::SearcherId;
use bevy_ecs::change_detection::Mut;
use robots::actuate::Pilot;
use robots::handoff::{Actuation, Behaviour, Belief, Decision, Estimate, Readings};
use robots::vehicles::Battery;
use world::clock::Clock;
use world::digest::Digest;
use world::frames::Truth;
use world::physics::Physics;

/// A robot at the end of a step. It holds the truth.
pub(super) type RobotEnd<'a> = (
    &'a SearcherId,
    &'a Truth,
    &'a Estimate,
    &'a Readings,
    &'a Decision,
    &'a Actuation,
    &'a Hull,
    &'a Pilot,
    Option<&'a Battery>,
);

/// Adds it to the digest; `number` is that of the newest behaviour.
pub(super) fn digest(
    (_, truth, estimate, _, decision, set, ..): &RobotEnd,
    map: Option<(&Belief, Mut<Mapping>)>,
    digest: &mut Digest,
    number: &mut Option<(Behaviour, f64)>,
) {
    digest.f64s(truth.pose.p_WB.as_slice());
    digest.f64s(truth.pose.R_WB.coords.as_slice());
    digest.f64s(truth.v_WB_B.as_slice());
    digest.f64s(truth.w_WB_B.as_slice());
    digest.f64s(estimate.position.as_slice());
    digest.f64s(&[estimate.depth_m, estimate.attitude.heading.rad()]);
    for (_, value) in set.named() {
        digest.f64(value);
    }
    let behaviour = decision.behaviour;
    let known = number.filter(|(known, _)| *known == behaviour);
    let (_, behaviour) = *number.insert(known.unwrap_or_else(|| (behaviour, behaviour.number(&Behaviour::ALL))));
    digest.f64(f64::from(decision.goal.id));
    digest.f64(behaviour);
    // Only when it is new: a map is large and changes seldom.
    if let Some((belief, mut mapping)) = map
        && mapping.digested != Some(belief.updates)
    {
        digest.f64s(&belief.p);
        mapping.digested = Some(belief.updates);
    }
}

/// Whether a thruster is at its limit; `None` without thrusters to share out among, and with an empty battery.
fn saturated(pilot: &Pilot, battery: Option<&Battery>) -> Option<bool> {
    pilot.saturated().filter(|_| !battery.is_some_and(Battery::is_empty))
}

/// Keeps its score.
pub(super) fn score(
    (id, truth, estimate, readings, decision, _, _, pilot, battery): &RobotEnd,
    clock: &Clock,
    score: &mut Score,
) {
    let p_W = truth.pose.p_WB;
    score.moved_to(id.place, &p_W);
    score.outcome(id.place, decision.outcome);
    let own = &mut score.searchers[id.place];
    if let Some(declaration) = decision.declared {
        own.declared(declaration);
    }
    if let Some(battery) = battery {
        own.powered(clock.t_next_s(), battery);
    }
    if let Some(saturated) = saturated(pilot, *battery) {
        own.allotted(saturated, clock.dt_s);
    }
    own.misplaced((estimate.position - p_W.xy()).norm());
    if readings.chemical.is_some_and(|c| c.detected) {
        own.detected(clock.t_next_s(), p_W.xy());
    }
}

/// Watches for what is abnormal.
pub(super) fn watch(
    (id, truth, _, readings, decision, _, hull, pilot, battery): &RobotEnd,
    clock: &Clock,
    ocean: &Ocean,
    physics: &Physics,
    lookout: &mut IncidentMonitor,
    events: &mut Vec<Incident>,
) {
    let p = truth.pose.p_WB;
    let outside_m = -ocean.sides.edge_distance(p.xy()).0;
    let deaf = |valid: Option<bool>| valid.map(|valid| !valid);
    let contact = physics.contacts(hull.body);
    let vehicle = contact.touching && contact.only_bodies;
    let strained = pilot.saturated().map(|_| saturated(pilot, *battery) == Some(true));
    let dithers = (lookout.switches).alternate(decision.behaviour, clock.t_s(), &p);
    let mut see = |what, wrong| lookout.see(what, wrong, &id.name, clock.t_s(), p, events);
    see(IncidentKind::LeftArea, Some(outside_m > OUTSIDE_M));
    see(IncidentKind::NoBottomLock, deaf(readings.dvl.map(|r| r.valid)));
    see(IncidentKind::NoAltitude, deaf(readings.altimeter.map(|r| r.valid)));
    see(IncidentKind::NoFlow, deaf(readings.adcp.map(|r| r.valid)));
    see(IncidentKind::Touched, Some(contact.touching && !vehicle));
    see(IncidentKind::TouchedVehicle, Some(vehicle));
    see(IncidentKind::ThrustersSaturated, strained);
    see(IncidentKind::BatteryEmpty, battery.map(Battery::is_empty));
    see(IncidentKind::Dithering, Some(dithers));
}

/// Notes what happens between two frames, and passes on pictures and pings, which come at times of their own.
pub(super) fn log((id, truth, estimate, readings, ..): &RobotEnd, clock: &Clock, log: &mut Log, outbox: &mut Outbox) {
    let (t_s, name) = (clock.t_s(), &id.name);
    let picture = readings.picture.as_ref();
    (outbox.pictures).extend(picture.map(|p| PictureFrame::new(t_s, name, p, truth, estimate)));
    let ping = readings.sidescan.as_ref();
    (outbox.pings).extend(ping.map(|p| PingFrame::new(t_s, name, p, estimate)));
    log.readings.hear(t_s, readings);
    if let Some(reading) = readings.chemical {
        log.chemical = Some(reading);
        log.detected |= reading.detected;
    }
    if readings.lbl.is_some() {
        let moved_m = estimate.fix_jump_m();
        log.fix_m = Some(log.fix_m.map_or(moved_m, |m| m.max(moved_m)));
    }
}
