//! A horizontal section of the water round a gantry: its axes, and the concentration on it.

use crate::charts::contours::Grid;
use crate::charts::panel::range_of;
use crate::results::{GantryTrack, RunReport};
use nalgebra::{Vector2, Vector3};
use world::fields::Concentration;
use world::math;

/// Room left round the track, cm.
const ROOM_CM: f64 = 8.0;
/// The sides of the area are shown if they are at most this far from the track, cm.
const NEAR_CM: f64 = 40.0;
/// Additional width beyond the right side, for the scale bar, cm.
const BESIDE_CM: f64 = 7.0;
/// Levels of C/C0, half a decade apart: from less than a 12-bit probe can resolve to a tenth of the source.
const LEVELS: [f64; 7] = [1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 3e-2, 1e-1];

/// Axes of the figures of a flume: centimetres down-stream of the source and to the left of it, looking down-stream.
pub(super) struct Axes {
    origin: Vector2<f64>,
    down: Vector2<f64>,
    /// Ranges of both axes, which contain the track and the source, cm.
    pub(super) x: [f64; 2],
    pub(super) y: [f64; 2],
    /// The sides of the area, if it lies along the stream, cm.
    pub(super) sides: Option<[f64; 2]>,
}

impl Axes {
    /// `None` for a gantry that appears in no frame.
    pub(super) fn from_track(run: &RunReport<'_>, track: &GantryTrack) -> Option<Self> {
        let first = Vector2::from(track.rows.first()?.head);
        let last = Vector2::from(track.rows.last()?.head);
        let source = (run.sources.iter().map(|s| s.position.xy()))
            .min_by(|a, b| (a - last).norm().total_cmp(&(b - last).norm()));
        let mut axes = Self {
            origin: source.unwrap_or(first),
            down: -Vector2::from(track.forward),
            x: [0.0, 1.0],
            y: [0.0, 1.0],
            sides: None,
        };
        let heads = || track.rows.iter().map(|r| axes.cm(r.head));
        let tips = || (track.tips.iter()).map(|p| axes.cm([p[0], p[1]]));
        let along = |k: usize| {
            let all = heads().chain(tips()).chain([[0.0, 0.0]]);
            range_of(all.map(|p| p[k]), 0.0).map(|r| [r[0] - ROOM_CM, r[1] + ROOM_CM])
        };
        let (x, mut y) = (along(0)?, along(1)?);
        let corners = run.area.corners().map(|p| axes.cm([p.x, p.y]));
        let straight = corners.iter().all(|p| corners.iter().filter(|q| (q[1] - p[1]).abs() < 0.1).count() == 2);
        let sides = range_of(corners.iter().map(|p| p[1]), 0.0).filter(|_| straight);
        if let Some([right, left]) = sides {
            if (y[0] - right).abs() < NEAR_CM {
                y[0] = right - BESIDE_CM;
            }
            if (left - y[1]).abs() < NEAR_CM {
                y[1] = left + 2.0;
            }
        }
        (axes.x, axes.y, axes.sides) = (x, y, sides);
        Some(axes)
    }

    /// A place in the world in coordinates of the axes, cm.
    pub(super) fn cm(&self, p: [f64; 2]) -> [f64; 2] {
        let d = (Vector2::from(p) - self.origin) * 100.0;
        [d.dot(&self.down), self.down.perp(&d)]
    }

    /// A place on the axes in world coordinates, m.
    fn world(&self, x: f64, y: f64) -> Vector2<f64> {
        let left = Vector2::new(-self.down.y, self.down.x);
        self.origin + (self.down * x + left * y) / 100.0
    }
}

/// Concentration on a section, with the levels to draw.
pub(super) struct Section {
    /// Natural logarithm of the concentration.
    grid: Grid,
    /// Levels from thin to dense, as shown.
    pub(super) levels: Vec<f64>,
    /// Their unit.
    pub(super) unit: &'static str,
    scale: f64,
}

impl Section {
    /// The section at height `z` (ENU, m) over the range of the axes, with this number of nodes; relative to the
    /// effluent if that is known.
    pub(super) fn sample(
        axes: &Axes,
        z: f64,
        n: [usize; 2],
        effluent_kg_m3: Option<f64>,
        dye: &dyn Concentration,
    ) -> Option<Self> {
        let at = |x: f64, y: f64| {
            let inside = axes.sides.is_none_or(|s| (s[0]..=s[1]).contains(&y));
            let p = axes.world(x, y);
            let c = if inside { dye.concentration(&Vector3::new(p.x, p.y, z)) } else { 0.0 };
            math::ln(c.max(f64::MIN_POSITIVE))
        };
        let mut grid = Grid::evaluate(axes.x, axes.y, n, at);
        let densest = grid.values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let (scale, unit) = match effluent_kg_m3 {
            Some(c0) => (c0, "C/C0"),
            // A tenth of the densest value is the top of the scale.
            None => (crate::charts::panel::power_of_ten(crate::charts::panel::decade(math::exp(densest))), "kg/m³"),
        };
        let lowest = math::ln(scale * LEVELS[0]);
        if densest < lowest {
            return None;
        }
        // Clean water is set to one value, so that lines between nodes follow the slope of the chemical.
        for v in &mut grid.values {
            *v = v.max(lowest - 4.0);
        }
        let shown = if effluent_kg_m3.is_some() { 1.0 } else { scale };
        Some(Self { grid, levels: LEVELS.map(|l| l * shown).to_vec(), unit, scale: scale / shown })
    }

    /// The level for the edge of the plume where only one level is drawn: a thousandth of the source.
    pub(super) fn edge(&self) -> f64 {
        self.levels[2]
    }

    /// Rings round the regions above a level, in coordinates of the axes.
    pub(super) fn rings(&self, level: f64) -> Vec<Vec<[f64; 2]>> {
        self.grid.rings(math::ln(level * self.scale))
    }
}
