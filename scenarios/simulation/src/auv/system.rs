//! The systems of a robot: each hands its parts, and the ocean, to plain state machines.

use super::{Guiding, Hull, Instruments, Mapping, Navigation, Searching, Steering};
use crate::abnormal::{Abnormality, Abnormals, Lookout, OUTSIDE_M};
use crate::ocean::Ocean;
use crate::score::Score;
use crate::searchers::{Roster, SearcherId, whole};
use bevy_ecs::prelude::{DetectChanges, Query, Ref, Res, ResMut};
use nalgebra::Vector3;
use robots::handoff::{
    ActuatorCommand, Belief, Command, Decision, Estimate, GuidanceStatus, Observation, Readings,
};
use robots::map::MapObservation;
use robots::sense::camera::Optics;
use robots::sense::{Around, Asked};
use world::clock::Clock;
use world::digest::Digest;
use world::fields::Flow;
use world::frames::Truth;
use world::physics::Physics;

pub(crate) fn read_instruments(
    clock: Res<Clock>,
    ocean: Res<Ocean>,
    optics: Res<Optics>,
    mut robots: Query<(&Truth, &Decision, &mut Instruments, &mut Readings)>,
) {
    for (truth, decision, mut suite, mut readings) in &mut robots {
        *readings = (suite.0).read(&Around {
            clock: &clock,
            truth,
            flow: &*ocean,
            dye: &ocean.dye(clock.t_s()),
            terrain: &ocean.terrain,
            obstacles: &ocean.obstacles,
            optics: &optics,
            asked: Asked::from(decision),
        });
    }
}

pub(crate) fn estimate_state(
    clock: Res<Clock>,
    mut robots: Query<(&Readings, &mut Navigation, &mut Estimate)>,
) {
    for (readings, mut navigator, mut estimate) in &mut robots {
        *estimate = navigator.0.step(&clock, readings);
    }
}

pub(crate) fn update_map(
    clock: Res<Clock>,
    mut robots: Query<(&Readings, &Estimate, &mut Mapping, &mut Belief)>,
) {
    for (readings, estimate, mut mapper, mut belief) in &mut robots {
        let p = estimate.position;
        mapper.0.step(&MapObservation {
            t_s: clock.t_s(),
            p_W: Vector3::new(p.x, p.y, -estimate.depth_m),
            detected: readings.chemical.map(|c| c.detected),
            flow: estimate.flow.map(|f| f.velocity),
        });
        let new = mapper.0.belief();
        if new.updates != belief.updates {
            *belief = new.clone();
        }
    }
}

type Deciding<'a> = (
    &'a Readings,
    &'a Estimate,
    &'a GuidanceStatus,
    Option<&'a Belief>,
    &'a mut Searching,
    &'a mut Decision,
);

pub(crate) fn decide(clock: Res<Clock>, ocean: Res<Ocean>, mut robots: Query<Deciding>) {
    for (readings, estimate, guidance, belief, mut searching, mut decision) in &mut robots {
        let seen = Observation {
            t_s: clock.t_s(),
            estimate: *estimate,
            chemical: readings.chemical,
            guidance: *guidance,
            area: ocean.area,
            home: searching.home,
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
    ocean: Res<Ocean>,
    mut robots: Query<(
        &Estimate,
        &Decision,
        &mut Guiding,
        &mut Command,
        &mut GuidanceStatus,
    )>,
) {
    for (estimate, decision, mut guidance, mut command, mut status) in &mut robots {
        (*command, *status) = guidance
            .0
            .step(estimate, &decision.goal, &ocean.area, clock.dt_s);
    }
}

pub(crate) fn actuate(
    clock: Res<Clock>,
    mut robots: Query<(&Command, &Estimate, &mut Steering, &mut ActuatorCommand)>,
) {
    for (command, estimate, mut autopilot, mut set) in &mut robots {
        *set = autopilot.0.step(command, estimate, clock.dt_s);
    }
}

pub(crate) fn move_bodies(
    clock: Res<Clock>,
    ocean: Res<Ocean>,
    roster: Res<Roster>,
    mut physics: ResMut<Physics>,
    mut robots: Query<(&SearcherId, &ActuatorCommand, &mut Hull, &mut Truth)>,
) {
    let mut each = robots.iter_many_mut(&roster.robots);
    while let Some((_, set, mut hull, truth)) = each.fetch_next().map(whole) {
        let sample = ocean.sample(&truth.pose.p_WB, clock.t_s());
        let push = hull.vehicle.step(&truth, &sample, set, clock.dt_s);
        physics.push(hull.body, push);
    }
    physics.step();
    for (id, _, hull, mut truth) in &mut robots {
        *truth = physics.truth(hull.body);
        assert!(
            truth.is_finite(),
            "the state of robot {} is not finite after step {}: a force on it was not; check its parameters and the water there",
            id.0,
            clock.step
        );
    }
}

type Digested<'a> = (
    &'a Truth,
    &'a Estimate,
    &'a Decision,
    &'a ActuatorCommand,
    Option<Ref<'a, Belief>>,
);

pub(crate) fn digest_robots(
    roster: Res<Roster>,
    mut digest: ResMut<Digest>,
    robots: Query<Digested>,
) {
    for (truth, estimate, decision, set, belief) in robots.iter_many(&roster.robots).map(whole) {
        digest.f64s(truth.pose.p_WB.as_slice());
        digest.f64s(truth.pose.R_WB.coords.as_slice());
        digest.f64s(truth.v_WB_B.as_slice());
        digest.f64s(truth.w_WB_B.as_slice());
        digest.f64s(estimate.position.as_slice());
        digest.f64s(&[estimate.depth_m, estimate.attitude.heading.rad()]);
        digest.f64s(&[set.rudder_rad, set.stern_rad, set.rpm]);
        digest.f64s(&[f64::from(decision.goal.id), decision.behaviour.number()]);
        // Only when it is new: a map is large and changes seldom.
        if let Some(belief) = belief.filter(|b| b.is_changed()) {
            digest.f64s(&belief.p);
        }
    }
}

pub(crate) fn keep_score(
    roster: Res<Roster>,
    mut score: ResMut<Score>,
    robots: Query<(&Truth, &Decision)>,
) {
    for (n, (truth, decision)) in robots.iter_many(&roster.robots).map(whole).enumerate() {
        score.at(n, &truth.pose.p_WB);
        score.declared(n, decision.declared);
    }
}

pub(crate) fn watch(
    clock: Res<Clock>,
    ocean: Res<Ocean>,
    physics: Res<Physics>,
    mut abnormals: ResMut<Abnormals>,
    mut robots: Query<(&SearcherId, &Truth, &Readings, &Hull, &mut Lookout)>,
) {
    let events = &mut abnormals.0;
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
            lookout.see(what, wrong, &id.0, clock.t_s(), p, events);
        }
    }
}
