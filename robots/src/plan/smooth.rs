//! Turns a chain of cells into a path that a vehicle with a turning circle can follow: pulls it straight and rounds
//! the corners.
//!
//! *Source*: string pulling by line of sight: Thorpe 1984, AAAI-84, 318 (path relaxation); rounding of corners by
//! tangent arcs: Fossen 2011, Handbook of Marine Craft Hydrodynamics, section 10.3 (circular inscribed arcs).
//!
//! *Parameters*: turning radius, m; the costs of the search.
//!
//! *Deviations*: a string is pulled only if that costs no more than the cells that it replaces, clearance included.
//! An arc that would leave the free cells is made tighter, down to a quarter of the radius, and otherwise stays a
//! corner; the path reports its tightest turn. The turn from the vehicle's own direction to the first leg is part of
//! the path if one of the two turning circles is free; otherwise the path begins with a corner.

use super::{FreeSpace, PathStart};
use crate::plan::search::Costs;
use nalgebra::{Vector2, Vector3};
use std::f64::consts::{FRAC_PI_2, TAU};
use world::math;
use world::units::{Heading, wrap_tau};

/// Greatest angle between two chords of an arc, rad.
const CHORD_RAD: f64 = 0.2;
/// A turn smaller than this counts as none, rad.
const STRAIGHT_RAD: f64 = 0.02;
/// How much more a pulled string may cost than what it replaces: the costs of cells are not exactly those of a line.
const SLACK: f64 = 1.005;

/// Cost of a straight line: its length, with a higher price for the vertical and for small clearance.
fn line_cost(room: &FreeSpace, costs: &Costs, a: &Vector3<f64>, b: &Vector3<f64>) -> f64 {
    let d = b - a;
    let length = (d.xy().norm_squared() + (costs.climb * d.z) * (costs.climb * d.z)).sqrt();
    if costs.weight == 0.0 || costs.soft_m == 0.0 {
        return length;
    }
    let n = (d.norm() / (0.5 * room.narrowest_m())).ceil().max(1.0) as usize;
    let sum: f64 = (0..n)
        .map(|k| {
            let p = a + d * ((k as f64 + 0.5) / n as f64);
            let spare = room.clearance_m(room.nearest_cell(&p)) - room.needed_m();
            1.0 + costs.weight * (1.0 - spare / costs.soft_m).clamp(0.0, 1.0)
        })
        .sum();
    length * sum / n as f64
}

/// Leaves out the points that a free straight line can bypass at no higher cost.
pub(super) fn pull(room: &FreeSpace, costs: &Costs, points: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
    let mut upto = vec![0.0; points.len()];
    for k in 1..points.len() {
        upto[k] = upto[k - 1] + line_cost(room, costs, &points[k - 1], &points[k]);
    }
    let good = |i: usize, j: usize| {
        room.line_free(&points[i], &points[j])
            && line_cost(room, costs, &points[i], &points[j]) <= SLACK * (upto[j] - upto[i])
    };
    let last = points.len() - 1;
    let mut kept = vec![points[0]];
    let mut at = 0;
    while at < last {
        // Twice as far as long as it works, then halving towards the farthest that worked.
        let (mut sure, mut span) = (at + 1, 2);
        let mut beyond = last + 1;
        while sure < last {
            let to = (at + span).min(last);
            if !good(at, to) {
                beyond = to;
                break;
            }
            sure = to;
            span *= 2;
        }
        while sure + 1 < beyond {
            let middle = usize::midpoint(sure, beyond);
            if good(at, middle) {
                sure = middle;
            } else {
                beyond = middle;
            }
        }
        kept.push(points[sure]);
        at = sure;
    }
    kept
}

/// An arc from a point: chords around `centre`, turning by `angle` (clockwise positive); the height changes linearly
/// to `z`.
fn arc(start: Vector3<f64>, centre: Vector2<f64>, angle: f64, z: f64) -> Vec<Vector3<f64>> {
    let n = (angle.abs() / CHORD_RAD).ceil().max(1.0);
    let spoke = start.xy() - centre;
    (1..=n as usize)
        .map(|k| {
            let part = k as f64 / n;
            let (s, c) = math::sin_cos(-angle * part);
            let p = centre + Vector2::new(c * spoke.x - s * spoke.y, s * spoke.x + c * spoke.y);
            Vector3::new(p.x, p.y, start.z + (z - start.z) * part)
        })
        .collect()
}

fn free(room: &FreeSpace, from: &Vector3<f64>, points: &[Vector3<f64>]) -> bool {
    let mut last = from;
    points.iter().all(|p| room.line_free(std::mem::replace(&mut last, p), p))
}

/// The turn from the start's own direction towards `to` on one of the two turning circles: the shorter free one.
fn first_turn(room: &FreeSpace, start: &PathStart, to: &Vector3<f64>, radius_m: f64) -> Option<Vec<Vector3<f64>>> {
    let mut best: Option<(f64, Vec<Vector3<f64>>)> = None;
    for turn in [1.0, -1.0] {
        let centre = start.p_W.xy() + start.heading.turned(turn * FRAC_PI_2).unit() * radius_m;
        let away = to.xy() - centre;
        let d = away.norm();
        if d <= radius_m {
            continue;
        }
        // The course of the tangent: the direction to the centre, turned by asin(r / d).
        let course = Heading::from_vector(away).turned(turn * math::asin(radius_m / d));
        let angle = wrap_tau(turn * (course.rad() - start.heading.rad()));
        let angle = if TAU - angle < 1e-9 { 0.0 } else { angle };
        let tangent_m = (d * d - radius_m * radius_m).sqrt();
        let length = angle * radius_m + tangent_m;
        let z = start.p_W.z + (to.z - start.p_W.z) * (angle * radius_m / length);
        let points = arc(start.p_W, centre, turn * angle, z);
        let ends_free = points.last().is_some_and(|p| room.line_free(p, to));
        if ends_free && free(room, &start.p_W, &points) && best.as_ref().is_none_or(|(l, _)| length < *l) {
            best = Some((length, points));
        }
    }
    best.map(|(_, points)| points)
}

/// Rounds the corners; returns the path and the radius of its tightest turn, m.
pub(super) fn round(
    room: &FreeSpace,
    start: &PathStart,
    points: &[Vector3<f64>],
    radius_m: f64,
) -> (Vec<Vector3<f64>>, f64) {
    let mut tightest = f64::INFINITY;
    let mut made = vec![points[0]];
    let Some(second) = points.get(1) else {
        return (made, tightest);
    };
    let aside = start.heading.turn_to(Heading::from_vector(second.xy() - points[0].xy())).abs();
    if aside > STRAIGHT_RAD {
        match first_turn(room, start, second, radius_m) {
            Some(turn) => {
                made.extend(turn);
                tightest = radius_m;
            }
            None => tightest = 0.0,
        }
    }
    for k in 1..points.len() {
        let (last, corner) = (made[made.len() - 1], points[k]);
        let Some(next) = points.get(k + 1) else {
            made.push(corner);
            break;
        };
        let (a, b) = ((corner - last).xy(), (next - corner).xy());
        let turn = Heading::from_vector(a).turn_to(Heading::from_vector(b));
        if a.norm() < 1e-9 || b.norm() < 1e-9 || turn.abs() < STRAIGHT_RAD {
            made.push(corner);
            continue;
        }
        let tan = math::tan(turn.abs() / 2.0);
        // Half of the next leg is left for the next corner.
        let room_for = a.norm().min(b.norm() / 2.0) / tan;
        let mut r = radius_m.min(room_for);
        let mut rounded = false;
        while !rounded && r >= 0.249 * radius_m {
            let t = r * tan;
            let enter = corner + (last - corner) * (t / a.norm());
            let leave = corner + (next - corner) * (t / b.norm());
            let side = Heading::from_vector(a).turned(FRAC_PI_2 * turn.signum()).unit();
            let bow = arc(enter, enter.xy() + side * r, turn, leave.z);
            if free(room, &enter, &bow) {
                made.push(enter);
                made.extend(bow);
                tightest = tightest.min(r);
                rounded = true;
            }
            r *= 0.5;
        }
        if !rounded {
            made.push(corner);
            tightest = 0.0;
        }
    }
    (made, tightest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::testing::{block, from, room};

    const COSTS: Costs = Costs { climb: 1.0, weight: 0.0, soft_m: 0.0 };

    fn at(x: f64, y: f64) -> Vector3<f64> {
        Vector3::new(x, y, -4.0)
    }

    #[test]
    fn a_string_is_pulled_tight_in_free_water_and_holds_at_a_block() {
        let open = room([60, 60, 1], [1.0; 3], vec![]);
        let stairs: Vec<_> = (0..40_i32).map(|k| at(5.0 + f64::from(k / 2), 5.0 + f64::from((k + 1) / 2))).collect();
        assert_eq!(pull(&open, &COSTS, &stairs), [stairs[0], stairs[39]]);
        let held = room([60, 60, 1], [1.0; 3], vec![block("b", 20.0, 20.0, [10.0, 10.0, 8.0])]);
        let round: Vec<_> =
            (10..=30).map(|y| at(10.5, f64::from(y))).chain((11..=30).map(|x| at(f64::from(x), 30.0))).collect();
        let pulled = pull(&held, &COSTS, &round);
        assert!(pulled.len() >= 3 && pulled.len() < 8, "{pulled:?}");
        assert!(pulled.windows(2).all(|w| held.line_free(&w[0], &w[1])));
    }

    #[test]
    fn corners_become_arcs_of_the_radius() {
        let open = room([80, 80, 1], [1.0; 3], vec![]);
        let start = from(10.0, 10.0, 0.0);
        let (path, tightest) = round(&open, &start, &[at(10.0, 10.0), at(10.0, 60.0), at(60.0, 60.0)], 12.0);
        assert_eq!(tightest, 12.0);
        // Round the corner every point of the arc lies 12 m from its centre.
        let centre = Vector2::new(22.0, 48.0);
        let bow: Vec<_> = path.iter().filter(|p| p.x < 21.9 && p.y > 48.1).collect();
        assert!(bow.len() >= 6 && bow.iter().all(|p| ((p.xy() - centre).norm() - 12.0).abs() < 1e-9));
        let length: f64 = path.windows(2).map(|w| (w[1] - w[0]).norm()).sum();
        assert!((length - (38.0 + 38.0 + 12.0 * FRAC_PI_2)).abs() < 0.1, "{length}");
    }

    #[test]
    fn the_first_turn_is_on_a_turning_circle_to_the_free_side() {
        let start = from(40.0, 40.0, 0.0);
        let legs = [at(40.0, 40.0), at(40.0, 5.0)];
        let open = room([80, 80, 1], [1.0; 3], vec![]);
        let (path, tightest) = round(&open, &start, &legs, 10.0);
        assert_eq!(tightest, 10.0);
        let first = path[1] - path[0];
        assert!(first.y > 0.0, "it begins the way it moves");
        // With the right side walled off it turns left.
        let walled = room([80, 80, 1], [1.0; 3], vec![block("w", 52.0, 45.0, [4.0, 40.0, 8.0])]);
        let (path, tightest) = round(&walled, &start, &legs, 10.0);
        assert_eq!(tightest, 10.0);
        assert!(path.iter().all(|p| p.x <= 40.0 + 1e-9));
        // Between two walls no turn is free, and the path says so.
        let gorge = vec![block("e", 48.0, 45.0, [4.0, 60.0, 8.0]), block("w", 32.0, 45.0, [4.0, 60.0, 8.0])];
        assert_eq!(round(&room([80, 80, 1], [1.0; 3], gorge), &start, &legs, 10.0).1, 0.0);
    }
}
