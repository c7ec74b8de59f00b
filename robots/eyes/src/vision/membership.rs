//! Membership of a colour difference in Negative, Zero and Positive, and of a result in Matched and Unmatched.
//!
//! *Source*: Tian et al. 2013, section 5, eq. 7-11, Fig. 10.
//!
//! *Parameters*: knees of the input sets α₁, `alpha1`, 35, and α₂, `alpha2`, 200; width of Matched ρ_M, `rho_m`, 20,
//! from which ρ_U = 255 − ρ_M; all in levels of 8 bits.
//!
//! *Deviations*: misprints are corrected so that the sets are those of Fig. 10a: eq. 7's last interval ends at 255
//! (printed −255); the falling side of eq. 8 is (α₂ − x)/(α₂ − α₁) (printed (x − α₁)/(α₂ − α₁), which rises).

use robots::strategy::ColourSpec;

/// Greatest level.
const TOP: f64 = 255.0;

/// The input sets over a difference of levels, −255 to 255.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Differences {
    alpha1: f64,
    alpha2: f64,
}

impl Differences {
    /// With the knees of the parameters.
    pub fn new(spec: &ColourSpec) -> Self {
        Self { alpha1: spec.alpha1.get(), alpha2: spec.alpha2.get() }
    }

    /// μ_N, eq. 7.
    pub fn negative(&self, x: f64) -> f64 {
        self.positive(-x)
    }

    /// μ_Z, eq. 8.
    pub fn zero(&self, x: f64) -> f64 {
        ((self.alpha2 - x.abs()) / (self.alpha2 - self.alpha1)).clamp(0.0, 1.0)
    }

    /// μ_P, eq. 9.
    pub fn positive(&self, x: f64) -> f64 {
        ((x - self.alpha1) / (self.alpha2 - self.alpha1)).clamp(0.0, 1.0)
    }
}

/// The output sets over 0 to 255, and what remains of them when a rule's weight cuts them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs {
    rho_m: f64,
}

impl Outputs {
    /// With the width of the parameters.
    pub fn new(spec: &ColourSpec) -> Self {
        Self { rho_m: spec.rho_m.get() }
    }

    /// ρ_U.
    pub fn rho_u(&self) -> f64 {
        TOP - self.rho_m
    }

    /// μ_M, eq. 10.
    pub fn matched(&self, x: f64) -> f64 {
        ((self.rho_m - x) / self.rho_m).max(0.0)
    }

    /// μ_U, eq. 11: the mirror image of μ_M, since ρ_M + ρ_U = 255.
    pub fn unmatched(&self, x: f64) -> f64 {
        self.matched(TOP - x)
    }

    /// Places, in order, between which both sets, cut at `w_m` and `w_u`, are straight lines.
    pub fn knees(&self, w_m: f64, w_u: f64) -> [f64; 6] {
        let mut at = [0.0, self.rho_m * (1.0 - w_m), self.rho_m, self.rho_u(), self.rho_u() + w_u * self.rho_m, TOP];
        at.sort_by(f64::total_cmp);
        at
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn input_sets_have_the_papers_knees() {
        let mu = Differences::new(&ColourSpec::default());
        for (x, zero) in [(0.0, 1.0), (34.0, 1.0), (35.0, 1.0), (117.5, 0.5), (200.0, 0.0), (255.0, 0.0)] {
            assert_eq!(mu.zero(x), zero, "{x}");
            assert_eq!(mu.zero(-x), zero, "{x}");
            assert_eq!(mu.positive(x), 1.0 - zero, "{x}");
            assert_eq!(mu.negative(-x), 1.0 - zero, "{x}");
            assert_eq!(mu.negative(x.max(1.0)), 0.0);
            assert_eq!(mu.positive(-x), 0.0);
        }
    }

    #[test]
    fn output_sets_fall_from_the_ends() {
        let mu = Outputs::new(&ColourSpec::default());
        assert_eq!([0.0, 5.0, 20.0, 128.0].map(|x| mu.matched(x)), [1.0, 0.75, 0.0, 0.0]);
        assert_eq!([255.0, 250.0, 235.0, 128.0].map(|x| mu.unmatched(x)), [1.0, 0.75, 0.0, 0.0]);
        assert_eq!(mu.knees(0.25, 0.5), [0.0, 15.0, 20.0, 235.0, 245.0, 255.0]);
    }
}
