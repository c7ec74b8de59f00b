//! The guidance: a mode makes a course, the cage corrects it, flow compensation and rate filter make the command.
//!
//! *Source*: Pang 2009, section 4.
//!
//! *Parameters*: see [`GuidanceSpec`].
//!
//! *Deviations*: those of the modes, each stated in its file. A line whose ends coincide is a point. For a vehicle
//! that the water does not carry, nothing is compensated for, and its speed is that over ground.

use super::cage::{altered, cage, lost};
use super::dubins::{Follower, Pose};
use super::flow_compensation::compensate;
use super::follow_line::FollowLine;
use super::go_to_point::GoToPoint;
use super::hover::{HoverDemand, Hovering};
use super::known::CachedCourse;
use super::rate_filter::RateFilter;
use super::spec::GuidanceSpec;
use crate::handoff::{ActuatorCommand, Command, Estimate, Goal, GuidanceStatus, Manoeuvre, MoveSetpoint, Setpoint};
use bevy_ecs::prelude::Component;
use nalgebra::Vector2;
use world::area::{Area, Sides};
use world::ranges::Positive;
use world::units::Heading;

/// A line shorter than this has no direction, m.
const SHORTEST_LINE_M: f64 = 0.01;
/// At a slower speed over ground than this, the heading stands for the course, m/s.
const SLOWEST_COURSE_M_S: f64 = 0.2;

#[derive(Clone, Copy, Debug)]
enum Mode {
    Point(GoToPoint),
    ToLine(Follower, FollowLine),
    Line(FollowLine),
    ToPose(Follower),
    Hover(Hovering),
    Free,
}

/// State of the guidance.
#[derive(Component, Clone, Debug)]
pub struct Guidance {
    spec: Box<GuidanceSpec>,
    filter: RateFilter,
    mode: Mode,
    /// The newest course wanted.
    known: CachedCourse,
    goal_id: Option<u32>,
    done: bool,
    aborted: bool,
    /// Whether the water carries the vehicle.
    carried: bool,
    /// Whether the vehicle hovers.
    hovers: bool,
    /// Of the area of the last step.
    sides: Option<Box<Sides>>,
}

impl Guidance {
    /// A guidance without a goal.
    pub fn new(spec: &GuidanceSpec) -> Self {
        Self {
            filter: RateFilter::new(spec.heading_rate_deg_s.get().to_radians()),
            spec: Box::new(spec.clone()),
            mode: Mode::Free,
            known: CachedCourse::from_course(Heading::from_rad(0.0)),
            goal_id: None,
            done: false,
            aborted: false,
            carried: true,
            hovers: false,
            sides: None,
        }
    }

    /// The same for a vehicle that the water carries, or not: only drift is compensated for.
    #[must_use]
    pub fn carried(mut self, carried: bool) -> Self {
        self.carried = carried;
        self
    }

    /// The same for a vehicle that hovers, or not.
    #[must_use]
    pub fn hovering(mut self, hovers: bool) -> Self {
        self.hovers = hovers;
        self
    }

    /// The same for a vehicle whose tightest turn has this radius, m: paths are not planned tighter.
    #[must_use]
    pub fn turning(mut self, radius_m: f64) -> Self {
        if radius_m > self.spec.turn_radius_m.get() {
            self.spec.turn_radius_m = Positive::new(radius_m);
        }
        self
    }

    /// The command for this tick and the state of the goal. A new `goal.id` restarts the manoeuvre; under the same id
    /// only the course may change.
    pub fn step(&mut self, est: &Estimate, goal: &Goal, area: &Area, dt_s: f64) -> (Command, GuidanceStatus) {
        let known = self.sides.as_deref().copied();
        let known = known.filter(|sides| sides.area() == area);
        let sides = &known.unwrap_or_else(|| area.sides());
        if known.is_none() {
            self.sides = Some(Box::new(*sides));
        }
        if let Some(command) = straight(goal) {
            // Neither cage nor filter stands between the searcher and the autopilot or the drives.
            self.filter.reset();
            self.goal_id = None;
            self.done = false;
            if !matches!(goal.manoeuvre, Manoeuvre::Direct { .. }) {
                self.aborted |= lost(est.position, sides, self.spec.abort_outside_m.get());
            }
            return (command, self.status(goal.id));
        }

        if self.goal_id != Some(goal.id) {
            self.goal_id = Some(goal.id);
            self.done = false;
            self.mode = self.start(est, goal);
        }
        self.aborted |= lost(est.position, sides, self.spec.abort_outside_m.get());
        if let Mode::Hover(hovering) = &mut self.mode {
            hovering.adjust(goal.manoeuvre);
            let at = Pose { position: est.position, heading: est.attitude.heading };
            let wanted = hovering.step(&self.spec, at, goal.speed_m_s);
            self.done |= wanted.done;
            return (self.moved(est, goal, &wanted, sides), self.status(goal.id));
        }
        let wanted = self.course(est, goal, dt_s);
        self.known.exchange(wanted);
        let (known, cage_m) = (&self.known, self.spec.cage_m.get());
        let (course, along) = match altered(known.unit, est.position, sides, cage_m) {
            Some(course) => (course, course.unit()),
            None => known.again,
        };
        let drift = est.flow.filter(|_| self.carried);
        let drift = drift.map_or_else(Vector2::zeros, |f| f.velocity);
        let limit = self.spec.water_speed_limit_m_s.get();
        let (heading, water_speed_m_s) = compensate(course, along, goal.speed_m_s, drift, limit);
        let setpoint = Setpoint {
            heading: self.filter.step(heading, est.attitude.heading, dt_s),
            water_speed_m_s,
            vertical: goal.vertical,
        };
        (Command::Steer(setpoint), self.status(goal.id))
    }

    /// The command of a hovering vehicle: its velocity within the cage and the limit of its speed.
    fn moved(&self, est: &Estimate, goal: &Goal, wanted: &HoverDemand, sides: &Sides) -> Command {
        let speed = wanted.velocity_m_s.norm();
        let over_ground_m_s = if speed > 0.0 {
            let course = Heading::from_vector(wanted.velocity_m_s);
            let course = cage(course, est.position, sides, self.spec.cage_m.get());
            course.unit() * speed.min(self.spec.water_speed_limit_m_s.get())
        } else {
            Vector2::zeros()
        };
        Command::Move(MoveSetpoint {
            heading: wanted.heading.unwrap_or(est.attitude.heading),
            over_ground_m_s,
            vertical: goal.vertical,
        })
    }

    fn status(&self, goal_id: u32) -> GuidanceStatus {
        GuidanceStatus { goal_id, done: self.done, aborted: self.aborted }
    }

    fn start(&self, est: &Estimate, goal: &Goal) -> Mode {
        let s = &self.spec;
        let to_pose = |end: Pose| {
            let from = Pose { position: est.position, heading: course_over_ground(est) };
            Follower::new(from, end, goal.speed_m_s, s)
        };
        let to_point = |point, radius: Option<f64>| {
            let radius_m = radius.unwrap_or(s.arrive_m.get());
            Mode::Point(GoToPoint::new(point, radius_m, s.turn_radius_m.get()))
        };
        if self.hovers {
            let line = match goal.manoeuvre {
                Manoeuvre::FollowLine { from, to } if (to - from).norm() >= SHORTEST_LINE_M => {
                    Some(FollowLine::new(from, to))
                }
                _ => None,
            };
            return Mode::Hover(Hovering::new(goal.manoeuvre, line));
        }
        match goal.manoeuvre {
            Manoeuvre::GoToPoint { point, radius_m } => to_point(point, radius_m),
            Manoeuvre::Hold { point, .. } => to_point(point, None),
            Manoeuvre::SlideTo { point, radius_m, .. } => to_point(point, radius_m),
            Manoeuvre::FollowLine { from, to } if (to - from).norm() < SHORTEST_LINE_M => to_point(to, None),
            Manoeuvre::FollowLine { from, to } => {
                let line = FollowLine::new(from, to);
                let end = Pose { position: from, heading: line.direction() };
                Mode::ToLine(to_pose(end), line)
            }
            Manoeuvre::GoToPointWithHeading { point, heading } => {
                Mode::ToPose(to_pose(Pose { position: point, heading }))
            }
            _ => Mode::Free,
        }
    }

    fn course(&mut self, est: &Estimate, goal: &Goal, dt_s: f64) -> Heading {
        // Asked only when it matters: it needs five sines.
        let moving = || course_over_ground(est);
        // When the line's start is reached, the line itself begins in the same tick.
        if let Mode::ToLine(follower, line) = &mut self.mode {
            let (course, over) = follower.step(&self.spec, est.position, moving, goal.speed_m_s, dt_s);
            if !over && !line.entered(&self.spec, est.position, moving) {
                return course;
            }
            self.mode = Mode::Line(*line);
        }
        match &mut self.mode {
            Mode::Point(point) => {
                let (course, arrived) = point.step(est.position, moving);
                self.done |= arrived;
                course
            }
            Mode::Line(line) => {
                self.done |= line.finished(&self.spec, est.position);
                line.course(&self.spec, est.position)
            }
            Mode::ToPose(follower) | Mode::ToLine(follower, _) => {
                let (course, over) = follower.step(&self.spec, est.position, moving, goal.speed_m_s, dt_s);
                self.done |= over;
                course
            }
            Mode::Hover(_) | Mode::Free => match goal.manoeuvre {
                Manoeuvre::Course { course } => course,
                _ => moving(),
            },
        }
    }
}

/// The command of a goal that the guidance hands on as it is.
fn straight(goal: &Goal) -> Option<Command> {
    let vertical = goal.vertical;
    Some(match goal.manoeuvre {
        Manoeuvre::Direct { rudder_rad, stern_rad, rpm } => {
            Command::Direct(ActuatorCommand { rudder_rad, stern_rad, rpm })
        }
        Manoeuvre::Drives(set) => Command::Drives(set),
        Manoeuvre::Steer { heading } => Command::Steer(Setpoint { heading, water_speed_m_s: goal.speed_m_s, vertical }),
        Manoeuvre::Slide { heading, over_ground_m_s } => {
            Command::Move(MoveSetpoint { heading, over_ground_m_s, vertical })
        }
        _ => return None,
    })
}

fn course_over_ground(est: &Estimate) -> Heading {
    let v = est.v_ground();
    if v.norm() > SLOWEST_COURSE_M_S { Heading::from_vector(v) } else { est.attitude.heading }
}

#[cfg(test)]
mod tests;
