//! Buoyancy of a released volume by how far it is mixed, molecule by molecule.
//!
//! *Source*: conservation of mass; a sheet that stirring makes thinner and thinner until its molecules diffuse out of
//! it (Ranz 1979, AIChE J. 25, 41; Villermaux 2019, Annu. Rev. Fluid Mech. 51, 245). In the sheet's own time τ, the
//! integral of D/s² dt over its thickness s, a slab of unit thickness spreads as by plain diffusion.
//!
//! *Parameters*: none.
//!
//! *Deviations*: one sheet stands for the whole thread: neighbouring sheets do not overlap, which late in the mixing
//! they do. One diffusivity for all that is dissolved.

use world::math;

/// Buoyant acceleration of the released volume, m/s² upwards: g·D(ρ0 − ρ)/ρ0 at a dilution D, averaged over its mass.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Unmixed, and then at times exp([`Self::FIRST`] + n·[`Self::STEP`]) of the sheet.
    unmixed: f64,
    lifts: Vec<f64>,
}

/// What a litre lifts by its dilution: at dilutions exp(n·[`Self::STEP`]).
pub(super) struct LiftByDilution(pub(super) Vec<f64>);

impl LiftByDilution {
    const STEP: f64 = 0.05;
    /// Up to a dilution of a million.
    const COUNT: usize = 278;

    /// From what tells the lift at a dilution of at least 1.
    pub(super) fn of(lift: impl Fn(f64) -> f64) -> Self {
        Self((0..Self::COUNT).map(|n| lift(math::exp(n as f64 * Self::STEP))).collect())
    }

    fn at(&self, dilution: f64) -> f64 {
        let last = self.0.len() - 1;
        let at = (math::ln(dilution.max(1.0)) / Self::STEP).min(last as f64);
        let n = (at as usize).min(last - 1);
        self.0[n] + (self.0[n + 1] - self.0[n]) * (at - n as f64)
    }
}

impl Curve {
    /// ln τ of the first entry, at which a per cent of the sheet's mass has left it.
    const FIRST: f64 = -8.0;
    const STEP: f64 = 0.1;
    const COUNT: usize = 201;
    /// Sheets older than this, in their own time, are mixed.
    pub(crate) const MIXED: f64 = 1.6e5;

    /// That of a release whose lift does not depend on what it is mixed with.
    pub(crate) fn constant(lift: f64) -> Self {
        Self { unmixed: lift, lifts: Vec::new() }
    }

    /// That of a release of which each part lifts as its dilution says.
    pub(super) fn of_a_sheet(by_dilution: &LiftByDilution) -> Self {
        let lift = |n: usize| mean_over_sheet(by_dilution, math::exp(Self::FIRST + n as f64 * Self::STEP));
        Self { unmixed: by_dilution.at(1.0), lifts: (0..Self::COUNT).map(lift).collect() }
    }

    /// Whether it depends on mixing at all.
    pub(crate) fn changes(&self) -> bool {
        !self.lifts.is_empty()
    }

    /// At a time of the sheet.
    pub fn at(&self, mixed: f64) -> f64 {
        let (Some(first), Some(last)) = (self.lifts.first(), self.lifts.last()) else {
            return self.unmixed;
        };
        let at = (math::ln(mixed.max(0.0)) - Self::FIRST) / Self::STEP;
        if at <= 0.0 {
            // At first only the two surfaces of the sheet mix, to a depth of √τ.
            return self.unmixed + (first - self.unmixed) * (mixed.max(0.0) / math::exp(Self::FIRST)).sqrt();
        }
        let n = at as usize;
        match self.lifts.get(n + 1) {
            Some(high) => self.lifts[n] + (high - self.lifts[n]) * (at - n as f64),
            None => *last,
        }
    }
}

/// Mean of the lift over the mass of a slab of unit thickness that has diffused for a time.
fn mean_over_sheet(by_dilution: &LiftByDilution, mixed: f64) -> f64 {
    // Half of it, by the midpoint rule. What lies farther out is less than a millionth.
    const CELLS: usize = 400;
    let spread = 2.0 * mixed.sqrt();
    let cell = (0.5 + 4.0 * spread) / CELLS as f64;
    let (mut mass, mut sum) = (0.0, 0.0);
    for n in 0..CELLS {
        let x = (n as f64 + 0.5) * cell;
        let c = 0.5 * (math::erf((x + 0.5) / spread) - math::erf((x - 0.5) / spread));
        if c > 0.0 {
            mass += c;
            sum += c * by_dilution.at(1.0 / c);
        }
    }
    sum / mass
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A lift in proportion to the concentration is the mean of c over the mass, ∫c² dx.
    #[test]
    fn the_mean_over_a_sheet_is_that_of_its_profile() {
        let curve = Curve::of_a_sheet(&LiftByDilution::of(|dilution| 1.0 / dilution));
        for mixed in [1e-4, 1e-2, 0.3, 10.0, 1e3] {
            // Self-convolution of the slab's profile at its middle: a slab spread for twice the time, a triangle wide.
            let spread = f64::sqrt(8.0 * mixed);
            let want = math::erf(1.0 / spread)
                - spread / std::f64::consts::PI.sqrt() * (1.0 - math::exp(-1.0 / (spread * spread)));
            let got = curve.at(mixed);
            assert!((got / want - 1.0).abs() < 0.01, "{mixed}: {got} {want}");
        }
        assert_eq!(curve.at(0.0), 1.0);
        assert!(Curve::of_a_sheet(&LiftByDilution::of(|_| 0.7)).at(3.0) - 0.7 < 1e-12);
    }

    /// A sheet in a strain: finite differences of the advection and diffusion of its concentration, to a hundredth of its
    /// mass, beside its own time.
    #[test]
    fn a_strained_sheet_diffuses_in_its_own_time() {
        // Strain 0.5/s, thickness 1 mm, diffusivity 1.2e-9 m²/s: mixed at some ln(Pe)/2γ, 6 s.
        let (strain, s0, diffusivity) = (0.5, 1e-3, 1.2e-9);
        let lift = |dilution: f64| 1.0 / dilution - 0.3 / dilution.sqrt();
        let curve = Curve::of_a_sheet(&LiftByDilution::of(lift));
        // The half of the sheet, c in cells; the coordinate moves with the strain, x = ξ·exp(−γt).
        let cells = 1200;
        let cell = 3e-3 / f64::from(cells);
        let mut c: Vec<f64> =
            (0..cells).map(|n| if (f64::from(n) + 0.5) * cell < 0.5 * s0 { 1.0 } else { 0.0 }).collect();
        let (mut t, mut mixed) = (0.0, 0.0);
        let mut compared = 0;
        while t < 7.0 {
            let d = diffusivity * math::exp(2.0 * strain * t);
            let dt = (0.2 * cell * cell / d).min(0.01);
            let flux: Vec<f64> = c.windows(2).map(|p| d * (p[0] - p[1]) / cell).collect();
            for (n, f) in flux.iter().enumerate() {
                c[n] -= dt * f / cell;
                c[n + 1] += dt * f / cell;
            }
            let before = t;
            t += dt;
            mixed += d * dt / (s0 * s0);
            for at in [2.0, 4.0, 5.0, 6.0] {
                if before < at && t >= at {
                    let mass: f64 = c.iter().sum();
                    let felt: f64 = c.iter().filter(|c| **c > 0.0).map(|c| c * lift(1.0 / c)).sum();
                    let (got, want) = (curve.at(mixed), felt / mass);
                    assert!((got - want).abs() < 0.01, "{at} s: {got} {want}");
                    compared += 1;
                }
            }
        }
        assert_eq!(compared, 4);
    }
}
