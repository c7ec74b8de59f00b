//! The chance that dye from any place was met, not only from the middle of a cell.
//!
//! *Source*: as `kernel`: Wang & Pang, eqs. 1 and 2.
//!
//! *Parameters*: as `kernel`.
//!
//! *Deviations*: as `kernel`; the cut at seven standard deviations is one of the horizontal distance and one of the
//! vertical. Eight places are weighed at a time, so that the compiler makes vector instructions of the arithmetic; a
//! set of releases that reaches none of the eight is left out. The exponential is a polynomial of degree 6 to the
//! 128th power, within 1e-13 of the function.

use super::releases::Set;
use super::terms::LEAST;
use crate::handoff::BeliefGrid;

/// Standard deviations at which a Gaussian is cut off.
pub(super) const REACH: f64 = 7.0;
/// √(2π).
pub(super) const ROOT_TAU: f64 = 2.506_628_274_631_000_7;
/// Places that are weighed at a time.
const LANES: usize = 8;
/// Half the square of the reach.
const EDGE: f64 = 0.5 * REACH * REACH;

/// A set of releases.
#[derive(Clone, Copy, Debug)]
struct Cloud {
    /// From where its dye has come to the vehicle, in the grid's own axes, m.
    from: [f64; 2],
    /// Half the reciprocals of the variances, 1/m².
    half: [f64; 3],
    /// Chance in the middle of the set, without the vertical.
    peak: f64,
    /// Factor of the vertical at the vehicle's own height.
    layer: f64,
    log2: u32,
}

/// All sets of releases, for a vehicle at one place.
#[derive(Clone, Debug)]
pub(in crate::map) struct ReleaseSets {
    mu: f64,
    /// The vehicle's height and its mirror images in the map's lower and upper edge, m; none in a map of the plane.
    heights: Option<[f64; 3]>,
    clouds: Vec<Cloud>,
}

impl ReleaseSets {
    /// For a vehicle at `at` (the grid's own axes, m) and a chance `mu` of detecting dye that is there.
    /// Dye is met within a cell of `meets_m`.
    pub(super) fn new(grid: &BeliefGrid, meets_m: [f64; 3], mu: f64, at: [f64; 3], sets: &[Set]) -> Self {
        let high = grid.cell_m[2] * grid.n[2] as f64;
        let clouds = sets.iter().map(|set| {
            let top = [0, 1, 2].map(|a| meets_m[a] / (ROOT_TAU * set.var_m2[a].sqrt()));
            Cloud {
                from: [at[0] - set.s_m[0], at[1] - set.s_m[1]],
                half: set.var_m2.map(|var| 0.5 / var),
                peak: top[0] * top[1],
                layer: top[2],
                log2: set.log2,
            }
        });
        Self { mu, heights: (grid.n[2] > 1).then_some([at[2], -at[2], 2.0 * high - at[2]]), clouds: clouds.collect() }
    }

    /// γ, the chance of no detection, for a source at each of the places (the grid's own axes, m).
    pub(in crate::map) fn not_detecting(&self, places: &[[f64; 3]], out: &mut Vec<f64>) {
        out.clear();
        for places in places.chunks(LANES) {
            let axis = |a: usize| {
                // The last place fills the lanes that are left.
                let place = |lane: usize| places[lane.min(places.len() - 1)][a];
                std::array::from_fn(place)
            };
            let gamma = self.block(&[axis(0), axis(1), axis(2)]);
            out.extend_from_slice(&gamma[..places.len()]);
        }
    }

    #[expect(clippy::needless_range_loop, reason = "one index into many arrays is what becomes vector code")]
    fn block(&self, [x, y, z]: &[[f64; LANES]; 3]) -> [f64; LANES] {
        let mut gamma = [1.0; LANES];
        for cloud in &self.clouds {
            let mut away = [0.0; LANES];
            for i in 0..LANES {
                let d = [cloud.from[0] - x[i], cloud.from[1] - y[i]];
                away[i] = d[0] * d[0] * cloud.half[0] + d[1] * d[1] * cloud.half[1];
            }
            let mut any = false;
            for i in 0..LANES {
                any |= away[i] <= EDGE;
            }
            if !any {
                continue;
            }
            let mut p = [0.0; LANES];
            for i in 0..LANES {
                p[i] = cloud.peak * falling(away[i]);
            }
            if let Some(heights) = &self.heights {
                let mut images = [0.0; LANES];
                for height in heights {
                    for i in 0..LANES {
                        let d = height - z[i];
                        images[i] += falling(d * d * cloud.half[2]);
                    }
                }
                for i in 0..LANES {
                    p[i] *= cloud.layer * images[i];
                }
            }
            let mut missed = [0.0; LANES];
            for i in 0..LANES {
                missed[i] = 1.0 - self.mu * if p[i] < 1.0 { p[i] } else { 1.0 };
            }
            for _ in 0..cloud.log2 {
                for i in 0..LANES {
                    missed[i] *= missed[i];
                }
            }
            for i in 0..LANES {
                let g = gamma[i] * missed[i];
                gamma[i] = if g > LEAST { g } else { LEAST };
            }
        }
        gamma
    }
}

/// exp(−x) for x from 0 to the edge, zero beyond.
#[inline(always)]
fn falling(x: f64) -> f64 {
    let r = x * (-1.0 / 128.0);
    let (r2, inside) = (r * r, x <= EDGE);
    let high = 1.0 / 24.0 + r * (1.0 / 120.0) + r2 * (1.0 / 720.0);
    let mut q = 1.0 + r + r2 * (0.5 + r * (1.0 / 6.0)) + r2 * r2 * high;
    for _ in 0..7 {
        q *= q;
    }
    if inside { q } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::testing::grid;
    use proptest::prelude::*;
    use world::math;

    #[test]
    fn polynomial_is_close_to_the_exponential() {
        for k in 0..=24_500 {
            let x = f64::from(k) / 1000.0;
            let error = falling(x) - math::exp(-x);
            assert!(error.abs() < 1e-13, "{x}: {error:e}");
        }
        assert_eq!([EDGE * 1.001, 1e3, 1e9].map(falling), [0.0; 3]);
    }

    /// γ as eqs. 1 and 2 have it, one place and one set at a time.
    fn by_hand(grid: &BeliefGrid, mu: f64, at: [f64; 3], sets: &[Set], place: [f64; 3]) -> f64 {
        let high = grid.cell_m[2] * grid.n[2] as f64;
        let one = |axis: usize, from: f64, set: &Set| {
            let (d, var) = (from - place[axis], set.var_m2[axis]);
            grid.cell_m[axis] / (ROOT_TAU * var.sqrt()) * math::exp(-0.5 * d * d / var)
        };
        let mut gamma = 1.0;
        for set in sets {
            let mut p = one(0, at[0] - set.s_m[0], set) * one(1, at[1] - set.s_m[1], set);
            if grid.n[2] > 1 {
                let heights = [at[2], -at[2], 2.0 * high - at[2]];
                p *= heights.iter().map(|z| one(2, *z, set)).sum::<f64>();
            }
            gamma *= math::powf(1.0 - mu * p.min(1.0), f64::from(1_u32 << set.log2));
        }
        gamma
    }

    proptest! {
        #![proptest_config(crate::handoff::testing::fixed(96))]

        #[test]
        fn eight_at_a_time_are_as_one_at_a_time(
            layers in 1_usize..6, mu in 0.05..0.99f64, at in proptest::array::uniform3(0.0..1.0f64),
            places in proptest::collection::vec(proptest::array::uniform3(0.0..1.0f64), 1..30),
            sets in proptest::collection::vec(
                (0_u32..7, proptest::array::uniform2(-40.0..40.0f64), proptest::array::uniform3(0.2..150.0f64)),
                0..20),
        ) {
            let grid = grid([40, 25, layers]);
            let size = [100.0, 100.0, grid.cell_m[2] * layers as f64];
            let scaled = |p: [f64; 3]| [0, 1, 2].map(|a| p[a] * size[a]);
            let sets: Vec<_> = sets
                .into_iter()
                .map(|(log2, s_m, var_m2)| Set { log2, s_m, var_m2 })
                .collect();
            let places: Vec<_> = places.into_iter().map(scaled).collect();
            let mut gamma = vec![7.0; 3];
            ReleaseSets::new(&grid, grid.cell_m, mu, scaled(at), &sets).not_detecting(&places, &mut gamma);
            prop_assert_eq!(gamma.len(), places.len());
            for (place, gamma) in places.iter().zip(&gamma) {
                let exact = by_hand(&grid, mu, scaled(at), &sets, *place);
                // What lies beyond the cut: 2.3e-11 of the peak of each release.
                let tops = sets.iter().map(|s| {
                    let m = f64::from(1_u32 << s.log2);
                    let axes = if layers > 1 { 0..3 } else { 0..2 };
                    let top = axes.map(|a| grid.cell_m[a] / (ROOT_TAU * s.var_m2[a].sqrt()));
                    2.4e-11 * m * top.product::<f64>() * if layers > 1 { 6.0 } else { 1.0 }
                });
                let most = tops.sum::<f64>() + 1e-11;
                prop_assert!((gamma - exact).abs() <= most, "{gamma} {exact} {most}");
            }
        }
    }
}
