//! The plume on the map: mass of the chemical above each square metre of bed. Also levels for any quantity on a grid.

use crate::charts::contours::Grid;
use crate::charts::panel::{Panel, decade, power_of_ten};
use rheotaxis::frame::PlumeFrame;
use std::f64::consts::TAU;
use world::math;

/// Levels shown, half a decade apart.
const LEVELS: usize = 6;
/// Grid spacing, px.
const CELL_PX: f64 = 2.0;
/// Smallest spread drawn, px. The snapshot holds only some of the filaments, and this fills the space between them.
const LEAST_PX: f64 = 3.0;
/// Where the kernel ends, in spreads; 1.1 % of its mass lies beyond.
const REACH: f64 = 3.0;

/// Depth-integrated concentration and its levels, mg/m²; or another quantity on a grid.
pub(super) struct PlumeLoad {
    pub(super) grid: Grid,
    pub(super) levels: Vec<f64>,
}

impl PlumeLoad {
    /// `None` if there is nothing to show.
    pub(super) fn from_plume(plume: &PlumeFrame, panel: &Panel) -> Option<Self> {
        if plume.points.is_empty() {
            return None;
        }
        let per_px = 1.0 / panel.px_per_unit();
        let cell = CELL_PX * per_px;
        let n = [(panel.width / CELL_PX).ceil() as usize + 1, (panel.height / CELL_PX).ceil() as usize + 1];
        let mut grid = Grid { n, origin: [panel.x[0], panel.y[0]], step: [cell, cell], values: vec![0.0; n[0] * n[1]] };
        for &[x, y, _, size, mass, _] in &plume.points {
            let sd = size.max(LEAST_PX * per_px);
            let load = mass * 1e6 / (TAU * sd * sd);
            grid.add([x, y], sd, load);
        }
        Self::on(grid)
    }

    /// The levels of a quantity on a grid; `None` if there is nothing to show.
    pub(super) fn on(grid: Grid) -> Option<Self> {
        let max = grid.values.iter().fold(0.0, |m: f64, v| m.max(*v));
        if !(max > 0.0 && max.is_finite()) {
            return None;
        }
        // The densest spot beside the source would dominate the scale. So the top level is one that a tenth of the
        // plume still exceeds.
        let mut loads: Vec<f64> = grid.values.iter().copied().filter(|v| *v > max * 1e-4).collect();
        loads.sort_by(f64::total_cmp);
        let top = half_decade_below(loads[loads.len() * 9 / 10]);
        let levels = (0..LEVELS).map(|k| half_decade(top - (LEVELS - 1 - k) as i32)).collect();
        Some(Self { grid, levels })
    }
}

/// 10^(n/2), with the half step as 3.
fn half_decade(n: i32) -> f64 {
    let whole = power_of_ten(n.div_euclid(2));
    if n.rem_euclid(2) == 1 { 3.0 * whole } else { whole }
}

/// Largest n whose [`half_decade`] does not exceed `v`.
fn half_decade_below(v: f64) -> i32 {
    let n = 2 * decade(v);
    if half_decade(n + 1) <= v { n + 1 } else { n }
}

impl Grid {
    fn add(&mut self, p: [f64; 2], sd: f64, peak: f64) {
        let span = |k: usize| {
            let lo = ((p[k] - REACH * sd - self.origin[k]) / self.step[k]).ceil().max(0.0);
            let hi = ((p[k] + REACH * sd - self.origin[k]) / self.step[k]).floor();
            let end = if hi < 0.0 { 0 } else { (hi as usize + 1).min(self.n[k]) };
            (lo as usize).min(end)..end
        };
        let (columns, rows) = (span(0), span(1));
        let fall = |d: f64| math::exp(-0.5 * d * d / (sd * sd));
        for j in rows {
            let row = peak * fall(self.origin[1] + j as f64 * self.step[1] - p[1]);
            for i in columns.clone() {
                let dx = self.origin[0] + i as f64 * self.step[0] - p[0];
                self.values[j * self.n[0] + i] += row * fall(dx);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panel() -> Panel {
        Panel { left: 0.0, top: 0.0, width: 400.0, height: 400.0, x: [-100.0, 100.0], y: [-100.0, 100.0] }
    }

    #[test]
    fn load_holds_the_mass_of_all_filaments() {
        let plume = PlumeFrame {
            t_s: 0.0,
            total: 20,
            // Two shown, each for ten of a gram.
            points: vec![[0.0, 0.0, -5.0, 8.0, 1e-2, 10.0]; 2],
            ..PlumeFrame::default()
        };
        let load = PlumeLoad::from_plume(&plume, &panel()).unwrap();
        let g = &load.grid;
        let mg: f64 = g.values.iter().sum::<f64>() * g.step[0] * g.step[1];
        // 20 filaments of 1 g; 1.1 % of a Gaussian lies beyond three spreads.
        assert!((mg / 2e4 - 1.0).abs() < 0.012, "{mg} mg");
        assert_eq!(load.levels.len(), LEVELS);
        assert!(load.levels.is_sorted());
        let max = g.values.iter().fold(0.0, |m: f64, v| m.max(*v));
        assert!(load.levels[LEVELS - 1] < max && load.levels[0] > max / 1e4);
    }

    #[test]
    fn nothing_to_show_is_none() {
        assert!(PlumeLoad::from_plume(&PlumeFrame::default(), &panel()).is_none());
        let away =
            PlumeFrame { t_s: 0.0, total: 1, points: vec![[1e6, 0.0, 0.0, 1.0, 1.0, 1.0]], ..PlumeFrame::default() };
        assert!(PlumeLoad::from_plume(&away, &panel()).is_none());
    }
}
