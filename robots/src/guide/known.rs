//! A course with what cage and flow compensation ask of it. A searcher that keeps its course asks for it again and
//! again.
//!
//! What is kept has the bits of what would be worked out.

use nalgebra::Vector2;
use world::units::Heading;

/// A course and its directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct CachedCourse {
    course: Heading,
    /// As a unit vector (east, north).
    pub(super) unit: Vector2<f64>,
    /// That vector as a heading, which differs from the course by rounding, and as a unit vector again.
    pub(super) again: (Heading, Vector2<f64>),
}

impl CachedCourse {
    pub(super) fn from_course(course: Heading) -> Self {
        let unit = course.unit();
        let again = Heading::from_vector(unit);
        Self { course, unit, again: (again, again.unit()) }
    }

    /// Exchanges it for another course, unless that has the same bits.
    pub(super) fn exchange(&mut self, course: Heading) {
        if self.course.rad().to_bits() != course.rad().to_bits() {
            *self = Self::from_course(course);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_always_knows_the_newest_course() {
        let mut known = CachedCourse::from_course(Heading::from_deg(0.0));
        for deg in [0.0, 10.0, 10.0, 10.000_000_000_001, 350.0, 0.0] {
            let course = Heading::from_deg(deg);
            known.exchange(course);
            assert_eq!(known.unit, course.unit());
            let again = Heading::from_vector(course.unit());
            assert_eq!(known.again, (again, again.unit()));
        }
    }
}
