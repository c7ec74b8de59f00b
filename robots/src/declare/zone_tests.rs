//! What the rules show of themselves agrees with what they decide.

use super::testing::{list, n, siz_f, siz_t};
use super::{AlongFlow, DeclareParams, SizOrder, SizT};
use crate::handoff::Zone;
use crate::memory::PlumeMemory;
use nalgebra::Vector2;
use proptest::prelude::*;
use world::units::Heading;

const POINTS: usize = 4;
const SIZE_M: f64 = 6.0;

fn memory(places: &[(f64, f64)]) -> PlumeMemory {
    let mut memory = PlumeMemory::new(n(20), n(20));
    list(places).into_iter().for_each(|point| memory.lose(point, Heading::from_deg(0.0)));
    memory
}

/// Whether the zone is as small as `SizT` asks for; `None` without a zone.
fn small_box(zone: &Zone) -> Option<bool> {
    Some((zone.corners.get(2)? - zone.corners.first()?).norm() <= SIZE_M)
}

/// Whether all points lie in the zone of `SizF`.
fn in_circle(zone: &Zone) -> Option<bool> {
    let middle = zone.corners.iter().sum::<Vector2<f64>>() / zone.corners.len().max(1) as f64;
    let far = |p: &Vector2<f64>| (p - middle).norm();
    let most = zone.points.iter().map(far).reduce(f64::max)?;
    Some(most <= SIZE_M + 1e-9)
}

#[test]
fn with_too_few_points_there_is_no_zone() {
    let (few, north) = (memory(&[(0.0, 0.0); 3]), Heading::from_deg(0.0));
    assert_eq!(siz_t(SIZE_M, POINTS).zone(&few, north), Zone::default());
    assert_eq!(siz_f(SIZE_M, POINTS).zone(&few, north), Zone::default());
    assert_eq!(AlongFlow::default().zone(&memory(&[]), north), Zone::default());
}

/// Three lost points 20 m apart, up-flow north-east: the zone is as long along the flow as the rule compares.
#[test]
fn along_the_flow_the_zone_lies_along_it() {
    let rule = AlongFlow::default();
    let n = rule.points.get();
    let slanted = Heading::from_deg(45.0);
    let along = slanted.unit();
    let places: Vec<_> = (0..=n).map(|k| along * (20.0 * k as f64)).map(|p| (p.x, p.y)).collect();
    let zone = rule.zone(&memory(&places), slanted);
    assert_eq!(zone.points.len(), n);
    let length = (zone.corners[1] - zone.corners[0]).norm();
    let width = (zone.corners[2] - zone.corners[1]).norm();
    assert!((length - 20.0 * (n - 1) as f64).abs() < 1e-9, "{length}");
    assert!(width < 1e-9, "{width}");
}

proptest! {
    /// The zone is small enough exactly when the rule declares.
    #[test]
    fn a_zone_is_small_enough_when_its_rule_declares(
        places in prop::collection::vec((-6.0..6.0, -6.0..6.0), 0..12),
        up_deg in 0.0..360.0,
    ) {
        let (memory, up) = (memory(&places), Heading::from_deg(up_deg));
        for order in [SizOrder::Time, SizOrder::UpFlow] {
            let rule = SizT { order, ..siz_t(SIZE_M, POINTS) };
            let declares = rule.identify(&memory, up).is_some();
            prop_assert_eq!(small_box(&rule.zone(&memory, up)).unwrap_or(false), declares);
        }
        let declares = siz_f(SIZE_M, POINTS).identify(&memory, up).is_some();
        prop_assert_eq!(in_circle(&siz_f(SIZE_M, POINTS).zone(&memory, up)).unwrap_or(false), declares);
    }
}
