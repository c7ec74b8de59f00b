//! A kept plume answers as the one that was kept, and goes on as it, bit by bit.

use super::flume;
use super::water::{off_duck, pour};
use crate::filaments::plume::Plume;
use crate::flow::eddies::{tests_eddies, tests_small};
use crate::flow::water::Water;
use nalgebra::Vector3;
use std::fmt::Debug;
use world::bits::{Reader, Writer};
use world::fields::{Concentration, Flow};

type Make = fn() -> (Water, Plume);

/// Water with eddies between the walls of a flume, and a nozzle.
fn in_flume() -> (Water, Plume) {
    (tests_eddies::water(2.5, 2), flume::plume(2.5, 2))
}

/// The same with small eddies and a buoyant release.
fn in_fine_flume() -> (Water, Plume) {
    let water = tests_small::water(2.5, 0.00625, 2);
    let plume = flume::light(2.5, 2).carried_by(water.small());
    let plume = plume.with_buoyancy(&water).unwrap();
    (water, plume)
}

fn develop((water, plume): &mut (Water, Plume), end_s: f64) {
    plume.pace(0.0, end_s, 10.0);
    let mut t_s = 0.0;
    while t_s < end_s {
        water.advance(t_s);
        t_s = plume.next_meeting_s();
        plume.advance(water, t_s);
    }
    water.advance(end_s);
}

fn kept(plume: &Plume) -> Vec<u8> {
    let mut to = Writer::default();
    plume.keep(&mut to);
    to.into_bytes()
}

/// Concentrations beside some filaments, by their bits.
fn felt(plume: &Plume) -> Vec<u64> {
    let some = plume.places().step_by(50);
    some.map(|p| plume.concentration(&(p + Vector3::x() * 0.01)).to_bits()).collect()
}

/// All that decides how filaments go on.
fn whole(plume: &Plume) -> String {
    let flow = (plume.next_refresh_s, plume.sampled.even_k_h, plume.grid.t_s);
    let filaments = (&plume.releases, &plume.stores, &plume.bands);
    let counts = (plume.steps, plume.turned_back, plume.now_s);
    let all: [&dyn Debug; 4] = [&filaments, &flow, &counts, &plume.sampled.scales(1.0)];
    format!("{all:?}")
}

#[test]
fn a_kept_plume_answers_and_goes_on_as_the_one_that_was_kept() {
    // Meanders and layers, eddies between walls, and small eddies with a buoyant release.
    let cases: [(Make, f64); 3] = [(|| off_duck(100.0), 173.0), (in_flume, 12.3), (in_fine_flume, 12.3)];
    for (make, end_s) in cases {
        let mut first = make();
        develop(&mut first, end_s);
        let (mut water, mut plume) = first;
        let bytes = kept(&plume);
        let (mut water_2, mut other) = make();
        water_2.advance(end_s);
        let mut from = Reader::new(&bytes);
        other.recall(&water_2, &mut from).unwrap();
        from.end().unwrap();
        assert_eq!(kept(&other), bytes);
        assert!(other.iter().eq(plume.iter()));
        assert!(plume.len() > 100 && plume.now_s() == end_s);
        for p in [&mut plume, &mut other] {
            p.pace(end_s, f64::INFINITY, 5.0);
        }
        assert_eq!(felt(&other), felt(&plume));
        assert!(felt(&plume).iter().any(|c| f64::from_bits(*c) > 0.0));
        // Past the next evaluations of the flow, and also within steps.
        for n in 1..=90 {
            let t_s = end_s + 0.4 * f64::from(n);
            water.advance(t_s);
            water_2.advance(t_s);
            plume.advance(&water, t_s);
            other.advance(&water_2, t_s);
            assert_eq!(felt(&other), felt(&plume), "{t_s} s");
            if n % 10 == 0 {
                assert_eq!(whole(&other), whole(&plume), "{t_s} s");
            }
        }
    }
}

/// A plume that was paced again may be kept, too: nothing has moved yet.
#[test]
fn what_is_kept_does_not_depend_on_the_pace_that_follows() {
    let mut first = off_duck(100.0);
    develop(&mut first, 40.0);
    let (_, mut plume) = first;
    let bytes = kept(&plume);
    plume.pace(40.0, f64::INFINITY, 5.0);
    assert_eq!(kept(&plume), bytes);
    pour(&mut plume, 1, -5.0, |_| [0.0, 0.0, -1.0]);
    assert_ne!(kept(&plume), bytes);
}

#[test]
#[should_panic(expected = "at the end of its steps")]
fn a_plume_is_not_kept_within_a_step() {
    let (water, mut plume) = off_duck(100.0);
    plume.pace(0.0, f64::INFINITY, 5.0);
    plume.advance(&water, 0.1);
    kept(&plume);
}
