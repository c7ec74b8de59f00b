//! Resolution and extent of the grid on which the plume sees the water.
//!
//! *Source*: none.
//!
//! *Parameters*: [`GridShape`].
//!
//! *Deviations*: none.

use world::area::Area;

/// Most levels that interfaces ask for.
const MOST_LEVELS: usize = 64;
/// Most nodes that waves and interfaces ask for; they need a quarter of a gigabyte.
const MOST_NODES: f64 = 4e6;

/// Resolution and extent of the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridShape {
    /// Wanted horizontal spacing, m; reduced to fit the extent, never enlarged.
    pub cell_m: f64,
    /// Nodes from bed to surface, at least 2.
    pub levels: usize,
    /// 0 spaces the levels evenly; 0.9 puts ten times as many near the bed.
    pub stretch: f64,
    /// Reach beyond the operating area on every side, m.
    pub margin_m: f64,
}

/// The shortest lengths and times over which a current changes.
#[derive(Clone, Debug, PartialEq)]
pub struct CurrentScales {
    /// Length of the shortest wave that turns it, m; infinite without waves.
    pub shortest_m: f64,
    /// Shortest period of these waves, s; infinite without waves.
    pub shortest_s: f64,
    /// The interfaces between layers.
    pub interfaces: Vec<InterfaceScale>,
}

/// Where an interface is, and over which height the current changes in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InterfaceScale {
    /// Mean depth, m.
    pub depth_m: f64,
    /// Thickness, m.
    pub thickness_m: f64,
}

impl Default for CurrentScales {
    fn default() -> Self {
        Self { shortest_m: f64::INFINITY, shortest_s: f64::INFINITY, interfaces: Vec::new() }
    }
}

impl Default for GridShape {
    fn default() -> Self {
        Self { cell_m: 20.0, levels: 24, stretch: 0.8, margin_m: 50.0 }
    }
}

impl GridShape {
    /// Cells that a wave needs for its length, and renewals for its period: linear between them, it keeps 98 % of its
    /// height.
    pub const CELLS_OF_WAVE: f64 = 12.0;

    /// The default grid. In water less than 100 m wide it is scaled: cells of a sixth of the width, a margin of an
    /// eighth.
    pub fn fitting(area: &Area) -> Self {
        let usual = Self::default();
        if area.width_m >= 2.0 * usual.margin_m {
            return usual;
        }
        Self { cell_m: area.width_m / 6.0, margin_m: area.width_m / 8.0, ..usual }
    }

    /// Number of nodes along, across and upwards. These are `f64`, so that a number that is too large can be reported.
    pub fn nodes(&self, area: &Area) -> [f64; 3] {
        let [along, across] = self.extent_m(area).map(|e| (e / self.cell_m).ceil().max(1.0) + 1.0);
        [along, across, self.levels as f64]
    }

    /// Length and width with the margin, m.
    pub(crate) fn extent_m(&self, area: &Area) -> [f64; 2] {
        [area.length_m, area.width_m].map(|e| e + 2.0 * self.margin_m)
    }

    /// Height of level `k` above the bed, as a part of the depth.
    pub(crate) fn level(&self, k: usize) -> f64 {
        let xi = k as f64 / (self.levels - 1) as f64;
        (1.0 - self.stretch) * xi + self.stretch * xi * xi
    }

    /// Distance between two levels at a height above the bed, m.
    pub fn spacing_m(&self, height_m: f64, depth_m: f64) -> f64 {
        let (a, s) = (self.stretch, (height_m / depth_m).clamp(0.0, 1.0));
        // ds/dξ at s, from s = (1 − a)ξ + aξ².
        let b = 1.0 - a;
        depth_m * (b * b + 4.0 * a * s).sqrt() / (self.levels - 1) as f64
    }

    /// So fine, if the grid does not become too large, that it shows these currents' waves and interfaces.
    #[must_use]
    pub fn resolving(mut self, scales: &CurrentScales, area: &Area, depth_m: f64) -> Self {
        for face in scales.interfaces.iter().filter(|f| f.depth_m < depth_m) {
            let gap_m = self.spacing_m(depth_m - face.depth_m, depth_m);
            let wanted = 1.0 + ((self.levels - 1) as f64 * gap_m / face.thickness_m).ceil();
            self.levels = self.levels.max(wanted.min(MOST_LEVELS as f64) as usize);
        }
        let wanted_m = scales.shortest_m / Self::CELLS_OF_WAVE;
        while self.cell_m > wanted_m {
            let finer = Self { cell_m: wanted_m.max(0.9 * self.cell_m), ..self };
            if finer.nodes(area).iter().product::<f64>() > MOST_NODES {
                break;
            }
            self = finer;
        }
        self
    }
}
