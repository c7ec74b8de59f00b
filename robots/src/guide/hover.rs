//! Guides a vehicle that hovers: a velocity over ground and a heading of their own.
//!
//! *Source*: position reference with a velocity limit, Fossen, "Handbook of Marine Craft Hydrodynamics and Motion
//! Control", 2nd ed. 2021, section 12.1; the manoeuvres are those of Pang 2009, section 4.
//!
//! *Parameters*: approach K, 0.3 1/s; a place is held within 0.5 m, a heading within 10°. All others are the
//! guidance's.
//!
//! *Deviations*: the nose goes first, so that what ranges ahead sees where the vehicle goes. Within [`NEAR_M`] of a
//! point the heading stays as it is. A line is followed as by every vehicle, from its start; it is entered without a
//! turning circle.

use super::dubins::Pose;
use super::follow_line::FollowLine;
use super::spec::GuidanceSpec;
use crate::handoff::Manoeuvre;
use nalgebra::Vector2;
use world::units::Heading;

/// Speed towards a point for each metre of distance, 1/s.
const APPROACH_1_S: f64 = 0.3;
/// Within this distance of a point the heading no longer follows the way to it, m.
const NEAR_M: f64 = 1.0;
/// A point to be held, or the start of a line, counts as reached within this distance, m.
const HELD_M: f64 = 0.5;
/// A heading counts as taken within this angle, rad.
const TAKEN_RAD: f64 = 10.0 * std::f64::consts::PI / 180.0;

/// What a hovering vehicle is to do in a tick.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct HoverDemand {
    /// Velocity over ground (east, north), m/s.
    pub(super) velocity_m_s: Vector2<f64>,
    /// Heading; `None` for the one that it has.
    pub(super) heading: Option<Heading>,
    /// The manoeuvre has come to its end.
    pub(super) done: bool,
}

/// State of a manoeuvre.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hovering {
    manoeuvre: Manoeuvre,
    line: Option<FollowLine>,
    on_line: bool,
}

impl Hovering {
    /// Begins a manoeuvre; `line` is the follower of its line, if it has one.
    pub(super) fn new(manoeuvre: Manoeuvre, line: Option<FollowLine>) -> Self {
        Self { manoeuvre, line, on_line: false }
    }

    /// Only the course of a manoeuvre may change in between.
    pub(super) fn adjust(&mut self, manoeuvre: Manoeuvre) {
        if matches!(self.manoeuvre, Manoeuvre::Course { .. }) {
            self.manoeuvre = manoeuvre;
        }
    }

    /// What to do at a place, at a speed (m/s).
    pub(super) fn step(&mut self, spec: &GuidanceSpec, at: Pose, speed_m_s: f64) -> HoverDemand {
        let to = |point: Vector2<f64>, reached_m: f64, heading: Option<Heading>| {
            let way = point - at.position;
            let distance_m = way.norm();
            let along = (distance_m > NEAR_M).then(|| Heading::from_vector(way));
            let speed = speed_m_s.min(APPROACH_1_S * distance_m);
            let velocity_m_s = if distance_m > 0.0 { way * (speed / distance_m) } else { Vector2::zeros() };
            HoverDemand { velocity_m_s, heading: heading.or(along), done: distance_m < reached_m }
        };
        match self.manoeuvre {
            Manoeuvre::GoToPoint { point, radius_m } => to(point, radius_m.unwrap_or(spec.arrive_m.get()), None),
            Manoeuvre::SlideTo { point, radius_m, heading } => {
                to(point, radius_m.unwrap_or(spec.arrive_m.get()), Some(heading))
            }
            Manoeuvre::Hold { point, heading } => to(point, HELD_M, heading),
            Manoeuvre::GoToPointWithHeading { point, heading } => {
                let near = (point - at.position).norm() < HELD_M.max(NEAR_M);
                let mut wanted = to(point, spec.arrive_m.get(), near.then_some(heading));
                wanted.done = near && at.heading.turn_to(heading).abs() < TAKEN_RAD;
                wanted
            }
            Manoeuvre::FollowLine { from, .. } => match self.line {
                Some(line) => {
                    let begun = to(from, HELD_M, None);
                    self.on_line |= begun.done;
                    if !self.on_line {
                        return HoverDemand { done: false, ..begun };
                    }
                    HoverDemand {
                        velocity_m_s: line.course(spec, at.position).unit() * speed_m_s,
                        heading: Some(line.direction()),
                        done: line.finished(spec, at.position),
                    }
                }
                None => to(from, spec.arrive_m.get(), None),
            },
            Manoeuvre::Course { course } => {
                HoverDemand { velocity_m_s: course.unit() * speed_m_s, heading: Some(course), done: false }
            }
            Manoeuvre::Direct { .. } | Manoeuvre::Steer { .. } | Manoeuvre::Slide { .. } | Manoeuvre::Drives(_) => {
                HoverDemand { velocity_m_s: Vector2::zeros(), heading: None, done: false }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(east: f64, north: f64) -> Pose {
        Pose { position: Vector2::new(east, north), heading: Heading::from_deg(0.0) }
    }

    #[test]
    fn it_slows_down_towards_a_point_and_holds_it() {
        let hold = Manoeuvre::Hold { point: Vector2::new(10.0, 0.0), heading: None };
        let mut hovering = Hovering::new(hold, None);
        let far = hovering.step(&GuidanceSpec::default(), at(0.0, 0.0), 0.5);
        assert!((far.velocity_m_s - Vector2::new(0.5, 0.0)).norm() < 1e-12);
        assert!(!far.done && (far.heading.expect("ahead").deg() - 90.0).abs() < 1e-9);
        let near = hovering.step(&GuidanceSpec::default(), at(9.8, 0.0), 0.5);
        assert!((near.velocity_m_s.x - 0.06).abs() < 1e-12 && near.done);
        assert_eq!(near.heading, None);
        let there = hovering.step(&GuidanceSpec::default(), at(10.0, 0.0), 0.5);
        assert_eq!(there.velocity_m_s, Vector2::zeros());
    }

    #[test]
    fn it_slides_with_its_heading_held() {
        let north = Heading::from_deg(0.0);
        let slide = Manoeuvre::SlideTo { point: Vector2::new(5.0, 0.0), radius_m: None, heading: north };
        let wanted = Hovering::new(slide, None).step(&GuidanceSpec::default(), at(0.0, 0.0), 0.3);
        assert_eq!(wanted.heading, Some(north));
        assert!((wanted.velocity_m_s - Vector2::new(0.3, 0.0)).norm() < 1e-12);
    }
}
