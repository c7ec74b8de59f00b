//! Turns a wanted velocity over ground into heading and speed through the water.
//!
//! *Source*: Pang 2009, section 4, eq. 1-3: V_f = V_g - F_g, heading = direction of V_f, speed = |V_f|.
//!
//! *Parameters*: greatest speed through the water, `water_speed_limit_m_s`, m/s, 2.
//!
//! *Deviations*: the paper does not say what happens if |V_f| exceeds the limit. Here the vehicle keeps the course
//! and takes the largest speed over ground within the limit. If the flow across the course alone exceeds the limit,
//! no course can be kept, and the vehicle drives in the direction of V_f at the limit.

use nalgebra::Vector2;
use world::units::Heading;

/// Heading and speed (m/s) through the water that give `speed_m_s` over ground along `course` in `flow` (m/s, where
/// it goes); `along` is the course as a unit vector.
pub(super) fn compensate(
    course: Heading,
    along: Vector2<f64>,
    speed_m_s: f64,
    flow: Vector2<f64>,
    limit_m_s: f64,
) -> (Heading, f64) {
    let through_water = along * speed_m_s - flow;
    if through_water.norm() <= limit_m_s {
        let speed = through_water.norm();
        // If drift alone gives the wanted speed, keep the nose on the course.
        let heading = if speed > 1e-9 { Heading::from_vector(through_water) } else { course };
        return (heading, speed);
    }
    let across = flow - along * flow.dot(&along);
    let left_for_along = limit_m_s * limit_m_s - across.norm_squared();
    if left_for_along <= 0.0 {
        return (Heading::from_vector(through_water), limit_m_s);
    }
    let kept = along * left_for_along.sqrt() - across;
    (Heading::from_vector(kept), limit_m_s)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn plainly(course: Heading, speed: f64, flow: Vector2<f64>, limit: f64) -> (Heading, f64) {
        compensate(course, course.unit(), speed, flow, limit)
    }

    #[test]
    fn crabs_into_a_cross_flow() {
        // 1 m/s north in 0.5 m/s eastward water: V_f = (-0.5, 1).
        let (h, v) = plainly(Heading::from_deg(0.0), 1.0, Vector2::new(0.5, 0.0), 2.0);
        assert!((h.deg() - (360.0 - 26.565_051)).abs() < 1e-5, "{}", h.deg());
        assert!((v - 1.25f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn head_flow_beyond_the_limit_takes_what_is_left() {
        let (h, v) = plainly(Heading::from_deg(90.0), 2.0, Vector2::new(-0.5, 0.0), 2.0);
        assert!((h.deg() - 90.0).abs() < 1e-9 && (v - 2.0).abs() < 1e-12);
    }

    proptest! {
        #![proptest_config(crate::handoff::testing::fixed(256))]

        #[test]
        fn course_is_kept_within_the_limit(
            course in 0.0..360.0, speed in 0.1..2.5, east in -1.2..1.2, north in -1.2..1.2,
        ) {
            let (course, flow) = (Heading::from_deg(course), Vector2::new(east, north));
            let (h, v) = plainly(course, speed, flow, 2.0);
            prop_assert!(v <= 2.0 + 1e-9);
            let ground = h.unit() * v + flow;
            // Flow is at most 1.7 m/s, so the course can be kept; the limit only costs speed.
            prop_assert!(ground.norm() < 1e-9 || course.turn_to(Heading::from_vector(ground)).abs() < 1e-6);
            prop_assert!(ground.norm() <= speed + 1e-9);
        }
    }
}
