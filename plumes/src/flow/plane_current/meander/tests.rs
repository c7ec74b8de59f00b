//! The meander's statistics.

use super::*;
use crate::flow::tests::kit::meander_spec;
use world::units::Heading;

fn area() -> Area {
    Area { centre: Vector2::new(30.0, -20.0), length_m: 100.0, width_m: 100.0, axis: Heading::from_deg(35.0) }
}

/// With noise that reaches everywhere at once the field is bilinear between the corners. Area means of the variance
/// on a square: uniform part 1/4, shears 1/12, strain 1/24 pass the projection whole; convergence
/// (1/24) and twist (1/36) in part; 4/9 in all.
#[test]
fn rms_is_that_of_the_corners_spread_inside() {
    let stiff = MeanderSpec { diffusivity_m2_s: Some(NonNegative::new(1e7)), ..meander_spec(0.1, 0.2, 12.5) };
    let (n, side, mut sum) = (400_u32, 5, 0.0);
    for seed in 0..n {
        let m = stiff.build("water.currents[0]", &area(), Vector2::new(0.2, 0.1), u64::from(seed).into()).unwrap();
        for k in 0..side * side {
            let at = |i: i32| 100.0 * ((f64::from(i) + 0.5) / f64::from(side) - 0.5);
            let p = area().world(Vector2::new(at(k / side), at(k % side)));
            sum += m.velocity(p, 0.0).norm_squared() / 2.0 / f64::from(side * side);
        }
    }
    let part = sum / f64::from(n) / 0.01;
    // One member's mean has about 8 degrees of freedom: standard error √(2/(8·400)) = 2.5 % of the value, 4 of them;
    // below: midpoint means over 5×5 points take 4 % off the linear terms.
    let (least, most) = (0.25 + 0.96 * 0.125, 4.0 / 9.0);
    assert!(part > 0.9 * least && part < 1.1 * most, "{part}");
}
