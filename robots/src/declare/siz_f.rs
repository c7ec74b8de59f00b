//! Declares the most up-flow of the last detection points that lie near their mean, if there are enough of them.
//! Points far from the mean are left out.
//!
//! *Source*: Tian et al. 2013, section 3, eq. 5, algorithm 2.
//!
//! *Parameters*: ε_F, `size: Fixed`, m, 6; N_min, `points`, 6; N_ini, `initial`, not given.
//!
//! *Deviations*: algorithm 2 as printed tests the result inside the loop and would give up after its first removal.
//! Here the loop goes on until it finds a result or too few points are left, as the text says. At least N_min points
//! must be left (the algorithm), not more than N_min (the text). Of equally far points the most down-flow one is
//! removed first. N_ini is 1, which has no effect: the paper says that it matters only for very small N_min.

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
pub struct SizF {
    /// Greatest distance from the mean, m.
    #[default(ZoneSize::Fixed(Positive::new(6.0)))]
    pub size: ZoneSize,
    /// N_min: the number of points that must be left.
    #[default(NonZeroUsize::new(6).expect("6 is not zero"))]
    pub points: NonZeroUsize,
    /// N_ini: the number of points that there must be before anything is declared.
    #[default(NonZeroUsize::MIN)]
    pub initial: NonZeroUsize,
}

impl Listed for SizF {
    const ENTRY: Entry = Entry {
        name: "SizF",
        what: "the most up-flow of six or more last detection points within 6 m of their mean; others are left out",
        source: "Tian et al. 2013, section 3, algorithm 2",
    };
}

impl DeclareParams for SizF {
    fn needs(&self) -> NonZeroUsize {
        self.points.max(self.initial)
    }

    fn identify(&self, memory: &PlumeMemory, up_flow: Heading) -> Option<(Vector2<f64>, Evidence)> {
        self.declare(memory.lcdps.all(), up_flow, memory.fixes.scale_m())
    }

    fn zone(&self, memory: &PlumeMemory, up_flow: Heading) -> Zone {
        let points = memory.lcdps.all();
        let radius_m = self.size.radius_m(points, up_flow, memory.fixes.scale_m());
        let (left, _) = self.left(points, up_flow, radius_m);
        Zone::round(left.iter().map(|p| p.position).collect(), radius_m)
    }

    fn check_own(&self) -> Result<(), RobotError> {
        self.size.check("declare.SizF.size")
    }
}

impl SizF {
    /// The most up-flow (east, north), m, of those `points` (in order of time) that remain near their mean, if there
    /// are enough, and its evidence. `fix_m`, the error of a navigation fix along an axis, m, matters to an adaptive
    /// size only.
    pub fn declare(&self, points: &[Lcdp], up_flow: Heading, fix_m: f64) -> Option<(Vector2<f64>, Evidence)> {
        let radius_m = self.size.radius_m(points, up_flow, fix_m);
        let (left, near) = self.left(points, up_flow, radius_m);
        let first = left.first().filter(|_| near)?;
        Some((first.position, Evidence::from_points(&left)))
    }

    /// The points that are left in the end, most up-flow first, and whether all lie within `radius_m` of their mean;
    /// none if there are too few.
    fn left(&self, points: &[Lcdp], up_flow: Heading, radius_m: f64) -> (Vec<Lcdp>, bool) {
        if points.len() < self.needs().get() {
            return (Vec::new(), false);
        }
        let mut left = most_up_flow_first(points, up_flow);
        loop {
            let sum: Vector2<f64> = left.iter().map(|p| p.position).sum();
            let mean = sum / left.len() as f64;
            let far = |p: &Lcdp| (p.position - mean).norm();
            // The last of equals is the most down-flow one.
            let farthest = (left.iter().enumerate()).max_by(|a, b| far(a.1).total_cmp(&far(b.1)));
            match farthest {
                Some((_, most)) if far(most) <= radius_m => return (left, true),
                Some((k, _)) if left.len() > self.points.get() => _ = left.remove(k),
                _ => return (left, false),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declare::AdaptiveSize;
    use crate::declare::testing::{list, n, siz_f as rule, v};
    use crate::handoff::testing::fixed;
    use proptest::prelude::*;

    fn found(rule: &SizF, up_deg: f64, places: &[(f64, f64)]) -> Option<Vector2<f64>> {
        rule.declare(&list(places), Heading::from_deg(up_deg), 0.0).map(|(place, _)| place)
    }

    #[test]
    fn by_hand() {
        // Three near (0, 100), two left behind on the way up-flow.
        let places = [(0.0, 20.0), (0.0, 60.0), (1.0, 99.0), (-1.0, 100.0), (0.0, 101.0)];
        // Mean 76: 20 is 56 m off and goes; mean 90: 60 goes; then mean 100, farthest sqrt(2) m at most.
        assert_eq!(found(&rule(1.5, 3), 0.0, &places), Some(v(0.0, 101.0)));
        // Fewer than four points are left within 1.5 m.
        assert_eq!(found(&rule(1.5, 4), 0.0, &places), None);
        // 60, 99, 100, 101 within 30 m of their mean, 90: found with four.
        assert_eq!(found(&rule(30.0, 4), 0.0, &places), Some(v(0.0, 101.0)));
        // A distance equal to the size is enough.
        assert_eq!(found(&rule(2.0, 2), 0.0, &[(0.0, 0.0), (0.0, 4.0)]), Some(v(0.0, 4.0)));
    }

    #[test]
    fn flow_turned_about_declares_the_other_end() {
        let places = [(0.0, 1.0), (0.0, 0.0), (0.0, -1.0)];
        for (up_deg, north) in [(0.0, 1.0), (180.0, -1.0)] {
            assert_eq!(found(&rule(6.0, 3), up_deg, &places), Some(v(0.0, north)));
        }
        // Each point carries the flow of its time; only the present one counts.
        let mut points = list(&places);
        for (k, p) in points.iter_mut().enumerate() {
            let turned = if k % 2 == 0 { 1.0 } else { -1.0 };
            p.flow = Some(v(0.0, turned));
        }
        let (place, evidence) = rule(6.0, 3).declare(&points, Heading::from_deg(0.0), 0.0).expect("near");
        assert_eq!(place, v(0.0, 1.0));
        assert_eq!((evidence.points, evidence.since_s), (3, 0.0));
    }

    #[test]
    fn degenerate_clusters() {
        assert_eq!(found(&rule(6.0, 1), 0.0, &[]), None);
        assert_eq!(found(&rule(6.0, 3), 0.0, &[(1.0, 1.0); 2]), None);
        assert_eq!(found(&rule(1e-9, 3), 77.0, &[(1.0, 1.0); 3]), Some(v(1.0, 1.0)));
        let late = SizF { initial: n(5), ..rule(6.0, 3) };
        assert_eq!(found(&late, 0.0, &[(1.0, 1.0); 4]), None);
        assert!(found(&late, 0.0, &[(1.0, 1.0); 5]).is_some());
        // In a line across the flow all points are equally far up-flow: always the rightmost is declared.
        let line = [(0.0, 5.0), (4.0, 5.0), (2.0, 5.0)];
        assert_eq!(found(&rule(6.0, 3), 0.0, &line), Some(v(0.0, 5.0)));
        // Two pairs equally far: the down-flow pair is removed first, in any order in time.
        for places in
            [[(0.0, 0.0), (0.0, 0.0), (0.0, 80.0), (0.0, 80.0)], [(0.0, 80.0), (0.0, 0.0), (0.0, 80.0), (0.0, 0.0)]]
        {
            assert_eq!(found(&rule(6.0, 2), 0.0, &places), Some(v(0.0, 80.0)));
        }
    }

    #[test]
    fn an_adaptive_size_waits_for_headway_to_end() {
        let adaptive = SizF { size: ZoneSize::Adaptive(AdaptiveSize::default()), ..rule(6.0, 6) };
        let up = Heading::from_deg(0.0);
        // Headway of 2 m a point, 0.1 m across: the fixed zone declares on the way, the adaptive one does not.
        let way: Vec<_> = (0..6).map(|k| (0.1 * f64::from(k % 2), 2.0 * f64::from(k))).collect();
        assert!(rule(6.0, 6).declare(&list(&way), up, 0.0).is_some());
        assert!(adaptive.declare(&list(&way), up, 0.0).is_none());
        // No headway, 8 m either side across the flow: the fixed zone is too small for it.
        let wide: Vec<_> = (0..6).map(|k| (16.0 * f64::from(k % 2), f64::from(k))).collect();
        assert!(rule(6.0, 6).declare(&list(&wide), up, 0.0).is_none());
        let (place, _) = adaptive.declare(&list(&wide), up, 0.0).expect("no headway");
        assert_eq!(place, v(16.0, 5.0));
    }

    proptest! {
        #![proptest_config(fixed(256))]

        // The order in time does not matter to a fixed size. The declared place is a point with enough others near
        // it.
        #[test]
        fn order_does_not_matter_and_the_answer_has_company(
            places in proptest::collection::vec((-15.0..15.0f64, -15.0..15.0f64), 0..20),
            deg in 0.0..360.0f64, turn in 0usize..20,
        ) {
            let r = rule(6.0, 6);
            let answer = found(&r, deg, &places);
            let mut mixed = places.clone();
            mixed.reverse();
            if !mixed.is_empty() {
                let by = turn % mixed.len();
                mixed.rotate_left(by);
            }
            prop_assert_eq!(answer, found(&r, deg, &mixed));
            if let Some(a) = answer {
                let near = places.iter().filter(|(e, n)| (v(*e, *n) - a).norm() <= 12.0);
                prop_assert!(near.count() >= 6);
            }
        }
    }
}
