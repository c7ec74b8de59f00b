//! Steps of a vehicle alone, with and without a look for contacts, and of a gantry. `cargo bench -p rheotaxis-robots --bench
//! vehicle`

use divan::Bencher;
use nalgebra::{Matrix3, Vector2, Vector3};
use robots::handoff::{Actuation, ActuatorCommand, Behaviour, Decision, HeadGoal};
use robots::vehicles::{Gantry, GantrySpec, InMemory, ParameterSet, RemusSpec, Vehicle, VehicleSpec};
use world::area::Area;
use world::fields::WaterSample;
use world::frames::{Pose, Truth};
use world::physics::{Physics, Solver};
use world::seeds::Stream;
use world::terrain::Terrain;
use world::units::Heading;

const STEPS: u32 = 1000;
const STEP_S: f64 = 0.02;

fn main() {
    divan::main();
}

fn water() -> WaterSample {
    WaterSample {
        velocity: Vector3::new(0.1, -0.2, 0.0),
        gradient: Matrix3::zeros(),
        rate: Vector3::zeros(),
        density_kg_m3: 1026.0,
    }
}

fn start() -> Truth {
    Truth::at_rest(Pose::level(Vector3::new(0.0, 0.0, -4.0), Heading::from_deg(70.0)))
}

fn auv(parameters: ParameterSet) -> Vehicle {
    let spec = VehicleSpec::Remus100(RemusSpec { parameters, ..RemusSpec::default() });
    Vehicle::load(&spec, &InMemory::default()).expect("built-in vehicle")
}

const TURN: Actuation = Actuation::Fins(ActuatorCommand { rudder_rad: 0.1, stern_rad: 0.0, rpm: 1200.0 });

/// 1000 steps of the equation of motion only.
#[divan::bench(args = [ParameterSet::Remus100, ParameterSet::Reference])]
fn equation_only(bencher: Bencher, set: ParameterSet) {
    let mut vehicle = auv(set);
    let mut truth = start();
    bencher.counter(divan::counter::ItemsCount::new(STEPS)).bench_local(|| {
        for _ in 0..STEPS {
            truth = vehicle.step_in(&truth, &water(), &TURN, STEP_S);
        }
    });
}

/// 1000 steps over the bed at Duck, 2 m above it.
#[divan::bench(args = [Solver::WhenInReach, Solver::Always])]
fn with_physics(bencher: Bencher, solver: Solver) {
    let mut vehicle = auv(ParameterSet::Remus100);
    let mut physics = Physics::new(STEP_S).with_solver(solver);
    let area =
        Area { centre: nalgebra::Vector2::zeros(), length_m: 1094.0, width_m: 367.0, axis: Heading::from_deg(340.0) };
    let bed = Terrain::sloping_over(&area, Heading::from_deg(250.0), 4.0, 8.0);
    physics.add_terrain(&bed, &area);
    let id = physics.add_body(vehicle.body_spec("auv", start()));
    let level = WaterSample { velocity: Vector3::zeros(), ..water() };
    bencher.counter(divan::counter::ItemsCount::new(STEPS)).bench_local(|| {
        physics.set_truth(id, start());
        for _ in 0..STEPS {
            let free = vehicle.step_in(&physics.truth(id), &level, &TURN, STEP_S);
            physics.push(id, free);
            physics.step();
        }
    });
}

/// 1000 steps of the gantry, drives and joints, in sight of the bed; diagonal steps to and fro.
#[divan::bench]
fn gantry(bencher: Bencher) {
    let mut gantry = Gantry::load(&GantrySpec::default(), &InMemory::default()).expect("built in");
    let mut physics = Physics::new(STEP_S);
    let area = Area { centre: Vector2::zeros(), length_m: 24.0, width_m: 1.07, axis: Heading::from_deg(90.0) };
    let bed = Terrain::sloping_over(&area, Heading::from_deg(0.0), 0.2, 0.2);
    physics.add_terrain(&bed, &area);
    let base = Pose::level(Vector3::new(0.0, 0.0, -0.2), Heading::from_deg(270.0));
    let body = gantry.body_spec("gantry", &base, Vector2::new(0.5, 0.0));
    let id = physics.add_gantry(body.expect("inside its travel"));
    let mut rng = Stream::new(1, "gantry", "drives");
    let speed_m_s = Vector2::new(0.061, 0.03);
    let mut decision = Decision::new(Behaviour::StepUp, HeadGoal { speed_m_s, ..HeadGoal::default() });
    bencher.counter(divan::counter::ItemsCount::new(STEPS)).bench_local(|| {
        for i in 0..STEPS {
            if i % 100 == 0 {
                decision.goal.id += 1;
                let side = if decision.goal.id.is_multiple_of(2) { 1.0 } else { -1.0 };
                decision.goal.target_m = Vector2::new(1.0 + 0.05 * side, 0.025 * side);
            }
            let joints = physics.joints(id);
            let drives = gantry.drive(&decision, &joints, STEP_S, &mut rng);
            physics.drive(id, drives);
            physics.step();
            divan::black_box(gantry.readings(&physics.joints(id)));
        }
    });
}
