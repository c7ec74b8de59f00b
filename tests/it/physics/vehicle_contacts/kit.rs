//! Hulls in still water, and what stands in their way.

use crate::physics::kit::{energy, remus, water};
use nalgebra::Vector3;
use robots::handoff::{Actuation, ActuatorCommand};
use robots::vehicles::{ParameterSet, Vehicle};
use std::path::Path;
use world::frames::{Pose, Truth};
use world::obstacles::{Base, BoxShape, Obstacle, ObstacleSpec, ShapeSpec};
use world::physics::{BodyId, Physics};
use world::ranges::{Finite, HeadingDeg, Positive};
use world::terrain::Terrain;
use world::units::Heading;

/// The usual, a middling and the longest legal step, s.
pub(super) const STEPS_S: [f64; 3] = [0.02, 0.05, 0.1];
const SEA: Terrain = Terrain::Level { depth_m: 40.0 };
/// Half of the hull, a capsule: its straight part, and its radius, m.
pub(super) const HALF_M: f64 = 0.705;
pub(super) const RADIUS_M: f64 = 0.095;

pub(super) fn solid(shape: ShapeSpec, dir: &Path) -> Obstacle {
    let spec = ObstacleSpec {
        surface: Default::default(),
        id: "solid".into(),
        shape,
        east_m: Finite::new(0.0),
        north_m: Finite::new(0.0),
        base: Base::OnBed,
        heading_deg: HeadingDeg::new(90.0),
    };
    Obstacle::build(&spec, &SEA, dir).expect("a solid")
}

/// A plate of this thickness across the way east, its middle at x = 0.
pub(super) fn plate(thick_m: f64) -> Obstacle {
    let size_m = [thick_m, 30.0, 39.0].map(Positive::new).into();
    solid(ShapeSpec::Box(BoxShape { size_m }), Path::new("."))
}

/// At x = `east_m`, heading as given, moving over ground at `v_W`.
pub(super) fn moving(east_m: f64, heading_deg: f64, v_W: Vector3<f64>) -> Truth {
    let at = Vector3::new(east_m, 0.0, -20.0);
    let mut truth = Truth::at_rest(Pose::level(at, Heading::from_deg(heading_deg)));
    truth.v_WB_B = truth.pose.R_WB.inverse() * v_W;
    truth
}

/// Ends of the hull's axis.
pub(super) fn ends(t: &Truth) -> [Vector3<f64>; 2] {
    [HALF_M, -HALF_M].map(|x| t.pose.point(Vector3::new(x, 0.0, 0.0)))
}

/// Greatest x of the hull.
pub(super) fn front_m(t: &Truth) -> f64 {
    let [a, b] = ends(t);
    a.x.max(b.x) + RADIUS_M
}

/// Hulls in still water among solids.
pub(super) struct Water {
    pub(super) physics: Physics,
    pub(super) hulls: Vec<(Vehicle, BodyId)>,
    pub(super) command: ActuatorCommand,
}

impl Water {
    pub(super) fn new(step_s: f64, obstacle: Option<&Obstacle>, starts: &[Truth]) -> Self {
        let mut physics = Physics::new(step_s);
        if let Some(obstacle) = obstacle {
            physics.add_obstacle(obstacle);
        }
        let hulls = (starts.iter())
            .map(|start| {
                let vehicle = remus(ParameterSet::Remus100);
                let id = physics.add_body(vehicle.body_spec("auv", *start));
                (vehicle, id)
            })
            .collect();
        Self { physics, hulls, command: ActuatorCommand::default() }
    }

    pub(super) fn truth(&self) -> Truth {
        self.physics.truth(self.hulls[0].1)
    }

    /// No water: straight on.
    pub(super) fn glide(&mut self) -> bool {
        self.physics.step();
        self.hulls.iter().any(|(_, id)| self.physics.contacts(*id).touching)
    }

    /// By the hull's own equation.
    pub(super) fn step(&mut self) -> bool {
        let still = water(Vector3::zeros());
        let step_s = self.physics.dt_s();
        for (vehicle, id) in &mut self.hulls {
            let free = vehicle.step_in(&self.physics.truth(*id), &still, &Actuation::Fins(self.command), step_s);
            self.physics.push(*id, free);
        }
        self.glide()
    }

    pub(super) fn impulse(&self) -> Vector3<f64> {
        self.physics.contacts(self.hulls[0].1).impulse_N_s
    }

    /// That of all hulls, J.
    pub(super) fn energy(&self) -> f64 {
        self.hulls.iter().map(|(vehicle, id)| energy(vehicle, &self.physics.truth(*id))).sum()
    }
}
