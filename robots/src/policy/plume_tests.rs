//! The policies in a Gaussian plume: whether the belief that their ways lead to finds the source.

use super::{Policy, PolicySpec, Prospect, Way};
use nalgebra::Vector2;
use world::math;
use world::seeds::Stream;

/// Cells along and across, 5 m each; the flow goes east.
const N: (usize, usize) = (40, 20);
const CELL_M: f64 = 5.0;
const WAY_M: f64 = 20.0;

/// Chance of a detection on a way that ends here.
fn chance(here: Vector2<f64>, source: Vector2<f64>) -> f64 {
    let d = here - source;
    if d.x <= 0.0 {
        return 0.01;
    }
    let width_m = 4.0 + 0.15 * d.x;
    let off = (d.y / width_m) * (d.y / width_m);
    0.01 + 0.98 * math::exp(-off * off)
}

fn cells() -> Vec<Vector2<f64>> {
    let middle = |i: usize| Vector2::new((i % N.0) as f64 + 0.5, (i / N.0) as f64 + 0.5) * CELL_M;
    (0..N.0 * N.1).map(middle).collect()
}

/// Ways to all sides that stay inside.
fn ways(from: Vector2<f64>, cells: &[Vector2<f64>]) -> Vec<Way> {
    let to = (0..8).map(|k| {
        let (s, c) = math::sin_cos(f64::from(k) * std::f64::consts::FRAC_PI_4);
        from + Vector2::new(c, s) * WAY_M
    });
    let far = Vector2::new(N.0 as f64, N.1 as f64) * CELL_M;
    let inside = to.filter(|p| p.x > 0.0 && p.y > 0.0 && p.x < far.x && p.y < far.y);
    inside.map(|end| Way::with_detection(end, &cells.iter().map(|s| chance(end, *s)).collect::<Vec<_>>())).collect()
}

/// Distance of the likeliest cell from the source after so many ways, m.
fn error_m(policy: &mut dyn Policy, seed: u64, moves: u32) -> f64 {
    let mut rng = Stream::new(seed, "plume", "test");
    let cells = cells();
    let mut p = vec![1.0 / cells.len() as f64; cells.len()];
    let source = Vector2::new(30.0 + 60.0 * rng.uniform(), 25.0 + 50.0 * rng.uniform());
    let mut here = Vector2::new(182.5, 52.5);
    for _ in 0..moves {
        let ways = ways(here, &cells);
        let way = &ways[policy.choose(&Prospect::new(&p, &cells, WAY_M, &ways), &mut rng)];
        here = way.end;
        let outcome = &way.outcomes[usize::from(rng.uniform() < chance(here, source))];
        p.iter_mut().zip(outcome.chance.iter()).for_each(|(p, c)| *p *= c);
        let sum: f64 = p.iter().sum();
        p.iter_mut().for_each(|p| *p /= sum);
    }
    (Prospect::new(&p, &cells, WAY_M, &ways(here, &cells)).likeliest() - source).norm()
}

/// Median over seeds. A cell drawn at random is 80 m off.
fn median_m(policy: &PolicySpec) -> f64 {
    let mut errors: Vec<f64> = (1..=21).map(|seed| error_m(&mut *policy.build(), seed, 60)).collect();
    errors.sort_by(f64::total_cmp);
    errors[10]
}

#[test]
fn the_belief_finds_the_source_whose_ways_gather_information() {
    for policy in [
        PolicySpec::new(super::entrotaxis::Entrotaxis {}),
        PolicySpec::new(super::dcee::Dcee {}),
        PolicySpec::new(super::infotaxis::Infotaxis {}),
        PolicySpec::new(super::space_aware::SpaceAware {}),
    ] {
        let m = median_m(&policy);
        assert!(m < 20.0, "{policy:?}: {m} m");
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
    // The third way tells all and is far: 50² + 300² against 2 · 50² for the one in the middle.
    assert_eq!(chosen(PolicySpec::new(super::dcee::Dcee {})), 1);
    // Where nothing more can be learned, it goes to the source.
    let sure = [0.0, 1.0];
    let prospect = Prospect::new(&sure, &cells, 10.0, &ways);
    let mut dual = PolicySpec::new(super::dual::Dual::default()).build();
    assert_eq!(dual.choose(&prospect, &mut rng), 1);
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
