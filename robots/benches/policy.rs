//! How long a choice takes: four moves on a belief of 53 × 53 cells, a lattice of Loisy & Eloy (2022), and the seven
//! ways of a vehicle over a map of 40 × 25.
//!
//! `cargo bench -p rheotaxis-robots --bench policy`

use nalgebra::Vector2;
use robots::policy::{Infotaxis, PathOutcome, Policy, PolicyParams, Prospect, SpaceAware, Way};
use world::math;
use world::seeds::Stream;

fn main() {
    divan::main();
}

/// A belief with a wide peak beside the middle, and ways from there to all sides; on each of them several outcomes.
fn choose(bencher: divan::Bencher, mut policy: Box<dyn Policy>, n: [usize; 2], sides: usize, outcomes: usize) {
    let cells: Vec<_> = (0..n[0] * n[1]).map(|i| Vector2::new((i % n[0]) as f64, (i / n[0]) as f64)).collect();
    let middle = Vector2::new(n[0] as f64, n[1] as f64) / 2.0;
    let near = |at: Vector2<f64>, width: f64| {
        let height = move |cell: &Vector2<f64>| math::exp(-(cell - at).norm_squared() / (2.0 * width * width));
        cells.iter().map(height).collect::<Vec<f64>>()
    };
    let raw = near(middle + Vector2::new(8.0, 3.0), 9.0);
    let sum: f64 = raw.iter().sum();
    let p: Vec<f64> = raw.iter().map(|v| v / sum).collect();
    let ways: Vec<Way> = (0..sides)
        .map(|k| {
            let (s, c) = math::sin_cos(std::f64::consts::TAU * k as f64 / sides as f64);
            let end = middle + Vector2::new(c, s);
            // The chance of each number of detections but the first is the same.
            let rest = (outcomes - 1) as f64;
            let met = near(end, 6.0);
            let share = |k: usize| met.iter().map(|m| if k == 0 { 1.0 - m } else { m / rest }).collect();
            Way { end, outcomes: (0..outcomes).map(|k| PathOutcome::new(share(k))).collect() }
        })
        .collect();
    let mut rng = Stream::new(1, "bench", "policy");
    bencher.bench_local(|| policy.choose(&Prospect::new(&p, &cells, 1.0, &ways), &mut rng));
}

#[divan::bench]
fn space_aware_on_the_lattice(bencher: divan::Bencher) {
    choose(bencher, SpaceAware {}.build(), [53, 53], 4, 4);
}

#[divan::bench]
fn infotaxis_on_the_lattice(bencher: divan::Bencher) {
    choose(bencher, Infotaxis {}.build(), [53, 53], 4, 4);
}

#[divan::bench]
fn space_aware_of_a_vehicle(bencher: divan::Bencher) {
    choose(bencher, SpaceAware {}.build(), [40, 25], 7, 2);
}
