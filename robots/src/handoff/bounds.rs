//! Finds numbers in decisions and orders that nobody can carry out: not finite, or far outside of what any vehicle does.
//!
//! All decisions pass here, whichever way they come: those of strategies and those of searchers outside this program.

use super::{Behaviour, Decision, Declaration, Goal, HeadGoal, HeadOrder, Manoeuvre, MoveOrder, Shown, Vertical};
use nalgebra::{Vector2, Vector3};
use world::units::Heading;

/// Within what numbers must lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Places and heights, m.
    far_m: f64,
    /// Speeds, m/s.
    fast_m_s: f64,
    /// Least height and speed.
    least: f64,
}

impl Bounds {
    /// Of code that is not part of this program: no place of a scenario is farther from its datum, no vehicle faster.
    pub const OWN: Self = Self { far_m: 1e6, fast_m_s: 100.0, least: 0.0 };
    /// Of strategies of this program: any number, if it is one. The scenario's limits have bounded their parameters.
    pub const ANY: Self = Self { far_m: f64::MAX, fast_m_s: f64::MAX, least: -f64::MAX };

    /// Those for a strategy: of another crate, or of this program.
    pub fn for_origin(own: bool) -> Self {
        if own { Self::OWN } else { Self::ANY }
    }

    fn place(self, field: &str, values: &[f64]) -> Option<String> {
        within(field, values, self.far_m)
    }

    fn heading(self, heading: Heading) -> Option<String> {
        self.place("heading_rad", &[heading.rad()])
    }

    fn at_least(self, field: &str, value: f64, most: f64) -> Option<String> {
        let wrong = !(self.least..=most).contains(&value);
        wrong.then(|| match self.least {
            0.0 => format!("`{field}` must be from 0 to {most}, got {value}"),
            _ => format!("`{field}` must be a number, got {value}"),
        })
    }

    fn above_0(self, field: &str, values: &[f64], most: f64) -> Option<String> {
        if self == Self::ANY {
            return within(field, values, most);
        }
        let wrong = values.iter().find(|v| !(**v > 0.0 && **v <= most))?;
        Some(format!("`{field}` must be above 0 and at most {most}, got {wrong}"))
    }

    fn radius(self, radius_m: Option<f64>) -> Option<String> {
        self.above_0("radius_m", radius_m.as_slice(), self.far_m)
    }

    fn manoeuvre(self, manoeuvre: &Manoeuvre) -> Option<String> {
        match manoeuvre {
            Manoeuvre::GoToPoint { point, radius_m } => {
                (self.radius(*radius_m)).or_else(|| self.place("point_m", point.as_slice()))
            }
            Manoeuvre::SlideTo { point, heading, radius_m } => (self.radius(*radius_m))
                .or_else(|| self.place("point_m", point.as_slice()))
                .or_else(|| self.heading(*heading)),
            Manoeuvre::FollowLine { from, to } => {
                (self.place("from_m", from.as_slice())).or_else(|| self.place("to_m", to.as_slice()))
            }
            Manoeuvre::GoToPointWithHeading { point, heading } => {
                (self.place("point_m", point.as_slice())).or_else(|| self.heading(*heading))
            }
            Manoeuvre::Hold { point, heading } => {
                (self.place("point_m", point.as_slice())).or_else(|| heading.and_then(|h| self.heading(h)))
            }
            Manoeuvre::Course { course: heading } | Manoeuvre::Steer { heading } => self.heading(*heading),
            Manoeuvre::Slide { heading, over_ground_m_s: v } => {
                (self.heading(*heading)).or_else(|| within("velocity_m_s", v.as_slice(), self.fast_m_s))
            }
            Manoeuvre::Drives(set) => self.place("drives", set.all()),
            Manoeuvre::Direct { rudder_rad, stern_rad, rpm } => self.place("direct", &[*rudder_rad, *stern_rad, *rpm]),
        }
    }

    fn vertical(self, vertical: Vertical) -> Option<String> {
        match vertical {
            Vertical::Depth(m) => self.at_least("depth_m", m, self.far_m),
            Vertical::Altitude(m) => self.at_least("altitude_m", m, self.far_m),
        }
    }

    fn speed(self, speed_m_s: f64) -> Option<String> {
        self.at_least("speed_m_s", speed_m_s, self.fast_m_s)
    }
}

fn within(field: &str, values: &[f64], most: f64) -> Option<String> {
    let wrong = values.iter().find(|v| !(v.abs() <= most))?;
    Some(if most < f64::MAX {
        format!("`{field}` must be within ±{most}, got {wrong}")
    } else {
        format!("`{field}` must be a number, got {wrong}")
    })
}

impl Goal {
    /// What of it cannot be carried out.
    pub fn fault(&self, bounds: Bounds) -> Option<String> {
        // Who sets the drives asks for neither height nor speed; what stands there is only shown.
        let bypasses = matches!(self.manoeuvre, Manoeuvre::Direct { .. } | Manoeuvre::Drives(_));
        let held = if bypasses { Bounds::ANY } else { bounds };
        (bounds.manoeuvre(&self.manoeuvre))
            .or_else(|| held.vertical(self.vertical))
            .or_else(|| held.speed(self.speed_m_s))
    }
}

impl MoveOrder {
    /// What of it a vehicle with so many drives cannot carry out.
    pub fn fault(&self, drives: usize) -> Option<String> {
        let bounds = Bounds::OWN;
        if let Manoeuvre::Drives(set) = &self.manoeuvre
            && set.all().len() != drives
        {
            return Some(format!(
                "`drives` must have a set-point for each of the vehicle's {drives} drives, got {}",
                set.all().len()
            ));
        }
        (bounds.manoeuvre(&self.manoeuvre))
            .or_else(|| self.vertical.and_then(|v| bounds.vertical(v)))
            .or_else(|| self.speed_m_s.and_then(|m_s| bounds.speed(m_s)))
    }
}

impl HeadOrder {
    /// What of it no gantry can carry out.
    pub fn fault(&self, bounds: Bounds) -> Option<String> {
        let speeds = self.speed_m_s.as_ref().map_or(&[][..], |v| v.as_slice());
        (bounds.above_0("speed_m_s", speeds, bounds.fast_m_s))
            .or_else(|| bounds.place("target_m", self.target_m.as_slice()))
            .or_else(|| {
                let wrong = !Behaviour::OF_GANTRY.contains(&self.behaviour);
                wrong.then(|| format!("`behaviour` must be one of a gantry, got {:?}", self.behaviour.name()))
            })
    }
}

impl Declaration {
    /// What of it is no place or no number.
    pub fn fault(&self, bounds: Bounds) -> Option<String> {
        let place = |field: &str, p: &[f64]| bounds.place(&format!("declare.{field}"), p);
        (place("position_m", self.position.as_slice()))
            .or_else(|| place("z_m", self.z_m.as_slice()))
            .or_else(|| within("declare.t_s", &[self.t_s], f64::MAX))
            .or_else(|| self.surveyed.and_then(|p| place("surveyed_m", p.as_slice())))
            .or_else(|| {
                let e = self.evidence?;
                let [east_m, north_m] = e.middle_m;
                let numbers = [e.since_s, east_m, north_m, e.reach_m];
                within("declare.evidence", &numbers, f64::MAX)
            })
            .or_else(|| {
                let seen = self.looked?;
                let visibility_m = seen.visibility_m.unwrap_or(0.0);
                let numbers = [seen.lowest_m, visibility_m, seen.log_factor];
                let wrong = numbers.iter().any(|v| v.is_nan());
                wrong.then(|| "`declare.looked` must hold numbers, got NaN".to_string())
            })
    }
}

impl Decision {
    /// What of it cannot be carried out or shown.
    pub fn fault(&self, bounds: Bounds) -> Option<String> {
        (self.goal.fault(bounds)).or_else(|| self.declared.and_then(|d| d.fault(bounds)))
    }
}

impl Shown {
    /// What of it cannot be shown.
    pub fn fault(&self, bounds: Bounds) -> Option<String> {
        let lost = |p: &Vector2<f64>| bounds.place("lost_points_m", p.as_slice());
        let planned = |p: &Vector3<f64>| bounds.place("planned_m", p.as_slice());
        (self.lost_points.iter().find_map(lost)).or_else(|| self.planned.iter().find_map(planned))
    }
}

impl Decision<HeadGoal> {
    /// What of it cannot be carried out or shown.
    pub fn fault(&self, bounds: Bounds) -> Option<String> {
        let HeadGoal { id, target_m, speed_m_s } = self.goal;
        // Before its first motion there is no speed.
        let order =
            HeadOrder { id: Some(id), target_m, speed_m_s: (id > 0).then_some(speed_m_s), behaviour: self.behaviour };
        order.fault(bounds)
    }
}

#[cfg(test)]
mod tests {
    use super::super::Evidence;
    use super::*;

    fn goal(speed_m_s: f64) -> Goal {
        Goal::none_yet(Vertical::Depth(2.0), speed_m_s)
    }

    fn said(goal: Goal) -> String {
        (goal.fault(Bounds::OWN)).unwrap_or_else(|| "fine".to_string())
    }

    #[test]
    fn numbers_that_no_vehicle_can_carry_out_are_named() {
        assert_eq!(said(goal(1.5)), "fine");
        for (speed_m_s, got) in [(f64::NAN, "NaN"), (-3.0, "-3"), (1e9, "1000000000")] {
            let want = format!("`speed_m_s` must be from 0 to 100, got {got}");
            assert_eq!(said(goal(speed_m_s)), want);
        }
        let nan = f64::NAN;
        let nowhere = Vector2::new(0.0, nan);
        let (point, radius_m) = (Vector2::zeros(), Some(0.0));
        let heading = Heading::from_rad(nan);
        for (manoeuvre, field) in [
            (Manoeuvre::GoToPoint { point: nowhere, radius_m: None }, "point_m"),
            (Manoeuvre::GoToPoint { point, radius_m }, "radius_m"),
            (Manoeuvre::FollowLine { from: point, to: nowhere }, "to_m"),
            (Manoeuvre::GoToPointWithHeading { point, heading }, "heading_rad"),
            (Manoeuvre::Hold { point, heading: Some(heading) }, "heading_rad"),
            (Manoeuvre::Course { course: heading }, "heading_rad"),
            (Manoeuvre::Steer { heading }, "heading_rad"),
            (Manoeuvre::Direct { rudder_rad: nan, stern_rad: 0.0, rpm: 0.0 }, "direct"),
        ] {
            let told = said(Goal { manoeuvre, ..goal(1.5) });
            assert!(told.starts_with(&format!("`{field}` must be ")), "{told}");
        }
        for vertical in [Vertical::Depth(-1.0), Vertical::Altitude(nan)] {
            assert!(said(Goal { vertical, ..goal(1.5) }).contains("must be from 0 to 1000000"));
        }
        // Of this program's own strategies only what is no number is told of.
        assert_eq!(goal(1e9).fault(Bounds::ANY), None);
        let told = goal(nan).fault(Bounds::ANY);
        assert_eq!(told.as_deref(), Some("`speed_m_s` must be a number, got NaN"));
    }

    #[test]
    fn a_gantry_does_what_gantries_do() {
        let said = |behaviour| Decision::new(behaviour, HeadGoal::default()).fault(Bounds::OWN);
        assert_eq!(said(Behaviour::Sweep), None);
        let told = said(Behaviour::GoHome);
        assert_eq!(told.as_deref(), Some("`behaviour` must be one of a gantry, got \"go_home\""));
    }

    #[test]
    fn what_is_declared_must_be_a_place() {
        let fine = Declaration::first(3.0, Vector2::new(1.0, 2.0), "own");
        let said = |declared: Declaration| {
            let decision = Decision { declared: Some(declared), ..Decision::new(Behaviour::Find, goal(1.0)) };
            decision.fault(Bounds::OWN).unwrap_or_default()
        };
        assert_eq!(said(fine), "");
        let nan = f64::NAN;
        let evidence = Evidence { points: 1, since_s: nan, middle_m: [0.0; 2], reach_m: 0.0 };
        for (declared, field) in [
            (Declaration { position: Vector2::new(nan, 0.0), ..fine }, "position_m"),
            (Declaration { position: Vector2::new(0.0, 1e9), ..fine }, "position_m"),
            (Declaration { z_m: Some(nan), ..fine }, "z_m"),
            (Declaration { t_s: nan, ..fine }, "t_s"),
            (Declaration { evidence: Some(evidence), ..fine }, "evidence"),
        ] {
            let told = said(declared);
            assert!(told.starts_with(&format!("`declare.{field}` must be ")), "{told}");
        }
    }
}
