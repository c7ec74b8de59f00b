//! Declares when the most up-flow lost points lie close together along the flow.
//!
//! *Source*: Pang 2009, section 5.6.
//!
//! *Parameters*: number of points, `points`, 3; greatest difference along the flow, `within_m`, m, 4; greatest
//! difference across it, `across_m`, m, none.
//!
//! *Deviations*: none by default. The points are sorted by the flow at the time of the test, not by the flow at the
//! time when they were stored. As in the paper, the difference across the flow is not tested. The paper names that
//! among the causes of its 31 m error, and a bound on it as future work: `across_m` is that bound.

use super::rule::{DeclareParams, Points};
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
pub struct AlongFlow {
    /// How many of the most up-flow points are compared.
    #[default(NonZeroUsize::new(3).expect("3 is not zero"))]
    pub points: NonZeroUsize,
    /// They must differ by less than this along the flow, m.
    #[default(Positive::new(4.0))]
    pub within_m: Positive,
    /// They must differ by less than this across the flow, m; tested only if given.
    pub across_m: Option<Positive>,
}

impl Listed for AlongFlow {
    const ENTRY: Entry = Entry {
        name: "AlongFlow",
        what: "the most up-flow lost point, when the first three differ by under 4 m along the flow",
        source: "Pang 2009, section 5.6",
    };
}

impl DeclareParams for AlongFlow {
    fn points(&self) -> Points {
        Points::Lost
    }

    fn needs(&self) -> NonZeroUsize {
        self.points
    }

    fn identify(&self, memory: &PlumeMemory, up_flow: Heading) -> Option<(Vector2<f64>, Evidence)> {
        self.declare(memory.lost.all(), up_flow)
    }

    fn zone(&self, memory: &PlumeMemory, up_flow: Heading) -> Zone {
        let points = most_up_flow_first(memory.lost.all(), up_flow);
        let leading = points.get(..self.points.get()).unwrap_or_default();
        Zone::boxed(leading.iter().map(|p| p.position).collect(), up_flow)
    }
}

impl AlongFlow {
    /// The most up-flow of `points` (east, north; m), if enough of them lie close to it along the flow, and also
    /// across it if `across_m` is given; and the points that the result rests on.
    pub fn declare(&self, points: &[Lcdp], up_flow: Heading) -> Option<(Vector2<f64>, Evidence)> {
        let up = up_flow.unit();
        let mut sorted: Vec<(f64, &Lcdp)> = points.iter().map(|p| (p.position.dot(&up), p)).collect();
        sorted.sort_by(|a, b| b.0.total_cmp(&a.0));
        let leading = sorted.get(..self.points.get())?;
        let (first, last) = (leading.first()?, leading.last()?);
        let along = first.0 - last.0 < self.within_m.get();
        let across = self.across_m.is_none_or(|most_m| {
            let y = leading.iter().map(|(_, p)| p.in_flow(up_flow).y);
            let (low, high) = y.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), y| (l.min(y), h.max(y)));
            high - low < most_m.get()
        });
        (along && across).then(|| (first.1.position, Evidence::from_points(leading.iter().map(|(_, p)| *p))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declare::testing::{list, v};

    fn found(rule: &AlongFlow, points: &[(f64, f64)], up_deg: f64) -> Option<Vector2<f64>> {
        rule.declare(&list(points), Heading::from_deg(up_deg)).map(|(place, _)| place)
    }

    #[test]
    fn by_hand() {
        let rule = AlongFlow::default();
        // 100, 97.5, 96.5: within 3.5 m. What lies behind them or across does not matter.
        let near = [(0.0, 40.0), (5.0, 97.5), (-30.0, 100.0), (9.0, 96.5)];
        assert_eq!(found(&rule, &near, 0.0), Some(v(-30.0, 100.0)));
        // Exactly 4 m is not less than 4 m.
        assert_eq!(found(&rule, &[(0.0, 0.0), (0.0, 2.0), (0.0, 4.0)], 0.0), None);
        // Two points where three are needed.
        assert_eq!(found(&rule, &near[1..3], 0.0), None);
        assert_eq!(found(&rule, &[], 0.0), None);
    }

    #[test]
    fn flow_turned_about_looks_from_the_other_end() {
        let rule = AlongFlow::default();
        let points = [(0.0, 100.0), (0.0, 99.0), (0.0, 98.0), (0.0, 50.0)];
        assert_eq!(found(&rule, &points, 0.0), Some(v(0.0, 100.0)));
        // From the south the first three are 50, 98, 99: 49 m apart.
        assert_eq!(found(&rule, &points, 180.0), None);
        // Seen from the side, all lie side by side.
        assert!(found(&rule, &points, 90.0).is_some());
    }

    #[test]
    fn a_bound_across_the_flow() {
        // Within 3.5 m along the flow, 39 m apart across it.
        let wide = [(5.0, 97.5), (-30.0, 100.0), (9.0, 96.5)];
        let bound = |m| AlongFlow { across_m: Some(Positive::new(m)), ..AlongFlow::default() };
        assert_eq!(found(&bound(39.0), &wide, 0.0), None);
        assert_eq!(found(&bound(39.1), &wide, 0.0), Some(v(-30.0, 100.0)));
        // A fourth point far to the side, but farther down-flow, does not matter.
        let more = [wide[0], wide[1], wide[2], (200.0, 0.0)];
        assert!(found(&bound(39.1), &more, 0.0).is_some());
    }
}
