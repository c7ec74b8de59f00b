//! Beliefs stay beliefs: sums, hours of updates, memory, and no preferred place or direction.

use crate::map::kernel::flow_history::FlowHistory;
use crate::map::log_belief::LogBelief;
use crate::map::mapper::Mapper;
use crate::map::over_cells::OverCells;
use crate::map::pomdp;
use crate::map::spec::{GridSpec, TrajectorySpec};
use crate::map::testing::{build, every, grid, p_by_hand, paper_area};
use crate::map::watch::MapObservation;
use crate::map::workings::CellsSpec;
use nalgebra::{Rotation2, Vector2, Vector3};
use std::sync::Arc;
use world::area::Area;
use world::ranges::{Fraction, NonNegative, Positive};
use world::seeds::Stream;
use world::units::Heading;

fn small() -> CellsSpec {
    let sigma = Positive::new(2.0);
    CellsSpec {
        grid: GridSpec { along: 7, across: 6, ..GridSpec::default() },
        trajectory: TrajectorySpec {
            lookback_s: Positive::new(20.0),
            sigma_x_m_rts: sigma,
            sigma_y_m_rts: sigma,
            ..TrajectorySpec::default()
        },
        ..CellsSpec::default()
    }
}

fn random_walk(rng: &mut Stream, n: u32) -> MapObservation {
    MapObservation {
        t_s: f64::from(n),
        p_W: Vector3::new(100.0 * rng.uniform(), 100.0 * rng.uniform(), -3.0),
        detected: Some(rng.uniform() < 0.1),
        flow: Some(Vector2::new(1.0 + 0.3 * rng.normal(), 0.3 * rng.normal())),
        fixed: false,
    }
}

fn assert_sound(mapper: &dyn Mapper, what: &str) {
    let b = mapper.belief();
    let total: f64 = b.p.iter().sum();
    assert!((total - 1.0).abs() < 1e-12, "{what}: sums to {total}");
    assert!(b.p.iter().all(|p| (0.0..=1.0).contains(p)), "{what}");
    assert!(b.entropy_nat.is_finite() && b.credible_95 > 0.0, "{what}");
}

#[test]
fn a_hundred_thousand_contradictory_updates_still_sum_to_one() {
    // The particle filter takes one exponential per particle and release, so here it has fewer of both.
    let mut short = small();
    short.trajectory.lookback_s = Positive::new(4.0);
    let [pomdp, bayesian, hmm, _] = every(&small(), 20);
    let [.., particles] = every(&short, 20);
    for spec in [pomdp, bayesian, hmm, particles] {
        let mut rng = Stream::new(3, "auv0", "walk");
        let mut mapper = build(&spec);
        for n in 0..100_002 {
            mapper.step(&random_walk(&mut rng, n));
        }
        assert!(mapper.belief().updates >= 100_000, "{}", mapper.belief().updates);
        assert_sound(mapper.as_ref(), spec.name());
    }
}

#[test]
fn an_hour_without_a_detection_or_with_nothing_else_does_not_underflow() {
    for detected in [false, true] {
        for spec in every(&CellsSpec::default(), 200) {
            let mut mapper = build(&spec);
            for n in 0..3600 {
                let t = f64::from(n);
                mapper.step(&MapObservation {
                    t_s: t,
                    p_W: Vector3::new(90.0, 50.0 + 40.0 * world::math::sin(t / 30.0), -2.0),
                    detected: Some(detected),
                    flow: Some(Vector2::new(0.3, 0.02)),
                    fixed: false,
                });
            }
            assert_sound(mapper.as_ref(), spec.name());
            assert_eq!(mapper.belief().informed, detected);
        }
    }
}

#[test]
fn logarithms_lose_nothing_where_probabilities_underflow() {
    let grid = Arc::new(grid([2, 1, 1]));
    let mut b = LogBelief::uniform(&grid);
    for _ in 0..10_000 {
        b.update(0.0, false, &[1.0, 0.5], 1.0);
    }
    assert_eq!(b.belief().p[1], 0.0);
    for _ in 0..10_000 {
        b.update(0.0, false, &[0.5, 1.0], 1.0);
    }
    // 10 000 steps there and back: each rounding at most 7000·1.1e-16.
    assert!((b.belief().p[1] - 0.5).abs() < 1e-8, "{}", b.belief().p[1]);
    assert!((b.ln_p()[0] + std::f64::consts::LN_2).abs() < 1e-8);
}

#[test]
fn numbers_of_a_map_by_hand() {
    let grid = Arc::new(grid([4, 1, 1]));
    let mut b = LogBelief::uniform(&grid);
    assert!((b.belief().entropy_nat - 2.0 * std::f64::consts::LN_2).abs() < 1e-12);
    assert_eq!(b.belief().best, 0);
    b.update(1.0, true, &[1.0, 2.0, 4.0, 1.0], 1.0);
    let belief = b.belief();
    assert_eq!(belief.best, 2);
    // 1/2 ln 2 + 1/4 ln 4 + 2/8 ln 8 = 1.75 ln 2; 95 % needs all four cells of 2500 m².
    assert!((belief.entropy_nat - 1.75 * std::f64::consts::LN_2).abs() < 1e-12);
    assert!((belief.credible_95 - 10_000.0).abs() < 1e-9);
}

/// The filter's belief is Bayes' rule with the products written out, update by update.
#[test]
fn the_pomdp_map_equals_a_brute_force_product() {
    let mut spec = CellsSpec { false_detection: Fraction::new(1e-3), ..small() };
    spec.trajectory.merge = Fraction::new(0.0);
    let grid = Arc::new(spec.grid.build(&paper_area()).expect("grid"));
    let mut mapper = OverCells::new(&spec, (*grid).clone(), pomdp::weigh).expect("mapper");
    let mut history = FlowHistory::new(1.0, 20.0, true);
    let mut rng = Stream::new(9, "auv0", "walk");
    let mut detections = 0;
    let mut by_hand = vec![1.0 / grid.len() as f64; grid.len()];
    for n in 0..40 {
        let mut seen = random_walk(&mut rng, n);
        if n == 0 {
            // No reading yet: then each update has one reading of its own.
            seen.detected = None;
        }
        mapper.step(&seen);
        history.record(seen.t_s, seen.flow.map(|v| [v.x, v.y]));
        let Some(detected) = seen.detected else {
            continue;
        };
        detections += usize::from(detected);
        let at = grid.cell(&seen.p_W).expect("inside");
        let p = p_by_hand(&grid, &spec.trajectory, &history, at);
        for (i, b) in by_hand.iter_mut().enumerate() {
            let gamma: f64 = p.iter().map(|l| 1.0 - 0.9 * l[i]).product();
            *b *= if detected { 1e-3 + (1.0 - 1e-3) * (1.0 - gamma) } else { gamma };
        }
        let total: f64 = by_hand.iter().sum();
        for b in &mut by_hand {
            *b /= total;
        }
        for (a, b) in mapper.belief().p.iter().zip(&by_hand) {
            // The kernel leaves out what lies beyond its reach, under 1e-9; the chance of a false detection makes
            // that 1e-6 per detection.
            assert!((a - b).abs() < 1e-5, "update {n}: {a} {b}");
        }
    }
    assert!(detections > 2);
}

#[test]
fn neither_place_nor_direction_of_the_area_matters() {
    let here = paper_area();
    let shift = Vector2::new(3000.0, -700.0);
    // Turning the axis from 90° to 30° is a turn of 60° to the left.
    let turn = Rotation2::new(60.0_f64.to_radians());
    let there = Area { centre: turn * here.centre + shift, axis: Heading::from_deg(30.0), ..here };
    for spec in every(&CellsSpec::default(), 200) {
        let build = |area: &Area| spec.build(area, Stream::new(3, "auv0", "map")).expect("mapper");
        let (mut a, mut b) = (build(&here), build(&there));
        let mut rng = Stream::new(4, "auv0", "walk");
        for n in 0..60 {
            let seen = random_walk(&mut rng, n);
            a.step(&seen);
            let xy = turn * seen.p_W.xy() + shift;
            b.step(&MapObservation {
                p_W: Vector3::new(xy.x, xy.y, seen.p_W.z),
                flow: seen.flow.map(|v| turn * v),
                ..seen
            });
        }
        for (x, y) in a.belief().p.iter().zip(b.belief().p.iter()) {
            assert!((x - y).abs() < 1e-9, "{}: {x} {y}", spec.name());
        }
    }
}

#[test]
fn odd_grids_are_refused_with_the_legal_range() {
    let of = |g: GridSpec| g.build(&paper_area()).expect_err("refused").to_string();
    let d = GridSpec::default;
    let upside_down = GridSpec { top_depth_m: NonNegative::new(5.0), bottom_depth_m: Some(Positive::new(2.0)), ..d() };
    let short = TrajectorySpec { lookback_s: Positive::new(0.5), ..TrajectorySpec::default() };
    let particles = every(&small(), 3)[3].build(&paper_area(), Stream::new(3, "auv0", "map"));
    for (said, wanted) in [
        (of(GridSpec { along: 0, ..d() }), "map.grid.along: must be at least 1, got 0"),
        (of(GridSpec { vertical: 5, ..d() }), "map.grid.bottom_depth_m: must be given when vertical is more than 1"),
        (of(upside_down), "map.grid.bottom_depth_m: must be greater than top_depth_m, 5, got 2"),
        (of(GridSpec { along: 4000, across: 4000, ..d() }), "map.grid: must have at most 1000000 cells, got 16000000"),
        (short.check().expect_err("refused").to_string(), "map.trajectory.lookback_s: must hold from 1 to 100000"),
        (particles.expect_err("refused").to_string(), "map.particles: must be from 10 to 100000, got 3"),
    ] {
        assert!(said.starts_with(wanted), "{said}");
    }
}
