//! Impulses at points of contact between movers with any mass matrix. No solid enters another, and no energy is added.
//!
//! *Source:* M. Anitescu and F. A. Potra, Nonlinear Dynamics 14, 231 (1997): contact as a complementarity
//! problem of velocities; solved by projected Gauss-Seidel, friction by projection on Coulomb's disc
//! (M. Jourdan, P. Alart and M. Jean, Comput. Methods Appl. Mech. Eng. 155, 31 (1998)).
//!
//! *Parameters:* mass matrices, gaps, coefficients of friction.
//!
//! *Deviations:* impacts are wholly inelastic, as by default in rapier. The iteration ends after a fixed number of
//! rounds; a single normal impulse is exact after the first.

use nalgebra::{Matrix6, Vector3, Vector6};

/// Largest number of rounds.
const ROUNDS: usize = 400;
/// The rounds end when no velocity at a contact changes by more than this, m/s.
const SETTLED_M_S: f64 = 1e-13;

/// One point at which two solids are next to each other.
#[derive(Clone, Debug)]
pub(super) struct Row {
    /// The two movers, each with the velocity of its point along the normal and both tangents, for a unit of each of
    /// its velocities. Those of the second mover have the opposite sign. `None` is fixed.
    pub(super) on: [Option<(usize, [Vector6<f64>; 3])>; 2],
    /// Normal towards the first solid, and two tangents, world axes.
    pub(super) axes_W: [Vector3<f64>; 3],
    /// Place, world axes, m.
    pub(super) at_W: Vector3<f64>,
    /// Distance, m; negative where they overlap.
    pub(super) gap_m: f64,
    /// Coefficient of friction.
    pub(super) friction: f64,
}

impl Row {
    /// Speed of the first solid relative to the second along an axis, m/s.
    pub(super) fn speed(&self, axis: usize, rates: &[Vector6<f64>]) -> f64 {
        let on = self.on.iter().flatten();
        on.map(|(m, by)| by[axis].dot(&rates[*m])).sum()
    }

    /// Speed along one axis for a unit impulse along another, 1/kg.
    fn give(&self, axes: [usize; 2], inverse: &[Matrix6<f64>]) -> f64 {
        let on = self.on.iter().flatten();
        on.map(|(m, by)| by[axes[0]].dot(&(inverse[*m] * by[axes[1]]))).sum()
    }

    fn strike(&self, axis: usize, by_N_s: f64, inverse: &[Matrix6<f64>], rates: &mut [Vector6<f64>]) {
        for (m, by) in self.on.iter().flatten() {
            rates[*m] += inverse[*m] * by[axis] * by_N_s;
        }
    }
}

/// Changes the velocities so that the solids of no row approach faster than `fastest` says (m/s; not negative where
/// they may approach). Returns the impulses along the normal and the tangents, N s.
pub(super) fn solve(
    rows: &[Row],
    inverse: &[Matrix6<f64>],
    rates: &mut [Vector6<f64>],
    fastest: impl Fn(&Row) -> f64,
) -> Vec<[f64; 3]> {
    let least: Vec<f64> = rows.iter().map(|r| -fastest(r)).collect();
    let gives: Vec<(f64, f64)> = rows.iter().map(|r| gives(r, inverse)).collect();
    let mut impulses = vec![[0.0; 3]; rows.len()];
    for _ in 0..ROUNDS {
        let mut change: f64 = 0.0;
        for (((row, least), (normal, tangent)), impulse) in rows.iter().zip(&least).zip(&gives).zip(&mut impulses) {
            if *normal <= 0.0 {
                continue;
            }
            let wanted = impulse[0] + (least - row.speed(0, rates)) / normal;
            let step = wanted.max(0.0) - impulse[0];
            impulse[0] += step;
            row.strike(0, step, inverse, rates);
            change = change.max(step.abs() * normal);
            if row.friction == 0.0 || *tangent <= 0.0 {
                continue;
            }
            let mut aim = [1, 2].map(|k| impulse[k] - row.speed(k, rates) / tangent);
            let size = (aim[0] * aim[0] + aim[1] * aim[1]).sqrt();
            let most = row.friction * impulse[0];
            if size > most {
                aim = aim.map(|a| a * (most / size));
            }
            for k in [1, 2] {
                let step = aim[k - 1] - impulse[k];
                impulse[k] = aim[k - 1];
                row.strike(k, step, inverse, rates);
                change = change.max(step.abs() * tangent);
            }
        }
        if change <= SETTLED_M_S {
            break;
        }
    }
    impulses
}

/// Speed for a unit impulse along the normal, and the highest along any tangent, 1/kg.
fn gives(row: &Row, inverse: &[Matrix6<f64>]) -> (f64, f64) {
    let [a, b, c] = [[1, 1], [2, 2], [1, 2]].map(|axes| row.give(axes, inverse));
    let half = 0.5 * (a - b);
    let most = 0.5 * (a + b) + (half * half + c * c).sqrt();
    (row.give([0, 0], inverse), most)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A mover with a different mass along every axis, hit off its centre along a slanting normal.
    fn slanting(friction: f64) -> (Row, Matrix6<f64>) {
        let n = Vector3::new(-0.6, 0.8, 0.0);
        let axes_W = [n, Vector3::new(0.8, 0.6, 0.0), Vector3::z()];
        let arm = Vector3::new(0.7, 0.1, -0.05);
        let by = axes_W.map(|a| {
            let m = arm.cross(&a);
            Vector6::new(a.x, a.y, a.z, m.x, m.y, m.z)
        });
        let row = Row { on: [Some((0, by)), None], axes_W, at_W: arm, gap_m: 0.0, friction };
        let mass = Matrix6::from_diagonal(&Vector6::new(32.0, 60.0, 60.0, 0.2, 8.0, 8.0));
        (row, mass.try_inverse().expect("a mass"))
    }

    #[test]
    fn one_point_takes_the_effective_mass_along_its_normal() {
        let (row, inverse) = slanting(0.0);
        let before = Vector6::new(1.5, -0.3, 0.2, 0.1, -0.2, 0.3);
        let mut rates = [before];
        let impulse = solve(std::slice::from_ref(&row), &[inverse], &mut rates, |_| 0.0)[0];
        let j = row.on[0].expect("a mover").1[0];
        let effective = 1.0 / j.dot(&(inverse * j));
        assert!((impulse[0] + effective * j.dot(&before)).abs() < 1e-12);
        assert!((rates[0] - before - inverse * j * impulse[0]).norm() < 1e-12);
        assert!(row.speed(0, &rates).abs() < 1e-12);
    }

    #[test]
    fn friction_stops_what_it_can_and_else_stays_at_its_bound() {
        for (friction, across, sticks) in [(4.0, 0.02, true), (0.4, 3.0, false)] {
            let (row, inverse) = slanting(friction);
            let mass = inverse.try_inverse().expect("a mass");
            let n = row.axes_W[0];
            let v = n * -1.0 + row.axes_W[1] * across;
            let before = Vector6::new(v.x, v.y, v.z, 0.0, 0.0, 0.0);
            let mut rates = [before];
            let impulse = solve(std::slice::from_ref(&row), &[inverse], &mut rates, |_| 0.0)[0];
            let [a, b] = [1, 2].map(|k| row.speed(k, &rates));
            let tangent = (impulse[1] * impulse[1] + impulse[2] * impulse[2]).sqrt();
            let slip = (a * a + b * b).sqrt();
            if sticks {
                assert!(slip < 1e-9 && tangent < friction * impulse[0], "{slip} m/s, {impulse:?}");
            } else {
                assert!((tangent - friction * impulse[0]).abs() < 1e-9, "{impulse:?}");
                let against = (a * impulse[1] + b * impulse[2]) / (slip * tangent);
                assert!((against + 1.0).abs() < 1e-9, "friction acts against the slip");
            }
            let energy = |r: &Vector6<f64>| 0.5 * r.dot(&(mass * r));
            assert!(energy(&rates[0]) < energy(&before));
        }
    }

    #[test]
    fn what_goes_apart_or_may_still_come_closer_is_left_alone() {
        let (row, inverse) = slanting(0.4);
        let away = Vector6::new(-1.0, 0.5, 0.0, 0.0, 0.0, 0.0);
        let mut rates = [away];
        let rows = [row];
        assert_eq!(solve(&rows, &[inverse], &mut rates, |_| 0.0), [[0.0; 3]]);
        let mut rates = [-away];
        assert_eq!(solve(&rows, &[inverse], &mut rates, |_| 2.0), [[0.0; 3]]);
        assert_eq!(rates, [-away]);
    }
}
