//! The systems of the tick: each hands the parts of a robot, and the world, to plain state machines.

use bevy_ecs::prelude::{Component, DetectChanges, Entity, Query, Ref, Res, ResMut, Resource};
use nalgebra::{Vector2, Vector3};
use plumes::filaments::{Displaced, Plume};
use robots::actuate::Autopilot;
use robots::estimate::Estimator;
use robots::guide::Guidance;
use robots::handoff::{
    ActuatorCommand, Belief, Command, Decision, Estimate, GuidanceStatus, Observation, Readings,
};
use robots::map::{MapObservation, Mapper};
use robots::sense::camera::Optics;
use robots::sense::{Around, Asked, SensorSuite};
use robots::strategy::Strategy;
use robots::vehicles::Vehicle;
use world::area::Area;
use world::clock::{Clock, Every};
use world::digest::Digest;
use world::fields::{Flow, Mixing, WaterSample};
use world::frames::Truth;
use world::obstacles::Obstacles;
use world::physics::{BodyId, Physics};
use world::seeds::Stream;
use world::terrain::Terrain;

/// All searchers, each in the scenario's order: systems whose order can be seen (digest, frames, score, the physics' input) go by it, not by
/// the order in which they happen to be stored.
#[derive(Resource, Clone, Debug, Default)]
pub struct Roster {
    /// Robots.
    pub robots: Vec<Entity>,
    /// Gantries.
    pub gantries: Vec<Entity>,
}

/// The parts of somebody on the roster: nobody leaves it while the run lasts.
pub(crate) fn whole<T, E: std::fmt::Debug>(parts: Result<T, E>) -> T {
    parts.expect("who is on the roster is alive and has all parts: spawn it with them")
}

/// Name of a robot in the scenario.
#[derive(Component, Clone, Debug)]
pub struct RobotId(pub String);

/// A robot's vehicle and its body in the physics.
#[derive(Component)]
pub struct Hull {
    /// Dynamics and actuators.
    pub vehicle: Vehicle,
    /// Body it moves.
    pub body: BodyId,
}

/// A robot's instruments.
#[derive(Component)]
pub struct Instruments(pub SensorSuite);

/// A robot's navigation.
#[derive(Component)]
pub struct Navigator(pub Estimator);

/// A robot's strategy with the random stream it holds.
#[derive(Component)]
pub struct Mind {
    /// What decides.
    pub strategy: Box<dyn Strategy>,
    /// Its random numbers.
    pub rng: Stream,
    /// Where it was launched, as its navigation had it.
    pub home: Vector2<f64>,
}

/// A robot's mapper.
#[derive(Component)]
pub struct Cartographer(pub Box<dyn Mapper>);

/// A robot's guidance.
#[derive(Component)]
pub struct Pilotage(pub Guidance);

/// A robot's autopilot.
#[derive(Component)]
pub struct Helm(pub Autopilot);

/// The water with the time at which the mission starts in it.
#[derive(Resource)]
pub struct Water {
    /// The one flow for everything.
    pub flow: plumes::flow::Water,
    /// Age of the water at mission time zero (the spin-up), s.
    pub t0_s: f64,
}

impl Flow for Water {
    fn advance(&mut self, t_s: f64) {
        self.flow.advance(t_s + self.t0_s);
    }
    fn velocity(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
        self.flow.velocity(p, t_s + self.t0_s)
    }
    fn density(&self, p: &Vector3<f64>, t_s: f64) -> f64 {
        self.flow.density(p, t_s + self.t0_s)
    }
    fn mixing(&self, p: &Vector3<f64>, t_s: f64) -> Mixing {
        self.flow.mixing(p, t_s + self.t0_s)
    }
    fn column(
        &self,
        place: Vector2<f64>,
        heights_m: &[f64],
        t_s: f64,
        out: &mut [(Vector3<f64>, Mixing)],
    ) {
        Flow::column(&self.flow, place, heights_m, t_s + self.t0_s, out);
    }
    fn displacement(&self, p: &Vector3<f64>, t_s: f64) -> Option<Vector3<f64>> {
        self.flow.displacement(p, t_s + self.t0_s)
    }
    fn head(&self, p: &Vector3<f64>, t_s: f64) -> f64 {
        self.flow.head(p, t_s + self.t0_s)
    }
    fn sample(&self, p: &Vector3<f64>, t_s: f64) -> WaterSample {
        self.flow.sample(p, t_s + self.t0_s)
    }
}

/// The plume and how often it drifts.
#[derive(Resource)]
pub struct Dye {
    /// Filaments of all sources.
    pub plume: Plume,
    /// Steps between two drifts.
    pub every: Every,
}

pub(crate) fn read_instruments(
    clock: Res<Clock>,
    water: Res<Water>,
    dye: Res<Dye>,
    terrain: Res<Terrain>,
    obstacles: Res<Obstacles>,
    optics: Res<Optics>,
    mut robots: Query<(&Truth, &Decision, &mut Instruments, &mut Readings)>,
) {
    for (truth, decision, mut suite, mut readings) in &mut robots {
        let asked = Asked::from(decision);
        let plume = Displaced::new(&dye.plume, &*water, clock.t_s());
        *readings = (suite.0).read(&Around {
            clock: &clock,
            truth,
            flow: &*water,
            dye: &plume,
            terrain: &terrain,
            obstacles: &obstacles,
            optics: &optics,
            asked,
        });
    }
}

pub(crate) fn estimate_state(
    clock: Res<Clock>,
    mut robots: Query<(&Readings, &mut Navigator, &mut Estimate)>,
) {
    for (readings, mut navigator, mut estimate) in &mut robots {
        *estimate = navigator.0.step(&clock, readings);
    }
}

pub(crate) fn update_map(
    clock: Res<Clock>,
    mut robots: Query<(&Readings, &Estimate, &mut Cartographer, &mut Belief)>,
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
    &'a mut Mind,
    &'a mut Decision,
);

pub(crate) fn decide(clock: Res<Clock>, area: Res<Area>, mut robots: Query<Deciding>) {
    for (readings, estimate, guidance, belief, mut mind, mut decision) in &mut robots {
        let seen = Observation {
            t_s: clock.t_s(),
            estimate: *estimate,
            chemical: readings.chemical,
            guidance: *guidance,
            area: *area,
            home: mind.home,
            belief: belief.cloned(),
            ranging: readings.ranging.clone(),
            sidescan: readings.sidescan.clone(),
            picture: readings.picture.clone(),
            other: readings.other.clone(),
        };
        let mind = &mut *mind;
        *decision = mind.strategy.step(&seen, &mut mind.rng);
    }
}

pub(crate) fn guide(
    clock: Res<Clock>,
    area: Res<Area>,
    mut robots: Query<(
        &Estimate,
        &Decision,
        &mut Pilotage,
        &mut Command,
        &mut GuidanceStatus,
    )>,
) {
    for (estimate, decision, mut pilotage, mut command, mut status) in &mut robots {
        (*command, *status) = pilotage.0.step(estimate, &decision.goal, &area, clock.dt_s);
    }
}

pub(crate) fn actuate(
    clock: Res<Clock>,
    mut robots: Query<(&Command, &Estimate, &mut Helm, &mut ActuatorCommand)>,
) {
    for (command, estimate, mut helm, mut set) in &mut robots {
        *set = helm.0.step(command, estimate, clock.dt_s);
    }
}

pub(crate) fn move_bodies(
    clock: Res<Clock>,
    water: Res<Water>,
    roster: Res<Roster>,
    mut physics: ResMut<Physics>,
    mut robots: Query<(&RobotId, &ActuatorCommand, &mut Hull, &mut Truth)>,
) {
    let mut each = robots.iter_many_mut(&roster.robots);
    while let Some((_, set, mut hull, truth)) = each.fetch_next().map(whole) {
        let sample = water.sample(&truth.pose.p_WB, clock.t_s());
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

pub(crate) fn drift_plume(clock: Res<Clock>, mut water: ResMut<Water>, mut dye: ResMut<Dye>) {
    let t1 = clock.t_next_s();
    water.advance(t1);
    if (clock.step + 1).is_multiple_of(dye.every.steps) {
        let t0 = t1 - dye.every.period_s(clock.dt_s);
        let t0_s = water.t0_s;
        dye.plume.drift(&water.flow, t0 + t0_s, t1 + t0_s);
    }
}

type Digested<'a> = (
    &'a Truth,
    &'a Estimate,
    &'a Decision,
    &'a ActuatorCommand,
    Option<Ref<'a, Belief>>,
);

pub(crate) fn digest_state(
    clock: Res<Clock>,
    dye: Res<Dye>,
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
    if (clock.step + 1).is_multiple_of(dye.every.steps) {
        dye.plume.digest_into(&mut digest);
    }
}

pub(crate) fn pass_time(mut clock: ResMut<Clock>) {
    clock.advance();
}
