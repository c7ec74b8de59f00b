//! From a scenario to a world that ticks: everything that lives in it, put in its place.

use crate::abnormal::Abnormals;
use crate::auv::assemble as auv;
use crate::error::AssembleError;
use crate::frame::system::Outbox;
use crate::gantry::assemble as gantry;
use crate::gantry::system::outcome;
use crate::ocean::{DriftEvery, Ocean, Origin};
use crate::scenario::Scenario;
use crate::score::Score;
use crate::searchers::{Roster, part};
use crate::tick::tick;
use bevy_ecs::prelude::{Mut, Schedule, World};
use nalgebra::Vector3;
use robots::handoff::{Decision, GantryDecision, Outcome};
use robots::sense::camera::Optics;
use std::path::Path;
use world::clock::{Clock, Every};
use world::digest::Digest;
use world::fields::Flow;
use world::physics::Physics;
use world::seeds::Seed;

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
        seed: impl Into<Seed>,
    ) -> Result<Self, AssembleError> {
        let seed = seed.into();
        let dt_s = scenario.time.step_s.get();
        let origin = Origin::of(scenario, base_dir, seed);
        let ocean = origin.build(base_dir)?;
        let optics = Optics::new(&scenario.optics).map_err(AssembleError::Optics)?;
        let mut physics = Physics::new(dt_s);
        physics.add_terrain(&ocean.terrain, &ocean.area);
        for obstacle in &ocean.obstacles.0 {
            physics.add_obstacle(obstacle);
        }

        let mut world = World::new();
        let mut roster = Roster::default();
        for spec in &scenario.robots {
            let setting = spec.setting(&ocean.area, &ocean.terrain, &ocean.obstacles);
            let robot = auv::spawn(
                &mut world,
                &mut physics,
                spec,
                &setting,
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
            let gantry = gantry::spawn(
                &mut world,
                &mut physics,
                block,
                &ocean.terrain,
                base_dir,
                seed,
            )
            .map_err(|source| AssembleError::Robot {
                id: block.id.as_str().to_string(),
                source,
            })?;
            roster.gantries.push(gantry);
        }
        let every = |period_s: f64| Every::period(period_s, dt_s);
        world.insert_resource(Clock::new(dt_s));
        let robots = scenario.robots.iter().map(|r| &r.id);
        let ids = robots.chain(scenario.gantries.iter().map(|g| &g.id));
        world.insert_resource(Score::new(
            ocean.plume().sources().iter().map(|s| s.p_W).collect(),
            ids.map(|id| id.as_str().to_string()),
        ));
        world.insert_resource(roster);
        world.insert_resource(DriftEvery(every(scenario.time.drift_period_s.get())));
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
        world.insert_resource(ocean);
        world.insert_resource(physics);
        world.insert_resource(Digest::default());
        world.insert_resource(Abnormals::default());
        Ok(Self {
            world,
            tick: tick(),
            origin,
        })
    }

    /// The ocean as it is.
    #[must_use]
    pub fn ocean(&self) -> &Ocean {
        self.world.resource()
    }

    /// The ocean, to let it develop before the mission.
    pub fn ocean_mut(&mut self) -> Mut<'_, Ocean> {
        self.world.resource_mut()
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
        self.ocean().velocity(p_W, self.t_s())
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
