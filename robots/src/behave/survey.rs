//! Passes over a place on parallel lines, one after the other, back and forth.
//!
//! *Source*: Pang 2009, section 4.2 ("a lawn mower search, or ... a side scan maneuver after it declares the source
//! location" by Follow Line) and section 6: the sidescan over the declared source gives its position.
//!
//! *Parameters*: distance of each line from the place, positive to the right of `along`, `offsets_m`, m; half the
//! length of the lines, `half_length_m`, m. The paper prints neither: see `strategy/survey`.
//!
//! *Deviations*: none. The ends of a line are held 10 m inside the area; a line with less than a metre left is not
//! flown.

use super::Stride;
use crate::handoff::Manoeuvre;
use crate::places::{MARGIN_M, inside};
use nalgebra::Vector2;
use std::f64::consts::FRAC_PI_2;
use world::area::Area;
use world::units::Heading;

/// Shortest line that is flown, m.
const SHORTEST_M: f64 = 1.0;
/// The vehicle is on its line if it is no farther from it and no more turned from it than this, m and rad.
const ON_LINE: (f64, f64) = (6.0, 0.35);

/// Lines over a place, and which of them is being flown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Passes {
    lines: Vec<(Vector2<f64>, Vector2<f64>)>,
    /// Lines begun.
    begun: usize,
}

impl Passes {
    /// Lines through points `offsets_m` to the right of `place`, looking along `along`. Each extends `half_length_m`
    /// to both ends.
    pub fn over(place: Vector2<f64>, along: Heading, offsets_m: &[f64], half_length_m: f64, area: &Area) -> Self {
        let right = along.turned(FRAC_PI_2).unit();
        let line = |(k, offset): (usize, &f64)| {
            let middle = place + right * *offset;
            let half = along.unit() * half_length_m * if k % 2 == 0 { 1.0 } else { -1.0 };
            let [from, to] = [middle - half, middle + half].map(|p| inside(area, p, MARGIN_M));
            ((to - from).norm() >= SHORTEST_M).then_some((from, to))
        };
        Self { lines: offsets_m.iter().enumerate().filter_map(line).collect(), begun: 0 }
    }

    /// One tick. `arrived` says whether the guidance has reached the end of the last line.
    pub fn step(&mut self, arrived: bool) -> Stride {
        if self.begun > 0 && !arrived {
            return Stride::Keep;
        }
        match self.lines.get(self.begun) {
            Some(&(from, to)) => {
                self.begun += 1;
                Stride::Start(Manoeuvre::FollowLine { from, to })
            }
            None => Stride::Over,
        }
    }

    /// Number (from 0) of the line being flown, if a vehicle at `position` on `course` is on it; `None` while it is
    /// on its way to the line.
    pub fn on_line(&self, position: Vector2<f64>, course: Heading) -> Option<usize> {
        let number = self.begun.checked_sub(1)?;
        let (from, to) = *self.lines.get(number)?;
        let way = to - from;
        let (length, u) = (way.norm(), way.normalize());
        let v = position - from;
        let (along, off) = (v.dot(&u), u.perp(&v).abs());
        let (most_m, most_rad) = ON_LINE;
        let on =
            along > 0.0 && along < length && off < most_m && course.turn_to(Heading::from_vector(way)).abs() < most_rad;
        on.then_some(number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handoff::testing::area;

    fn flown(mut passes: Passes) -> Vec<(Vector2<f64>, Vector2<f64>)> {
        let mut lines = Vec::new();
        for _ in 0..9 {
            match passes.step(true) {
                Stride::Start(Manoeuvre::FollowLine { from, to }) => lines.push((from, to)),
                Stride::Over => return lines,
                other => panic!("{other:?}"),
            }
            assert_eq!(passes.step(false), Stride::Keep);
        }
        panic!("more lines than asked for");
    }

    #[test]
    fn back_and_forth_beside_the_place() {
        let place = Vector2::new(20.0, 50.0);
        let east = Heading::from_deg(90.0);
        let lines = flown(Passes::over(place, east, &[-10.0, 10.0], 30.0, &area()));
        let near = |a: Vector2<f64>, x: f64, y: f64| (a - Vector2::new(x, y)).norm() < 1e-9;
        assert_eq!(lines.len(), 2);
        // Left of east is north.
        assert!(near(lines[0].0, -10.0, 60.0) && near(lines[0].1, 50.0, 60.0));
        assert!(near(lines[1].0, 50.0, 40.0) && near(lines[1].1, -10.0, 40.0));
    }

    #[test]
    fn lines_end_inside_the_area_and_what_is_left_of_one_outside_is_not_flown() {
        // The area reaches to 300 m north and 200 m east.
        let north = Heading::from_deg(0.0);
        let at_edge = Passes::over(Vector2::new(0.0, 295.0), north, &[0.0], 30.0, &area());
        let lines = flown(at_edge);
        assert!((lines[0].1 - Vector2::new(0.0, 290.0)).norm() < 1e-9);
        assert!((lines[0].0 - Vector2::new(0.0, 265.0)).norm() < 1e-9);
        let beyond = Passes::over(Vector2::new(0.0, 340.0), north, &[0.0], 30.0, &area());
        assert!(flown(beyond).is_empty());
        assert_eq!(Passes::default().step(false), Stride::Over);
    }

    #[test]
    fn on_the_line_only_between_its_ends_and_along_it() {
        let north = Heading::from_deg(0.0);
        let mut p = Passes::over(Vector2::zeros(), north, &[5.0, -5.0], 30.0, &area());
        assert_eq!(p.on_line(Vector2::new(5.0, 0.0), north), None);
        p.step(false);
        assert_eq!(p.on_line(Vector2::new(5.0, 0.0), north), Some(0));
        assert_eq!(p.on_line(Vector2::new(5.0, 0.0), Heading::from_deg(40.0)), None);
        assert_eq!(p.on_line(Vector2::new(5.0, 31.0), north), None);
        assert_eq!(p.on_line(Vector2::new(12.0, 0.0), north), None);
        p.step(true);
        assert_eq!(p.on_line(Vector2::new(-5.0, 0.0), north.opposite()), Some(1));
    }
}
