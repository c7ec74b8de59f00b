//! Declares when the newest last detection points lie in a small box.
//!
//! *Source*: Tian et al. 2013, section 3, eq. 2-4, algorithm 1.
//!
//! *Parameters*: ε_T, `size: Fixed`, m, 4; N_dec, `points`, 6; N_ini, `initial`, not given. Before the missions of
//! 2002 the values were ε_T = 3 m and N_dec = 3, with which nothing was declared.
//!
//! *Deviations*: none by default. N_ini is 1, which has no effect: the paper says that it matters only for very small
//! N_dec. `size: Adaptive` takes twice the adaptive radius as the diagonal. `order: UpFlow` is another reading:
//! algorithm 1 takes the newest points "in the order of the time serials", as the default does; but its input is a
//! queue in up-flow order (eq. 1), and the REMUS of 2003, of which the paper says that it carried "a type of" this
//! rule with these 4 m, looked at the first points of a list in up-flow order (Pang 2009, section 5.6).

use super::rule::DeclareParams;
use super::zone_size::ZoneSize;
use crate::error::RobotError;
use crate::handoff::{Evidence, Lcdp, Zone};
use crate::memory::{PlumeMemory, most_up_flow_first};
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::num::NonZeroUsize;
use world::catalogue::Entry;
use world::ranges::Positive;
use world::registry::Listed;
use world::units::Heading;

/// The rule's parameters.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct SizT {
    /// Greatest diagonal of the points' bounding box (axes east and north), m.
    #[default(ZoneSize::Fixed(Positive::new(4.0)))]
    pub size: ZoneSize,
    /// N_dec: number of points considered.
    #[default(NonZeroUsize::new(6).expect("6 is not zero"))]
    pub points: NonZeroUsize,
    /// Which ones.
    pub order: Order,
    /// N_ini: the number of points that there must be before anything is declared.
    #[default(NonZeroUsize::MIN)]
    pub initial: NonZeroUsize,
}

/// The order whose first points are looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum Order {
    /// Newest first.
    #[default]
    Time,
    /// Most up-flow first, in the present flow.
    UpFlow,
}

impl Listed for SizT {
    const ENTRY: Entry = Entry {
        name: "SizT",
        what: "the mean of the six newest last detection points, when they lie within 4 m",
        source: "Tian et al. 2013, section 3, algorithm 1",
    };
}

impl DeclareParams for SizT {
    fn needs(&self) -> NonZeroUsize {
        self.points.max(self.initial)
    }

    fn identify(&self, memory: &PlumeMemory, up_flow: Heading) -> Option<(Vector2<f64>, Evidence)> {
        self.declare(memory.lcdps.all(), up_flow, memory.fixes.scale_m())
    }

    fn zone(&self, memory: &PlumeMemory, up_flow: Heading) -> Zone {
        let looked_at = self.looked_at(memory.lcdps.all(), up_flow).unwrap_or_default();
        let places = looked_at.iter().map(|p| p.position).collect();
        Zone::boxed(places, Heading::from_deg(0.0))
    }

    fn check_own(&self) -> Result<(), RobotError> {
        self.size.check("declare.SizT.size")
    }
}

impl SizT {
    /// The points that it looks at; `None` if there are too few.
    fn looked_at(&self, points: &[Lcdp], up_flow: Heading) -> Option<Vec<Lcdp>> {
        let n = self.points.get();
        if points.len() < n.max(self.initial.get()) {
            return None;
        }
        Some(match self.order {
            Order::Time => points[points.len() - n..].to_vec(),
            Order::UpFlow => {
                let mut sorted = most_up_flow_first(points, up_flow);
                sorted.truncate(n);
                sorted
            }
        })
    }

    /// The mean (east, north), m, of the considered `points` (given in order of time), if they lie close enough
    /// together, and its evidence. `fix_m`, the error of a navigation fix along an axis, m, matters to an adaptive
    /// size only; `up_flow` matters to an adaptive size and to the order of the same name.
    pub fn declare(&self, points: &[Lcdp], up_flow: Heading, fix_m: f64) -> Option<(Vector2<f64>, Evidence)> {
        let first = self.looked_at(points, up_flow)?;
        let corner = first[0].position;
        let (low, high) = first.iter().fold((corner, corner), |(l, h), p| (l.inf(&p.position), h.sup(&p.position)));
        let mean = first.iter().map(|p| p.position).sum::<Vector2<f64>>() / first.len() as f64;
        let near = (high - low).norm() <= self.size.diagonal_m(points, up_flow, fix_m);
        near.then(|| (mean, Evidence::from_points(&first)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declare::AdaptiveSize;
    use crate::declare::testing::{list, n, siz_t as rule, v};
    use crate::handoff::testing::fixed;
    use proptest::prelude::*;

    const NORTH: f64 = 0.0;

    fn found(rule: &SizT, places: &[(f64, f64)]) -> Option<Vector2<f64>> {
        rule.declare(&list(places), Heading::from_deg(NORTH), 0.0).map(|(place, _)| place)
    }

    #[test]
    fn by_hand() {
        // A box of 3 by 4 m: its diagonal is 5 m; the mean of the three newest is (11, 21).
        let places = [(90.0, 90.0), (10.0, 20.0), (13.0, 19.0), (10.0, 24.0)];
        let (place, evidence) = rule(5.9, 3).declare(&list(&places), Heading::from_deg(NORTH), 0.0).expect("near");
        assert_eq!(place, v(11.0, 21.0));
        // It rests on the newest; the farthest is (10, 24).
        let (points, since_s, reach_m) = (3, 1.0, 10f64.sqrt());
        assert_eq!(evidence, Evidence { points, since_s, middle_m: [11.0, 21.0], reach_m });
        // 3 by 5 m: sqrt(34) = 5.83.
        assert_eq!(found(&rule(5.8, 3), &places), None);
        // The fourth is 80 m away.
        assert_eq!(found(&rule(5.9, 4), &places), None);
        // A diagonal exactly as long as the size is enough: 3, 4, 5.
        let just = [(0.0, 0.0), (3.0, 4.0)];
        assert_eq!(found(&rule(5.0, 2), &just), Some(v(1.5, 2.0)));
    }

    #[test]
    fn degenerate_clusters() {
        assert_eq!(found(&rule(4.0, 3), &[]), None);
        let late = SizT { initial: n(5), ..rule(4.0, 3) };
        assert_eq!(found(&late, &[(1.0, 1.0); 4]), None);
        assert!(found(&late, &[(1.0, 1.0); 5]).is_some());
        assert_eq!(found(&rule(4.0, 3), &[(1.0, 1.0), (1.0, 1.0)]), None);
        // All in one place; all on a line.
        assert_eq!(found(&rule(1e-9, 3), &[(1.0, 1.0); 3]), Some(v(1.0, 1.0)));
        let line = [(0.0, 0.0), (2.0, 0.0), (4.0, 0.0)];
        assert_eq!(found(&rule(4.0, 3), &line), Some(v(2.0, 0.0)));
        assert_eq!(found(&rule(3.9, 3), &line), None);
    }

    #[test]
    fn in_up_flow_order_by_hand() {
        let up = SizT { order: Order::UpFlow, ..rule(2.9, 3) };
        // Three round (0, 100) with two farther down-flow between and after them: never the three newest.
        let places = [(0.0, 100.0), (0.0, 60.0), (2.0, 101.0), (1.0, 99.0), (5.0, 70.0)];
        assert_eq!(found(&rule(2.9, 3), &places), None);
        // A box of 2 by 2 m: its diagonal is 2.83 m; the mean of the three is (1, 100).
        assert_eq!(found(&up, &places), Some(v(1.0, 100.0)));
        assert_eq!(found(&up, &places[..3]), None);
        let (_, evidence) = (up.declare(&list(&places), Heading::from_deg(NORTH), 0.0)).expect("near");
        assert_eq!((evidence.points, evidence.since_s), (3, 0.0));
        // With the flow turned about, the most up-flow ones are those at 60, 70 and 99 m.
        let south = Heading::from_deg(180.0);
        assert!(up.declare(&list(&places), south, 0.0).is_none());
    }

    #[test]
    fn the_flow_does_not_matter_unless_the_size_adapts() {
        let points = list(&[(0.0, 0.0), (3.0, 0.0), (0.0, 1.0), (3.0, 1.0)]);
        for deg in [0.0, 90.0, 180.0] {
            let up = Heading::from_deg(deg);
            assert!(rule(4.0, 4).declare(&points, up, 0.0).is_some());
        }
        let adaptive = SizT {
            size: ZoneSize::Adaptive(AdaptiveSize { least_m: Positive::new(0.5), ..AdaptiveSize::default() }),
            ..rule(4.0, 4)
        };
        // Flow along north: 3 m across it, sigma 2.2 m. Flow along east: 1 m, sigma 0.74 m, and r = 1.8 m holds them
        // too.
        assert!(adaptive.declare(&points, Heading::from_deg(0.0), 0.0).is_some());
        // Stretched to 6 m along an eastward flow it holds them no more, but a fix that errs by 3 m explains them.
        let longer = list(&[(0.0, 0.0), (6.0, 0.0), (0.0, 1.0), (6.0, 1.0)]);
        let east = Heading::from_deg(270.0);
        assert!(adaptive.declare(&longer, east, 0.0).is_none());
        assert!(adaptive.declare(&longer, east, 3.0).is_some());
    }

    proptest! {
        #![proptest_config(fixed(256))]

        // Older points than N_dec and the order among the newest do not matter; a shift moves the answer.
        #[test]
        fn only_the_newest_count_in_any_order(
            places in proptest::collection::vec((-4.0..4.0f64, -4.0..4.0f64), 6..12), eps in 3.0..12.0f64,
            shift in -1000.0..1000.0f64,
        ) {
            let r = rule(eps, 6);
            let whole = found(&r, &places);
            let mut newest = places[places.len() - 6..].to_vec();
            newest.reverse();
            let turned = found(&r, &newest);
            prop_assert_eq!(whole.is_some(), turned.is_some());
            if let (Some(a), Some(b)) = (whole, turned) {
                prop_assert!((a - b).norm() < 1e-12);
                let moved: Vec<_> = places.iter().map(|(e, n)| (e + shift, *n)).collect();
                // Rounding may push a diagonal over the limit, so a little more is allowed.
                let c = found(&rule(eps + 1e-9, 6), &moved).expect("the same box elsewhere");
                prop_assert!((c - a - v(shift, 0.0)).norm() < 1e-9);
            }
        }
    }
}
