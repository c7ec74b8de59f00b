//! Declares when the most up-flow lost points lie close together along the flow.
//!
//! *Source*: Pang 2009, section 5.6.
//!
//! *Parameters*: number of points, `points`, 3; greatest difference along the flow, `within_m`, m, 4.
//!
//! *Deviations*: none. The points are sorted by the flow at the time of the test, whatever it was when
//! they were taken. The difference across the flow is not looked at, as in the paper, which names that
//! as the cause of its 31 m error.

use nalgebra::Vector2;
use serde::{Deserialize, Serialize};
use std::num::NonZeroUsize;
use world::ranges::Positive;
use world::units::Heading;

/// The rule's parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct AlongFlow {
    /// How many of the most up-flow points are compared.
    pub points: NonZeroUsize,
    /// They must differ by less than this along the flow, m.
    pub within_m: Positive,
}

impl Default for AlongFlow {
    fn default() -> Self {
        Self {
            points: NonZeroUsize::new(3).expect("3 is not zero"),
            within_m: Positive::new(4.0),
        }
    }
}

impl AlongFlow {
    /// The most up-flow of `points` (east, north; m), if enough of them lie close to it along the flow.
    #[must_use]
    pub fn declare(&self, points: &[Vector2<f64>], up_flow: Heading) -> Option<Vector2<f64>> {
        let up = up_flow.unit();
        let mut sorted: Vec<(f64, Vector2<f64>)> =
            points.iter().map(|p| (p.dot(&up), *p)).collect();
        sorted.sort_by(|a, b| b.0.total_cmp(&a.0));
        let (first, last) = (sorted.first()?, sorted.get(self.points.get() - 1)?);
        (first.0 - last.0 < self.within_m.get()).then_some(first.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn v(east: f64, north: f64) -> Vector2<f64> {
        Vector2::new(east, north)
    }

    #[test]
    fn by_hand() {
        let rule = AlongFlow::default();
        let north = Heading::from_deg(0.0);
        // 100, 97.5, 96.5: within 3.5 m, whatever lies behind them and across.
        let near = [v(0.0, 40.0), v(5.0, 97.5), v(-30.0, 100.0), v(9.0, 96.5)];
        assert_eq!(rule.declare(&near, north), Some(v(-30.0, 100.0)));
        // Exactly 4 m is not less than 4 m.
        assert_eq!(
            rule.declare(&[v(0.0, 0.0), v(0.0, 2.0), v(0.0, 4.0)], north),
            None
        );
        // Two are not three.
        assert_eq!(rule.declare(&near[1..3], north), None);
        assert_eq!(rule.declare(&[], north), None);
    }

    #[test]
    fn one_place_thrice_is_a_source() {
        let p = v(3.0, -8.0);
        let found = AlongFlow::default().declare(&[p; 3], Heading::from_deg(77.0));
        assert_eq!(found, Some(p));
    }

    #[test]
    fn flow_turned_about_looks_from_the_other_end() {
        let rule = AlongFlow::default();
        let points = [v(0.0, 100.0), v(0.0, 99.0), v(0.0, 98.0), v(0.0, 50.0)];
        assert_eq!(
            rule.declare(&points, Heading::from_deg(0.0)),
            Some(v(0.0, 100.0))
        );
        // From the south the first three are 50, 98, 99: 49 m apart.
        assert_eq!(rule.declare(&points, Heading::from_deg(180.0)), None);
        // From the side all lie abreast.
        assert!(rule.declare(&points, Heading::from_deg(90.0)).is_some());
    }

    proptest! {
        #![proptest_config(crate::handoff::testing::fixed(256))]

        #[test]
        fn order_of_the_list_does_not_matter(
            norths in proptest::collection::vec(-50.0..50.0f64, 3..7), deg in 0.0..360.0,
        ) {
            let up = Heading::from_deg(deg);
            let points: Vec<_> = norths.iter().map(|n| up.unit() * *n).collect();
            let mut turned = points.clone();
            turned.reverse();
            let rule = AlongFlow::default();
            prop_assert_eq!(rule.declare(&points, up), rule.declare(&turned, up));
        }
    }
}
