//! The cells in which blocked water is computed: bed-following boxes, open or solid, with staggered faces.
//!
//! *Source*: staggered (MAC) placing of fluxes, Harlow and Welch 1965, Phys. Fluids 8, 2182; bed-following
//! coordinate s = 1 − z/b, Phillips 1957, J. Meteorol. 14, 184.
//!
//! *Parameters*: those of [`BlockageSpec`]. The cells lie between the nodes of the plume's flow grid of the same shape.
//!
//! *Deviations*: a cell is solid if its centre is inside an obstacle. Obstacles that overlap form their union, and a
//! round one becomes a staircase. A wall thinner than the cells closes the faces between the centres that it separates.
//! An obstacle that does neither, or a pile or pipe thinner than half a cell, is not felt. Water enclosed on all sides
//! counts as solid, because it stands still. Water and dye share this geometry: the part of an open cell that an
//! obstacle fills is open to both. In a channel between side walls, the outermost faces across are closed.

use nalgebra::{Vector2, Vector3};
use world::area::Area;
use world::obstacles::{Obstacle, Obstacles};

use super::spec::{BlockageSpec, MOST_CELLS};
use crate::error::PlumeError;
use crate::flow::ground::Ground;

/// Fluxes, velocities or conductances on the faces along, across and upwards; [`Cells::face`] numbers them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Faces<T>(pub(super) [Vec<T>; 3]);

/// The next cell along a direction, and the face to it.
pub(crate) fn beyond(d: usize, mut cell: [usize; 3]) -> [usize; 3] {
    cell[d] += 1;
    cell
}

/// Position of the cells, and which cells and faces are open.
#[derive(Clone, Debug)]
pub(crate) struct Cells {
    /// World (east, north) of corner (0, 0), m.
    corner: Vector2<f64>,
    /// Unit vectors (east, north) along and across.
    pub(crate) axes: [Vector2<f64>; 2],
    /// Sizes along and across, m.
    pub(crate) d: [f64; 2],
    /// Number of cells along, across and upwards.
    pub(crate) n: [usize; 3],
    stretch: f64,
    /// s of the faces, 0 at the bed to 1 at the surface.
    pub(crate) s: Vec<f64>,
    /// Cell (i·ny + j)·nz + k is open.
    pub(crate) open: Vec<bool>,
    // Faces that let water and dye pass.
    pass: Faces<bool>,
    /// For each obstacle, whether it contains the centre of a cell or separates two.
    pub(super) felt: Vec<bool>,
}

impl Cells {
    pub(crate) fn new(
        spec: &BlockageSpec,
        area: &Area,
        ground: &Ground,
        obstacles: &Obstacles,
        walled: bool,
    ) -> Result<Self, PlumeError> {
        spec.check()?;
        if walled && spec.margin_m.get() > 0.0 {
            let problem = format!(
                "must be 0 in an OpenChannel, whose walls are the sides of the area, got {}",
                spec.margin_m.get()
            );
            return Err(PlumeError::new("water.blockage.margin_m", problem));
        }
        // The nodes of the plume's flow grid are the corners.
        let shape = spec.grid_shape();
        let extent = shape.extent_m(area);
        let count = shape.nodes(area).map(|n| n - 1.0);
        let nz = shape.levels - 1;
        let cells = count.iter().product::<f64>();
        // NaN counts as too many.
        if !(cells <= MOST_CELLS) {
            let problem = format!(
                "{} m makes {} x {} x {nz} = {cells:.3e} cells over {:.0} x {:.0} m; at most {MOST_CELLS:e} fit: take larger cells, fewer levels or a smaller margin_m",
                spec.cell_m.get(),
                count[0],
                count[1],
                extent[0],
                extent[1]
            );
            return Err(PlumeError::new("water.blockage.cell_m", problem));
        }
        let turned = area.axis.turned(std::f64::consts::FRAC_PI_2);
        let mut this = Self {
            corner: area.world(Vector2::new(-extent[0] / 2.0, -extent[1] / 2.0)),
            axes: [area.axis.unit(), turned.unit()],
            d: [0, 1].map(|d| extent[d] / count[d]),
            n: [count[0] as usize, count[1] as usize, nz],
            stretch: shape.stretch,
            s: (0..=nz).map(|k| shape.level(k)).collect(),
            open: vec![true; cells as usize],
            pass: Faces::default(),
            felt: Vec::new(),
        };
        this.pass = this.within(walled);
        for obstacle in &obstacles.0 {
            let felt = this.fill(obstacle, ground);
            this.felt.push(felt);
        }
        for (n, obstacle) in obstacles.0.iter().enumerate() {
            this.felt[n] |= this.part(obstacle, ground);
        }
        this.shut_in();
        if !this.open.contains(&true) {
            let problem = format!(
                "no water that could flow is left in cells of {:.2} x {:.2} m: obstacles fill the area; make them smaller or leave blockage out",
                this.d[0], this.d[1]
            );
            return Err(PlumeError::new("water.blockage", problem));
        }
        Ok(this)
    }

    /// All faces except bed, surface and, between walls, the sides across.
    fn within(&self, walled: bool) -> Faces<bool> {
        let [nx, ny, nz] = self.n;
        let numbers = [(nx + 1) * ny * nz, nx * (ny + 1) * nz, nx * ny * (nz + 1)];
        let [along, mut across, mut up] = numbers.map(|n| vec![true; n]);
        for column in up.chunks_exact_mut(nz + 1) {
            (column[0], column[nz]) = (false, false);
        }
        if walled {
            for row in across.chunks_exact_mut((ny + 1) * nz) {
                row[..nz].fill(false);
                row[ny * nz..].fill(false);
            }
        }
        Faces([along, across, up])
    }

    /// The columns over which an obstacle stands, plus `beside` columns on each side.
    fn under(&self, obstacle: &Obstacle, beside: f64) -> [std::ops::Range<usize>; 2] {
        let (low, high) = obstacle.bounds();
        let corners = [(low.x, low.y), (low.x, high.y), (high.x, low.y), (high.x, high.y)]
            .map(|(x, y)| self.in_cells(Vector2::new(x, y)));
        [0, 1].map(|d| {
            let least = corners.iter().fold(f64::INFINITY, |a, c| a.min(c[d])) - beside;
            let most = corners.iter().fold(0.0_f64, |a, c| a.max(c[d])) + beside;
            let [least, most] = [least, most.ceil()].map(|v| v.clamp(0.0, self.n[d] as f64));
            least as usize..most as usize
        })
    }

    /// Makes the cells solid that an obstacle fills; returns whether there are any.
    fn fill(&mut self, obstacle: &Obstacle, ground: &Ground) -> bool {
        let mut felt = false;
        let (low, high) = obstacle.bounds();
        let [along, across] = self.under(obstacle, 0.0);
        for i in along {
            for j in across.clone() {
                let p = self.place(i as f64 + 0.5, j as f64 + 0.5);
                let bed = ground.floor(p).z;
                for k in 0..self.n[2] {
                    let z = bed * (1.0 - self.middle(k));
                    let at = self.cell([i, j, k]);
                    let near = z >= low.z && z <= high.z;
                    if near && (self.open[at] || !felt) && obstacle.contains(&p.push(z)) {
                        (self.open[at], felt) = (false, true);
                    }
                }
            }
        }
        felt
    }

    /// Closes the faces between open centres that an obstacle separates; returns whether there are any.
    fn part(&mut self, obstacle: &Obstacle, ground: &Ground) -> bool {
        let mut felt = false;
        let (low, high) = obstacle.bounds();
        if self.is_rod(low, high, ground) {
            return felt;
        }
        let [along, across] = self.under(obstacle, 1.0);
        for i in along {
            for j in across.clone() {
                // This column and the next along and across.
                let columns = [[i, j], [i + 1, j], [i, j + 1]].map(|[i, j]| {
                    let p = self.place(i as f64 + 0.5, j as f64 + 0.5);
                    (p, ground.floor(p).z)
                });
                for k in 0..self.n[2] {
                    let from = self.centre(columns[0], k);
                    for d in 0..3 {
                        let next = beyond(d, [i, j, k]);
                        let both = next[d] < self.n[d] && self.open[self.cell([i, j, k])] && self.open[self.cell(next)];
                        if !both {
                            continue;
                        }
                        let to = self.centre(columns[[1, 2, 0][d]], next[2]);
                        let (least, most) = (from.inf(&to), from.sup(&to));
                        if (0..3).any(|e| most[e] < low[e] || least[e] > high[e]) {
                            continue;
                        }
                        let way = to - from;
                        if obstacle.ray(&from, &way, way.norm()).is_some() {
                            let face = self.face(d, next);
                            self.pass.0[d][face] = false;
                            felt = true;
                        }
                    }
                }
            }
        }
        felt
    }

    /// Whether a box is thinner than half a cell in two directions: a pile or a pipe. It separates centres but leaves
    /// most of a face open. A wall is thin in one direction.
    fn is_rod(&self, low: Vector3<f64>, high: Vector3<f64>, ground: &Ground) -> bool {
        let size = high - low;
        let wide = |d: usize| {
            let axis = self.axes[d].abs();
            size.xy().dot(&axis) / self.d[d]
        };
        let depth = -ground.floor((low.xy() + high.xy()) / 2.0).z;
        let s = (1.0 + (low.z + high.z) / 2.0 / depth).clamp(0.0, 1.0);
        let k = self.level(s);
        let thick = (self.s[k + 1] - self.s[k]) * depth;
        let cells = [wide(0), wide(1), size.z / thick];
        cells.iter().filter(|c| **c < 0.5).count() >= 2
    }

    /// Centre of a cell of a column: its place and bed.
    fn centre(&self, (p, bed): (Vector2<f64>, f64), k: usize) -> Vector3<f64> {
        p.push(bed * (1.0 - self.middle(k)))
    }

    /// Makes solid what no way through open cells connects to the sides, and closes the faces of solid cells.
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
        // Between the walls of a channel, only its ends are open.
        todo.retain(|c| {
            (0..2).any(|d| {
                let next = beyond(d, *c);
                (c[d] == 0 && self.passes(d, *c)) || (next[d] == self.n[d] && self.passes(d, next))
            })
        });
        while let Some(here) = todo.pop() {
            let at = self.cell(here);
            if !self.open[at] || reached[at] {
                continue;
            }
            reached[at] = true;
            for d in 0..3 {
                let mut next = here;
                if here[d] > 0 && self.passes(d, here) {
                    next[d] = here[d] - 1;
                    todo.push(next);
                }
                next[d] = here[d] + 1;
                if next[d] < self.n[d] && self.passes(d, next) {
                    todo.push(next);
                }
            }
        }
        self.open = reached;
        let mut pass = std::mem::take(&mut self.pass);
        for d in 0..3 {
            self.each_face(d, |f| {
                if !self.beside(d, f).iter().flatten().all(|c| self.open[*c]) {
                    pass.0[d][self.face(d, f)] = false;
                }
            });
        }
        self.pass = pass;
    }

    /// Number of a cell.
    #[inline]
    pub(crate) fn cell(&self, [i, j, k]: [usize; 3]) -> usize {
        (i * self.n[1] + j) * self.n[2] + k
    }

    /// World place (east, north) for coordinates in cells.
    pub(crate) fn place(&self, a: f64, b: f64) -> Vector2<f64> {
        self.corner + self.axes[0] * (a * self.d[0]) + self.axes[1] * (b * self.d[1])
    }

    /// Coordinates of a place (east, north) in cells along and across.
    pub(crate) fn in_cells(&self, p: Vector2<f64>) -> [f64; 2] {
        let q = p - self.corner;
        [0, 1].map(|d| q.dot(&self.axes[d]) / self.d[d])
    }

    /// s at the centre of level k.
    pub(super) fn middle(&self, k: usize) -> f64 {
        0.5 * (self.s[k] + self.s[k + 1])
    }

    /// Level that contains an s from 0 to 1.
    #[inline]
    pub(crate) fn level(&self, s: f64) -> usize {
        let (a, nz) = (self.stretch, self.n[2]);
        let b = 1.0 - a;
        let xi = 2.0 * s / (b + (b * b + 4.0 * a * s).sqrt());
        ((xi * nz as f64) as usize).min(nz - 1)
    }

    /// Number of open cells.
    pub(super) fn open_count(&self) -> usize {
        self.open.iter().filter(|o| **o).count()
    }

    /// The cells on both sides of an x face, a y face or an s face; `None` outside the cells.
    pub(super) fn beside(&self, d: usize, [i, j, k]: [usize; 3]) -> [Option<usize>; 2] {
        let at = [i, j, k];
        let below = (at[d] > 0).then(|| {
            let mut c = at;
            c[d] -= 1;
            self.cell(c)
        });
        [below, (at[d] < self.n[d]).then(|| self.cell(at))]
    }

    /// Number of a face across direction d.
    #[inline]
    pub(crate) fn face(&self, d: usize, [i, j, k]: [usize; 3]) -> usize {
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

    /// Whether water can pass a face: open on its sides, not separated by a thin wall, and neither bed nor surface.
    #[inline]
    pub(crate) fn passes(&self, d: usize, face: [usize; 3]) -> bool {
        self.pass.0[d][self.face(d, face)]
    }
}
