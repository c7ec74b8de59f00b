//! A gantry: what it is made of, how it moves, and what it ran into.

use super::body::BodyId;
use super::shape::Shape;
use crate::frames::Pose;
use bevy_ecs::prelude::Component;
use nalgebra::Vector3;
use rapier3d::prelude as r;

/// Identifies a gantry of one [`Physics`](super::Physics).
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct GantryId(pub(super) usize);

/// One slide with everything it carries except the next slide. All places are in the gantry's base axes, with both
/// joints at zero.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisSpec {
    /// Unit vector in the direction of travel.
    pub along_B: Vector3<f64>,
    /// Least and greatest position, m.
    pub travel_m: [f64; 2],
    /// Moving mass, kg.
    pub mass_kg: f64,
    /// Collision shapes.
    pub shapes: Vec<(Pose, Shape)>,
}

/// A gantry as the solver needs it.
#[derive(Clone, Debug, PartialEq)]
pub struct GantryBodySpec {
    /// Name for error messages.
    pub id: String,
    /// Where its base stands.
    pub base: Pose,
    /// Collision shapes that stay where they are, in base axes.
    pub base_shapes: Vec<(Pose, Shape)>,
    /// The slide on the base, then the slide on that one, which carries the head.
    pub axes: [AxisSpec; 2],
    /// Where the joints start, m.
    pub start_m: [f64; 2],
}

/// Command to a drive for one step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct AxisDrive {
    /// Speed to reach, m/s.
    pub speed_m_s: f64,
    /// Greatest force, N.
    pub max_force_N: f64,
    /// Time constant of the speed loop when the force is sufficient, s.
    pub response_s: f64,
}

/// State of a joint after the latest step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointState {
    /// Position, m.
    pub position_m: f64,
    /// Speed, m/s.
    pub speed_m_s: f64,
    /// Mean force of its drive in that step, N.
    pub force_N: f64,
}

pub(super) struct Gantry {
    pub(super) id: String,
    pub(super) base: Pose,
    pub(super) base_handle: r::RigidBodyHandle,
    pub(super) slides: [r::RigidBodyHandle; 2],
    pub(super) joints: [r::MultibodyJointHandle; 2],
    pub(super) along_B: [Vector3<f64>; 2],
    pub(super) travel_m: [[f64; 2]; 2],
    pub(super) mass_kg: [f64; 2],
    pub(super) drives: [AxisDrive; 2],
    pub(super) states: [JointState; 2],
    /// Positions of the joints before the latest step, m.
    pub(super) before_m: [f64; 2],
    pub(super) contact: GantryContact,
}

impl Gantry {
    /// Generalised momentum for given joint speeds, N s.
    pub(super) fn momentum(&self, v: [f64; 2]) -> [f64; 2] {
        let [first, second] = self.mass_kg;
        let shared = second * self.along_B[0].dot(&self.along_B[1]);
        [(first + second) * v[0] + shared * v[1], shared * v[0] + second * v[1]]
    }
}

/// Something solid of one [`Physics`](super::Physics).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solid {
    /// A fixed thing, by the order in which the fixed things were added.
    Fixed(usize),
    /// A moving body.
    Body(BodyId),
    /// Another gantry.
    Gantry(GantryId),
}

/// What a gantry touched in the latest step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GantryContact {
    /// Impulse on the first slide, and on the second slide with the head; world axes, N s.
    pub impulse_N_s: [Vector3<f64>; 2],
    /// Deepest overlap at the beginning of the step, as the solver had it, m. The solver keeps contacts that hardly
    /// moved, so the value may be short by hundredths of a millimetre.
    pub max_penetration_m: f64,
    /// The thing that pushed back most.
    pub with: Option<Solid>,
    /// Place of that contact, world axes, m.
    pub at_W: Option<Vector3<f64>>,
}

impl GantryContact {
    /// Whether anything pushed back.
    pub fn touching(&self) -> bool {
        self.with.is_some()
    }
}
