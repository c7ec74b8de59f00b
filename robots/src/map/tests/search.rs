//! Each mapper finds the source of a small plume that differs from its own model.

use crate::map::testing::{ToyPlume, build, every};
use crate::map::workings::CellsSpec;
use nalgebra::Vector2;
use world::ranges::Positive;

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
    let mut spec = CellsSpec::default();
    spec.trajectory.lookback_s = Positive::new(150.0);
    for flow in [steady as fn(f64) -> Vector2<f64>, swinging] {
        for spec in every(&spec, 1000) {
            let mut plume = ToyPlume::new(source(), flow, 11);
            let mut mapper = build(&spec);
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
