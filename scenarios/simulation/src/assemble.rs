//! From a scenario to a world that ticks: everything that lives in it, put in its place.

use crate::abnormal::{Abnormals, Lookout};
use crate::frame::system::{Log, Outbox};
use crate::gantry::assemble as gantry;
use crate::gantry::system::outcome;
use crate::ocean::{Ocean, Origin};
use crate::scenario::{RobotSpec, Scenario};
use crate::score::Score;
use crate::system::{
    Cartographer, Dye, Helm, Hull, Instruments, Mind, Navigator, Pilotage, RobotId, Roster, Water,
    whole,
};
use crate::tick::tick;
use bevy_ecs::prelude::{Component, Entity, Schedule, World};
use nalgebra::{Vector2, Vector3};
use plumes::error::PlumeError;
use plumes::filaments::Plume;
use robots::actuate::Autopilot;
use robots::error::RobotError;
use robots::estimate::{Estimator, Start};
use robots::guide::Guidance;
use robots::handoff::{
    ActuatorCommand, Behaviour, Command, Decision, GantryDecision, Goal, GuidanceStatus, Manoeuvre,
    Outcome, Readings, Setting, Vertical,
};
use robots::sense::SensorSuite;
use robots::sense::camera::Optics;
use robots::vehicles::Vehicle;
use std::path::Path;
use world::clock::{Clock, Every};
use world::digest::Digest;
use world::error::WorldError;
use world::fields::Flow;
use world::frames::{Pose, Truth};
use world::physics::Physics;
use world::seeds::Stream;

/// Why a scenario that could be read cannot be assembled.
#[derive(Debug, thiserror::Error)]
pub enum AssembleError {
    /// Terrain or obstacles.
    #[error(transparent)]
    World(#[from] WorldError),
    /// Water or sources.
    #[error(transparent)]
    Plume(#[from] PlumeError),
    /// Light in the water.
    #[error(transparent)]
    Optics(RobotError),
    /// A robot.
    #[error("robot {id}: {source}")]
    Robot {
        /// Which.
        id: String,
        /// What is wrong.
        source: RobotError,
    },
}

/// A scenario brought to life: the ECS world and the tick that moves it.
pub struct Simulation {
    /// All entities and resources.
    pub world: World,
    tick: Schedule,
    pub(crate) origin: Origin,
}

impl Simulation {
    /// Puts everything in its place; mission time is zero, the plume not yet released.
    ///
    /// # Errors
    /// When a part of the scenario cannot be built; what [`crate::scenario::check`] passes can.
    pub fn assemble(
        scenario: &Scenario,
        base_dir: &Path,
        seed: u64,
    ) -> Result<Self, AssembleError> {
        let dt_s = scenario.time.step_s.get();
        let origin = Origin::of(scenario, base_dir, seed);
        let Ocean {
            area,
            terrain,
            obstacles,
            water,
            plume,
        } = origin.build(base_dir)?;
        let optics = Optics::new(&scenario.optics).map_err(AssembleError::Optics)?;
        let mut physics = Physics::new(dt_s);
        physics.add_terrain(&terrain, &area);
        for obstacle in &obstacles.0 {
            physics.add_obstacle(obstacle);
        }

        let mut world = World::new();
        let mut roster = Roster::default();
        for spec in &scenario.robots {
            let robot = spawn(
                &mut world,
                &mut physics,
                spec,
                &spec.setting(&area, &terrain, &obstacles),
                base_dir,
                seed,
                dt_s,
            )
            .map_err(|source| AssembleError::Robot {
                id: spec.id.as_str().to_string(),
                source,
            })?;
            roster.robots.push(robot);
        }
        for block in &scenario.gantries {
            let gantry = gantry::spawn(&mut world, &mut physics, block, &terrain, base_dir, seed)
                .map_err(|source| AssembleError::Robot {
                id: block.id.as_str().to_string(),
                source,
            })?;
            roster.gantries.push(gantry);
        }
        let every = |period_s: f64| Every::period(period_s, dt_s);
        world.insert_resource(Clock::new(dt_s));
        world.insert_resource(area);
        world.insert_resource(obstacles);
        world.insert_resource(Water {
            flow: water,
            t0_s: origin.spin_up_s(),
        });
        let robots = scenario.robots.iter().map(|r| &r.id);
        let ids = robots.chain(scenario.gantries.iter().map(|g| &g.id));
        world.insert_resource(Score::new(
            plume.sources().iter().map(|s| s.p_W).collect(),
            ids.map(|id| id.as_str().to_string()),
        ));
        world.insert_resource(roster);
        world.insert_resource(Dye {
            plume,
            every: every(scenario.time.drift_period_s.get()),
        });
        world.insert_resource(Outbox {
            frame: None,
            plume: None,
            pictures: Vec::new(),
            pings: Vec::new(),
            frame_every: every(scenario.record.frame_period_s.get()),
            plume_every: every(scenario.record.plume_period_s.get()),
            plume_points: scenario.record.plume_points as usize,
        });
        world.insert_resource(optics);
        world.insert_resource(terrain);
        world.insert_resource(physics);
        world.insert_resource(Digest::default());
        world.insert_resource(Abnormals::default());
        Ok(Self {
            world,
            tick: tick(),
            origin,
        })
    }

    /// Lets the plume develop before the mission. `heard` is told the share done after every drift
    /// and may end it early by answering `false`.
    pub fn spin_up(&mut self, mut heard: impl FnMut(f64) -> bool) {
        if self.world.resource::<Dye>().plume.sources().is_empty() {
            let mut water = self.world.resource_mut::<Water>();
            water.flow.advance(self.origin.spin_up_s());
            return;
        }
        let (steps, dt_s) = self.origin.spin_up_steps();
        for n in 0..steps {
            let (t0, t1) = (n as f64 * dt_s, (n + 1) as f64 * dt_s);
            self.world.resource_scope::<Water, ()>(|world, mut water| {
                water.flow.advance(t1);
                world.resource_mut::<Dye>().plume.drift(&water.flow, t0, t1);
            });
            if !heard((n + 1) as f64 / steps as f64) {
                return;
            }
        }
    }

    /// Copies of water and plume as they are.
    #[must_use]
    pub fn water_and_plume(&self) -> (plumes::flow::Water, Plume) {
        let (water, dye) = (self.world.resource::<Water>(), self.world.resource::<Dye>());
        (water.flow.clone(), dye.plume.clone())
    }

    /// Puts water and plume of another simulation in the place of its own, which must be alike in all
    /// that makes them: [`crate::trial::Trial::take_over`] sees to that.
    pub fn put_water_and_plume(&mut self, flow: plumes::flow::Water, plume: Plume) {
        self.world.resource_mut::<Water>().flow = flow;
        self.world.resource_mut::<Dye>().plume = plume;
    }

    /// One tick.
    pub fn tick(&mut self) {
        self.tick.run(&mut self.world);
    }

    /// Mission time, s.
    #[must_use]
    pub fn t_s(&self) -> f64 {
        self.world.resource::<Clock>().t_s()
    }

    /// Flow at a point (ENU, m) now, m/s.
    #[must_use]
    pub fn velocity(&self, p_W: &Vector3<f64>) -> Vector3<f64> {
        self.world.resource::<Water>().velocity(p_W, self.t_s())
    }

    /// How each robot's and then each gantry's mission ended, in the scenario's order; `None` while it lasts.
    pub fn outcomes(&self) -> impl Iterator<Item = Option<Outcome>> {
        let (world, roster) = (&self.world, self.world.resource::<Roster>());
        let robots = roster
            .robots
            .iter()
            .map(|robot| part::<Decision>(world, *robot).outcome);
        let gantries = roster.gantries.iter();
        robots.chain(gantries.map(|gantry| outcome(part::<GantryDecision>(world, *gantry))))
    }
}

fn part<C: Component>(world: &World, of: Entity) -> &C {
    whole(world.get(of).ok_or(of))
}

fn spawn(
    world: &mut World,
    physics: &mut Physics,
    spec: &RobotSpec,
    setting: &Setting,
    base_dir: &Path,
    seed: u64,
    dt_s: f64,
) -> Result<Entity, RobotError> {
    let id = spec.id.as_str();
    let heading = spec.start.heading_deg.heading();
    let p_W = spec.start.p_W(&setting.bed);
    let mut truth = Truth::at_rest(Pose::level(p_W, heading));
    truth.v_WB_B.x = spec.start.speed_m_s.get();
    let vehicle = Vehicle::load(&spec.vehicle, base_dir)?;
    let body = physics.add_body(vehicle.body_spec(id, truth));
    let suite = SensorSuite::new(&spec.sensors, &|name| vehicle.mount(name), id, seed, dt_s)?;
    let fix_noise_m = spec.start.fix_noise_m.get();
    let mut rng = Stream::new(seed, id, "launch fix");
    let fix = p_W.xy() + Vector2::from_fn(|_, _| rng.normal()) * fix_noise_m;
    let start = Start {
        position: fix,
        heading,
        depth_m: -p_W.z,
    };
    // A first belief from the launch data alone; the navigator itself starts fresh at the first tick.
    let estimate =
        Estimator::new(&spec.estimator, start, dt_s).step(&Clock::new(dt_s), &Readings::default());
    let goal = Goal {
        id: 0,
        manoeuvre: Manoeuvre::Course { course: heading },
        vertical: Vertical::Depth(-p_W.z),
        speed_m_s: 0.0,
    };
    let strategy = spec.strategy.build(setting)?;
    let mapper = (spec.map.as_ref())
        .map(|map| map.build(&setting.area, Stream::new(seed, id, "map")))
        .transpose()?;
    let mut robot = world.spawn((
        RobotId(id.to_string()),
        truth,
        Hull { vehicle, body },
        Instruments(suite),
        Readings::default(),
        Navigator(Estimator::new(&spec.estimator, start, dt_s)),
        estimate,
        (
            Mind {
                strategy,
                rng: Stream::new(seed, id, "strategy"),
                home: fix,
            },
            Decision {
                behaviour: Behaviour::Idle,
                goal,
                declared: None,
                lost_points: Vec::new(),
                planned: std::sync::Arc::default(),
                regions: Default::default(),
                layers: Default::default(),
                picture: false,
                outcome: None,
            },
            Pilotage(Guidance::new(&spec.guidance)),
            Command::Direct(ActuatorCommand::default()),
            GuidanceStatus::default(),
            Helm(Autopilot::new(&spec.autopilot)),
            ActuatorCommand::default(),
            Log::default(),
            Lookout::default(),
        ),
    ));
    if let Some(mapper) = mapper {
        robot.insert((mapper.belief().clone(), Cartographer(mapper)));
    }
    Ok(robot.id())
}
