//! The systems of robots: each passes components and the ocean to plain state machines.

use super::{Briefing, Hull, Mapping, Robots, Searching};
use crate::abnormal::{Abnormality, FaultLog, Lookout, OUTSIDE_M};
use crate::assemble::WaterLight;
use crate::control::Seen;
use crate::control::consulting::{Consulting, Kept};
use crate::ocean::Ocean;
use crate::score::Score;
use crate::searchers::{SearcherId, whole};
use bevy_ecs::prelude::{Local, Query, Res, ResMut};
use nalgebra::Vector3;
use robots::actuate::Pilot;
use robots::estimate::Estimator;
use robots::faults::{DriveFaults, SensorFaults};
use robots::guide::Guidance;
use robots::handoff::{
    Actuation, Behaviour, Belief, Command, Decision, Estimate, GuidanceStatus, Observation,
    Readings,
};
use robots::map::MapObservation;
use robots::sense::{Around, Asked, SensorSuite};
use robots::vehicles::Battery;
use world::clock::Clock;
use world::digest::Digest;
use world::frames::Truth;
use world::physics::Physics;

pub(crate) fn read_instruments(
    clock: Res<Clock>,
    ocean: Res<Ocean>,
    light: Res<WaterLight>,
    mut robots: Query<(
        &Truth,
        &Decision,
        &mut SensorSuite,
        &mut SensorFaults,
        &mut Readings,
    )>,
) {
    for (truth, decision, mut suite, mut faults, mut readings) in &mut robots {
        *readings = suite.read(&Around {
            clock: &clock,
            truth,
            flow: &*ocean,
            dye: &ocean.dye(clock.t_s()),
            terrain: &ocean.terrain,
            obstacles: &ocean.obstacles,
            optics: &light.0,
            asked: Asked::from(decision),
        });
        faults.alter(&clock, &mut readings);
    }
}

pub(crate) fn estimate_state(
    clock: Res<Clock>,
    mut robots: Query<(&Readings, &mut Estimator, &mut Estimate)>,
) {
    for (readings, mut estimator, mut estimate) in &mut robots {
        *estimate = estimator.step(&clock, readings);
    }
}

pub(crate) fn update_map(
    clock: Res<Clock>,
    mut robots: Query<(&Readings, &Estimate, &mut Mapping, &mut Belief)>,
) {
    for (readings, estimate, mut mapping, mut belief) in &mut robots {
        let p = estimate.position;
        mapping.mapper.step(&MapObservation {
            t_s: clock.t_s(),
            p_W: Vector3::new(p.x, p.y, -estimate.depth_m),
            detected: readings.chemical.map(|c| c.detected),
            flow: estimate.flow.map(|f| f.velocity),
            fixed: readings.lbl.is_some(),
        });
        let new = mapping.mapper.belief();
        if new.updates != belief.updates {
            *belief = new.clone();
        }
    }
}

type Perceived<'a> = (
    &'a Readings,
    &'a Estimate,
    &'a GuidanceStatus,
    &'a Briefing,
    Option<&'a Belief>,
);

/// What a robot sees in this tick.
fn observation(clock: &Clock, parts: Perceived) -> Observation {
    let (readings, estimate, guidance, briefing, belief) = parts;
    Observation {
        t_s: clock.t_s(),
        estimate: *estimate,
        chemical: readings.chemical,
        guidance: *guidance,
        area: briefing.area,
        home: briefing.home,
        able: briefing.able,
        belief: belief.cloned(),
        ranging: readings.ranging.clone(),
        sidescan: readings.sidescan.clone(),
        picture: readings.picture.clone(),
        other: readings.other.clone(),
        told: None,
    }
}

/// Asks the searchers outside this program; the answers come between this stage and the next.
pub(crate) fn ask(
    clock: Res<Clock>,
    mut robots: Query<(Perceived, &SearcherId, &Decision, &mut Consulting)>,
) {
    for (parts, id, decision, mut consulting) in &mut robots {
        if let Kept::Robot(gathered) = &mut consulting.kept {
            gathered.add(clock.t_s(), parts.0);
        }
        if decision.outcome.is_none() && consulting.due(&clock) {
            consulting.ask(&clock, &id.name, |kept| {
                let seen = Box::new(observation(&clock, parts));
                Seen::Robot(seen, Box::new(kept.take_robot()))
            });
        }
    }
}

type Deciding<'a> = (
    Perceived<'a>,
    &'a mut Searching,
    &'a mut Decision,
    Option<&'a mut Consulting>,
);

pub(crate) fn decide(clock: Res<Clock>, mut robots: Query<Deciding>) {
    for (parts, mut searching, mut decision, consulting) in &mut robots {
        let seen = Observation {
            told: consulting.and_then(|mut c| c.take_told()),
            ..observation(&clock, parts)
        };
        let searching = &mut *searching;
        *decision = searching.strategy.step(&seen, &mut searching.rng);
    }
}

pub(crate) fn guide(
    clock: Res<Clock>,
    mut robots: Query<(
        &Estimate,
        &Decision,
        &Briefing,
        &mut Guidance,
        &mut Command,
        &mut GuidanceStatus,
    )>,
) {
    for (estimate, decision, briefing, mut guidance, mut command, mut status) in &mut robots {
        (*command, *status) = guidance.step(estimate, &decision.goal, &briefing.area, clock.dt_s);
    }
}

type Actuated<'a> = (
    &'a Command,
    &'a Estimate,
    &'a mut Pilot,
    &'a mut DriveFaults,
    &'a mut Actuation,
    Option<&'a Battery>,
    &'a Hull,
);

pub(crate) fn actuate(clock: Res<Clock>, mut robots: Query<Actuated>) {
    for (command, estimate, mut pilot, mut faults, mut set, battery, hull) in &mut robots {
        *set = pilot.step(command, estimate, clock.dt_s);
        faults.alter(&clock, &mut set);
        if battery.is_some_and(Battery::is_empty) {
            *set = hull.vehicle.idle();
        }
    }
}

pub(crate) fn push_bodies(
    clock: Res<Clock>,
    ocean: Res<Ocean>,
    roster: Res<Robots>,
    mut physics: ResMut<Physics>,
    mut robots: Query<(&Truth, &Actuation, &mut Hull, Option<&mut Battery>)>,
) {
    let mut each = robots.iter_many_mut(&roster.0);
    while let Some((truth, set, mut hull, battery)) = each.fetch_next().map(whole) {
        let (t_s, dt_s) = (clock.t_s(), clock.dt_s);
        let push = hull.vehicle.step(truth, &*ocean, t_s, set, dt_s);
        physics.push(hull.body, push);
        if let Some(mut battery) = battery {
            battery.use_w(hull.vehicle.power_w(), dt_s);
        }
    }
}

pub(crate) fn read_bodies(
    clock: Res<Clock>,
    physics: Res<Physics>,
    mut robots: Query<(&SearcherId, &Hull, &mut Truth)>,
) {
    for (id, hull, mut truth) in &mut robots {
        *truth = physics.truth(hull.body);
        assert!(
            truth.is_finite(),
            "the state of robot {} is not finite after step {}: a force on it was not; check its parameters and the \
             water there",
            id.name,
            clock.step
        );
    }
}

type Digested<'a> = (
    &'a Truth,
    &'a Estimate,
    &'a Decision,
    &'a Actuation,
    Option<(&'a Belief, &'a mut Mapping)>,
);

pub(crate) fn digest_robots(
    roster: Res<Robots>,
    mut digest: ResMut<Digest>,
    mut robots: Query<Digested>,
    // Of the newest behaviour: some are hashed, and they seldom change.
    mut number: Local<Option<(Behaviour, f64)>>,
) {
    let mut each = robots.iter_many_mut(&roster.0);
    while let Some((truth, estimate, decision, set, map)) = each.fetch_next().map(whole) {
        digest.f64s(truth.pose.p_WB.as_slice());
        digest.f64s(truth.pose.R_WB.coords.as_slice());
        digest.f64s(truth.v_WB_B.as_slice());
        digest.f64s(truth.w_WB_B.as_slice());
        digest.f64s(estimate.position.as_slice());
        digest.f64s(&[estimate.depth_m, estimate.attitude.heading.rad()]);
        for (_, value) in set.named() {
            digest.f64s(&[value]);
        }
        let behaviour = decision.behaviour;
        let known = number.filter(|(known, _)| *known == behaviour);
        let (_, behaviour) =
            *number.insert(known.unwrap_or_else(|| (behaviour, behaviour.number())));
        digest.f64s(&[f64::from(decision.goal.id), behaviour]);
        // Only when it is new: a map is large and changes seldom.
        if let Some((belief, mut mapping)) = map
            && mapping.digested != Some(belief.updates)
        {
            digest.f64s(&belief.p);
            mapping.digested = Some(belief.updates);
        }
    }
}

/// Whether a thruster is at its limit; `None` without thrusters to share out among, and with an empty battery.
fn saturated(pilot: &Pilot, battery: Option<&Battery>) -> Option<bool> {
    pilot
        .saturated()
        .filter(|_| !battery.is_some_and(Battery::is_empty))
}

type Scored<'a> = (
    &'a Pilot,
    Option<&'a Battery>,
    &'a SearcherId,
    &'a Truth,
    &'a Estimate,
    &'a Readings,
    &'a Decision,
);

pub(crate) fn keep_score(
    clock: Res<Clock>,
    roster: Res<Robots>,
    mut score: ResMut<Score>,
    robots: Query<Scored>,
) {
    for parts in robots.iter_many(&roster.0).map(whole) {
        let (pilot, battery, id, truth, estimate, readings, decision) = parts;
        let p_W = truth.pose.p_WB;
        score.at(id.place, &p_W);
        score.outcome(id.place, decision.outcome);
        let own = &mut score.searchers[id.place];
        if let Some(declaration) = decision.declared {
            own.declared(declaration);
        }
        if let Some(battery) = battery {
            own.powered(clock.t_next_s(), battery);
        }
        if let Some(saturated) = saturated(pilot, battery) {
            own.allotted(saturated, clock.dt_s);
        }
        own.misplaced((estimate.position - p_W.xy()).norm());
        if readings.chemical.is_some_and(|c| c.detected) {
            own.detected(clock.t_next_s(), p_W.xy());
        }
    }
}

type Watched<'a> = (
    &'a SearcherId,
    &'a Truth,
    &'a Readings,
    &'a Hull,
    &'a Pilot,
    Option<&'a Battery>,
    &'a mut Lookout,
);

pub(crate) fn watch(
    clock: Res<Clock>,
    ocean: Res<Ocean>,
    physics: Res<Physics>,
    mut score: ResMut<Score>,
    mut robots: Query<Watched>,
) {
    let events = &mut score.abnormal;
    for (id, truth, readings, hull, pilot, battery, mut lookout) in &mut robots {
        let p = truth.pose.p_WB;
        let outside_m = -ocean.sides.edge_distance(p.xy()).0;
        let deaf = |valid: Option<bool>| valid.map(|valid| !valid);
        for (what, wrong) in [
            (Abnormality::LeftArea, Some(outside_m > OUTSIDE_M)),
            (
                Abnormality::NoBottomLock,
                deaf(readings.dvl.map(|r| r.valid)),
            ),
            (
                Abnormality::NoAltitude,
                deaf(readings.altimeter.map(|r| r.valid)),
            ),
            (Abnormality::NoFlow, deaf(readings.adcp.map(|r| r.valid))),
            (
                Abnormality::Touched,
                Some(physics.contacts(hull.body).touching),
            ),
            (
                Abnormality::ThrustersSaturated,
                saturated(pilot, battery).or(pilot.saturated().map(|_| false)),
            ),
            (Abnormality::BatteryEmpty, battery.map(Battery::is_empty)),
        ] {
            lookout.see(what, wrong, &id.name, clock.t_s(), p, events);
        }
    }
}

pub(crate) fn tell_faults(
    clock: Res<Clock>,
    mut score: ResMut<Score>,
    mut robots: Query<(&SearcherId, &Truth, &mut FaultLog)>,
) {
    for (id, truth, mut log) in &mut robots {
        log.see(&clock, &id.name, truth.pose.p_WB, &mut score.abnormal);
    }
}
