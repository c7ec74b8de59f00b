//! What a policy chooses between: ways, the belief now, and the belief after each outcome on a way.

use nalgebra::Vector2;
use std::sync::Arc;
use world::math;

/// How many partial sums are kept: they add several cells at once, in a fixed order.
const LANES: usize = 8;

/// An outcome on a way.
#[derive(Clone, Debug)]
pub struct PathOutcome {
    /// Its chance if the source is in this cell.
    pub chance: Arc<Vec<f64>>,
    /// That chance times its logarithm; 0 where it is 0.
    pub chance_ln: Arc<Vec<f64>>,
}

impl PathOutcome {
    /// An outcome of these chances, 0 to 1, one a cell.
    pub fn new(chance: Vec<f64>) -> Self {
        let times_ln = |c: &f64| if *c > 0.0 { c * math::ln(*c) } else { 0.0 };
        Self { chance_ln: Arc::new(chance.iter().map(times_ln).collect()), chance: Arc::new(chance) }
    }
}

/// A way that could be gone.
#[derive(Clone, Debug)]
pub struct Way {
    /// Where it ends (east, north), m.
    pub end: Vector2<f64>,
    /// What can come of it: the chances of all outcomes sum to 1 for each cell.
    pub outcomes: Vec<PathOutcome>,
}

impl Way {
    /// A way on which there is a detection with this chance, one a cell, or none.
    pub fn with_detection(end: Vector2<f64>, chance: &[f64]) -> Self {
        let none = chance.iter().map(|c| 1.0 - c).collect();
        Self { end, outcomes: vec![PathOutcome::new(none), PathOutcome::new(chance.to_vec())] }
    }
}

/// Ways, and the belief about the source.
#[derive(Clone, Debug)]
pub struct Prospect<'a> {
    /// Probability of each cell; they sum to 1.
    p: &'a [f64],
    /// That times its logarithm.
    p_ln: Vec<f64>,
    /// Middle of each cell (east, north), m.
    cells: &'a [Vector2<f64>],
    /// Length of a way, m: the unit of distances.
    step_m: f64,
    /// The ways.
    ways: &'a [Way],
}

/// The belief after an outcome.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BeliefAfter {
    /// Probability of the outcome.
    pub chance: f64,
    /// Entropy then, nat.
    pub entropy_nat: f64,
    /// Mean distance of the source from the way's end then, in lengths of a way.
    pub distance: f64,
}

impl<'a> Prospect<'a> {
    /// # Panics
    /// If there is no way, or not one probability for each cell.
    pub fn new(p: &'a [f64], cells: &'a [Vector2<f64>], step_m: f64, ways: &'a [Way]) -> Self {
        assert!(!ways.is_empty() && p.len() == cells.len(), "a choice needs ways, and a probability for each cell");
        let p_ln = p.iter().map(|v| if *v > 0.0 { v * math::ln(*v) } else { 0.0 }).collect();
        Self { p, p_ln, cells, step_m, ways }
    }

    /// The ways.
    pub fn ways(&self) -> &'a [Way] {
        self.ways
    }

    /// Entropy now, nat.
    pub fn entropy_nat(&self) -> f64 {
        -self.p_ln.iter().sum::<f64>()
    }

    /// Distance of each cell from a place, in lengths of a way.
    fn distances(&self, from: Vector2<f64>) -> Vec<f64> {
        self.cells.iter().map(|cell| (cell - from).norm() / self.step_m).collect()
    }

    /// The belief after each outcome on a way, by Bayes' rule. With q = p c, the entropy is
    /// ln Σq − Σ q ln q / Σq, and q ln q = c · p ln p + p · c ln c.
    pub fn after(&self, way: &Way) -> Vec<BeliefAfter> {
        let distances = self.distances(way.end);
        let of = |outcome: &PathOutcome| {
            let (c, c_ln) = (&outcome.chance[..], &outcome.chance_ln[..]);
            let mut lanes = [[0.0; LANES]; 3];
            let whole = self.p.len() - self.p.len() % LANES;
            for at in (0..whole).step_by(LANES) {
                let part = at..at + LANES;
                let (p, p_ln, c, c_ln) =
                    (&self.p[part.clone()], &self.p_ln[part.clone()], &c[part.clone()], &c_ln[part.clone()]);
                let d = &distances[part];
                for k in 0..LANES {
                    let q = p[k] * c[k];
                    lanes[0][k] += q;
                    lanes[1][k] += c[k] * p_ln[k] + p[k] * c_ln[k];
                    lanes[2][k] += q * d[k];
                }
            }
            let mut sums = lanes.map(|lane| lane.iter().sum::<f64>());
            for i in whole..self.p.len() {
                let q = self.p[i] * c[i];
                sums[0] += q;
                sums[1] += c[i] * self.p_ln[i] + self.p[i] * c_ln[i];
                sums[2] += q * distances[i];
            }
            let [chance, q_ln_q, q_d] = sums;
            if chance <= 0.0 {
                return BeliefAfter { chance: 0.0, entropy_nat: 0.0, distance: 0.0 };
            }
            let entropy_nat = (math::ln(chance) - q_ln_q / chance).max(0.0);
            BeliefAfter { chance, entropy_nat, distance: q_d / chance }
        };
        way.outcomes.iter().map(of).collect()
    }

    /// Mean over all outcomes on a way of what is worth after each.
    pub fn expected(&self, way: &Way, worth: impl Fn(&BeliefAfter) -> f64) -> f64 {
        self.after(way).iter().filter(|a| a.chance > 0.0).map(|a| a.chance * worth(a)).sum()
    }

    /// After an outcome: its probability, and the mean (m) and the trace of the covariance (m²) of the source's place.
    pub fn moments(&self, outcome: &PathOutcome) -> (f64, Vector2<f64>, f64) {
        let (mut chance, mut first, mut second) = (0.0, Vector2::zeros(), 0.0);
        // About the first cell, so that large coordinates cost no digits.
        let origin = self.cells[0];
        for ((p, c), cell) in self.p.iter().zip(outcome.chance.iter()).zip(self.cells) {
            let (q, r) = (p * c, cell - origin);
            chance += q;
            first += r * q;
            second += q * r.norm_squared();
        }
        if chance <= 0.0 {
            return (0.0, origin, 0.0);
        }
        let mean: Vector2<f64> = first / chance;
        (chance, origin + mean, (second / chance - mean.norm_squared()).max(0.0))
    }

    /// Mean over the belief of a function of the distance from a place, in lengths of a way.
    pub fn mean_over_distance(&self, from: Vector2<f64>, f: impl Fn(f64) -> f64) -> f64 {
        self.p.iter().zip(self.distances(from)).map(|(p, d)| p * f(d)).sum()
    }

    /// Middle of the likeliest cell (east, north), m: the first of equals.
    pub fn likeliest(&self) -> Vector2<f64> {
        let mut best = 0;
        for (i, p) in self.p.iter().enumerate() {
            if *p > self.p[best] {
                best = i;
            }
        }
        self.cells[best]
    }

    /// Middle of the cell at which the sum of probabilities reaches a share (0–1) of the whole.
    pub fn drawn(&self, share: f64) -> Vector2<f64> {
        let (mut sum, mut place) = (0.0, self.likeliest());
        for (p, cell) in self.p.iter().zip(self.cells) {
            sum += p;
            if *p > 0.0 && sum >= share {
                place = *cell;
                break;
            }
        }
        place
    }

    /// The distance between two places, in lengths of a way.
    pub fn steps(&self, from: Vector2<f64>, to: Vector2<f64>) -> f64 {
        (to - from).norm() / self.step_m
    }

    /// The way with the greatest worth, the first of equals.
    pub fn best(&self, worth: impl Fn(&Way) -> f64) -> usize {
        let mut best = (0, f64::NEG_INFINITY);
        for (k, way) in self.ways.iter().enumerate() {
            let w = worth(way);
            if w > best.1 {
                best = (k, w);
            }
        }
        best.0
    }

    /// The way that ends nearest to a place.
    pub fn towards(&self, place: Vector2<f64>) -> usize {
        self.best(|way| -(way.end - place).norm())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bayes_by_hand() {
        let cells = [0.0, 1.0, 2.0].map(|x| Vector2::new(x, 0.0));
        let p = [0.5, 0.3, 0.2];
        let ways = [Way::with_detection(Vector2::new(2.0, 0.0), &[0.0, 0.5, 1.0])];
        let prospect = Prospect::new(&p, &cells, 1.0, &ways);
        let [none, hit] = prospect.after(&ways[0])[..] else { panic!("two outcomes") };
        // A detection: 0, 0.15, 0.2. None: 0.5, 0.15, 0.
        let h = |q: &[f64]| -> f64 {
            let sum: f64 = q.iter().sum();
            q.iter().filter(|v| **v > 0.0).map(|v| -(v / sum) * math::ln(v / sum)).sum()
        };
        assert!((hit.chance - 0.35).abs() < 1e-12 && (none.chance - 0.65).abs() < 1e-12);
        assert!((hit.entropy_nat - h(&[0.15, 0.2])).abs() < 1e-12);
        assert!((none.entropy_nat - h(&[0.5, 0.15])).abs() < 1e-12);
        assert!((hit.distance - 0.15 / 0.35).abs() < 1e-12);
        assert!((prospect.entropy_nat() - h(&p)).abs() < 1e-12);
        let (chance, mean, trace) = prospect.moments(&ways[0].outcomes[1]);
        assert!((chance - 0.35).abs() < 1e-12 && (mean.x - (0.15 + 0.4) / 0.35).abs() < 1e-12);
        let x2 = (0.15 + 0.8) / 0.35;
        assert!((trace - (x2 - mean.x * mean.x)).abs() < 1e-12);
        assert_eq!(prospect.drawn(0.4), cells[0]);
        assert_eq!(prospect.drawn(0.9), cells[2]);
    }

    /// A forecast never loses information, and beliefs after it average to the belief before.
    #[test]
    fn information_is_never_lost() {
        let cells: Vec<_> = (0..37).map(|i| Vector2::new(f64::from(i % 7), f64::from(i / 7))).collect();
        let raw: Vec<f64> = (0..37).map(|i| f64::from((i * 29) % 17)).collect();
        let sum: f64 = raw.iter().sum();
        let p: Vec<f64> = raw.iter().map(|v| v / sum).collect();
        let chance: Vec<f64> = (0..37).map(|i| f64::from((i * 13) % 11) / 10.0).collect();
        let ways = [Way::with_detection(Vector2::new(3.0, 3.0), &chance)];
        let prospect = Prospect::new(&p, &cells, 1.0, &ways);
        assert!(prospect.expected(&ways[0], |a| a.entropy_nat) < prospect.entropy_nat());
        let distance = prospect.mean_over_distance(ways[0].end, |d| d);
        assert!((prospect.expected(&ways[0], |a| a.distance) - distance).abs() < 1e-12);
        assert!((prospect.expected(&ways[0], |_| 1.0) - 1.0).abs() < 1e-12);
    }
}
