//! What a planner is asked and what it answers.
//!
//! *Source*: Wang & Pang, section II-D: a start (the vehicle's cell), a goal (the likeliest cell), a series of
//! points.
//!
//! *Parameters*: none.
//!
//! *Deviations*: the paper does not say what a planner answers if it cannot reach its goal: see [`Reach`].

use super::FreeSpace;
use crate::error::RobotError;
use crate::handoff::BeliefGrid;
use nalgebra::Vector3;
use std::fmt::Debug;
use world::cost::Cost;
use world::registry::Spec;
use world::units::Heading;

/// Where a path begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PathStart {
    /// Place (ENU), m.
    pub p_W: Vector3<f64>,
    /// Direction of motion.
    pub heading: Heading,
    /// Radius of the vehicle's tightest turn, m.
    pub turning_radius_m: f64,
}

/// How far a path leads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reach {
    /// To the cell of the goal.
    Goal,
    /// To the nearest free cell that can be reached, this far from the goal, m.
    Nearest(f64),
    /// Into a local minimum of the potential, this far from the goal, m.
    Caught(f64),
}

/// A planned path.
#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Corners (ENU), m, the start first.
    pub points: Vec<Vector3<f64>>,
    /// How far it leads.
    pub reach: Reach,
    /// The start lay in a solid or too near to one: the first leg leads out of it and is not free.
    pub leaves_solid: bool,
    /// Radius of the tightest turn on the path, m: infinite on a straight path, zero at a sharp corner.
    pub tightest_m: f64,
}

impl Path {
    /// Its length, m.
    pub fn length_m(&self) -> f64 {
        self.points.windows(2).map(|w| (w[1] - w[0]).norm()).sum()
    }
}

/// Why there is no path at all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoPath {
    /// No cell is free.
    #[error(
        "no cell of the planner's room is free: obstacles, bed and the hull's margin fill it; make the cells or the \
        margin smaller"
    )]
    Full,
}

/// A path planner: one room, one start, one goal, one answer. It always ends.
pub trait Planner: Debug + Send + Sync {
    /// A path from `start` to `goal` (ENU, m).
    ///
    /// # Errors
    /// If no cell of the room is free. A goal that cannot be reached is no error: see [`Reach`].
    fn plan(&mut self, room: &FreeSpace, start: &PathStart, goal: &Vector3<f64>) -> Result<Path, NoPath>;
}

/// Parameters of a planner.
pub trait PlannerParams: Spec {
    /// Builds the planner.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if a parameter makes no sense.
    fn build(&self) -> Result<Box<dyn Planner>, RobotError>;

    /// Checks that it fits the room in which it will plan.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if its steps are too small for the room's cells.
    fn check(&self, _cells: &BeliefGrid, _plane: bool) -> Result<(), RobotError> {
        Ok(())
    }

    /// Whether it plans in the plane only.
    fn plane_only(&self) -> bool {
        false
    }

    /// Clearance beyond the hull's own up to which it distinguishes cells, m, and the field that sets it.
    fn reach(&self) -> (&'static str, f64);

    /// Its cost besides the room, for so many plans over a way of a length, m; paths below `planner`.
    fn cost(&self, _way_m: f64, _plans: f64) -> Cost {
        Cost::default()
    }
}
