//! The cells in which blocked water is worked out: bed-following boxes, open or solid, with staggered faces.
//!
//! *Source*: staggered (MAC) placing of fluxes, Harlow and Welch 1965, Phys. Fluids 8, 2182; bed-following
//! coordinate s = 1 − z/b, Phillips 1957, J. Meteorol. 14, 184.
//!
//! *Parameters*: those of [`BlockageSpec`]. The cells lie between the nodes of the plume's flow grid of the same shape.
//!
//! *Deviations*: a cell is solid if its middle is inside an obstacle: obstacles that overlap are their union, a round
//! one is a staircase, and one that holds no cell's middle is not felt. Water shut in on all sides counts as solid: it stands still.

use nalgebra::Vector2;
use world::area::Area;
use world::obstacles::{Obstacle, Obstacles};

use super::spec::{BlockageSpec, MOST_CELLS};
use crate::error::PlumeError;
use crate::flow::ground::Ground;

/// Fluxes, velocities or conductances on the faces along (x), across (y) and upwards (s).
#[derive(Clone, Debug, Default)]
pub(super) struct Faces<T> {
    /// Face i (of nx + 1) of column row j, level k: (i·ny + j)·nz + k.
    pub(super) x: Vec<T>,
    /// Face j (of ny + 1): (i·(ny + 1) + j)·nz + k.
    pub(super) y: Vec<T>,
    /// Face k (of nz + 1): (i·ny + j)·(nz + 1) + k.
    pub(super) s: Vec<T>,
}

/// Where the cells are, and which are open.
#[derive(Clone, Debug)]
pub(super) struct Cells {
    /// World (east, north) of corner (0, 0), m.
    corner: Vector2<f64>,
    /// Unit vectors (east, north) along and across.
    pub(super) axes: [Vector2<f64>; 2],
    /// Sizes along and across, m.
    pub(super) d: [f64; 2],
    /// Cells along, across, upwards.
    pub(super) n: [usize; 3],
    stretch: f64,
    /// s of the faces, 0 at the bed to 1 at the surface.
    pub(super) s: Vec<f64>,
    /// Cell (i·ny + j)·nz + k is open.
    pub(super) open: Vec<bool>,
    /// Which of the obstacles hold the middle of a cell.
    pub(super) felt: Vec<bool>,
}

impl Cells {
    pub(super) fn new(
        spec: &BlockageSpec,
        area: &Area,
        ground: &Ground,
        obstacles: &Obstacles,
    ) -> Result<Self, PlumeError> {
        spec.check()?;
        // As the plume's flow grid places its nodes.
        let extent = [area.length_m, area.width_m].map(|e| e + 2.0 * spec.margin_m.get());
        let count = extent.map(|e| (e / spec.cell_m.get()).ceil().max(1.0));
        let nz = spec.levels as usize - 1;
        let cells = count[0] * count[1] * nz as f64;
        if cells > MOST_CELLS {
            let problem = format!(
                "{} m makes {} x {} x {nz} = {cells:.3e} cells over {:.0} x {:.0} m; at most {MOST_CELLS:e} fit: take larger cells, fewer levels or a smaller margin_m",
                spec.cell_m.get(),
                count[0],
                count[1],
                extent[0],
                extent[1]
            );
            let field = "water.blockage.cell_m".to_owned();
            return Err(PlumeError::Invalid { field, problem });
        }
        let a = spec.stretch.get();
        let s = (0..=nz).map(|k| {
            let xi = k as f64 / nz as f64;
            (1.0 - a) * xi + a * xi * xi
        });
        let turned = area.axis.turned(std::f64::consts::FRAC_PI_2);
        let mut this = Self {
            corner: area.world(Vector2::new(-extent[0] / 2.0, -extent[1] / 2.0)),
            axes: [area.axis.unit(), turned.unit()],
            d: [0, 1].map(|d| extent[d] / count[d]),
            n: [count[0] as usize, count[1] as usize, nz],
            stretch: a,
            s: s.collect(),
            open: vec![true; cells as usize],
            felt: Vec::new(),
        };
        for obstacle in &obstacles.0 {
            let felt = this.fill(obstacle, ground);
            this.felt.push(felt);
        }
        this.shut_in();
        if !this.open.contains(&true) {
            let problem = format!(
                "no water that could flow is left in cells of {:.2} x {:.2} m: obstacles fill the area; make them smaller or leave blockage out",
                this.d[0], this.d[1]
            );
            let field = "water.blockage".to_owned();
            return Err(PlumeError::Invalid { field, problem });
        }
        Ok(this)
    }

    /// Makes solid what an obstacle fills; whether that is anything.
    fn fill(&mut self, obstacle: &Obstacle, ground: &Ground) -> bool {
        let mut felt = false;
        let (low, high) = obstacle.bounds();
        let corners = [
            (low.x, low.y),
            (low.x, high.y),
            (high.x, low.y),
            (high.x, high.y),
        ]
        .map(|(x, y)| self.in_cells(Vector2::new(x, y)));
        let range = |d: usize| {
            let of = corners.map(|c| c[d].clamp(0.0, self.n[d] as f64));
            let least = of.iter().fold(f64::INFINITY, |a, b| a.min(*b));
            let most = of.iter().fold(0.0_f64, |a, b| a.max(*b));
            least as usize..most.ceil() as usize
        };
        for i in range(0) {
            for j in range(1) {
                let p = self.place(i as f64 + 0.5, j as f64 + 0.5);
                let bed = ground.floor(p).z;
                for k in 0..self.n[2] {
                    let z = bed * (1.0 - self.middle(k));
                    let at = (i * self.n[1] + j) * self.n[2] + k;
                    let near = z >= low.z && z <= high.z;
                    if near && (self.open[at] || !felt) && obstacle.contains(&p.push(z)) {
                        (self.open[at], felt) = (false, true);
                    }
                }
            }
        }
        felt
    }

    /// Makes solid what no way through open cells joins to the sides.
    fn shut_in(&mut self) {
        let [nx, ny, nz] = self.n;
        let mut reached = vec![false; self.open.len()];
        let mut todo = Vec::new();
        for i in 0..nx {
            for j in 0..ny {
                if i == 0 || j == 0 || i + 1 == nx || j + 1 == ny {
                    todo.extend((0..nz).map(|k| [i, j, k]));
                }
            }
        }
        while let Some([i, j, k]) = todo.pop() {
            let at = (i * ny + j) * nz + k;
            if !self.open[at] || reached[at] {
                continue;
            }
            reached[at] = true;
            let here = [i, j, k];
            for d in 0..3 {
                let mut next = here;
                if here[d] > 0 {
                    next[d] = here[d] - 1;
                    todo.push(next);
                }
                if here[d] + 1 < self.n[d] {
                    next[d] = here[d] + 1;
                    todo.push(next);
                }
            }
        }
        self.open = reached;
    }

    /// World (east, north) of a place counted in cells.
    pub(super) fn place(&self, a: f64, b: f64) -> Vector2<f64> {
        self.corner + self.axes[0] * (a * self.d[0]) + self.axes[1] * (b * self.d[1])
    }

    /// A place (east, north) counted in cells along and across.
    pub(super) fn in_cells(&self, p: Vector2<f64>) -> [f64; 2] {
        let q = p - self.corner;
        [0, 1].map(|d| q.dot(&self.axes[d]) / self.d[d])
    }

    /// s in the middle of level k.
    pub(super) fn middle(&self, k: usize) -> f64 {
        0.5 * (self.s[k] + self.s[k + 1])
    }

    /// Level of an s from 0 to 1.
    #[inline]
    pub(super) fn level(&self, s: f64) -> usize {
        let (a, nz) = (self.stretch, self.n[2]);
        let b = 1.0 - a;
        let xi = 2.0 * s / (b + (b * b + 4.0 * a * s).sqrt());
        ((xi * nz as f64) as usize).min(nz - 1)
    }

    /// Open cells.
    pub(super) fn open_count(&self) -> usize {
        self.open.iter().filter(|o| **o).count()
    }

    /// Cells on both sides of an x face, a y face, an s face; none beyond the cells.
    pub(super) fn beside(&self, d: usize, [i, j, k]: [usize; 3]) -> [Option<usize>; 2] {
        let at = [i, j, k];
        let cell = |c: [usize; 3]| (c[0] * self.n[1] + c[1]) * self.n[2] + c[2];
        let below = (at[d] > 0).then(|| {
            let mut c = at;
            c[d] -= 1;
            cell(c)
        });
        [below, (at[d] < self.n[d]).then(|| cell(at))]
    }

    /// Number of a face across direction d.
    #[inline]
    pub(super) fn face(&self, d: usize, [i, j, k]: [usize; 3]) -> usize {
        let [_, ny, nz] = self.n;
        match d {
            0 => (i * ny + j) * nz + k,
            1 => (i * (ny + 1) + j) * nz + k,
            _ => (i * ny + j) * (nz + 1) + k,
        }
    }

    /// Calls `f` with every face across direction d.
    pub(super) fn each_face(&self, d: usize, mut f: impl FnMut([usize; 3])) {
        let n = [0, 1, 2].map(|e| self.n[e] + usize::from(e == d));
        for i in 0..n[0] {
            for j in 0..n[1] {
                for k in 0..n[2] {
                    f([i, j, k]);
                }
            }
        }
    }

    /// Whether water may go through a face: open on its sides within the cells, and neither bed nor surface.
    pub(super) fn passes(&self, d: usize, face: [usize; 3]) -> bool {
        let sides = self.beside(d, face);
        let inner = d < 2 || sides.iter().all(Option::is_some);
        inner && sides.iter().flatten().all(|c| self.open[*c])
    }
}
