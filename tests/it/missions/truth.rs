//! No searcher reads the truth: behind the instruments it is scrambled, and every decision stays as it was.

use crate::common::lasting;
use bevy_ecs::prelude::{Query, Resource, World};
use nalgebra::{UnitQuaternion, Vector3};
use rheotaxis::extend::{Extend, Systems};
use rheotaxis::ocean::Ocean;
use robots::handoff::Command;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use studies::arena::{Contest, Family, campaign, families, searchers};
use studies::campaign::{RunOptions, read_rows, run};
use world::frames::Truth;
use world::physics::Physics;
use world::registry::Registry;
use world::seeds::Key;
use world::stage::Stage;

/// The truth while it is hidden.
#[derive(Resource, Default)]
struct Hidden {
    states: Vec<Truth>,
    physics: Option<Physics>,
    ocean: Option<Ocean>,
}

/// After the instruments have read: every state is another one, and there are neither water, plume nor bodies.
fn scramble(world: &mut World) {
    let mut hidden = Hidden { physics: world.remove_resource(), ocean: world.remove_resource(), ..Hidden::default() };
    assert!(hidden.physics.is_some() && hidden.ocean.is_some(), "there is something to hide");
    for mut truth in world.query::<&mut Truth>().iter_mut(world) {
        hidden.states.push(*truth);
        truth.pose.p_WB = truth.pose.p_WB * -3.0 + Vector3::new(17.0, -40.0, -3.0);
        truth.pose.R_WB *= UnitQuaternion::from_euler_angles(0.1, 0.2, 2.0);
        truth.v_WB_B = -truth.v_WB_B;
        truth.w_WB_B = Vector3::new(0.3, 0.2, 0.1);
    }
    world.insert_resource(hidden);
}

/// Between the halves of a tick the ocean goes to other lanes. That no system of a decision may so much as name it is
/// checked where systems are added (`Systems::add_blind`).
fn give_ocean_back(world: &mut World) {
    let ocean = world.resource_mut::<Hidden>().ocean.take().expect("hidden before");
    world.insert_resource(ocean);
}

/// The motors of a gantry are set in the bodies themselves.
fn give_bodies_back(world: &mut World) {
    let physics = world.resource_mut::<Hidden>().physics.take().expect("hidden before");
    world.insert_resource(physics);
}

/// Before the physics: all is as it was.
fn restore(world: &mut World) {
    let hidden = world.remove_resource::<Hidden>().expect("scrambled before");
    let mut states = hidden.states.into_iter();
    for mut truth in world.query::<&mut Truth>().iter_mut(world) {
        *truth = states.next().expect("as many as before");
    }
}

fn scrambled(registry: Registry) -> Registry {
    registry.with_systems(|systems: &mut Systems| {
        systems.add(Stage::Sense, scramble).add(Stage::Map, give_ocean_back);
        systems.add(Stage::Guide, give_bodies_back).add(Stage::Actuate, restore);
    })
}

/// A searcher that looks where it truly is, which no type of ours lets a strategy do.
fn cheat(mut robots: Query<(&Truth, &mut Command)>) {
    for (truth, mut command) in &mut robots {
        if let Command::Steer(set) = &mut *command {
            set.water_speed_m_s = 1.0 + 0.1 * (truth.pose.p_WB.x * 0.1).fract().abs();
        }
    }
}

fn cheating(registry: Registry) -> Registry {
    registry.with_systems(|systems: &mut Systems| {
        systems.add(Stage::Guide, cheat);
    })
}

/// Digests of one seed of a family, short, by searcher; and how many of them met dye.
fn digests(registry: &Registry, family: &str, asked: &[String]) -> (Vec<(String, String)>, usize) {
    let family = families(registry, &[PathBuf::from(family)]).unwrap().remove(0);
    let family = Family { base: lasting(family.base, 600.0, 120.0), ..family };
    let contest = Contest { seeds: Some(1), first_seed: 700_001, key: Key::public() };
    let mut planned = campaign(&family, &searchers(asked).unwrap(), &contest).unwrap();
    // From a place within the plume, so that all have something to decide.
    for draw in &mut planned.spec.draw {
        let near = match draw.path.as_str() {
            "sources[0].east_m" => Some((-120.0, -119.0)),
            "sources[0].north_m" | "robots[0].start.north_m" => Some((-1.0, 1.0)),
            "robots[0].start.east_m" => Some((-60.0, -50.0)),
            _ => None,
        };
        if let Some((low, high)) = near {
            draw.of = studies::distribution::Distribution::Uniform(low, high);
        }
    }
    let dir = tempfile::tempdir().unwrap();
    let options = RunOptions { jobs: 1, ..RunOptions::default() };
    run(&planned, dir.path(), &options, &AtomicBool::new(false), &|_| {}).unwrap();
    let rows = read_rows(dir.path()).unwrap();
    assert_eq!(rows.len() as u64, planned.n_runs());
    assert!(rows.iter().all(|row| row.error.is_none()), "{:?}", rows.iter().find_map(|row| row.error.as_ref()));
    let met = rows.iter().filter(|row| row.detections > 0).count();
    (rows.into_iter().map(|row| (row.arm, row.digest)).collect(), met)
}

#[test]
fn scrambled_truth_behind_the_instruments_changes_no_decision_of_any_searcher() {
    for family in ["uniform", "flume"] {
        let (plain, met) = digests(&Registry::default(), family, &[]);
        let (blind, _) = digests(&scrambled(Registry::default()), family, &[]);
        assert_eq!(blind, plain, "{family}");
        assert!(met + 1 >= plain.len(), "{met} of {} met dye", plain.len());
    }
}

#[test]
fn a_searcher_that_reads_the_truth_is_found_out() {
    let asked = ["surge-cast".to_string()];
    let (honest, _) = digests(&cheating(Registry::default()), "uniform", &asked);
    let (blind, _) = digests(&cheating(scrambled(Registry::default())), "uniform", &asked);
    assert_ne!(blind, honest);
}
