//! Puts a robot into the world.

use super::frame::Log;
use super::{Guiding, Hull, Instruments, Mapping, Navigation, Searching, Steering};
use crate::abnormal::Lookout;
use crate::scenario::{Beside, RobotSpec};
use crate::searchers::SearcherId;
use bevy_ecs::prelude::{Entity, World};
use nalgebra::Vector2;
use robots::actuate::Autopilot;
use robots::error::RobotError;
use robots::estimate::{Estimator, Start};
use robots::guide::Guidance;
use robots::handoff::{
    ActuatorCommand, Behaviour, Command, Decision, Goal, GuidanceStatus, Manoeuvre, Readings,
    Setting, Vertical,
};
use robots::sense::{OnBoard, SensorSuite};
use robots::vehicles::Vehicle;
use std::path::Path;
use world::clock::Clock;
use world::frames::{Pose, Truth};
use world::physics::Physics;
use world::seeds::{Seed, Stream};

/// Spawns it; its body goes into `physics`.
pub(crate) fn spawn(
    world: &mut World,
    physics: &mut Physics,
    spec: &RobotSpec,
    setting: &Setting,
    base_dir: &Path,
    seed: Seed,
    dt_s: f64,
) -> Result<Entity, RobotError> {
    let id = spec.id.as_str();
    let heading = spec.start.heading_deg.heading();
    let p_W = spec.start.p_W(&setting.bed);
    let mut truth = Truth::at_rest(Pose::level(p_W, heading));
    truth.v_WB_B.x = spec.start.speed_m_s.get();
    let vehicle = Vehicle::load(&spec.vehicle, &Beside(base_dir))?;
    let body = physics.add_body(vehicle.body_spec(id, truth));
    let suite = SensorSuite::new(
        &spec.sensors,
        &|name| vehicle.mount(name),
        OnBoard::new(id, seed, dt_s),
    )?;
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
        SearcherId(id.to_string()),
        truth,
        Hull { vehicle, body },
        Instruments(suite),
        Readings::default(),
        Navigation(Estimator::new(&spec.estimator, start, dt_s)),
        estimate,
        (
            Searching {
                strategy,
                rng: Stream::new(seed, id, "strategy"),
                home: fix,
            },
            Decision::new(Behaviour::Idle, goal),
            Guiding(Guidance::new(&spec.guidance)),
            Command::Direct(ActuatorCommand::default()),
            GuidanceStatus::default(),
            Steering(Autopilot::new(&spec.autopilot)),
            ActuatorCommand::default(),
            Log::default(),
            Lookout::default(),
        ),
    ));
    if let Some(mapper) = mapper {
        robot.insert((mapper.belief().clone(), Mapping(mapper)));
    }
    Ok(robot.id())
}
