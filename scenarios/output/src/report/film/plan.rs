//! The axes of the animation's plan, and its vertical section: which way they lie and how far they reach.

use crate::charts::panel::range_of;
use crate::results::RunReport;
use nalgebra::Vector2;

/// Numbers of a plan's axis, from its lower to its upper end.
pub(super) const STEPS: f64 = 10_000.0;
/// Columns of the bed's profile in the section, and of its lines across.
const PROFILE: usize = 96;
const ACROSS: i32 = 6;

/// Least range of an axis, in its units.
const LEAST: f64 = 10.0;

/// Axes of the plan. A robot's are east and north in metres. Those of a gantry alone lie along its stream, in
/// centimetres from the source.
#[derive(Clone, Debug)]
pub(super) struct Plan {
    /// Place of the origin (east, north), m.
    pub(super) origin: Vector2<f64>,
    /// Direction of the first axis (east, north); the second is to its left.
    pub(super) along: Vector2<f64>,
    /// Units to a metre: 1, or 100 for centimetres.
    pub(super) per_m: f64,
    pub(super) names: [&'static str; 2],
    /// What is shown, in units.
    pub(super) u: [f64; 2],
    pub(super) v: [f64; 2],
}

/// The vertical section in coordinates of the plan, in its units.
#[derive(Clone, Debug)]
pub(super) struct Cut {
    /// A point of its line, and its direction.
    pub(super) from: [f64; 2],
    pub(super) along: [f64; 2],
    pub(super) s: [f64; 2],
    pub(super) name: &'static str,
    /// For each column the deepest and the shallowest bed across what is shown, m.
    pub(super) bed: Vec<[f64; 2]>,
}

impl Plan {
    pub(super) fn from_run(run: &RunReport<'_>) -> Option<Self> {
        let mut plan = Self {
            origin: Vector2::zeros(),
            along: Vector2::x(),
            per_m: 1.0,
            names: ["East (m)", "North (m)"],
            u: [0.0; 2],
            v: [0.0; 2],
        };
        let flume = run.track.robots.is_empty() && !run.gantries.is_empty();
        if flume {
            let gantry = run.gantries.iter().find(|g| !g.rows.is_empty())?;
            plan.origin = match run.best_declared() {
                Some(source) => source.position.xy(),
                None => Vector2::from(gantry.rows[0].head),
            };
            plan.along = -Vector2::from(gantry.forward);
            plan.per_m = 100.0;
            plan.names = ["Down-stream (cm)", "To the left (cm)"];
        }
        let mut points: Vec<[f64; 2]> = Vec::new();
        let mut add = |p: Vector2<f64>| points.push(plan.position([p.x, p.y]));
        run.sources.iter().for_each(|s| add(s.position.xy()));
        for t in &run.track.robots {
            let places = t.rows.iter().map(|r| Vector2::new(r.p[0], r.p[1]));
            places.chain(t.declared().map(Vector2::from)).for_each(&mut add);
        }
        for g in run.gantries {
            g.rows.iter().for_each(|r| add(Vector2::from(r.head)));
            g.tips.iter().for_each(|p| add(Vector2::new(p[0], p[1])));
        }
        let corners = run.area.corners();
        if !flume {
            corners.iter().for_each(|p| add(*p));
        }
        points.retain(|p| p.iter().all(|x| x.is_finite()));
        let range = |k: usize, room: f64| range_of(points.iter().map(|p| p[k]), room);
        (plan.u, plan.v) = (range(0, 0.05)?, range(1, 0.05)?);
        if flume {
            // The whole width of the flume, as long as it does not dwarf the track.
            let across = corners.map(|p| plan.position([p.x, p.y])[1]);
            let across = range_of(across.into_iter(), 0.0)?;
            let length = plan.u[1] - plan.u[0];
            if across[1] - across[0] < 1.2 * length {
                let room = 0.03 * length;
                plan.v = [plan.v[0].min(across[0] - room), plan.v[1].max(across[1] + room)];
            }
        }
        for range in [&mut plan.u, &mut plan.v] {
            let more = 0.5 * f64::max(LEAST - (range[1] - range[0]), 0.0);
            *range = [range[0] - more, range[1] + more];
        }
        Some(plan)
    }

    /// A place (east, north, m) on the plan, in its units.
    pub(super) fn position(&self, p: [f64; 2]) -> [f64; 2] {
        let d = (Vector2::from(p) - self.origin) * self.per_m;
        [d.dot(&self.along), self.along.perp(&d)]
    }

    /// The place (east, north, m) of a point of the plan.
    pub(super) fn world(&self, [u, v]: [f64; 2]) -> Vector2<f64> {
        let left = Vector2::new(-self.along.y, self.along.x);
        self.origin + (self.along * u + left * v) / self.per_m
    }

    /// Size of a step of the numbers of places, in units.
    pub(super) fn quantum(&self) -> f64 {
        (self.u[1] - self.u[0]).max(self.v[1] - self.v[0]) / STEPS
    }
}

impl Cut {
    /// Along the flow at the source, or along the area without a source in moving water.
    pub(super) fn along_flow(run: &RunReport<'_>, plan: &Plan) -> Self {
        let source = run.best_declared();
        let flow = source.map(|s| s.flow).filter(|f| f.norm() > 1e-6);
        let (along, name) = match (flow, source) {
            _ if plan.per_m > 1.0 => (plan.along, plan.names[0]),
            (Some(f), _) => (f.normalize(), "Down-flow of the source (m)"),
            (None, Some(_)) => (run.area.axis.unit(), "Along the area, from the source (m)"),
            (None, None) => (run.area.axis.unit(), "Along the area (m)"),
        };
        let origin = source.map_or(run.area.centre, |s| s.position.xy());
        let from = plan.position([origin.x, origin.y]);
        // Directions turn with the axes of the plan.
        let along = [along.dot(&plan.along), plan.along.perp(&along)];
        let local = |[u, v]: [f64; 2]| {
            let d = [u - from[0], v - from[1]];
            [d[0] * along[0] + d[1] * along[1], along[0] * d[1] - along[1] * d[0]]
        };
        let mut reach: Vec<[f64; 2]> = Vec::new();
        let mut add = |p: [f64; 2]| reach.push(local(plan.position(p)));
        for t in &run.track.robots {
            t.rows.iter().for_each(|r| add([r.p[0], r.p[1]]));
        }
        for g in run.gantries {
            g.rows.iter().for_each(|r| add(r.head));
            g.tips.iter().for_each(|p| add([p[0], p[1]]));
        }
        run.sources.iter().for_each(|s| add([s.position.x, s.position.y]));
        if plan.per_m == 1.0 {
            run.area.corners().iter().for_each(|p| add([p.x, p.y]));
        }
        reach.retain(|p| p.iter().all(|x| x.is_finite()));
        let range = |k: usize| range_of(reach.iter().map(|p| p[k]), 0.02).unwrap_or([-1.0, 1.0]);
        let (s, across) = (range(0), range(1));
        let column = |k: usize| {
            let at = s[0] + (s[1] - s[0]) * k as f64 / (PROFILE - 1) as f64;
            let beds = (0..=ACROSS).map(|i| {
                let d = across[0] + (across[1] - across[0]) * f64::from(i) / f64::from(ACROSS);
                let p = plan.world([from[0] + at * along[0] - d * along[1], from[1] + at * along[1] + d * along[0]]);
                run.terrain.bed_z(p.x, p.y)
            });
            range_of(beds.filter(|z| z.is_finite()), 0.0).unwrap_or([0.0, 0.0])
        };
        Self { from, along, s, name, bed: (0..PROFILE).map(column).collect() }
    }
}
