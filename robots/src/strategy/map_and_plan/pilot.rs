//! Leads the vehicle through its room: keeps the obstacle map, plans, plans again, and follows the path.
//!
//! *Source*: Wang & Pang, section II-D: the path is planned again when its target moves, and followed until then.
//!
//! *Parameters*: see [`MapAndPlanSpec`].
//!
//! *Deviations*: there is also a new plan if newly sensed obstacles close the path ahead, if the vehicle is off the
//! path, and if the path's end was reached and the target is elsewhere. An echo counts as an obstacle unless the
//! chart has the bed there; in a room of the plane, only nearly level beams tell anything about its cells.

use super::super::setting::Setting;
use super::evade::Evade;
use super::spec::MapAndPlanSpec;
use crate::error::{RobotError, require};
use crate::handoff::{BeliefGrid, Estimate, Manoeuvre, Observation, RangeScan, Vertical};
use crate::plan::{Follow, FreeSpace, NoPath, Path, PathStart, Planner, Reach, Revision};
use crate::strategy::spec::StrategyParams;
use nalgebra::{UnitQuaternion, Vector3};
use world::terrain::Terrain;
use world::units::Heading;

/// An echo this near to the charted bed counts as the bed, m.
const BED_M: f64 = 1.0;
/// Beams steeper than this (sine) are ignored in a room of the plane.
const STEEPEST: f64 = 0.2;
/// At a slower speed over ground than this, the heading stands for the course, m/s.
const SLOWEST_M_S: f64 = 0.2;
/// A path with less than this left counts as finished, m.
const END_M: f64 = 0.5;
/// A destination that moved by less than this is the same, m.
const SAME_M: f64 = 1e-3;

/// What the vehicle must steer now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Steering {
    pub(super) course: Heading,
    /// Height on the path (z, m); `None` in a room of the plane.
    pub(super) z_m: Option<f64>,
    /// The end of the path has been reached.
    pub(super) ended: bool,
    /// A new plan was made in this tick.
    pub(super) replanned: bool,
}

/// State of the pilot.
#[derive(Debug)]
pub(super) struct Pilot {
    room: FreeSpace,
    planner: Box<dyn Planner>,
    bed: Terrain,
    spec: MapAndPlanSpec,
    follow: Option<Follow>,
    wish: Vector3<f64>,
    revision: Revision,
    planned_s: f64,
    evade: Option<Evade>,
}

impl Pilot {
    pub(super) fn new(spec: &MapAndPlanSpec, setting: &Setting) -> Result<Self, RobotError> {
        let planner = spec.planner.build()?;
        require(
            !spec.planner.plane_only() || spec.room.plane(),
            "strategy.MapAndPlan.planner.AStar.cost",
            "the paper's costs are for a room of the plane; use Metric, or room: Plane()",
        )?;
        spec.check(setting)?;
        let cells = spec.room.cells(setting)?;
        let vertical = Vertical::from(spec.vertical);
        let mut room = FreeSpace::new(cells, spec.hull_m.get(), spec.planner.reach().1);
        room.chart(&setting.chart, &setting.bed, &|x, y| level(vertical, &setting.bed, x, y));
        let lattice = room.lattice();
        require((0..lattice.len()).any(|cell| room.free(cell)), "strategy.MapAndPlan.room", NoPath::Full.to_string())?;
        Ok(Self {
            revision: room.revision().clone(),
            room,
            planner,
            bed: setting.bed.clone(),
            spec: spec.clone(),
            follow: None,
            wish: Vector3::zeros(),
            planned_s: f64::NEG_INFINITY,
            evade: spec.evade.map(|e| Evade::new(e, spec.hull_m.get())),
        })
    }

    /// Adds a ping to the map of obstacles.
    pub(super) fn sense(&mut self, seen: &Observation) {
        let Some(scan) = &seen.ranging else { return };
        let at = seen.estimate.p_WB();
        self.take_in(scan, at, seen.estimate.attitude.R_WB());
    }

    fn take_in(&mut self, scan: &RangeScan, at: Vector3<f64>, turn: UnitQuaternion<f64>) {
        let from = at + turn * scan.p_BS;
        for beam in scan.beams.iter() {
            let dir = turn * beam.dir_B;
            if self.room.plane() && dir.z.abs() > STEEPEST {
                continue;
            }
            let to = from + dir * beam.echo_m.unwrap_or(scan.max_m);
            let solid = beam.echo_m.is_some() && to.z - self.bed.bed_z(to.x, to.y) > BED_M;
            self.room.beam(&from, &to, solid);
        }
        self.room.refresh();
    }

    /// The map of obstacles.
    pub(super) fn room(&self) -> &FreeSpace {
        &self.room
    }

    /// Whether a cell of a map is solid at its middle and half-way to each of its corners.
    pub(super) fn in_solid(&self, grid: &BeliefGrid, cell: usize) -> bool {
        let middle = grid.centre(cell);
        let z = if grid.n[2] == 1 { self.level(middle.x, middle.y) } else { middle.z };
        let quarter = [grid.axes[0] * (grid.cell_m[0] / 4.0), grid.axes[1] * (grid.cell_m[1] / 4.0)];
        [(0.0, 0.0), (1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)].iter().all(|(a, b)| {
            let p = middle.xy() + quarter[0] * *a + quarter[1] * *b;
            let at = Vector3::new(p.x, p.y, z);
            self.room.solid(self.room.nearest_cell(&at))
        })
    }

    /// The path still ahead; empty without one.
    pub(super) fn planned(&self) -> Vec<Vector3<f64>> {
        self.follow.as_ref().map(|f| f.points().to_vec()).unwrap_or_default()
    }

    /// Forgets the path.
    pub(super) fn drop_path(&mut self) {
        self.follow = None;
    }

    /// Height at which the vehicle moves over a place (east, north) if it has no path in space, z, m.
    pub(super) fn level(&self, x: f64, y: f64) -> f64 {
        level(self.spec.vertical.into(), &self.bed, x, y)
    }

    /// What to steer to reach `wish` (ENU, m).
    pub(super) fn steer(&mut self, seen: &Observation, wish: Vector3<f64>) -> Steering {
        let at = seen.estimate.p_WB();
        let mut steer = self.follow.as_mut().map(|f| f.step(&at));
        let moved = (wish - self.wish).norm() > SAME_M;
        let due = seen.t_s - self.planned_s >= self.spec.replan_s.get();
        let ended = steer.is_some_and(|s| s.left_m < END_M);
        let off = steer.is_some_and(|s| s.off_m > self.spec.replan_off_m.get());
        let again = steer.is_none() || (due && (moved || ended || off || self.closed()));
        if again {
            let start =
                PathStart { p_W: at, heading: moving(&seen.estimate), turning_radius_m: seen.able.turning_radius_m };
            let path = self.planner.plan(&self.room, &start, &wish).unwrap_or_else(|full| {
                // What was sensed fills the whole room: steer for the destination itself.
                let NoPath::Full = full;
                Path { points: vec![at, wish], reach: Reach::Goal, leaves_solid: true, tightest_m: 0.0 }
            });
            let mut follow = Follow::new(&path, self.spec.look_ahead_m.get());
            steer = Some(follow.step(&at));
            self.follow = Some(follow);
            self.wish = wish;
            self.planned_s = seen.t_s;
            self.revision = self.room.revision().clone();
        }
        let steer = steer.expect("there is a path: it was just planned if there was none");
        let course = self.clear(seen, steer.course);
        // A destination within the turning circle that cannot be approached without a collision will not be reached
        // any better.
        let circle_m = (self.evade.as_ref()).map_or(0.0, |e| e.turn_radius_m(&seen.able));
        let near = (wish - at).xy().norm() < circle_m;
        let turned_away = near && course != steer.course;
        Steering {
            course,
            z_m: (!self.room.plane()).then_some(steer.z_m),
            ended: (ended && !moved) || turned_away,
            replanned: again,
        }
    }

    /// The course nearest to `wish` that is free.
    pub(super) fn clear(&self, seen: &Observation, wish: Heading) -> Heading {
        let (evade, est) = (self.evade.as_ref(), &seen.estimate);
        evade.map_or(wish, |e| {
            let radius_m = e.turn_radius_m(&seen.able);
            e.course(&self.room, &est.p_WB(), moving(est), wish, radius_m)
        })
    }

    /// Backs off if something holds the vehicle.
    pub(super) fn back(&mut self, seen: &Observation) -> Option<Manoeuvre> {
        let back = self.evade.as_mut()?.back(seen)?;
        self.follow = None;
        Some(back)
    }

    /// Whether obstacles sensed since the plan close the path ahead.
    fn closed(&mut self) -> bool {
        if *self.room.revision() == self.revision {
            return false;
        }
        self.revision = self.room.revision().clone();
        self.follow.as_ref().is_some_and(|f| {
            let rest = f.rest();
            !rest.windows(2).all(|w| self.room.line_free(&w[0], &w[1]))
        })
    }
}

fn level(vertical: Vertical, bed: &Terrain, x: f64, y: f64) -> f64 {
    match vertical {
        Vertical::Altitude(m) => bed.bed_z(x, y) + m,
        Vertical::Depth(m) => -m,
    }
}

/// Direction of motion over ground.
fn moving(est: &Estimate) -> Heading {
    let v = est.v_ground();
    if v.norm() > SLOWEST_M_S { Heading::from_vector(v) } else { est.attitude.heading }
}
