//! Pictures of a place by a vehicle that hovers: it holds over points instead of passing along lines.
//!
//! *Source*: ours; vehicles that keep station inspect from there.
//!
//! *Parameters*: pictures over each point, `pictures`. A picture counts as taken over a point if the vehicle is no
//! farther from it than [`OVER_M`] and no farther from the wanted altitude than [`LEVEL_M`].
//!
//! *Deviations*: it goes to a point nose first and then turns its nose up-flow, where a hull has the least drag. If
//! pictures do not come, it leaves after three times as long as they take and [`PATIENCE_S`].

use nalgebra::Vector2;
use robots::behave::{Passes, Stride};
use robots::handoff::{Manoeuvre, Observation, Vertical};
use smart_default::SmartDefault;
use world::units::Heading;

/// Distance from a point within which a picture counts as taken over it, m.
const OVER_M: f64 = 1.0;
/// Difference from the wanted altitude within which pictures are taken, m.
const LEVEL_M: f64 = 0.3;
/// A point counts as reached within this distance, m.
const REACHED_M: f64 = 0.5;
/// How long it stays at a point beside the time for its pictures, s.
const PATIENCE_S: f64 = 30.0;
/// Distance between points that are compared, m.
const POINTS_M: f64 = 0.5;

/// How points are held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Holding {
    /// Pictures over each point.
    pub(super) pictures: u32,
    /// Time between two of them, s.
    pub(super) period_s: f64,
    /// Heading while it holds.
    pub(super) heading: Heading,
}

/// Points over which pictures are taken, one after the other.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Holds {
    how: Holding,
    points: Vec<Vector2<f64>>,
    /// Points begun.
    begun: usize,
    /// Since when the present one is held, s.
    since_s: Option<f64>,
    /// Pictures taken over the present one.
    taken: u32,
}

impl Holds {
    pub(super) fn new(points: Vec<Vector2<f64>>, how: Holding) -> Self {
        Self { how, points, begun: 0, since_s: None, taken: 0 }
    }

    /// One tick. `arrived` says whether the guidance has reached the last goal.
    fn step(&mut self, t_s: f64, arrived: bool) -> Stride {
        let point = self.begun.checked_sub(1).map(|n| self.points[n]);
        match (point, self.since_s) {
            (Some(point), None) => {
                if !arrived {
                    return Stride::Keep;
                }
                self.since_s = Some(t_s);
                return Stride::Start(Manoeuvre::Hold { point, heading: Some(self.how.heading) });
            }
            (Some(_), Some(since_s)) => {
                let most_s = 3.0 * f64::from(self.how.pictures) * self.how.period_s + PATIENCE_S;
                if self.taken < self.how.pictures && t_s - since_s < most_s {
                    return Stride::Keep;
                }
            }
            (None, _) => {}
        }
        let Some(&point) = self.points.get(self.begun) else {
            return Stride::Over;
        };
        self.begun += 1;
        self.since_s = None;
        self.taken = 0;
        Stride::Start(Manoeuvre::GoToPoint { point, radius_m: Some(REACHED_M) })
    }

    /// Number (from 0) of the point, if it is being held.
    fn over(&self, seen: &Observation, vertical: Option<Vertical>) -> Option<usize> {
        self.since_s?;
        let number = self.begun.checked_sub(1)?;
        let level = match (vertical, seen.estimate.altitude_m) {
            (Some(Vertical::Altitude(wanted)), Some(is)) => (is - wanted).abs() <= LEVEL_M,
            _ => true,
        };
        let off_m = (seen.estimate.position - self.points[number]).norm();
        (level && off_m <= OVER_M).then_some(number)
    }
}

/// The lines or points from which a place is looked at.
#[derive(Clone, Debug, SmartDefault, PartialEq)]
pub(super) enum ViewPlan {
    /// Along lines; by default none.
    #[default]
    Lines(Passes),
    /// Over points.
    Points(Holds),
}

impl ViewPlan {
    /// One tick. `arrived` says whether the guidance has reached the last goal.
    pub(super) fn step(&mut self, seen: &Observation, arrived: bool) -> Stride {
        match self {
            Self::Lines(passes) => passes.step(arrived),
            Self::Points(holds) => holds.step(seen.t_s, arrived),
        }
    }

    /// Number (from 0) of the line or point at which the vehicle is; `None` on its way there.
    pub(super) fn on(&self, seen: &Observation, vertical: Option<Vertical>) -> Option<usize> {
        match self {
            Self::Lines(passes) => {
                let course = Heading::from_vector(seen.estimate.v_ground());
                passes.on_line(seen.estimate.position, course)
            }
            Self::Points(holds) => holds.over(seen, vertical),
        }
    }

    /// Counts a picture.
    pub(super) fn took(&mut self) {
        if let Self::Points(holds) = self {
            holds.taken += 1;
        }
    }
}

/// The point within `within_m` of `middle` from which a picture that shows `half_m` to all sides shows the most of
/// `unseen`: places with weights. Of equal ones the nearest to `middle`.
pub(super) fn best_point(
    unseen: &[(Vector2<f64>, f64)],
    middle: Vector2<f64>,
    within_m: f64,
    half_m: f64,
) -> Vector2<f64> {
    let n = (within_m / POINTS_M).floor() as i32;
    let mut points: Vec<Vector2<f64>> = (-n..=n)
        .flat_map(|y| (-n..=n).map(move |x| Vector2::new(f64::from(x), f64::from(y)) * POINTS_M))
        .filter(|off| off.norm() <= within_m)
        .collect();
    points.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
    let shown = |off: &Vector2<f64>| -> f64 {
        let at = middle + off;
        (unseen.iter()).filter(|(p, _)| (p - at).norm() <= half_m).map(|(_, weight)| weight).sum()
    };
    let best = (points.into_iter()).map(|off| (off, shown(&off))).reduce(|a, b| if b.1 > 1.001 * a.1 { b } else { a });
    best.map_or(middle, |(off, _)| middle + off)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::seen;

    fn holds(points: &[[f64; 2]]) -> Holds {
        let how = Holding { pictures: 2, period_s: 1.0, heading: Heading::from_deg(30.0) };
        Holds::new(points.iter().map(|p| Vector2::from(*p)).collect(), how)
    }

    #[test]
    fn each_point_is_reached_held_and_left_with_its_pictures() {
        let mut flown = ViewPlan::Points(holds(&[[5.0, 0.0], [5.0, 4.0]]));
        let mut o = seen(0.0, Vector2::zeros(), 0.0, None);
        let wanted = Some(Vertical::Altitude(2.0));
        for (number, north) in [0.0, 4.0].into_iter().enumerate() {
            let point = Vector2::new(5.0, north);
            let go = Manoeuvre::GoToPoint { point, radius_m: Some(REACHED_M) };
            assert_eq!(flown.step(&o, true), Stride::Start(go));
            o.estimate.position = point;
            assert_eq!(flown.on(&o, wanted), None, "it is not held yet");
            assert_eq!(flown.step(&o, false), Stride::Keep);
            let hold = Manoeuvre::Hold { point, heading: Some(Heading::from_deg(30.0)) };
            assert_eq!(flown.step(&o, true), Stride::Start(hold));
            assert_eq!(flown.on(&o, wanted), Some(number));
            o.estimate.position.x += 1.2;
            assert_eq!(flown.on(&o, wanted), None, "carried off");
            o.estimate.position = point;
            assert_eq!(flown.on(&o, Some(Vertical::Altitude(1.4))), None, "high");
            flown.took();
            assert_eq!(flown.step(&o, true), Stride::Keep);
            flown.took();
        }
        assert_eq!(flown.step(&o, true), Stride::Over);
    }

    #[test]
    fn without_pictures_a_point_is_left_all_the_same() {
        let mut flown = ViewPlan::Points(holds(&[[5.0, 0.0]]));
        let mut o = seen(0.0, Vector2::zeros(), 0.0, None);
        assert!(matches!(flown.step(&o, true), Stride::Start(_)));
        assert!(matches!(flown.step(&o, true), Stride::Start(_)));
        o.t_s = 35.0;
        assert_eq!(flown.step(&o, true), Stride::Keep);
        o.t_s = 37.0;
        assert_eq!(flown.step(&o, true), Stride::Over);
    }

    #[test]
    fn the_next_point_shows_the_most_of_what_is_unseen() {
        let middle = Vector2::new(10.0, 20.0);
        let at = |unseen: &[(Vector2<f64>, f64)]| best_point(unseen, middle, 6.0, 1.2);
        assert_eq!(at(&[]), middle);
        let east = (middle + Vector2::new(3.0, 0.0), 1.0);
        let west = (middle + Vector2::new(-3.0, 0.0), 1.5);
        assert!((at(&[east, west]) - west.0).norm() < 1.2);
        let more = (middle + Vector2::new(3.4, 0.2), 1.0);
        assert!((at(&[east, west, more]) - east.0).norm() < 1.2);
        // Out of reach.
        assert_eq!(at(&[(middle + Vector2::new(30.0, 0.0), 9.0)]), middle);
    }
}
