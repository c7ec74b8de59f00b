//! How different two colours are by the fuzzy rules: from three channel differences to one number Δρ_F.
//!
//! *Source*: Tian et al. 2013, section 5, the two rules, eq. 12 (weights) and 13 (centroid).
//!
//! *Parameters*: those of the sets (`membership.rs`).
//!
//! *Deviations*: none. The paper's "are Zero" joins the channels by min, its "is Negative or Positive" by max; a rule
//! cuts its output set at its weight. The envelope's centroid is computed exactly: the envelope is a chain of
//! straight lines, over each of which the trapezium rule and Simpson's rule integrate it and its first moment without
//! error.

use super::{Differences, Outputs};
use robots::strategy::ColourSpec;

/// The two rules with their sets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inference {
    differences: Differences,
    outputs: Outputs,
}

impl Inference {
    /// The rules with the sets of these parameters.
    pub fn new(spec: &ColourSpec) -> Self {
        Self { differences: Differences::new(spec), outputs: Outputs::new(spec) }
    }

    /// Weights of Matched and Unmatched (eq. 12) for differences in red, green and blue (eq. 6).
    pub fn weights(&self, difference: [f64; 3]) -> (f64, f64) {
        let mu = &self.differences;
        let zero = difference.map(|d| mu.zero(d));
        let other = difference.map(|d| mu.negative(d).max(mu.positive(d)));
        (zero.into_iter().fold(1.0, f64::min), other.into_iter().fold(0.0, f64::max))
    }

    /// Δρ_F (eq. 13) for differences in red, green and blue, levels.
    pub fn difference(&self, difference: [f64; 3]) -> f64 {
        let (w_m, w_u) = self.weights(difference);
        self.centroid(w_m, w_u)
    }

    /// Centroid of the envelope of both output sets, cut at their rules' weights.
    pub fn centroid(&self, w_m: f64, w_u: f64) -> f64 {
        let matched = |x: f64| self.outputs.matched(x).min(w_m);
        let unmatched = |x: f64| self.outputs.unmatched(x).min(w_u);
        let envelope = |x: f64| matched(x).max(unmatched(x));
        let (mut area, mut moment) = (0.0, 0.0);
        let mut add = |a: f64, b: f64| {
            let (fa, fb) = (envelope(a), envelope(b));
            let middle = 0.5 * (a + b);
            area += 0.5 * (b - a) * (fa + fb);
            moment += (b - a) / 6.0 * (a * fa + 4.0 * middle * (0.5 * (fa + fb)) + b * fb);
        };
        for pair in self.outputs.knees(w_m, w_u).windows(2) {
            let [a, b] = [pair[0], pair[1]];
            // Wide sets overlap: the envelope bends where they cross.
            let (da, db) = (matched(a) - unmatched(a), matched(b) - unmatched(b));
            if da * db < 0.0 {
                let cross = a + (b - a) * da / (da - db);
                add(a, cross);
                add(cross, b);
            } else {
                add(a, b);
            }
        }
        assert!(area > 0.0, "neither rule fires (weights {w_m}, {w_u}): the input sets must cover all differences");
        moment / area
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use world::ranges::Positive;

    fn papers() -> Inference {
        Inference::new(&ColourSpec::default())
    }

    fn near(got: f64, want: f64) {
        assert!((got - want).abs() < 1e-9, "{got} against {want}");
    }

    /// Equal colours: the whole triangle Matched, centroid ρ_M/3. Colours far apart: the whole of Unmatched. Half Zero,
    /// half Positive: both triangles cut at 1/2, so the middle of the range.
    #[test]
    fn ends_are_the_centroids_of_the_triangles_and_half_way_is_the_middle() {
        for (d, want) in [
            ([0.0; 3], 20.0 / 3.0),
            ([35.0, -35.0, 10.0], 20.0 / 3.0),
            ([0.0, 117.5, 0.0], 127.5),
            ([0.0, 0.0, 200.0], 255.0 - 20.0 / 3.0),
            ([-255.0, 0.0, 0.0], 255.0 - 20.0 / 3.0),
        ] {
            near(papers().difference(d), want);
        }
    }

    /// 68 levels: w_m = 0.8, w_u = 0.2. A triangle of base ρ and height 1 cut at w has the area ρ(w − w²/2) and,
    /// about its high end, the first moment ρ²(w(1 − w)²/2 + w²/2 − w³/3). Matched: 20·0.48 = 9.6 and 400·(0.016 +
    /// 0.32 − 0.1706667) = 66.1333; Unmatched: 20·0.18 = 3.6 and 400·(0.064 + 0.02 − 0.0026667) = 32.5333 from 255.
    #[test]
    fn one_value_by_hand() {
        let want = (66.133_333_333 + 255.0 * 3.6 - 32.533_333_333) / 13.2;
        let got = papers().difference([68.0, 0.0, -68.0]);
        assert!((got - want).abs() < 1e-6, "{got} against {want}");
    }

    /// Min for Zero, max for the others: the channel that differs most decides alone.
    #[test]
    fn weights_by_hand() {
        let (w_m, w_u) = papers().weights([0.0, -68.0, 117.5]);
        near(w_m, 0.5);
        near(w_u, 0.5);
    }

    /// The paper's two colour patterns of its Fig. 11 differ by (50, 30, 12), which its own parameters count as
    /// alike: the second would have been taken with the first. So the figure was not made with the printed
    /// parameters.
    #[test]
    fn the_papers_second_pattern_would_have_been_taken_with_the_first() {
        let d = [156.0 - 106.0, 136.0 - 106.0, 243.0 - 231.0];
        let rho = papers().difference(d);
        assert!(rho < 80.0, "{rho}");
        assert!((rho - 42.3).abs() < 0.1, "{rho}");
    }

    proptest! {
        #[test]
        fn never_falls_as_a_difference_grows(
            a in 0.0_f64..=255.0, more in 0.0_f64..=100.0, rho in 1.0_f64..254.0,
        ) {
            let spec = ColourSpec { rho_m: Positive::new(rho), ..ColourSpec::default() };
            let f = Inference::new(&spec);
            let b = (a + more).min(255.0);
            prop_assert!(f.difference([a, 0.0, 0.0]) <= f.difference([0.0, -b, 0.0]) + 1e-9);
        }

        /// Against a sum over 25 500 slices (midpoints: error below a slice's width).
        #[test]
        fn centroid_is_exact_for_overlapping_sets_too(
            w_m in 0.01_f64..=1.0, w_u in 0.0_f64..=1.0, rho in 1.0_f64..254.0,
        ) {
            let spec = ColourSpec { rho_m: Positive::new(rho), ..ColourSpec::default() };
            let f = Inference::new(&spec);
            let (mut area, mut moment) = (0.0, 0.0);
            for k in 0..25_500 {
                let x = (f64::from(k) + 0.5) * 0.01;
                let mu = f.outputs.matched(x).min(w_m).max(f.outputs.unmatched(x).min(w_u));
                area += mu;
                moment += mu * x;
            }
            prop_assert!((f.centroid(w_m, w_u) - moment / area).abs() < 0.02);
        }
    }
}
