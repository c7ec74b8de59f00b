//! The systems of robots: each passes components and the ocean to plain state machines.

use super::{Briefing, Hull, Mapping};
use crate::assemble::WaterLight;
use crate::control::{QuestionContent, ReadingsSince};
use crate::incidents::FaultLog;
use crate::machines::{Inputs, SearcherKind};
use crate::ocean::Ocean;
use crate::score::Score;
use crate::searchers::{OnboardTime, SearcherId};
use bevy_ecs::prelude::{Query, Res, ResMut};
use nalgebra::Vector3;
use robots::actuate::Pilot;
use robots::estimate::DeadReckoning;
use robots::faults::{DriveFaults, SensorFaults};
use robots::guide::Guidance;
use robots::handoff::{
    Actuation, Belief, Command, Decision, Estimate, Goal, GuidanceStatus, Observation, Readings, ReplyOutcome,
};
use robots::map::MapObservation;
use robots::sense::{SensorRequests, SensorSuite, Surroundings};
use robots::vehicles::Battery;
use std::sync::Arc;
use world::clock::Clock;
use world::frames::{NOT_FINITE, Truth};
use world::physics::Physics;

pub(crate) fn read_instruments(
    clock: Res<Clock>,
    ocean: Res<Ocean>,
    light: Res<WaterLight>,
    mut robots: Query<(&mut OnboardTime, &Truth, &Decision, &mut SensorSuite, &mut SensorFaults, &mut Readings)>,
) {
    for (mut now, truth, decision, mut suite, mut faults, mut readings) in &mut robots {
        now.0 = *clock;
        let around = Surroundings {
            clock: &clock,
            truth,
            flow: &*ocean,
            dye: &ocean.dye(clock.t_s()),
            terrain: &ocean.terrain,
            obstacles: &ocean.obstacles,
            imaging: &*light.0,
            asked: SensorRequests::from(decision),
        };
        suite.read_into(&around, &mut readings);
        faults.alter(&clock, &mut readings);
    }
}

pub(crate) fn estimate_state(mut robots: Query<(&OnboardTime, &Readings, &mut DeadReckoning, &mut Estimate)>) {
    for (now, readings, mut estimator, mut estimate) in &mut robots {
        *estimate = estimator.step(&now.0, readings);
    }
}

pub(crate) fn update_map(
    clock: Res<Clock>,
    mut robots: Query<(&Readings, &Estimate, &Decision, &mut Mapping, &mut Belief)>,
) {
    for (readings, estimate, decision, mut mapping, mut belief) in &mut robots {
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
            *belief = Belief { outlook: belief.outlook.take(), ..new.clone() };
        }
        // What the strategy has asked in the tick before.
        if let Some(ways) = decision.ways
            && belief.outlook.as_ref().is_none_or(|known| known.ways != ways)
        {
            belief.outlook = mapping.mapper.outlook(&ways).map(Arc::new);
        }
    }
}

impl SearcherKind for Goal {
    type Inputs =
        (&'static Readings, &'static Estimate, &'static GuidanceStatus, &'static Briefing, Option<&'static Belief>);
    const WORDS: [&'static str; 2] = ["robot", "strategy"];

    fn see((readings, estimate, guidance, briefing, belief): &Inputs<Self>, told: Option<ReplyOutcome>) -> Observation {
        Observation {
            // The estimate is of this tick.
            t_s: estimate.t_s,
            estimate: **estimate,
            chemical: readings.chemical,
            sides: readings.sides,
            guidance: **guidance,
            area: briefing.area,
            home: briefing.home,
            able: briefing.able,
            belief: belief.cloned(),
            ranging: readings.ranging.clone(),
            sidescan: readings.sidescan.clone(),
            picture: readings.picture.clone(),
            dvl: readings.dvl,
            adcp: readings.adcp,
            ctd: readings.ctd,
            other: readings.other.clone(),
            told,
        }
    }

    fn gather(t_s: f64, (readings, ..): &Inputs<Self>, gathered: &mut ReadingsSince) {
        gathered.add(t_s, readings);
    }

    fn ask(seen: Observation, gathered: ReadingsSince) -> QuestionContent {
        QuestionContent::Robot(Box::new(seen), Box::new(gathered))
    }
}

pub(crate) fn guide(
    mut robots: Query<(
        &OnboardTime,
        &Estimate,
        &Decision,
        &Briefing,
        &mut Guidance,
        &mut Command,
        &mut GuidanceStatus,
    )>,
) {
    for (now, estimate, decision, briefing, mut guidance, mut command, mut status) in &mut robots {
        (*command, *status) = guidance.step(estimate, &decision.goal, &briefing.area, now.0.dt_s);
    }
}

type ActuateParts<'a> = (
    &'a OnboardTime,
    &'a Command,
    &'a Estimate,
    &'a mut Pilot,
    &'a mut DriveFaults,
    &'a mut Actuation,
    Option<&'a Battery>,
    &'a Hull,
);

pub(crate) fn actuate(mut robots: Query<ActuateParts>) {
    for (now, command, estimate, mut pilot, mut faults, mut set, battery, hull) in &mut robots {
        *set = pilot.step(command, estimate, now.0.dt_s);
        faults.alter(&now.0, &mut set);
        if battery.is_some_and(Battery::is_empty) {
            *set = hull.vehicle.idle();
        }
    }
}

type PushParts<'a> = (&'a OnboardTime, &'a Truth, &'a Actuation, &'a mut Hull, Option<&'a mut Battery>);

pub(crate) fn push_bodies(ocean: Res<Ocean>, mut physics: ResMut<Physics>, mut robots: Query<PushParts>) {
    // Each pushes its own body: their order does not matter.
    for (now, truth, set, mut hull, battery) in &mut robots {
        let (t_s, dt_s) = (now.0.t_s(), now.0.dt_s);
        let push = hull.vehicle.step(truth, &*ocean, t_s, set, dt_s);
        physics.push(hull.body, push);
        if let Some(mut battery) = battery {
            battery.use_w(hull.vehicle.power_w(), dt_s);
        }
    }
}

pub(crate) fn read_bodies(physics: Res<Physics>, mut robots: Query<(&OnboardTime, &SearcherId, &Hull, &mut Truth)>) {
    for (now, id, hull, mut truth) in &mut robots {
        *truth = physics.truth(hull.body);
        assert!(
            truth.is_finite(),
            "the state of robot {} {NOT_FINITE} after step {}: a force on it was not; check its parameters and the \
             water there",
            id.name,
            now.0.step
        );
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
