//! Each mapper finds the source of a small plume that differs from its own model.

use super::belief::all;
use crate::map::spec::{GridSpec, TrajectorySpec};
use crate::map::testing::{ToyPlume, paper_area};
use nalgebra::Vector2;
use world::ranges::Positive;
use world::seeds::Stream;

/// The paper's source, cell (8, 12).
fn source() -> Vector2<f64> {
    Vector2::new(21.25, 50.0)
}

fn steady(_: f64) -> Vector2<f64> {
    Vector2::new(1.0, 0.0)
}

fn swinging(t_s: f64) -> Vector2<f64> {
    Vector2::new(0.8, 0.3 * world::math::sin(t_s / 40.0))
}

#[test]
fn the_source_is_found_in_steady_and_in_swinging_flow() {
    let trajectory = TrajectorySpec { lookback_s: Positive::new(150.0), ..TrajectorySpec::default() };
    for flow in [steady as fn(f64) -> Vector2<f64>, swinging] {
        for spec in all(&GridSpec::default(), &trajectory, 1000) {
            let mut plume = ToyPlume::new(source(), flow, 11);
            let mut mapper = spec.build(&paper_area(), Stream::new(1, "auv0", "map")).expect("mapper");
            let first = mapper.belief().entropy_nat;
            for n in 0..600 {
                mapper.step(&plume.seen(f64::from(n)));
            }
            let b = mapper.belief();
            let off = (b.grid.centre(b.best).xy() - source()).norm();
            // Two cells of 2.5 × 4 m.
            assert!(b.informed && off < 9.5, "{}: {off:.1} m off", spec.name());
            assert!(b.entropy_nat < 0.7 * first, "{}: {} of {first}", spec.name(), b.entropy_nat);
        }
    }
}
