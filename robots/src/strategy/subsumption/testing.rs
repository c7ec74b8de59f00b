//! A planner for tests, with observations written by hand.

use super::{GoHomeSpec, LayerSpec, MaintainSpec, PlumeMapSpec, Subsumption, SubsumptionSpec};
use crate::behave::{AvoidParams, FindSpec, ReacquireSpec};
use crate::declare::DeclareSpec;
use crate::handoff::testing::{area, seen, smelling};
use crate::handoff::{Beam, Belief, BeliefGrid, Goal, LayerState, Observation, RangeScan};
use crate::strategy::testing::{Ticked, setting};
use nalgebra::{Vector2, Vector3};
use std::sync::Arc;
use world::seeds::Stream;

pub(super) fn find() -> LayerSpec {
    LayerSpec::Find(FindSpec::default())
}
pub(super) fn maintain() -> LayerSpec {
    LayerSpec::Maintain(MaintainSpec::default())
}
pub(super) fn reacquire() -> LayerSpec {
    LayerSpec::Reacquire(ReacquireSpec::default())
}
pub(super) fn declare() -> LayerSpec {
    LayerSpec::Declare(DeclareSpec::default())
}
pub(super) fn avoid() -> LayerSpec {
    LayerSpec::Avoid(AvoidParams::default())
}
pub(super) fn plume_map() -> LayerSpec {
    LayerSpec::PlumeMap(PlumeMapSpec::default())
}
pub(super) fn go_home() -> LayerSpec {
    LayerSpec::GoHome(GoHomeSpec::default())
}

pub(super) fn all() -> Vec<LayerSpec> {
    vec![find(), maintain(), reacquire(), declare(), avoid(), plume_map(), go_home()]
}

/// A planner and its last goal; the flow goes south, so up-flow is north. On request there is an obstacle ahead, and
/// a map.
pub(super) struct Desk {
    pub(super) planner: Subsumption,
    pub(super) rng: Stream,
    pub(super) t_s: f64,
    pub(super) goal: Option<Goal>,
    pub(super) obstacle: bool,
    pub(super) map: Option<Vector2<f64>>,
    pub(super) jump: Vector2<f64>,
}

impl Desk {
    pub(super) fn new(layers: Vec<LayerSpec>) -> Self {
        Self::of(&SubsumptionSpec::with_layers(layers))
    }

    pub(super) fn of(spec: &SubsumptionSpec) -> Self {
        Self {
            planner: Subsumption::new(spec, &setting(8.0, true)).expect("these layers make sense"),
            rng: Stream::new(1, "auv0", "strategy"),
            t_s: 0.0,
            goal: None,
            obstacle: false,
            map: None,
            jump: Vector2::zeros(),
        }
    }

    pub(super) fn seen(&self, north: f64, smells: bool) -> Observation {
        let flow = Some(Vector2::new(0.0, -0.2));
        let at = Vector2::new(0.0, north);
        let mut o = smelling(seen(self.t_s, at, 350.0, flow), smells);
        // 15 m away in every direction: in the way on any course.
        let beams = (0..36).map(|k| {
            let (s, c) = world::math::sin_cos(f64::from(k * 10).to_radians());
            Beam { dir_B: Vector3::new(c, s, 0.0), echo_m: self.obstacle.then_some(15.0) }
        });
        o.ranging = Some(RangeScan { p_BS: Vector3::zeros(), max_m: 40.0, beams: beams.collect() });
        o.belief = self.map.map(belief);
        o.estimate.fix_jump = self.jump;
        o
    }

    pub(super) fn tick(&mut self, north: f64, smells: bool, arrived: bool) -> Ticked {
        self.t_s += 0.1;
        let mut o = self.seen(north, smells);
        if let Some(goal) = self.goal {
            o.guidance.goal_id = goal.id;
            o.guidance.done = arrived;
        }
        let decision = Ticked::step(&mut self.planner, &o, &mut self.rng);
        self.goal = Some(decision.goal);
        let holds = |l: &&crate::handoff::Layer| l.state == LayerState::Holds;
        assert!(decision.shown.layers.iter().filter(holds).count() <= 1);
        decision
    }

    pub(super) fn quiet(&mut self, north: f64) -> Ticked {
        self.tick(north, false, false)
    }
    pub(super) fn smell(&mut self, north: f64) -> Ticked {
        self.tick(north, true, false)
    }
    pub(super) fn arrive(&mut self, north: f64) -> Ticked {
        self.tick(north, false, true)
    }

    /// Detects at `north` and loses the plume there.
    pub(super) fn point(&mut self, north: f64) -> Ticked {
        self.smell(north);
        self.t_s += 5.0;
        self.quiet(north + 10.0)
    }

    /// Three points close together, the third on the list but not yet tested.
    pub(super) fn near_the_source(&mut self) {
        for north in [0.0, 1.0, 2.5] {
            assert_eq!(self.point(north).declared, None);
        }
    }
}

/// A map that is sure of a place.
fn belief(at: Vector2<f64>) -> Belief {
    let grid = BeliefGrid::over(&area(), 0.0, 8.0, [60, 40, 1]);
    let best = grid.cell(&Vector3::new(at.x, at.y, -4.0)).expect("inside");
    let mut p = vec![0.0; grid.len()];
    p[best] = 1.0;
    Belief {
        t_s: 0.0,
        updates: 1,
        informed: true,
        credible_95: 100.0,
        entropy_nat: 0.0,
        p: Arc::new(p),
        grid: Arc::new(grid),
        best,
        odour: None,
    }
}

pub(super) fn said(d: &Ticked) -> String {
    let word = |s| match s {
        LayerState::Silent => '.',
        LayerState::Holds => 'H',
        LayerState::Suppressed => 's',
        LayerState::Inhibited => 'i',
    };
    d.shown.layers.iter().map(|l| word(l.state)).collect()
}
