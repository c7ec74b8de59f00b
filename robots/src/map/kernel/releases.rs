//! Releases of the look-back; neighbours are merged into one Gaussian where that hardly changes the map.
//!
//! *Source*: our own; the releases are those of Wang & Pang, eq. 2. A set of m releases (m a power of two) becomes
//! one Gaussian with the mean of their displacements and, along each axis, the mean of their variances plus the
//! variance of their displacements (mean, variance and mass are kept), raised to the m-th power in the product.
//!
//! *Parameters*: κ, `merge`, 0.3: root mean square of the displacements within a set, as a share of its youngest
//! release's spread σ√Δt. It also sets further limits: ages within a set differ by at most 0.8 κ of the youngest,
//! displacements along the two axes covary by at most κ²/30 of the product of the spreads (a Gaussian along the axes
//! cannot represent more), and no set is made where the chance of detection exceeds 0.25.
//!
//! *Deviations*: none with κ = 0. With κ = 0.3 the logarithm of the chance of no detection is off by at most 1 % of
//! its largest value over the map (`tests_kernel`: random flows; some 0.3 % in typical flows).

use crate::map::spec::TrajectorySpec;

/// Chance of detection above which (1 − p)^m can no longer replace a product of different factors.
const MERGE_PEAK: f64 = 0.25;
/// Largest set, as a power of two.
const MOST_LOG2: u32 = 6;

/// Releases that count as one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::map) struct Set {
    /// Their number is two to this power.
    pub log2: u32,
    /// Mean displacement since, in the grid's axes, m.
    pub s_m: [f64; 2],
    /// Variance along the grid's three axes, m².
    pub var_m2: [f64; 3],
}

/// Sums over the releases up to one, which give the moments of any run of them.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    age: f64,
    s: [f64; 2],
    ss: [f64; 3],
}

/// Makes the sets; keeps its memory between two calls.
#[derive(Clone, Debug)]
pub(in crate::map) struct Gatherer {
    /// σ², m²/s.
    var_rate: [f64; 3],
    merge: f64,
    trajectory: TrajectorySpec,
    /// Chance of detection at age 1 s in the middle, before clamping.
    peak: f64,
    sums: Vec<Sums>,
    ages: Vec<f64>,
    /// The sets, youngest first.
    pub sets: Vec<Set>,
}

impl Gatherer {
    /// `cell_m`: the cell's size along the two horizontal axes.
    pub(in crate::map) fn new(trajectory: &TrajectorySpec, cell_m: [f64; 2]) -> Self {
        let (sigmas, merge) = (trajectory.sigmas(), trajectory.merge.get());
        let peak = cell_m[0] * cell_m[1] / (std::f64::consts::TAU * sigmas[0] * sigmas[1]);
        Self {
            var_rate: sigmas.map(|s| s * s),
            merge,
            peak,
            trajectory: trajectory.clone(),
            sums: Vec::new(),
            ages: Vec::new(),
            sets: Vec::new(),
        }
    }

    /// Sets of the releases (age in s, displacement since in m), youngest first.
    pub(in crate::map) fn gather(&mut self, releases: impl Iterator<Item = (f64, [f64; 2])>) {
        self.sums.clear();
        self.ages.clear();
        self.sets.clear();
        let mut total = Sums::default();
        self.sums.push(total);
        for (age, s) in releases {
            total.age += age;
            total.s[0] += s[0];
            total.s[1] += s[1];
            total.ss[0] += s[0] * s[0];
            total.ss[1] += s[1] * s[1];
            total.ss[2] += s[0] * s[1];
            self.sums.push(total);
            self.ages.push(age);
        }
        let mut first = 0;
        let mut guess = 0;
        while first < self.ages.len() {
            // The sets grow with age: start with the size of the one before.
            let mut log2 = guess;
            let mut set = self.set(first, log2);
            while set.is_none() {
                log2 -= 1;
                set = self.set(first, log2);
            }
            while log2 < MOST_LOG2
                && let Some(larger) = self.set(first, log2 + 1)
            {
                (set, log2) = (Some(larger), log2 + 1);
            }
            self.sets.extend(set);
            guess = log2;
            first += 1 << log2;
        }
    }

    /// The 2^log2 releases from `first` as one set, if that is allowed; a single release always is.
    fn set(&self, first: usize, log2: u32) -> Option<Set> {
        let m = 1_usize << log2;
        let last = first + m - 1;
        let (oldest, youngest) = (*self.ages.get(last)?, self.ages[first]);
        let (a, b) = (&self.sums[first], &self.sums[first + m]);
        let count = m as f64;
        let mean = [0, 1].map(|k| (b.s[k] - a.s[k]) / count);
        let moment = |k: usize, product: f64| (b.ss[k] - a.ss[k]) / count - product;
        let age = (b.age - a.age) / count;
        let mut spread = [0.0; 2];
        if log2 > 0 {
            spread = [moment(0, mean[0] * mean[0]).max(0.0), moment(1, mean[1] * mean[1]).max(0.0)];
            let covariance = moment(2, mean[0] * mean[1]).abs();
            let own = [0, 1].map(|k| self.var_rate[k] * youngest);
            let k2 = self.merge * self.merge;
            let alike = self.peak / youngest <= MERGE_PEAK
                && oldest - youngest <= 0.8 * self.merge * youngest
                && spread[0] <= k2 * own[0]
                && spread[1] <= k2 * own[1]
                && covariance <= k2 / 30.0 * (own[0] * own[1]).sqrt();
            if !alike {
                return None;
            }
        }
        let strayed = self.trajectory.beside_m2(age);
        Some(Set {
            log2,
            s_m: mean,
            var_m2: [
                self.var_rate[0] * age + spread[0] + strayed,
                self.var_rate[1] * age + spread[1] + strayed,
                self.var_rate[2] * age,
            ],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::ranges::{Fraction, NonNegative, Positive};

    fn spec(sigmas: [f64; 3], merge: f64) -> TrajectorySpec {
        let [x, y, z] = sigmas.map(Positive::new);
        TrajectorySpec {
            sigma_x_m_rts: x,
            sigma_y_m_rts: y,
            sigma_z_m_rts: z,
            merge: Fraction::new(merge),
            ..TrajectorySpec::default()
        }
    }

    fn gatherer(sigmas: [f64; 3], cell_m: [f64; 2], merge: f64) -> Gatherer {
        Gatherer::new(&spec(sigmas, merge), cell_m)
    }

    #[test]
    fn an_error_of_the_flow_spreads_first_with_age_then_with_its_root() {
        let with = TrajectorySpec {
            flow_error_m_s: NonNegative::new(0.03),
            flow_error_s: Positive::new(50.0),
            ..spec([0.5, 0.5, 0.05], 0.0)
        };
        let mut g = Gatherer::new(&with, [2.5, 4.0]);
        g.gather(releases(3000, [0.2, 0.0]));
        // Young: (u' dt)^2 but for a share of dt/3T. Old: 2 u'^2 T (dt - T).
        let strayed = |age: f64| g.sets[age as usize - 1].var_m2[0] - 0.25 * age;
        assert!((strayed(2.0) / 0.0036 - 1.0).abs() < 0.02);
        assert!((strayed(3000.0) - 0.09 * 2950.0).abs() < 1e-6);
        // In the vertical there is none.
        assert!((g.sets[2999].var_m2[2] - 7.5).abs() < 1e-9);
    }

    fn releases(n: u32, v: [f64; 2]) -> impl Iterator<Item = (f64, [f64; 2])> {
        (1..=n).map(move |l| (f64::from(l), v.map(|v| v * f64::from(l))))
    }

    #[test]
    fn none_lost_none_twice() {
        for (merge, v) in [(0.0, [1.0, 0.0]), (0.3, [0.17, 0.0]), (0.3, [0.0, 0.0]), (1.0, [0.4, 0.3])] {
            let mut g = gatherer([0.5, 0.5, 0.05], [2.5, 4.0], merge);
            g.gather(releases(601, v));
            let count: usize = g.sets.iter().map(|s| 1 << s.log2).sum();
            assert_eq!(count, 601);
            if merge == 0.0 {
                assert_eq!(g.sets.len(), 601);
            }
        }
    }

    #[test]
    fn slow_flow_needs_few_sets() {
        let mut g = gatherer([0.5, 0.5, 0.05], [2.5, 4.0], 0.3);
        g.gather(releases(600, [0.17, 0.0]));
        assert!(g.sets.len() <= 60, "{}", g.sets.len());
        g.gather(releases(600, [1.0, 0.0]));
        assert!(g.sets.len() > 60, "{}", g.sets.len());
    }

    #[test]
    fn a_set_keeps_mean_and_variance() {
        let mut g = gatherer([1.0, 1.0, 0.1], [1.0, 1.0], 1.0);
        g.gather(releases(600, [0.1, 0.0]));
        let set = g.sets.iter().find(|s| s.log2 == 2).expect("a set of four");
        let first: usize = g.sets.iter().take_while(|s| *s != set).map(|s| 1 << s.log2).sum();
        let ages: Vec<f64> = (0..4).map(|k| (first + k + 1) as f64).collect();
        let mean = ages.iter().sum::<f64>() / 4.0;
        // Displacement 0.1 per second of age; four ages one apart have variance 1.25.
        assert!((set.s_m[0] - 0.1 * mean).abs() < 1e-9);
        assert!((set.var_m2[0] - (mean + 0.01 * 1.25)).abs() < 1e-6);
        assert!((set.var_m2[1] - mean).abs() < 1e-9);
    }
}
