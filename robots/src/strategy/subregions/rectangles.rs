//! The subregions as rectangles in the world.

use super::spec::{GridSpec, RectangleSpec, RegionsSpec};
use crate::error::{RobotError, require};
use nalgebra::Vector2;
use world::area::Area;

/// Rectangles may reach beyond the area's edges by rounding only, m.
const ROUNDING_M: f64 = 1e-6;

/// The subregions of `whole`, in the order of search.
pub(super) fn areas(spec: &RegionsSpec, whole: &Area) -> Result<Vec<Area>, RobotError> {
    let areas = match spec {
        RegionsSpec::Grid(grid) => parts(grid, whole)?,
        RegionsSpec::Rectangles(spec) => {
            (spec.list.iter().enumerate()).map(|(k, r)| rectangle(k, r, whole)).collect::<Result<Vec<_>, _>>()?
        }
    };
    require(!areas.is_empty(), "regions", "must name at least one")?;
    Ok(areas)
}

fn parts(grid: &GridSpec, whole: &Area) -> Result<Vec<Area>, RobotError> {
    let (n, m) = (grid.along.get(), grid.across.get());
    let (length_m, width_m) = (whole.length_m / f64::from(n), whole.width_m / f64::from(m));
    let part = |(k, &(i, j)): (usize, &(u32, u32))| {
        let field = format!("regions.order[{k}]");
        let legal = format!("(0, 0) to ({}, {})", n - 1, m - 1);
        require(i < n && j < m, &field, format!("must be {legal}, got ({i}, {j})"))?;
        require(!grid.order[..k].contains(&(i, j)), &field, format!("({i}, {j}) occurs twice"))?;
        let at = Vector2::new(
            (f64::from(i) + 0.5) * length_m - whole.length_m / 2.0,
            (f64::from(j) + 0.5) * width_m - whole.width_m / 2.0,
        );
        Ok(Area { centre: whole.world(at), length_m, width_m, axis: whole.axis })
    };
    grid.order.iter().enumerate().map(part).collect()
}

fn rectangle(k: usize, r: &RectangleSpec, whole: &Area) -> Result<Area, RobotError> {
    let side = |name: &str, (from, to): (f64, f64), half: f64| {
        let field = format!("regions.list[{k}].{name}");
        require(from < to, &field, format!("must begin with the smaller number, got ({from}, {to})"))?;
        let legal = format!("-{half} to {half} (the operating area)");
        require(
            from >= -half - ROUNDING_M && to <= half + ROUNDING_M,
            &field,
            format!("must lie in {legal}, got ({from}, {to})"),
        )?;
        Ok((0.5 * (from + to), to - from))
    };
    let both = |(from, to): (world::ranges::Finite, world::ranges::Finite)| (from.get(), to.get());
    let (x, length_m) = side("along_m", both(r.along_m), whole.length_m / 2.0)?;
    let (y, width_m) = side("across_m", both(r.across_m), whole.width_m / 2.0)?;
    Ok(Area { centre: whole.world(Vector2::new(x, y)), length_m, width_m, axis: whole.axis })
}

#[cfg(test)]
mod tests {
    use super::super::spec::RectanglesSpec;
    use super::*;
    use std::num::NonZeroU32;
    use world::ranges::Finite;
    use world::units::Heading;

    /// 400 m by 100 m, long side to the east-south-east.
    fn whole() -> Area {
        Area { centre: Vector2::new(30.0, -20.0), length_m: 400.0, width_m: 100.0, axis: Heading::from_deg(120.0) }
    }

    fn grid(order: &[(u32, u32)]) -> Result<Vec<Area>, RobotError> {
        let two = NonZeroU32::new(2).expect("2 is not zero");
        let order = order.to_vec();
        areas(&RegionsSpec::Grid(GridSpec { along: two, across: two, order }), &whole())
    }

    fn rectangles(list: &[[f64; 4]]) -> Result<Vec<Area>, RobotError> {
        let of = |&[a, b, c, d]: &[f64; 4]| RectangleSpec {
            along_m: (Finite::new(a), Finite::new(b)),
            across_m: (Finite::new(c), Finite::new(d)),
        };
        let list = list.iter().map(of).collect();
        areas(&RegionsSpec::Rectangles(RectanglesSpec { list }), &whole())
    }

    #[test]
    fn parts_turn_with_the_area() {
        let got = grid(&[(1, 0), (0, 0)]).expect("legal");
        assert_eq!(got.len(), 2);
        let front_left = got[0];
        assert_eq!((front_left.length_m, front_left.width_m), (200.0, 50.0));
        assert_eq!(front_left.axis, whole().axis);
        // By hand: 100 m along 120 degrees (E 86.603, N -50), 25 m to its left, along 30 degrees (E 12.5, N 21.651).
        let by_hand = Vector2::new(30.0 + 86.602_54 + 12.5, -20.0 - 50.0 + 21.650_64);
        assert!((front_left.centre - by_hand).norm() < 1e-4, "{front_left:?}");
        // The front left corner of the whole area is also the part's.
        let corner = whole().world(Vector2::new(200.0, -50.0));
        assert!(front_left.corners().iter().any(|c| (c - corner).norm() < 1e-9));
        // Two points close to the line between front and rear, one on each side.
        let beside = |along| whole().world(Vector2::new(along, -30.0));
        assert!(front_left.contains(beside(0.01)) && !front_left.contains(beside(-0.01)));
        assert!(got[1].contains(beside(-0.01)) && !got[1].contains(beside(0.01)));
    }

    #[test]
    fn rectangles_are_in_the_areas_axes() {
        let got = rectangles(&[[-200.0, -100.0, 10.0, 50.0]]).expect("legal")[0];
        assert_eq!((got.length_m, got.width_m), (100.0, 40.0));
        assert!((whole().local(got.centre) - Vector2::new(-150.0, 30.0)).norm() < 1e-9);
    }

    #[test]
    fn says_what_is_wrong_and_where() {
        let said = |e: Result<Vec<Area>, RobotError>| e.expect_err("illegal").to_string();
        for (text, wanted) in [
            (said(grid(&[])), "regions"),
            (said(grid(&[(0, 0), (2, 1)])), "regions.order[1]"),
            (said(grid(&[(0, 1), (0, 1)])), "twice"),
            (said(rectangles(&[[5.0, 5.0, 0.0, 1.0]])), "along_m"),
            (said(rectangles(&[[0.0, 5.0, 0.0, 50.1]])), "-50 to 50"),
        ] {
            assert!(text.contains(wanted), "{text}");
        }
    }
}
