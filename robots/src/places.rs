//! Places in the operating area: moving a point inside.

use nalgebra::Vector2;
use world::area::Area;

/// Distance from the area's edge, m, within which no destination is placed: twice the 5 m of the cage's edge.
pub const MARGIN_M: f64 = 10.0;

/// The nearest place to `p` that is at least `margin_m` inside the area. Where the area is narrower than two margins,
/// its middle line.
pub fn inside(area: &Area, p: Vector2<f64>, margin_m: f64) -> Vector2<f64> {
    let q = area.local(p);
    let (l, w) = ((area.length_m / 2.0 - margin_m).max(0.0), (area.width_m / 2.0 - margin_m).max(0.0));
    if q.x.abs() <= l && q.y.abs() <= w {
        return p;
    }
    area.world(Vector2::new(q.x.clamp(-l, l), q.y.clamp(-w, w)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use world::units::Heading;

    proptest! {
        #![proptest_config(crate::handoff::testing::fixed(256))]

        #[test]
        fn brought_inside_and_edges_agree_with_the_area(x in -900.0..900.0, y in -400.0..400.0) {
            let area = Area {
                centre: Vector2::new(5.0, 9.0),
                length_m: 1094.0,
                width_m: 367.0,
                axis: Heading::from_deg(340.0),
            };
            let p = Vector2::new(x, y);
            let q = inside(&area, p, 10.0);
            prop_assert!(area.edge_distance(q).0 >= 10.0 - 1e-9);
            if area.edge_distance(p).0 >= 10.0 {
                prop_assert_eq!(p, q);
            }
            let nearest = area.sides().edges(q).iter().map(|e| e.0).fold(f64::INFINITY, f64::min);
            prop_assert!((nearest - area.edge_distance(q).0).abs() < 1e-9);
        }
    }
}
