//! The water over a source, as buoyant elements meet it: speed, dissipation and stratification by height.
//!
//! *Source*: the water itself; see [`Flow::dissipation`].
//!
//! *Parameters*: [`LEVELS`].
//!
//! *Deviations*: the column over the source stands for the water wherever the thread is. It rises near its source, over
//! distances in which the water changes little.

use super::element::Around;
use nalgebra::Vector3;
use world::fields::{Flow, Mixing};
use world::units::GRAVITY_M_S2;

/// Cells from bed to surface.
const LEVELS: usize = 64;

/// A column of water.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Profile {
    bed_m: f64,
    levels: Vec<Around>,
}

impl Profile {
    /// The column over a place at a time, from the bed (m, negative) to the surface.
    pub(crate) fn over(flow: &dyn Flow, p_W: Vector3<f64>, bed_m: f64, t_s: f64) -> Self {
        let cell = -bed_m / LEVELS as f64;
        let heights: Vec<f64> = (0..=LEVELS).map(|k| bed_m + k as f64 * cell).collect();
        let mut out = vec![(Vector3::zeros(), Mixing::default()); heights.len()];
        flow.column(p_W.xy(), &heights, t_s, &mut out);
        let at = |z: f64| Vector3::new(p_W.x, p_W.y, z);
        let density = |z: f64| flow.density(&at(z.clamp(bed_m, 0.0)), t_s);
        let levels = heights.iter().zip(&out).map(|(z, (u, _))| {
            let (low, high) = ((z - cell).max(bed_m), (z + cell).min(0.0));
            let slope = (density(high) - density(low)) / (high - low);
            Around {
                speed_m_s: u.xy().norm(),
                dissipation_m2_s3: flow.dissipation(&at(*z), t_s),
                n2_per_s2: -GRAVITY_M_S2 * slope / density(*z),
                largest_m: -0.5 * bed_m,
            }
        });
        Self { bed_m, levels: levels.collect() }
    }

    /// Still, even water of a depth.
    pub(crate) fn still(bed_m: f64) -> Self {
        Self { bed_m, levels: vec![Around::default(); LEVELS + 1] }
    }

    /// At a height (m, negative).
    pub(crate) fn at(&self, z_m: f64) -> Around {
        let at = (1.0 - z_m / self.bed_m).clamp(0.0, 1.0) * LEVELS as f64;
        let n = (at as usize).min(LEVELS - 1);
        let (low, high, part) = (&self.levels[n], &self.levels[n + 1], at - n as f64);
        let on = |low: f64, high: f64| low + part * (high - low);
        Around {
            speed_m_s: on(low.speed_m_s, high.speed_m_s),
            dissipation_m2_s3: on(low.dissipation_m2_s3, high.dissipation_m2_s3),
            n2_per_s2: on(low.n2_per_s2, high.n2_per_s2),
            largest_m: low.largest_m,
        }
    }
}
