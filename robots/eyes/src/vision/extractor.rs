//! Which pixels a colour pattern takes: the fuzzy rules as a table over the greatest of the three differences.
//!
//! *Source*: Tian et al. 2013, section 5, eq. 13 and the threshold after it (FCE).
//!
//! *Parameters*: threshold ε, `epsilon`, 80 (called δ in the text); the sets' own (`membership.rs`).
//!
//! *Deviations*: none in the result. The sets fall and rise with |x|, and Negative and Positive are the complement of
//! Zero, so min and max over the channels are both those of the channel that differs most: Δρ_F depends on max |dif|
//! alone, and a table of 256 entries is the whole extractor. With the paper's parameters it takes the colours within
//! 73 levels of the pattern in every channel, a cube: the fuzzy metric orders colours, but its threshold is a crisp
//! one.

use super::Inference;
use robots::strategy::ColourSpec;

/// The table.
#[derive(Clone, Debug, PartialEq)]
pub struct Extractor {
    rho: [f64; 256],
    taken: [bool; 256],
}

impl Extractor {
    /// The extractor with these parameters.
    pub fn new(spec: &ColourSpec) -> Self {
        let inference = Inference::new(spec);
        let rho: [f64; 256] = std::array::from_fn(|d| inference.difference([d as f64, 0.0, 0.0]));
        Self { taken: rho.map(|r| r < spec.epsilon.get()), rho }
    }

    /// Δρ_F of a pixel from a pattern, levels.
    pub fn difference(&self, pixel: [u8; 3], pattern: [u8; 3]) -> f64 {
        self.rho[greatest(pixel, pattern)]
    }

    /// Whether the pattern takes the pixel.
    #[inline]
    pub fn takes(&self, pixel: [u8; 3], pattern: [u8; 3]) -> bool {
        self.taken[greatest(pixel, pattern)]
    }

    /// The greatest difference in a channel that is still taken, levels; `None` if not even an equal colour is taken.
    pub fn reach(&self) -> Option<u8> {
        self.taken.iter().rposition(|t| *t).map(|d| d as u8)
    }
}

#[inline]
fn greatest(p: [u8; 3], q: [u8; 3]) -> usize {
    let d = [0, 1, 2].map(|k| p[k].abs_diff(q[k]));
    usize::from(d[0].max(d[1]).max(d[2]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use world::ranges::{NonNegative, Positive};

    #[test]
    fn the_papers_cube_is_73_levels_each_way() {
        let e = Extractor::new(&ColourSpec::default());
        assert_eq!(e.reach(), Some(73));
        assert!((e.rho[73] - 78.912).abs() < 1e-3 && (e.rho[74] - 80.221).abs() < 1e-3, "{} {}", e.rho[73], e.rho[74]);
        assert!(e.takes([100, 100, 100], [27, 173, 100]));
        assert!(!e.takes([100, 100, 100], [26, 100, 100]));
    }

    /// ε = ρ_M/3 is the difference of equal colours: "below" excludes them.
    #[test]
    fn a_threshold_as_low_as_the_least_difference_takes_nothing() {
        let spec = ColourSpec { rho_m: Positive::new(3.0), epsilon: Positive::new(0.5), ..ColourSpec::default() };
        assert_eq!(Extractor::new(&spec).reach(), None);
    }

    fn any_spec() -> impl Strategy<Value = ColourSpec> {
        (0.0_f64..150.0, 1.0_f64..100.0, 1.0_f64..254.0, 1.0_f64..255.0).prop_map(|(a1, more, rho, eps)| ColourSpec {
            alpha1: NonNegative::new(a1),
            alpha2: Positive::new(a1 + more),
            rho_m: Positive::new(rho),
            epsilon: Positive::new(eps),
            ..ColourSpec::default()
        })
    }

    proptest! {
        #[test]
        fn table_is_the_inference_bit_by_bit(spec in any_spec(), p: [u8; 3], q: [u8; 3]) {
            let e = Extractor::new(&spec);
            let direct = Inference::new(&spec)
                .difference([0, 1, 2].map(|k| f64::from(p[k]) - f64::from(q[k])));
            prop_assert_eq!(e.difference(p, q), direct);
            prop_assert_eq!(e.takes(p, q), direct < spec.epsilon.get());
        }
    }
}
