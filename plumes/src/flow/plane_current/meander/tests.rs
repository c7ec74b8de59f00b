//! The meander: its statistics, its divergence, and what it refuses.

use super::*;
use world::units::Heading;

fn area() -> Area {
    Area { centre: Vector2::new(30.0, -20.0), length_m: 100.0, width_m: 100.0, axis: Heading::from_deg(35.0) }
}

fn spec() -> MeanderSpec {
    MeanderSpec {
        std_m_s: NonNegative::new(0.1),
        omega_rad_s: Positive::new(0.2),
        damping: Positive::new(0.1),
        cell_m: Positive::new(12.5),
        diffusivity_m2_s: None,
    }
}

fn build(spec: &MeanderSpec, seed: u64) -> Meander {
    let carrier = Vector2::new(0.2, 0.1);
    spec.build("water.currents[0]", &area(), carrier, seed.into()).unwrap()
}

#[test]
fn does_not_depend_on_how_time_is_cut() {
    let (mut one, mut many) = (build(&spec(), 5), build(&spec(), 5));
    one.advance(37.3);
    for k in 1..=100 {
        many.advance(37.3 * f64::from(k) / 100.0);
    }
    for (x, y, t) in [(30.0, -20.0, 37.3), (60.0, 0.0, 36.9), (0.0, -50.0, 38.2)] {
        let p = Vector2::new(x, y);
        assert_eq!(one.velocity(p, t), many.velocity(p, t));
        assert!(one.velocity(p, t).norm() > 0.0);
    }
}

/// With noise that reaches everywhere at once the field is bilinear between the corners. Area means of the variance
/// on a square: uniform part 1/4, shears 1/12, strain 1/24 pass the projection whole; convergence
/// (1/24) and twist (1/36) in part; 4/9 in all.
#[test]
fn rms_is_that_of_the_corners_spread_inside() {
    let stiff = MeanderSpec { diffusivity_m2_s: Some(NonNegative::new(1e7)), ..spec() };
    let (n, side, mut sum) = (400_u32, 5, 0.0);
    for seed in 0..n {
        let m = build(&stiff, u64::from(seed));
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

#[test]
fn illegal_damping_and_grid_name_their_field() {
    let said = |s: MeanderSpec| {
        let e = s.build("water.currents[2]", &area(), Vector2::zeros(), 1.into());
        e.unwrap_err().to_string()
    };
    let over = MeanderSpec { damping: Positive::new(1.5), ..spec() };
    assert!(said(over).starts_with("water.currents[2].damping: must be > 0 and < 1"));
    let fine = MeanderSpec { cell_m: Positive::new(0.1), ..spec() };
    assert!(said(fine).starts_with("water.currents[2].cell_m: must be >= 1 "));
}
