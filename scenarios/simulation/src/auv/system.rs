//! The systems of robots: each passes components and the ocean to plain state machines.

use super::{Briefing, Hull, Log, Mapping, Robots, Searching};
use crate::abnormal::{Abnormality, FaultLog, Lookout, OUTSIDE_M};
use crate::frame::{PictureFrame, PingFrame, RobotFrame};
use crate::ocean::Ocean;
use crate::outbox::Outbox;
use crate::score::Score;
use crate::searchers::{SearcherId, whole};
use bevy_ecs::prelude::{DetectChanges, Query, Ref, Res, ResMut};
use nalgebra::Vector3;
use robots::actuate::Pilot;
use robots::estimate::Estimator;
use robots::faults::{DriveFaults, SensorFaults};
use robots::guide::Guidance;
use robots::handoff::{
    Actuation, Belief, Command, Decision, Estimate, GuidanceStatus, Observation, Readings,
};
use robots::map::MapObservation;
use robots::sense::camera::Optics;
use robots::sense::{Around, Asked, SensorSuite};
use robots::vehicles::Battery;
use world::clock::Clock;
use world::digest::Digest;
use world::frames::Truth;
use world::physics::Physics;

pub(crate) fn read_instruments(
    clock: Res<Clock>,
    ocean: Res<Ocean>,
    optics: Res<Optics>,
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
            optics: &optics,
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

type Deciding<'a> = (
    &'a Readings,
    &'a Estimate,
    &'a GuidanceStatus,
    &'a Briefing,
    Option<&'a Belief>,
    &'a mut Searching,
    &'a mut Decision,
);

pub(crate) fn decide(clock: Res<Clock>, mut robots: Query<Deciding>) {
    for (readings, estimate, guidance, briefing, belief, mut searching, mut decision) in &mut robots
    {
        let seen = Observation {
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
    Option<Ref<'a, Belief>>,
);

pub(crate) fn digest_robots(
    roster: Res<Robots>,
    mut digest: ResMut<Digest>,
    robots: Query<Digested>,
) {
    for (truth, estimate, decision, set, belief) in robots.iter_many(&roster.0).map(whole) {
        digest.f64s(truth.pose.p_WB.as_slice());
        digest.f64s(truth.pose.R_WB.coords.as_slice());
        digest.f64s(truth.v_WB_B.as_slice());
        digest.f64s(truth.w_WB_B.as_slice());
        digest.f64s(estimate.position.as_slice());
        digest.f64s(&[estimate.depth_m, estimate.attitude.heading.rad()]);
        digest.f64s(&set.named().map(|(_, value)| value).collect::<Vec<_>>());
        digest.f64s(&[f64::from(decision.goal.id), decision.behaviour.number()]);
        // Only when it is new: a map is large and changes seldom.
        if let Some(belief) = belief.filter(|b| b.is_changed()) {
            digest.f64s(&belief.p);
        }
    }
}

type Scored<'a> = (
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
    for (battery, id, truth, estimate, readings, decision) in robots.iter_many(&roster.0).map(whole)
    {
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
        own.misplaced((estimate.position - p_W.xy()).norm());
        if readings.chemical.is_some_and(|c| c.detected) {
            own.detected(clock.t_next_s(), p_W.xy());
        }
    }
}

pub(crate) fn watch(
    clock: Res<Clock>,
    ocean: Res<Ocean>,
    physics: Res<Physics>,
    mut score: ResMut<Score>,
    mut robots: Query<(&SearcherId, &Truth, &Readings, &Hull, &mut Lookout)>,
) {
    let events = &mut score.abnormal;
    for (id, truth, readings, hull, mut lookout) in &mut robots {
        let p = truth.pose.p_WB;
        let outside_m = -ocean.area.edge_distance(p.xy()).0;
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

/// Notes what happens between two frames, and passes on pictures and pings, which come at times of their own.
pub(crate) fn keep_log(
    clock: Res<Clock>,
    roster: Res<Robots>,
    mut outbox: ResMut<Outbox>,
    mut robots: Query<(&SearcherId, &Truth, &Estimate, &Readings, &mut Log)>,
) {
    let t_s = clock.t_s();
    let mut each = robots.iter_many_mut(&roster.0);
    while let Some((id, truth, estimate, readings, mut log)) = each.fetch_next().map(whole) {
        let name = &id.name;
        let picture = readings.picture.as_ref();
        (outbox.pictures).extend(picture.map(|p| PictureFrame::new(t_s, name, p, truth, estimate)));
        let ping = readings.sidescan.as_ref();
        (outbox.pings).extend(ping.map(|p| PingFrame::new(t_s, name, p, estimate)));
        log.heard.hear(t_s, readings);
        if let Some(reading) = readings.chemical {
            log.chemical = Some(reading);
            log.detected |= reading.detected;
        }
        if readings.lbl.is_some() {
            let moved_m = estimate.fix_jump_m();
            log.fix_m = Some(log.fix_m.map_or(moved_m, |m| m.max(moved_m)));
        }
    }
}

type Pictured<'a> = (
    &'a SearcherId,
    &'a Truth,
    &'a Estimate,
    &'a Decision,
    &'a Command,
    &'a Actuation,
    Option<&'a Belief>,
    &'a mut Log,
);

pub(crate) fn picture(
    ocean: Res<Ocean>,
    roster: Res<Robots>,
    score: Res<Score>,
    mut outbox: ResMut<Outbox>,
    mut robots: Query<Pictured>,
) {
    let Some(frame) = &mut outbox.open else {
        return;
    };
    let mut each = robots.iter_many_mut(&roster.0);
    while let Some(parts) = each.fetch_next().map(whole) {
        let (id, truth, estimate, decision, command, set, belief, mut log) = parts;
        let p = truth.pose.p_WB;
        frame.robots.push(RobotFrame {
            id: id.name.clone(),
            truth: *truth,
            altitude_m: p.z - ocean.terrain.bed_z(p.x, p.y),
            estimate: *estimate,
            goal: Some(decision.goal),
            command: Some(*command),
            actuators: *set,
            heard: std::mem::take(&mut log.heard),
            chemical: log.chemical,
            detected: std::mem::take(&mut log.detected),
            behaviour: decision.behaviour,
            layers: decision.layers.clone(),
            lost_points: decision.lost_points.clone(),
            planned: decision.planned.clone(),
            belief: belief.cloned(),
            regions: decision.regions.clone(),
            declarations: score.searchers[id.place].declarations.clone(),
            fix_m: log.fix_m.take(),
        });
    }
}
