//! Brings robots into a run.

use super::report::system as kept;
use super::shown::system as shown;
use super::vehicle_pool::{VehiclePool, build};
use super::{Briefing, Hull, Log, Mapping, system};
use crate::control::exchanges::ExchangeState;
use crate::error::AssembleError;
use crate::incidents::{FaultLog, IncidentMonitor};
use crate::machines::system as common;
use crate::machines::{BodiesMove, Launch, Machine, NewSearcher, Systems};
use crate::ocean::Ocean;
use crate::ocean::system::digest_plume;
use crate::scenario::RobotSpec;
use crate::searchers::Roster;
use bevy_ecs::prelude::{IntoScheduleConfigs, World};
use nalgebra::Vector2;
use robots::actuate::Pilot;
use robots::error::RobotError;
use robots::estimate::Start;
use robots::faults::{DriveFaults, SensorFaults, mistakes};
use robots::guide::Guidance;
use robots::handoff::{
    ActuatorCommand, Behaviour, Command, Decision, Goal, GuidanceStatus, Manoeuvre, Readings, Vertical,
};
use robots::sense::{OnBoard, SensorSuite};
use robots::strategy::Setting;
use robots::vehicles::Battery;
use world::catalogue::Entry;
use world::clock::Clock;
use world::frames::{Pose, Truth};
use world::physics::Physics;
use world::registry::Listed;
use world::seeds::Stream;
use world::stage::Stage;

impl Listed for RobotSpec {
    const ENTRY: Entry =
        Entry { name: "Auv", what: "An underwater vehicle that moves freely in the water", source: "Pang 2009" };
}

impl Machine for RobotSpec {
    fn id(&self) -> &str {
        self.id.as_str()
    }

    fn spawn(&self, world: &mut World, launch: &Launch) -> Result<(), AssembleError> {
        let ocean = world.resource::<Ocean>();
        let setting = self.setting(&ocean.area, &ocean.terrain, &ocean.obstacles);
        spawn(self, &setting, world, launch)
            .map_err(|source| AssembleError::Robot { id: self.id.as_str().to_string(), source })
    }

    fn systems(&self, systems: &mut Systems) {
        systems.add(Stage::Sense, system::read_instruments).add_blind(Stage::Estimate, system::estimate_state);
        if systems.has::<Mapping>() {
            systems.add_blind(Stage::Map, system::update_map);
        }
        if systems.has::<ExchangeState>() {
            systems.add_blind_after(Stage::Map, common::ask::<Goal>, system::update_map);
        }
        systems
            .add_blind(Stage::Decide, common::decide::<Goal>)
            .add_blind(Stage::Guide, system::guide)
            .add_blind(Stage::Actuate, system::actuate)
            .add(Stage::Physics, (system::push_bodies.before(BodiesMove), system::read_bodies.after(BodiesMove)))
            .add_to_frame(shown::picture);
        if systems.has_frames() {
            let report = kept::report_and_log.before(digest_plume);
            systems.add(Stage::Report, report);
        } else {
            systems.add(Stage::Report, kept::report.before(digest_plume));
        }
        if systems.has::<FaultLog>() {
            let tell = system::tell_faults.after(kept::report);
            systems.add(Stage::Report, tell.after(kept::report_and_log));
        }
    }
}

fn spawn(spec: &RobotSpec, setting: &Setting, world: &mut World, launch: &Launch) -> Result<(), RobotError> {
    let id = spec.id.as_str();
    let Launch { base_dir, seed, dt_s } = *launch;
    let heading = spec.start.heading_deg.heading();
    let p_W = spec.start.p_W(&setting.bed);
    let mut truth = Truth::at_rest(Pose::level(p_W, heading));
    truth.v_WB_B.x = spec.start.speed_m_s.get();
    let turn_m = spec.guidance.tightest_turn_m();
    let (vehicle, able) = match world.get_resource_mut::<VehiclePool>() {
        Some(mut yard) => yard.take(&spec.vehicle, turn_m, base_dir),
        None => build(&spec.vehicle, turn_m, base_dir),
    }?;
    let body = (world.resource_mut::<Physics>()).add_body(vehicle.body_spec(id, truth));
    let suite = SensorSuite::new(&spec.sensors, &|name| vehicle.mount(name), OnBoard::new(id, seed, dt_s))?;
    let carried = vehicle.is_carried();
    let pilot = Pilot::new(&spec.autopilot, &vehicle.control(), spec.start.speed_m_s.get());
    let still = vehicle.idle();
    let drives = vehicle.named_drives();
    if let Some(mistake) = mistakes(&spec.faults, &spec.sensors, Some(&drives)).first() {
        return Err(RobotError::Invalid { field: mistake.field.clone(), problem: mistake.problem.clone() });
    }
    let fix_noise_m = spec.start.fix_noise_m.get();
    let mut rng = Stream::new(seed, id, "launch fix");
    let fix = p_W.xy() + Vector2::from_fn(|_, _| rng.normal()) * fix_noise_m;
    let start = Start { position: fix, heading, depth_m: -p_W.z };
    // A first estimate from the data of the launch alone; the estimator itself starts with the first tick.
    let estimate = spec.estimator.build(start, dt_s).step(&Clock::new(dt_s), &Readings::default());
    let goal = Goal {
        id: 0,
        manoeuvre: Manoeuvre::Course { course: heading },
        vertical: Vertical::Depth(-p_W.z),
        speed_m_s: 0.0,
    };
    let searcher = NewSearcher {
        id,
        strategy: spec.strategy.build(setting)?,
        name: spec.strategy.name(),
        is_own: spec.strategy.is_own(),
        first: Decision::new(Behaviour::Idle, goal),
        consulted: spec.strategy.about().consulted,
        drives: Some(still.named().count()),
    };
    let mapper = (spec.map.as_ref()).map(|map| map.build(&setting.area, Stream::new(seed, id, "map"))).transpose()?;
    let machine = (
        truth,
        Hull { vehicle: Box::new(vehicle), body },
        suite,
        Readings::default(),
        spec.estimator.build(start, dt_s),
        estimate,
        (
            Briefing { area: setting.area, home: fix, able },
            Guidance::new(&spec.guidance).carried(carried).hovering(able.hovers).turning(able.turning_radius_m),
            Command::Direct(ActuatorCommand::default()),
            GuidanceStatus::default(),
            pilot,
            still,
            Log::default(),
            IncidentMonitor::default(),
        ),
        (SensorFaults::new(&spec.faults, &spec.sensors, dt_s), DriveFaults::new(&spec.faults, dt_s, &drives)),
    );
    let robot = searcher.join(world, launch, machine);
    world.resource_mut::<Roster>().robots.push(robot);
    let mut robot = world.entity_mut(robot);
    if !spec.faults.is_empty() {
        robot.insert(FaultLog::new(&spec.faults, dt_s));
    }
    if let Some(mapper) = mapper {
        let belief = mapper.belief().clone();
        let digested = None;
        robot.insert((belief, Mapping { mapper, digested }));
    }
    if let Some(energy) = &spec.energy {
        robot.insert(Battery::new(energy));
    }
    Ok(())
}
