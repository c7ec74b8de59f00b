//! Keeps the vehicle in the operating area.
//!
//! *Source*: Pang 2009, section 4.4, eq. 11-13.
//!
//! *Parameters*: width of the cage's edge, `cage_m`, m, 5; abort distance, `abort_outside_m`, m, 30.
//!
//! *Deviations*: eq. 12 removes the component along N whatever its sign, which would also hold back a vehicle heading
//! inward: here only an outward component (V·N > 0) is changed. Eq. 11 and 13 order north and east differently: here
//! the order is (east, north) throughout. In a corner both edges act. If nothing is left of the command (straight
//! outward at the edge), the course is the inward normal.

use nalgebra::Vector2;
use world::area::Sides;
use world::units::Heading;

/// The course to take instead of a commanded course at `position`.
pub(super) fn cage(course: Heading, position: Vector2<f64>, sides: &Sides, width_m: f64) -> Heading {
    let wanted = course.unit();
    altered(wanted, position, sides, width_m).unwrap_or_else(|| Heading::from_vector(wanted))
}

/// The course to take instead of one with this unit vector; `None` if no edge stands against it.
pub(super) fn altered(wanted: Vector2<f64>, position: Vector2<f64>, sides: &Sides, width_m: f64) -> Option<Heading> {
    let (nearest_m, normal) = sides.edge_distance(position);
    if nearest_m < 0.0 {
        return Some(Heading::from_vector(-normal));
    }
    if nearest_m >= width_m {
        return None;
    }
    let mut left = wanted;
    for (distance_m, normal) in sides.edges(position) {
        let outward = wanted.dot(&normal);
        if distance_m < width_m && outward > 0.0 {
            left -= normal * ((1.0 - distance_m / width_m) * outward);
        }
    }
    if left.norm() < 1e-9 {
        return Some(Heading::from_vector(-normal));
    }
    (left != wanted).then(|| Heading::from_vector(left))
}

/// Whether a position is farther outside than allowed.
pub(super) fn lost(position: Vector2<f64>, sides: &Sides, abort_outside_m: f64) -> bool {
    sides.edge_distance(position).0 < -abort_outside_m
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use world::area::Area;

    fn duck() -> Area {
        Area { centre: Vector2::new(3.0, -7.0), length_m: 1094.0, width_m: 367.0, axis: Heading::from_deg(340.0) }
    }

    #[test]
    fn half_the_outward_part_at_half_width() {
        let area = Area { axis: Heading::from_deg(0.0), centre: Vector2::zeros(), ..duck() };
        // North-east at 2.5 m from the north edge: north part halved, atan2(1, 0.5) = 63.43 deg.
        let p = Vector2::new(0.0, 547.0 - 2.5);
        let c = cage(Heading::from_deg(45.0), p, &area.sides(), 5.0);
        assert!((c.deg() - 63.434_949).abs() < 1e-5, "{}", c.deg());
        // A course heading inward is not changed.
        let c = cage(Heading::from_deg(135.0), p, &area.sides(), 5.0);
        assert!((c.deg() - 135.0).abs() < 1e-9);
    }

    proptest! {
        #![proptest_config(crate::handoff::testing::fixed(256))]

        #[test]
        fn never_outward_at_the_edge(course in 0.0..360.0, side in 0usize..4, at in -0.999..0.999, out in 0.0..40.0) {
            let a = duck();
            let (l, w) = (a.length_m / 2.0, a.width_m / 2.0);
            let (on, beyond, n) = match side {
                0 => (Vector2::new(l, at * w), Vector2::new(out, 0.0), Vector2::new(1.0, 0.0)),
                1 => (Vector2::new(-l, at * w), Vector2::new(-out, 0.0), Vector2::new(-1.0, 0.0)),
                2 => (Vector2::new(at * l, w), Vector2::new(0.0, out), Vector2::new(0.0, 1.0)),
                _ => (Vector2::new(at * l, -w), Vector2::new(0.0, -out), Vector2::new(0.0, -1.0)),
            };
            let course = cage(Heading::from_deg(course), a.world(on + beyond), &a.sides(), 5.0);
            let outward = a.world(n) - a.world(Vector2::zeros());
            prop_assert!(course.unit().dot(&outward) < 1e-6);
        }

        #[test]
        fn far_inside_nothing_changes(course in 0.0..360.0, x in -500.0..500.0, y in -170.0..170.0) {
            let a = duck();
            let h = Heading::from_deg(course);
            let c = cage(h, a.world(Vector2::new(x, y)), &a.sides(), 5.0);
            prop_assert!(h.turn_to(c).abs() < 1e-9);
        }
    }
}
