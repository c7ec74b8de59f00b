//! Shared by tests of strategies: a setting, eyes, a decision with what its strategy shows then, and a mission tick by
//! tick.

use super::{Eyes, Setting, Strategy, Survey, SurveySpec, VerifierSpec};
use crate::handoff::testing::{area, seen, smelling, sure_of};
use crate::handoff::{Beam, BeliefGrid, Decision, Goal, Layer, LayerState, Manoeuvre, Observation, RangeScan, Shown};
use image::RgbImage;
use nalgebra::{Vector2, Vector3};
use std::ops::Deref;
use std::sync::Arc;
use world::math;
use world::obstacles::Obstacles;
use world::seeds::Stream;
use world::terrain::Terrain;

/// Eyes for tests that fly no survey: a picture with anything bright red shows a source.
#[derive(Debug)]
pub(crate) struct Blind;

impl Eyes for Blind {
    fn survey(&self, _: &SurveySpec, _: bool) -> Box<dyn Survey> {
        unreachable!("no survey is tested here")
    }

    fn shows_source(&self, picture: &RgbImage, _: &VerifierSpec) -> bool {
        picture.pixels().any(|p| p.0[0] > 200)
    }
}

/// The usual area over a level bed, with nothing charted.
pub(crate) fn setting(depth_m: f64, maps: bool) -> Setting {
    Setting {
        area: area(),
        bed: Terrain::Level { depth_m },
        chart: Obstacles::default(),
        maps,
        outlook: maps,
        eyes: Arc::new(Blind),
    }
}

/// A strategy's tick. It is read like the decision.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ticked {
    decision: Decision,
    pub(crate) shown: Shown,
}

impl Ticked {
    /// One tick of a strategy.
    pub(crate) fn step(strategy: &mut dyn Strategy, seen: &Observation, rng: &mut Stream) -> Self {
        let decision = strategy.step(seen, rng);
        Self { decision, shown: strategy.shown() }
    }
}

impl Deref for Ticked {
    type Target = Decision;

    fn deref(&self) -> &Decision {
        &self.decision
    }
}

/// Where a decision leads to.
pub(crate) fn point_of(d: &Decision) -> Vector2<f64> {
    match d.goal.manoeuvre {
        Manoeuvre::GoToPoint { point, .. } => point,
        other => panic!("wanted a point, got {other:?}"),
    }
}

/// A strategy and its last goal, with observations written by hand; the flow goes south, so up-flow is north. On
/// request there is an obstacle ahead, and a map that is sure of a place.
pub(crate) struct Desk<S> {
    pub(crate) strategy: S,
    pub(crate) rng: Stream,
    pub(crate) t_s: f64,
    pub(crate) goal: Option<Goal>,
    pub(crate) flow: Option<Vector2<f64>>,
    pub(crate) obstacle: bool,
    pub(crate) map: Option<Vector2<f64>>,
    pub(crate) jump: Vector2<f64>,
}

impl<S: Strategy> Desk<S> {
    pub(crate) fn new(strategy: S) -> Self {
        Self {
            strategy,
            rng: Stream::new(1, "auv0", "strategy"),
            t_s: 0.0,
            goal: None,
            flow: Some(Vector2::new(0.0, -0.2)),
            obstacle: false,
            map: None,
            jump: Vector2::zeros(),
        }
    }

    pub(crate) fn tick(&mut self, north: f64, smells: bool, arrived: bool, aborted: bool) -> Ticked {
        self.t_s += 0.1;
        let mut o = smelling(seen(self.t_s, Vector2::new(0.0, north), 350.0, self.flow), smells);
        // 15 m away in every direction: in the way on any course.
        let beams = (0..36).map(|k| {
            let (s, c) = math::sin_cos(f64::from(k * 10).to_radians());
            Beam { dir_B: Vector3::new(c, s, 0.0), echo_m: self.obstacle.then_some(15.0) }
        });
        o.ranging = Some(RangeScan { p_BS: Vector3::zeros(), max_m: 40.0, beams: beams.collect() });
        o.belief = self.map.map(|at| {
            let grid = BeliefGrid::over(&area(), 0.0, 8.0, [60, 40, 1]);
            let best = grid.cell(&Vector3::new(at.x, at.y, -4.0)).expect("inside");
            sure_of(grid, best, 1.0)
        });
        o.estimate.fix_jump = self.jump;
        if let Some(goal) = self.goal {
            o.guidance.goal_id = goal.id;
            o.guidance.done = arrived;
        }
        o.guidance.aborted = aborted;
        let decision = Ticked::step(&mut self.strategy, &o, &mut self.rng);
        self.goal = Some(decision.goal);
        let holds = |l: &&Layer| l.state == LayerState::Holds;
        assert!(decision.shown.layers.iter().filter(holds).count() <= 1);
        decision
    }

    pub(crate) fn quiet(&mut self, north: f64) -> Ticked {
        self.tick(north, false, false, false)
    }

    pub(crate) fn smell(&mut self, north: f64) -> Ticked {
        self.tick(north, true, false, false)
    }

    pub(crate) fn arrive(&mut self, north: f64) -> Ticked {
        self.tick(north, false, true, false)
    }

    /// Detects at `north` and loses the plume there: nothing for more than lambda.
    pub(crate) fn point(&mut self, north: f64) -> Ticked {
        self.smell(north);
        self.t_s += 5.0;
        self.quiet(north + 10.0)
    }

    /// Three points close together, the third on the list but not yet tested.
    pub(crate) fn near_the_source(&mut self, north: f64) {
        for ahead in [0.0, 1.0, 2.5] {
            assert_eq!(self.point(north + ahead).declared, None);
        }
    }
}
