//! Steps of different length: exact laws hold with all of them, and nothing depends on who asks, when, or on how many
//! threads.

use super::drift::counts_from_release;
use super::water::{Given, basin, moments, off_duck, source};
use crate::filaments::plume::{Plume, PlumeSettings};
use crate::flow::grid::GridShape;
use nalgebra::Vector2;
use world::area::Area;
use world::fields::{Concentration, Flow};
use world::terrain::Terrain;

const BED: Terrain = Terrain::Level { depth_m: 40.0 };

/// The longest steps of a mission, s.
const LONGEST_S: [f64; 3] = [0.5, 5.0, 10.0];

fn plume(rate_hz: f64) -> Plume {
    within(&basin(), GridShape::default(), rate_hz)
}

fn within(area: &Area, grid: GridShape, rate_hz: f64) -> Plume {
    let settings = PlumeSettings { refresh_s: 10.0, grid };
    Plume::new(&[source(20.0, rate_hz, 0.001, 0.1)], area, &BED, 11, settings).expect("a legal source")
}

/// A plume off Duck, 200 s old, in small steps of the caller.
fn aged_off_duck(threads: usize, ask: bool) -> (String, f64) {
    let (mut water, mut plume) = off_duck(100.0);
    plume.use_threads(crate::filaments::threads(threads));
    plume.pace(0.0, f64::INFINITY, 5.0);
    let mut felt = 0.0;
    for n in 1..=4000 {
        let t_s = 0.05 * f64::from(n);
        water.advance(t_s);
        plume.advance(&water, t_s);
        if ask && n % 7 == 0 {
            let middle = plume.places().nth(plume.len() / 2);
            felt += plume.concentration(&middle.unwrap());
        }
    }
    (plume.digest(), felt)
}

#[test]
fn neither_questions_nor_threads_change_anything() {
    let (alone, _) = aged_off_duck(1, false);
    let (asked, felt) = aged_off_duck(1, true);
    assert_eq!(alone, asked);
    assert!(felt > 0.0 && alone != off_duck(100.0).1.digest());
    for threads in [2, 8] {
        assert_eq!(aged_off_duck(threads, false).0, alone, "{threads} threads");
        assert_eq!(aged_off_duck(threads, true).1.to_bits(), felt.to_bits());
    }
}

#[test]
fn while_it_rests_it_can_be_looked_at_in_any_order() {
    let (mut water, mut plume) = off_duck(100.0);
    plume.pace(0.0, f64::INFINITY, 5.0);
    let feel = |plume: &Plume, t_s: f64| {
        assert_eq!(plume.now_s().to_bits(), t_s.to_bits());
        let some = plume.places().step_by(plume.len() / 20);
        some.map(|p| plume.concentration(&p).to_bits()).collect::<Vec<u64>>()
    };
    let (dt_s, mut rested) = (0.05, 0);
    let time = |n: u32| dt_s * f64::from(n);
    for n in 1..=2400 {
        water.advance(time(n));
        plume.advance(&water, time(n));
        if n < 2000 || !plume.rests_until(time(n + 1)) {
            continue;
        }
        rested += 1;
        // A copy goes on as a run alone would; this one looks ahead and back.
        let mut alone = plume.clone();
        let now = feel(&plume, time(n));
        alone.advance(&water, time(n + 1));
        for _ in 0..2 {
            plume.look_at(time(n + 1));
            assert_eq!(feel(&plume, time(n + 1)), feel(&alone, time(n + 1)));
            plume.look_at(time(n));
            assert_eq!(feel(&plume, time(n)), now);
        }
    }
    assert!(rested > 100, "{rested}");
}

#[test]
#[should_panic(expected = "the plume takes a step before 1 s: advance it")]
fn a_plume_that_steps_is_not_only_looked_at() {
    let mut plume = plume(1.0);
    plume.pace(0.0, f64::INFINITY, 0.5);
    plume.look_at(1.0);
}

#[test]
fn the_columns_around_filaments_hold_the_flow_of_the_period() {
    let (mut water, mut plume) = off_duck(50.0);
    plume.pace(0.0, f64::INFINITY, 5.0);
    for n in 1..=60 {
        water.advance(5.0 * f64::from(n - 1));
        plume.advance(&water, 5.0 * f64::from(n));
    }
    let mut whole = plume.grid.clone();
    whole.refresh(&water, plume.grid.t_s);
    let mut seen = std::collections::BTreeSet::new();
    let (nz, ny) = (plume.grid.dims[2], plume.grid.dims[1]);
    // Where the steps that are being taken have started.
    let s = &plume.stores[0];
    for (x, y) in s.start[0].iter().zip(&s.start[1]) {
        let at = plume.cells.column(*x, *y).at as usize;
        seen.extend([at, at + 1, at + ny, at + ny + 1]);
    }
    for column in &seen {
        let nodes = column * nz..(column + 1) * nz;
        assert_eq!(plume.grid.data[nodes.clone()], whole.data[nodes]);
        assert_eq!(plume.grid.k_h[*column], whole.k_h[*column]);
    }
    let all = plume.grid.bed.len();
    let evaluated = plume.sampled.evaluated();
    assert!(evaluated >= seen.len() && evaluated < all / 4, "{} of {evaluated} of {all}", seen.len());
}

/// In the middle of a step, the straight line lacks at most an eighth of the filament's own variance, γ·age.
#[test]
fn spread_is_2kt_in_all_bands_at_once() {
    let water = Given(|_| 0.2, |_| (0.02, 0.0));
    for longest_s in LONGEST_S {
        let mut p = plume(100.0);
        p.pace(0.0, f64::INFINITY, longest_s);
        for (t_s, lacks) in [(400.0, 0.0), (402.5, 0.125 * 0.001 / 0.04)] {
            p.advance(&water, t_s);
            counts_from_release(&p, 0.2, lacks);
        }
    }
}

/// A plume that has become steady has the same profile across with long steps as with short ones, also between steps.
#[test]
fn the_profile_of_a_steady_plume_does_not_depend_on_the_longest_step() {
    let water = Given(|_| 0.2, |_| (0.02, 1e-3));
    // What has passed the slice may leave the water soon.
    let short = Area { centre: Vector2::new(-55.0, 0.0), length_m: 90.0, ..basin() };
    for longest_s in LONGEST_S {
        let grid = GridShape { margin_m: 0.0, ..GridShape::default() };
        let mut p = within(&short, grid, 100.0);
        p.pace(0.0, f64::INFINITY, longest_s);
        let mut across = Vec::new();
        for k in 0..40 {
            p.advance(&water, 500.0 + 13.7 * f64::from(k));
            let slice = p.iter().filter(|f| (f[0] + 30.0).abs() < 5.0);
            across.extend(slice.map(|f| f[1]));
        }
        // 60 m down-stream, 300 s old: variance 2·0.02·300 = 12 m². Each of some 2000 independent filaments counts
        // about three times.
        let n = across.len() as f64 / 3.0;
        let (_, v) = moments(across.into_iter());
        assert!((v / 12.0 - 1.0).abs() < 5.0 * (2.0 / n).sqrt(), "{longest_s} s: {v}");
    }
}

#[test]
fn mass_is_conserved_between_steps() {
    let water = Given(|_| 1.0, |_| (0.02, 1e-3));
    let mut p = plume(7.0);
    p.pace(0.0, 300.0, 4.0);
    let mut before = 0;
    for n in 1..=3000 {
        p.advance(&water, 0.1 * f64::from(n));
        assert_eq!(p.released(), p.len() as u64 + p.left());
        assert_eq!(p.iter().count(), p.len());
        assert!(p.released() >= before && p.released() - before < 15);
        before = p.released();
    }
    assert!(before > 1800 && p.left() > 0);
}
