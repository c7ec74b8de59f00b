//! Bodies among solids: each goes where its own equation of motion takes it, until it touches something.
//!
//! *Source:* conservative advancement (B. Mirtich, Impulse-based Dynamic Simulation of Rigid Body Systems, PhD thesis,
//! Berkeley 1996, ch. 2): in a sub-step nothing moves further than its distance from anything it could meet. Impulses
//! as in `impulses.rs`.
//!
//! *Parameters:* the coefficient of friction.
//!
//! *Deviations:* where nothing touched a body, its end of the step is that of its own equation, to the last bit.
//! A body without momentum (a kinematic vehicle) turns as it is told, and contacts move it aside; otherwise the speed
//! that it is told anew in each step would press it against a wall or into a corner and hold it there. Where there is no
//! room for its turn, it is first stopped as if it did not turn, and then turns less.
//! Velocity that an impulse adds is kept apart from that motion until the end of the step; the forces of the water
//! include it from the next step on.

use super::body::FRICTION;
use super::course::{Course, Who, note};
use super::gaps::{PlacedShape, Point};
use super::impulses::{Row, solve};
use super::solid::Physics;
use crate::convert::pose;
use nalgebra::{Matrix6, Vector3, Vector6};

/// A turn that still approaches something faster than this when all contacts have moved the body aside has no room, m/s.
const NO_ROOM_M_S: f64 = 1e-6;
/// Solids closer than this touch, m.
const TOUCH_M: f64 = 1e-4;
/// Anything closer than this is followed point by point, and moves by at most this in a sub-step, m.
const CREEP_M: f64 = 2e-3;
/// Overlap that is tolerated, m.
const SLACK_M: f64 = 1e-6;
/// Greatest speed at which an overlap is undone, m/s.
const UNDO_M_S: f64 = 0.5;

/// A shape that may be touched.
struct Thing {
    placed: PlacedShape,
    /// Index among the courses, and the slide of a gantry; `None` is fixed.
    on: Option<(usize, usize)>,
}

/// Two things within reach.
struct Near {
    things: [usize; 2],
    nearest: Point,
    /// Greatest speed of approach, m/s.
    fastest_m_s: f64,
}

impl Physics {
    /// Where all bodies and then all gantries get in this step.
    pub(super) fn meet(&self) -> Vec<Course> {
        let mut courses = self.courses();
        let still = self.still();
        let mut left_s = self.dt_s();
        while left_s > 0.0 {
            let things = self.things(&courses);
            let near = self.near(&courses, &things, &still, left_s);
            let mut h = left_s;
            for n in &near {
                let allowed_m = (n.nearest.gap_m - TOUCH_M / 2.0).max(CREEP_M);
                h = h.min(allowed_m / n.fastest_m_s);
            }
            // A remainder that is only rounding is no sub-step.
            if left_s - h < 1e-9 * self.dt_s() {
                h = left_s;
            }
            let mut rows = self.rows(&courses, &things, &still, &near, 2.0 * CREEP_M);
            rows.extend(self.stops(&courses, h));
            let undo = self.resolve(&mut courses, &rows, h);
            for (course, undo) in courses.iter_mut().zip(undo) {
                course.go(h, &undo);
            }
            left_s -= h;
        }
        if courses.iter().any(|c| c.moved) {
            self.settle(&mut courses, &still);
        }
        courses
    }

    /// Applies the impulses of a sub-step. Returns the velocities that undo overlaps; these change positions only.
    fn resolve(&self, courses: &mut [Course], rows: &[Row], h: f64) -> Vec<Vector6<f64>> {
        let mut undo = vec![Vector6::zeros(); courses.len()];
        if rows.is_empty() {
            return undo;
        }
        let inverse = self.inverse_masses(courses);
        let rates: Vec<_> = courses.iter().map(Course::rate).collect();
        self.stop(courses, rows, &inverse, rates, |row| row.gap_m.max(0.0) / h);
        if rows.iter().any(|row| row.gap_m < -SLACK_M) {
            let smooth: Vec<_> = rows.iter().map(|r| Row { friction: 0.0, ..r.clone() }).collect();
            let pushes = solve(&smooth, &inverse, &mut undo, |row| (row.gap_m / h).max(-UNDO_M_S));
            for (row, push) in rows.iter().zip(pushes) {
                for (m, _) in row.on.iter().flatten() {
                    courses[*m].moved |= push[0] > 0.0;
                }
            }
        }
        undo
    }

    /// Ensures that what touches at the end of the step no longer approaches.
    fn settle(&self, courses: &mut [Course], still: &[PlacedShape]) {
        let things = self.things(courses);
        let near = self.near(courses, &things, still, 0.0);
        let rows = self.rows(courses, &things, still, &near, TOUCH_M);
        let inverse = self.inverse_masses(courses);
        let rates: Vec<_> = courses.iter().map(|c| c.end + c.gained).collect();
        self.stop(courses, &rows, &inverse, rates, |_| 0.0);
    }

    /// Applies the impulses after which the solids of no row approach faster than `fastest` says, m/s.
    fn stop(
        &self,
        courses: &mut [Course],
        rows: &[Row],
        inverse: &[Matrix6<f64>],
        mut rates: Vec<Vector6<f64>>,
        fastest: impl Fn(&Row) -> f64,
    ) {
        let without_momentum: Vec<bool> = courses.iter().map(|c| self.has_no_momentum(c)).collect();
        let theirs = |row: &&Row| row.on.iter().flatten().any(|(m, _)| without_momentum[*m]);
        let theirs: Vec<Row> = rows.iter().filter(theirs).cloned().collect();
        if !theirs.is_empty() {
            let all = || (0..without_momentum.len()).filter(|m| without_momentum[*m]);
            let (mut straight, told) = (inverse.to_vec(), rates.clone());
            for m in all() {
                straight[m].fixed_rows_mut::<3>(3).fill(0.0);
                straight[m].fixed_columns_mut::<3>(3).fill(0.0);
            }
            let mut impulses = solve(&theirs, &straight, &mut rates, &fastest);
            let approach = |row: &Row| row.speed(0, &rates) + fastest(row);
            if !theirs.iter().all(|row| approach(row) >= -NO_ROOM_M_S) {
                rates.clone_from(&told);
                for m in all() {
                    rates[m].fixed_rows_mut::<3>(3).fill(0.0);
                }
                impulses = solve(&theirs, &straight, &mut rates, &fastest);
                for m in all() {
                    let turn = told[m].fixed_rows::<3>(3);
                    rates[m].fixed_rows_mut::<3>(3).copy_from(&turn);
                }
            }
            note(courses, &theirs, &impulses, &straight);
        }
        let impulses = solve(rows, inverse, &mut rates, fastest);
        note(courses, rows, &impulses, inverse);
    }

    fn has_no_momentum(&self, course: &Course) -> bool {
        matches!(course.who, Who::Body(i) if self.bodies[i].without_momentum)
    }

    /// Fixed things.
    fn still(&self) -> Vec<PlacedShape> {
        let fixed = self.fixed.iter().map(|f| PlacedShape::new(f.pose, &f.shape));
        let bases = (self.gantries.iter()).flat_map(|g| self.shapes_of(g.base_handle, g, [0.0; 2], 0));
        fixed.chain(bases).collect()
    }

    /// Moving things, bodies first.
    fn things(&self, courses: &[Course]) -> Vec<Thing> {
        let mut things = Vec::new();
        for (m, course) in courses.iter().enumerate() {
            match course.who {
                Who::Body(i) => {
                    let at = pose(&course.pose(&self.bodies[i].p_BG));
                    things.extend(self.bodies[i].parts.iter().map(|(local, shape)| Thing {
                        placed: PlacedShape::body(at * *local, shape),
                        on: Some((m, 0)),
                    }));
                }
                Who::Gantry(i) => {
                    let g = &self.gantries[i];
                    for k in 0..2 {
                        let shapes = self.shapes_of(g.slides[k], g, course.joints_m, k + 1);
                        things.extend(shapes.into_iter().map(|placed| Thing { placed, on: Some((m, k)) }));
                    }
                }
            }
        }
        things
    }

    /// Pairs that could meet within `left_s` and of which one is a body. The second index continues through the fixed
    /// things.
    fn near(&self, courses: &[Course], things: &[Thing], still: &[PlacedShape], left_s: f64) -> Vec<Near> {
        let speeds: Vec<f64> = courses.iter().map(|c| self.fastest_m_s(c)).collect();
        let speed = |thing: &Thing| thing.on.map_or(0.0, |(m, _)| speeds[m]);
        let body = |thing: &Thing| thing.on.is_some_and(|(m, _)| matches!(courses[m].who, Who::Body(_)));
        let reach = |fastest_m_s: f64| fastest_m_s * left_s + 2.0 * CREEP_M;
        let mut near = Vec::new();
        let others = beside(things, |thing| reach(speed(thing)));
        for ((i, first), others) in things.iter().enumerate().zip(others) {
            if !body(first) {
                continue;
            }
            let moving = others.into_iter().map(|k| (k, &things[k]));
            let moving = moving.map(|(k, t)| (k, &t.placed, t.on, speed(t)));
            let fixed = (things.len()..).zip(still);
            let fixed = fixed.map(|(k, placed)| (k, placed, None, 0.0));
            for (k, placed, on, other_m_s) in moving.chain(fixed) {
                if on.map(|(m, _)| m) == first.on.map(|(m, _)| m) {
                    continue;
                }
                let fastest_m_s = speed(first) + other_m_s;
                if let Some(nearest) = first.placed.nearest(placed, reach(fastest_m_s)) {
                    near.push(Near { things: [i, k], nearest, fastest_m_s });
                }
            }
        }
        near
    }

    fn rows(
        &self,
        courses: &[Course],
        things: &[Thing],
        still: &[PlacedShape],
        near: &[Near],
        reach_m: f64,
    ) -> Vec<Row> {
        let mut rows = Vec::new();
        for n in near.iter().filter(|n| n.nearest.gap_m <= reach_m) {
            let [a, b] = n.things;
            let first = &things[a];
            let (second, on) = match things.get(b) {
                Some(thing) => (&thing.placed, thing.on),
                None => (&still[b - things.len()], None),
            };
            let slides = on.is_some_and(|(m, _)| matches!(courses[m].who, Who::Gantry(_)))
                || (first.on.iter().chain(&on)).any(|(m, _)| self.has_no_momentum(&courses[*m]));
            for point in first.placed.points(second, n.nearest, reach_m) {
                let axes_W = axes(&point.normal_W);
                let share = |on: Option<(usize, usize)>, sign: f64| {
                    on.map(|(m, k)| (m, axes_W.map(|a| self.share(&courses[m], k, &point.at_W, &(a * sign)))))
                };
                rows.push(Row {
                    on: [share(first.on, 1.0), share(on, -1.0)],
                    axes_W,
                    at_W: point.at_W,
                    gap_m: point.gap_m,
                    friction: if slides { 0.0 } else { FRICTION },
                });
            }
        }
        rows
    }

    /// The ends of the gantries' travel that could be reached within `h`, s.
    fn stops(&self, courses: &[Course], h: f64) -> Vec<Row> {
        let mut rows = Vec::new();
        for (m, course) in courses.iter().enumerate() {
            let Who::Gantry(i) = course.who else { continue };
            for k in 0..2 {
                let [low, high] = self.gantries[i].travel_m[k];
                let q = course.joints_m[k];
                for (gap_m, sign) in [(q - low, 1.0), (high - q, -1.0)] {
                    if gap_m > h * self.fastest_m_s(course) + 2.0 * CREEP_M {
                        continue;
                    }
                    let mut by = [Vector6::zeros(); 3];
                    by[0][k] = sign;
                    rows.push(Row {
                        on: [Some((m, by)), None],
                        axes_W: [Vector3::zeros(); 3],
                        at_W: Vector3::zeros(),
                        gap_m: gap_m.max(0.0),
                        friction: 0.0,
                    });
                }
            }
        }
        rows
    }
}

/// For each thing, the later ones whose bounds come within reach of its own along the first axis, in order. So only
/// neighbours are compared (sweep and prune; Baraff 1992, Dynamic Simulation of Non-Penetrating Rigid Bodies, ch. 7).
fn beside(things: &[Thing], reach: impl Fn(&Thing) -> f64) -> Vec<Vec<usize>> {
    let span = |thing: &Thing| {
        let [lo, hi] = thing.placed.along_x();
        let reach_m = reach(thing);
        [lo - reach_m, hi + reach_m]
    };
    let spans: Vec<[f64; 2]> = things.iter().map(span).collect();
    let mut order: Vec<usize> = (0..things.len()).collect();
    order.sort_by(|a, b| spans[*a][0].total_cmp(&spans[*b][0]));
    let mut all = vec![Vec::new(); things.len()];
    for (n, a) in order.iter().enumerate() {
        let neighbours = order[n + 1..].iter();
        for b in neighbours.take_while(|b| spans[**b][0] <= spans[*a][1]) {
            all[*a.min(b)].push(*a.max(b));
        }
    }
    for later in &mut all {
        later.sort_unstable();
    }
    all
}

/// A unit normal with two tangents.
fn axes(normal: &Vector3<f64>) -> [Vector3<f64>; 3] {
    let least = normal.iamin();
    let first = normal.cross(&Vector3::ith(least, 1.0)).normalize();
    [*normal, first, normal.cross(&first)]
}
