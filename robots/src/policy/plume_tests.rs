//! The policies in a Gaussian plume: whether the belief that their ways lead to finds the source.

use super::{PathOutcome, Policy, PolicySpec, Prospect, Way};
use nalgebra::Vector2;
use std::collections::BTreeMap;
use world::math;
use world::seeds::Stream;

/// Cells along and across, 5 m each; the flow goes east.
const N: (usize, usize) = (40, 20);
const CELL_M: f64 = 5.0;
/// Ways go so far, twice or three times as far to four sides, as in the authors' program.
const WAY_M: f64 = 10.0;
/// Concentrations are told apart at these levels; at the source it is 1.
const LEVELS: [f64; 8] = [0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.6];
/// Standard deviation of a sample.
const NOISE: f64 = 0.05;

/// Mean concentration.
fn concentration(here: Vector2<f64>, source: Vector2<f64>) -> f64 {
    let d = here - source;
    if d.x <= 0.0 {
        return 0.0;
    }
    let width_m = 4.0 + 0.15 * d.x;
    let off = (d.y / width_m) * (d.y / width_m);
    4.0 / width_m * math::exp(-off * off)
}

/// Chances that a sample is below the first level, between two, and above the last one. Its noise is logistic.
fn chances(here: Vector2<f64>, source: Vector2<f64>) -> [f64; LEVELS.len() + 1] {
    let mean = concentration(here, source);
    let scale = NOISE * 3f64.sqrt() / std::f64::consts::PI;
    let below = |level: f64| 1.0 / (1.0 + math::exp((mean - level) / scale));
    let mut least = 0.0;
    std::array::from_fn(|k| {
        let most = LEVELS.get(k).map_or(1.0, |level| below(*level));
        let chance = most - least;
        least = most;
        chance
    })
}

struct Plume {
    cells: Vec<Vector2<f64>>,
    /// By the place at which a sample is taken, in lengths of a way.
    samples: BTreeMap<(usize, usize), Way>,
}

impl Plume {
    fn new() -> Self {
        let middle = |i: usize| Vector2::new((i % N.0) as f64 + 0.5, (i / N.0) as f64 + 0.5) * CELL_M;
        let cells: Vec<_> = (0..N.0 * N.1).map(middle).collect();
        let way = |(x, y): (usize, usize)| {
            let end = Vector2::new(x as f64, y as f64) * WAY_M;
            let all: Vec<_> = cells.iter().map(|source| chances(end, *source)).collect();
            let outcome = |k: usize| PathOutcome::new(all.iter().map(|of_cell| of_cell[k]).collect());
            ((x, y), Way { end, outcomes: (0..=LEVELS.len()).map(outcome).collect() })
        };
        let samples = (1..N.0 / 2).flat_map(|x| (1..N.1 / 2).map(move |y| (x, y))).map(way).collect();
        Self { cells, samples }
    }

    /// Ways to four sides that stay inside.
    fn ways(&self, (x, y): (usize, usize)) -> Vec<((usize, usize), Way)> {
        let to = (1..=3).flat_map(|k| [(x + k, y), (x, y + k), (x.wrapping_sub(k), y), (x, y.wrapping_sub(k))]);
        to.filter_map(|place| Some((place, self.samples.get(&place)?.clone()))).collect()
    }

    /// After so many ways: distances of the likeliest cell and of the searcher from the source, m.
    fn search(&self, policy: &mut dyn Policy, seed: u64, moves: u32) -> [f64; 2] {
        let mut rng = Stream::new(seed, "plume", "test");
        let mut p = vec![1.0 / self.cells.len() as f64; self.cells.len()];
        let source = Vector2::new(30.0 + 60.0 * rng.uniform(), 25.0 + 50.0 * rng.uniform());
        // Not in the middle: there the belief stays the same on both sides, and who goes to its mean learns no side.
        let mut here = (18, 3);
        for _ in 0..moves {
            let (places, ways): (Vec<_>, Vec<_>) = self.ways(here).into_iter().unzip();
            let chosen = policy.choose(&Prospect::new(&p, &self.cells, WAY_M, &ways), &mut rng);
            here = places[chosen];
            let (share, mut sum) = (rng.uniform(), 0.0);
            let reached = |chance: &f64| {
                sum += chance;
                sum >= share
            };
            let level = chances(ways[chosen].end, source).iter().position(reached).unwrap_or(LEVELS.len());
            p.iter_mut().zip(ways[chosen].outcomes[level].chance.iter()).for_each(|(p, c)| *p *= c);
            let sum: f64 = p.iter().sum();
            p.iter_mut().for_each(|p| *p /= sum);
        }
        let ways = [self.samples[&here].clone()];
        let prospect = Prospect::new(&p, &self.cells, WAY_M, &ways);
        [prospect.likeliest(), ways[0].end].map(|place| (place - source).norm())
    }

    /// Medians over searches.
    fn medians(&self, build: impl Fn() -> Box<dyn Policy>, moves: u32) -> [f64; 2] {
        let all: Vec<_> = (1..=101).map(|seed| self.search(&mut *build(), seed, moves)).collect();
        [0, 1].map(|what| {
            let mut of: Vec<f64> = all.iter().map(|search| search[what]).collect();
            of.sort_by(f64::total_cmp);
            of[50]
        })
    }
}

/// Goes anywhere.
#[derive(Debug)]
struct Blind;

impl Policy for Blind {
    fn choose(&mut self, prospect: &Prospect<'_>, rng: &mut Stream) -> usize {
        ((rng.uniform() * prospect.ways().len() as f64) as usize).min(prospect.ways().len() - 1)
    }
}

/// Chen et al. 2021: dual control is where the source is when it knows it. What only gathers information knows the
/// source as well, and need not go there.
#[test]
fn the_belief_finds_the_source_and_dual_control_is_there() {
    let plume = Plume::new();
    let [blind, _] = plume.medians(|| Box::new(Blind), 10);
    let of = |policy: PolicySpec| plume.medians(|| policy.build(), 10);
    let entrotaxis = of(PolicySpec::new(super::entrotaxis::Entrotaxis {}));
    let dual = of(PolicySpec::new(super::dcee::Dcee {}));
    let infotaxis = of(PolicySpec::new(super::infotaxis::Infotaxis {}));
    let space_aware = of(PolicySpec::new(super::space_aware::SpaceAware {}));
    for [belief, _] in [entrotaxis, dual, infotaxis, space_aware] {
        assert!(belief < 0.8 * blind, "{belief} m against {blind} m");
    }
    for [_, there] in [dual, space_aware] {
        assert!(there < WAY_M && there < 0.6 * infotaxis[1].min(entrotaxis[1]), "{there} m");
    }
}

/// Where the noise of a sample is the same whatever the source is, its entropy is that of the noise and what is
/// learned: entrotaxis then chooses as infotaxis does.
#[test]
fn the_most_surprise_is_the_most_information_where_noise_is_the_same_everywhere() {
    const WORTH: [f64; 4] = [0.7, 0.2, 0.07, 0.03];
    let mut rng = Stream::new(1, "surprise", "test");
    let cells: Vec<_> = (0..30).map(|i| Vector2::new(f64::from(i), 0.0)).collect();
    for _ in 0..100 {
        let raw: Vec<f64> = cells.iter().map(|_| rng.uniform()).collect();
        let sum: f64 = raw.iter().sum();
        let p: Vec<f64> = raw.iter().map(|v| v / sum).collect();
        let mut way = || {
            let level: Vec<usize> =
                cells.iter().map(|_| (rng.uniform() * 1.7) as usize + (rng.uniform() * 2.4) as usize).collect();
            let outcome = |k: usize| PathOutcome::new(level.iter().map(|l| WORTH[(k + 4 - l) % 4]).collect());
            Way { end: Vector2::zeros(), outcomes: (0..4).map(outcome).collect() }
        };
        let ways: Vec<Way> = (0..5).map(|_| way()).collect();
        let prospect = Prospect::new(&p, &cells, 1.0, &ways);
        let chosen = |policy: PolicySpec| policy.build().choose(&prospect, &mut Stream::new(1, "policy", "test"));
        let surprise = chosen(PolicySpec::new(super::entrotaxis::Entrotaxis {}));
        assert_eq!(surprise, chosen(PolicySpec::new(super::infotaxis::Infotaxis {})));
    }
}

/// Of three ways, one meets dye for certain, one never, one half the time.
#[test]
fn entrotaxis_wants_surprise_and_dual_control_the_source() {
    let cells = [Vector2::new(0.0, 0.0), Vector2::new(100.0, 0.0)];
    let ends = [Vector2::new(0.0, 0.0), Vector2::new(50.0, 0.0), Vector2::new(0.0, 300.0)];
    let chances = [[1.0, 1.0], [0.0, 0.0], [1.0, 0.0]];
    let ways: Vec<Way> = ends.iter().zip(chances).map(|(end, c)| Way::with_detection(*end, &c)).collect();
    let p = [0.5, 0.5];
    let prospect = Prospect::new(&p, &cells, 10.0, &ways);
    let mut rng = Stream::new(1, "policy", "test");
    let mut chosen = |policy: PolicySpec| policy.build().choose(&prospect, &mut rng);
    assert_eq!(chosen(PolicySpec::new(super::entrotaxis::Entrotaxis {})), 2);
    assert_eq!(chosen(PolicySpec::new(super::infotaxis::Infotaxis {})), 2);
    // The mean square distance is 2500 m² from the middle, 5000 m² from the first end.
    assert_eq!(chosen(PolicySpec::new(super::dcee::Dcee {})), 1);
    // Where nothing more can be learned, it goes to the source.
    let sure = [0.0, 1.0];
    let prospect = Prospect::new(&sure, &cells, 10.0, &ways);
    let mut dual = PolicySpec::new(super::dual::Dual::default()).build();
    assert_eq!(dual.choose(&prospect, &mut rng), 1);
}

/// The law of total variance: what could be detected on a way cancels out of dual control's cost.
#[test]
fn dual_control_goes_to_the_mean_of_its_belief_whatever_could_be_detected() {
    let mut rng = Stream::new(1, "dual", "test");
    let cells: Vec<_> = (0..20).map(|i| Vector2::new(f64::from(i % 5), f64::from(i / 5)) * 10.0).collect();
    for _ in 0..50 {
        let raw: Vec<f64> = cells.iter().map(|_| rng.uniform()).collect();
        let sum: f64 = raw.iter().sum();
        let p: Vec<f64> = raw.iter().map(|v| v / sum).collect();
        let mean: Vector2<f64> = p.iter().zip(&cells).map(|(p, cell)| cell * *p).sum();
        let mut way = || {
            let end = Vector2::new(rng.uniform(), rng.uniform()) * 40.0;
            Way::with_detection(end, &cells.iter().map(|_| rng.uniform()).collect::<Vec<_>>())
        };
        let ways: Vec<Way> = (0..6).map(|_| way()).collect();
        let prospect = Prospect::new(&p, &cells, 10.0, &ways);
        let chosen = super::dcee::Dcee {}.choose(&prospect, &mut Stream::new(1, "policy", "test"));
        assert_eq!(chosen, prospect.towards(mean));
    }
}

#[test]
fn thompson_keeps_a_drawn_place_and_draws_places_as_often_as_they_are_likely() {
    let cells = [Vector2::new(-500.0, 0.0), Vector2::new(500.0, 0.0)];
    let ends = [Vector2::new(-10.0, 0.0), Vector2::new(10.0, 0.0)];
    let ways: Vec<Way> = ends.iter().map(|end| Way::with_detection(*end, &[0.5, 0.5])).collect();
    let p = [0.25, 0.75];
    let prospect = Prospect::new(&p, &cells, 10.0, &ways);
    let mut rng = Stream::new(1, "thompson", "test");
    let mut policy = PolicySpec::new(super::thompson::Params::default()).build();
    let chosen: Vec<usize> = (0..4000).map(|_| policy.choose(&prospect, &mut rng)).collect();
    assert!(chosen.chunks(10).all(|ten| ten.iter().all(|k| *k == ten[0])), "kept for ten choices");
    // 400 draws: five standard deviations are 43.
    let right = chosen.iter().step_by(10).filter(|k| **k == 1).count();
    assert!((257..=343).contains(&right), "{right}");
}
