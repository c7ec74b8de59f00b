//! Shares out a wanted force and moment among thrusters with limits.
//!
//! *Source:* weighted least squares by an active set: Härkegård, "Efficient active set algorithms for solving
//! constrained least squares problems in aircraft control allocation", CDC 2002; Fossen, "Handbook of Marine Craft
//! Hydrodynamics and Motion Control", 2nd ed. 2021, section 11.2.
//!
//! *Parameters:* weights of the six directions; γ, 1e-6 of the matrix.
//!
//! ```text
//! min |W (B f − τ)|² + γ |f|²,   f_min ≤ f ≤ f_max
//! ```
//!
//! *Deviations:* thrusters that pass a limit are put on it all at once and the rest is solved anew; then those whose
//! multiplier has the wrong sign are freed, one in each round. It ends after as many rounds as twice the thrusters, at
//! a feasible, possibly not quite optimal, choice.

use nalgebra::{DMatrix, DVector, Vector6};

/// Weight of small forces beside the wanted ones.
const SMALL: f64 = 1e-6;

/// Thrusters' places and limits.
#[derive(Clone, Debug, PartialEq)]
pub struct Allocation {
    /// Six rows, one column for each thruster, rows times their weights.
    weighted: DMatrix<f64>,
    weights: Vector6<f64>,
    limits: Vec<[f64; 2]>,
    gamma: f64,
}

/// What thrusters are to do.
#[derive(Clone, Debug, PartialEq)]
pub struct ThrusterCommands {
    /// Thrust of each, N.
    pub thrusts_n: Vec<f64>,
    /// Whether one is at its limit.
    pub saturated: bool,
}

impl Allocation {
    /// For thrusters with force and moment of 1 N each, and limits (N). `weights` of zero leave a direction free.
    pub fn new(arms: &[Vector6<f64>], limits: Vec<[f64; 2]>, weights: Vector6<f64>) -> Self {
        let weighted = DMatrix::from_fn(6, arms.len(), |i, j| weights[i] * arms[j][i]);
        let gamma = SMALL * weighted.norm_squared().max(1e-12);
        Self { weighted, weights, limits, gamma }
    }

    /// The thrusts whose force and moment come nearest to what is wanted.
    pub fn share(&self, wanted: &Vector6<f64>) -> ThrusterCommands {
        let n = self.limits.len();
        let target = DVector::from_iterator(6, (0..6).map(|i| self.weights[i] * wanted[i]));
        // −1 at the lower limit, 1 at the upper one, 0 free.
        let mut held = vec![0i8; n];
        let mut thrusts = DVector::zeros(n);
        for _ in 0..2 * n.max(1) {
            thrusts = self.solved(&held, &target);
            let mut passed = false;
            for (k, limit) in self.limits.iter().enumerate() {
                if held[k] == 0 && !(limit[0]..=limit[1]).contains(&thrusts[k]) {
                    held[k] = if thrusts[k] < limit[0] { -1 } else { 1 };
                    passed = true;
                }
            }
            if passed {
                continue;
            }
            // Gradient of the sum of squares: at an upper limit it must fall, at a lower one rise.
            let gradient = self.weighted.transpose() * (&self.weighted * &thrusts - &target) + &thrusts * self.gamma;
            let wrong = (0..n)
                .map(|k| (k, gradient[k] * f64::from(held[k])))
                .filter(|(_, g)| *g > 1e-9 * self.gamma.max(1.0))
                .max_by(|a, b| a.1.total_cmp(&b.1));
            match wrong {
                Some((k, _)) => held[k] = 0,
                None => break,
            }
        }
        let limits = self.limits.iter();
        let thrusts_n: Vec<f64> =
            (thrusts.iter().zip(limits)).map(|(f, [least, most])| f.clamp(*least, *most)).collect();
        let saturated = held.iter().any(|h| *h != 0);
        ThrusterCommands { thrusts_n, saturated }
    }

    /// Least squares of the free ones, with the others at their limits.
    fn solved(&self, held: &[i8], target: &DVector<f64>) -> DVector<f64> {
        let mut thrusts = DVector::from_fn(held.len(), |k, _| match held[k] {
            0 => 0.0,
            h if h < 0 => self.limits[k][0],
            _ => self.limits[k][1],
        });
        let free: Vec<usize> = (0..held.len()).filter(|k| held[*k] == 0).collect();
        if free.is_empty() {
            return thrusts;
        }
        let rest = target - &self.weighted * &thrusts;
        let B = DMatrix::from_fn(6, free.len(), |i, j| self.weighted[(i, free[j])]);
        let normal = B.transpose() * &B + DMatrix::identity(free.len(), free.len()) * self.gamma;
        let right = B.transpose() * rest;
        let solution = normal.cholesky().expect("a sum of squares and a positive diagonal").solve(&right);
        for (j, k) in free.into_iter().enumerate() {
            thrusts[k] = solution[j];
        }
        thrusts
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Four thrusters at the corners of a square, at 45 degrees: surge, sway and yaw.
    fn square() -> Vec<Vector6<f64>> {
        let s = 0.5f64.sqrt();
        [(0.15, -0.11, s, s), (0.15, 0.11, s, -s), (-0.15, -0.11, -s, s), (-0.15, 0.11, -s, -s)]
            .map(|(x, y, fx, fy)| Vector6::new(fx, fy, 0.0, 0.0, 0.0, x * fy - y * fx))
            .to_vec()
    }

    fn cost(a: &Allocation, wanted: &Vector6<f64>, f: &[f64]) -> f64 {
        let f = DVector::from_column_slice(f);
        let target = DVector::from_iterator(6, (0..6).map(|i| a.weights[i] * wanted[i]));
        (&a.weighted * &f - target).norm_squared() + a.gamma * f.norm_squared()
    }

    #[test]
    fn what_can_be_given_is_given() {
        let arms = square();
        let a = Allocation::new(&arms, vec![[-40.0, 50.0]; 4], Vector6::repeat(1.0));
        let wanted = Vector6::new(20.0, -10.0, 0.0, 0.0, 0.0, 3.0);
        let got = a.share(&wanted);
        assert!(!got.saturated);
        let sum: Vector6<f64> = arms.iter().zip(&got.thrusts_n).map(|(b, f)| b * *f).sum();
        assert!((sum - wanted).norm() < 1e-3, "{sum}");
    }

    proptest! {
        #![proptest_config(crate::handoff::testing::fixed(256))]

        // No other choice within the limits, near or far, is better.
        #[test]
        fn nothing_within_the_limits_is_better(
            x in -200.0..200.0, y in -200.0..200.0, n in -40.0..40.0,
            other in proptest::collection::vec(-40.0..50.0, 4),
            weight in 0.1..10.0,
        ) {
            let weights = Vector6::new(1.0, 1.0, 1.0, 1.0, 1.0, weight);
            let a = Allocation::new(&square(), vec![[-40.0, 50.0]; 4], weights);
            let wanted = Vector6::new(x, y, 0.0, 0.0, 0.0, n);
            let got = a.share(&wanted);
            let best = cost(&a, &wanted, &got.thrusts_n);
            for share in [1e-3, 0.1, 1.0] {
                let there: Vec<f64> = got.thrusts_n.iter().zip(&other)
                    .map(|(f, o)| f + share * (o - f)).collect();
                prop_assert!(best <= cost(&a, &wanted, &there) + 1e-6 * (1.0 + best));
            }
        }
    }
}
