//! The flow laid out for the plume: velocity and diffusivity summed once at the nodes of a
//! bed-following grid, so that thousands of filaments each pay one trilinear look-up.
//!
//! *Source*: terrain-following ("sigma") coordinate, Phillips 1957, J. Meteorol. 14, 184; interpolation by
//! the tensor product of linear ones.
//!
//! *Parameters*: [`GridShape`]: `cell_m` horizontal spacing (m), `levels` nodes from bed to surface,
//! `stretch` (0 even, towards 1 denser at the bed), `margin_m` beyond the area (m).
//!
//! *Layout*: axes along (i) and across (j, to the right of) the area's axis, k from bed to surface;
//! node (i, j, k) is `data[(i·ny + j)·nz + k] = [u_east, u_north, w_up, K_z]`, f32. Height above the bed
//! as a part of the depth, s = (z − b)/(−b), is s(ξ) = (1 − a)ξ + aξ² with ξ = k/(nz − 1); its inverse is
//! a square root, so no search is needed. Within a cell everything is linear in s, that is in z, and K_z
//! is piecewise linear with the gradient the well-mixed drift wants.
//!
//! *Deviations*: outside the grid the value at the nearest edge holds. In time the values stand still
//! between two refreshes: call [`FlowGrid::refresh`] at fixed times, for the middle of the span to come.

use nalgebra::{Vector2, Vector3};
use world::area::Area;
use world::fields::{Flow, Mixing};
use world::terrain::Terrain;

/// How fine the grid is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridShape {
    /// Wanted horizontal spacing, m; made to fit the extent, never coarser.
    pub cell_m: f64,
    /// Nodes from bed to surface, at least 2.
    pub levels: usize,
    /// 0 spaces the levels evenly; 0.9 puts ten times as many near the bed.
    pub stretch: f64,
    /// Reach beyond the operating area on every side, m.
    pub margin_m: f64,
}

impl Default for GridShape {
    fn default() -> Self {
        Self {
            cell_m: 20.0,
            levels: 24,
            stretch: 0.8,
            margin_m: 50.0,
        }
    }
}

/// Flow and diffusivities at the grid's nodes at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct FlowGrid {
    /// World (east, north) of node (0, 0), m.
    pub origin: [f32; 2],
    /// Unit vector (east, north) of growing i.
    pub along: [f32; 2],
    /// Unit vector (east, north) of growing j.
    pub across: [f32; 2],
    /// Spacing along and across, m.
    pub spacing: [f32; 2],
    /// Nodes: nx along, ny across, nz upwards.
    pub dims: [usize; 3],
    /// The vertical map's a, see above.
    pub stretch: f32,
    /// s of each level, 0 at the bed to 1 at the surface.
    pub levels: Vec<f32>,
    /// `[east, north, up velocity (m/s), K_z (m²/s)]` at node (i·ny + j)·nz + k.
    pub data: Vec<[f32; 4]>,
    /// Bed height (m, negative) at column i·ny + j.
    pub bed: Vec<f32>,
    /// Horizontal diffusivity (m²/s) at column i·ny + j, taken at mid-depth.
    pub k_h: Vec<f32>,
    /// Time the values hold for, s.
    pub t_s: f64,
}

/// What a filament asks for at its place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GridSample {
    /// Velocity, ENU, m/s.
    pub velocity: [f32; 3],
    /// Vertical diffusivity, m²/s.
    pub k_z: f32,
    /// Its vertical gradient, m/s.
    pub dk_dz: f32,
    /// Horizontal diffusivity, m²/s.
    pub k_h: f32,
    /// Height of the bed below, m (negative).
    pub bed_z: f32,
}

impl FlowGrid {
    /// A grid of still water over the area and its margin; fill it with [`FlowGrid::refresh`].
    ///
    /// # Panics
    /// If the shape has fewer than two levels, no positive cell, or a stretch outside [0, 1): slips of code.
    #[must_use]
    pub fn new(area: &Area, terrain: &Terrain, shape: GridShape) -> Self {
        assert!(
            shape.levels >= 2 && shape.cell_m > 0.0 && (0.0..1.0).contains(&shape.stretch),
            "a flow grid needs levels >= 2, cell_m > 0 and stretch in [0, 1), got {shape:?}"
        );
        let extent = [area.length_m, area.width_m].map(|e| e + 2.0 * shape.margin_m);
        let n = extent.map(|e| (e / shape.cell_m).ceil().max(1.0) as usize + 1);
        let spacing = [0, 1].map(|d| extent[d] / (n[d] - 1) as f64);
        let corner = Vector2::new(-extent[0] / 2.0, -extent[1] / 2.0);
        let at = |i: usize, j: usize| {
            area.world(corner + Vector2::new(i as f64 * spacing[0], j as f64 * spacing[1]))
        };
        let mut bed = Vec::with_capacity(n[0] * n[1]);
        for i in 0..n[0] {
            for j in 0..n[1] {
                let p = at(i, j);
                bed.push(terrain.bed_z(p.x, p.y) as f32);
            }
        }
        let a = area.axis.unit();
        let r = area.axis.turned(std::f64::consts::FRAC_PI_2).unit();
        let o = at(0, 0);
        let nz = shape.levels;
        let levels = (0..nz).map(|k| {
            let xi = k as f64 / (nz - 1) as f64;
            ((1.0 - shape.stretch) * xi + shape.stretch * xi * xi) as f32
        });
        Self {
            origin: [o.x as f32, o.y as f32],
            along: [a.x as f32, a.y as f32],
            across: [r.x as f32, r.y as f32],
            spacing: spacing.map(|v| v as f32),
            dims: [n[0], n[1], nz],
            stretch: shape.stretch as f32,
            levels: levels.collect(),
            data: vec![[0.0; 4]; n[0] * n[1] * nz],
            k_h: vec![0.0; bed.len()],
            bed,
            t_s: 0.0,
        }
    }

    /// World position of a node, m.
    #[must_use]
    pub fn node(&self, i: usize, j: usize, k: usize) -> Vector3<f64> {
        let (di, dj) = (
            i as f64 * f64::from(self.spacing[0]),
            j as f64 * f64::from(self.spacing[1]),
        );
        let xy = |d: usize| {
            f64::from(self.origin[d])
                + di * f64::from(self.along[d])
                + dj * f64::from(self.across[d])
        };
        let b = f64::from(self.bed[i * self.dims[1] + j]);
        Vector3::new(xy(0), xy(1), b * (1.0 - f64::from(self.levels[k])))
    }

    /// Asks the flow again at every node, for time `t_s` (the flow must have been advanced there).
    pub fn refresh<F: Flow + ?Sized>(&mut self, flow: &F, t_s: f64) {
        self.refresh_columns(t_s, |p, heights, out| {
            for (z, node) in heights.iter().zip(out) {
                let p = Vector3::new(p.x, p.y, *z);
                *node = (flow.velocity(&p, t_s), flow.mixing(&p, t_s));
            }
        });
    }

    /// The same, one column at a time: the closure gets (east, north), heights from the bed up and where to write.
    pub fn refresh_columns(
        &mut self,
        t_s: f64,
        mut ask: impl FnMut(Vector2<f64>, &[f64], &mut [(Vector3<f64>, Mixing)]),
    ) {
        let [nx, ny, nz] = self.dims;
        let mut heights = vec![0.0; nz];
        let mut out = vec![(Vector3::zeros(), Mixing::default()); nz];
        for i in 0..nx {
            for j in 0..ny {
                let column = i * ny + j;
                for (k, z) in heights.iter_mut().enumerate() {
                    *z = f64::from(self.bed[column]) * (1.0 - f64::from(self.levels[k]));
                }
                ask(self.node(i, j, 0).xy(), &heights, &mut out);
                let nodes = &mut self.data[column * nz..(column + 1) * nz];
                for (node, (u, m)) in nodes.iter_mut().zip(&out) {
                    *node = [u.x as f32, u.y as f32, u.z as f32, m.k_z_m2_s as f32];
                }
                self.k_h[column] = out[nz / 2].1.k_h_m2_s as f32;
            }
        }
        self.t_s = t_s;
    }

    /// Trilinear values at a world point, m; the point is brought inside the grid first.
    #[inline]
    #[must_use]
    pub fn at(&self, x: f32, y: f32, z: f32) -> GridSample {
        let [nx, ny, nz] = self.dims;
        let (dx, dy) = (x - self.origin[0], y - self.origin[1]);
        let (i, fi) = split(
            (dx * self.along[0] + dy * self.along[1]) / self.spacing[0],
            nx,
        );
        let (j, fj) = split(
            (dx * self.across[0] + dy * self.across[1]) / self.spacing[1],
            ny,
        );
        let column = i * ny + j;
        let weights = [
            (1.0 - fi) * (1.0 - fj),
            (1.0 - fi) * fj,
            fi * (1.0 - fj),
            fi * fj,
        ];
        let of = [column, column + 1, column + ny, column + ny + 1];
        let (mut bed, mut k_h) = (0.0, 0.0);
        for c in 0..4 {
            bed += weights[c] * self.bed[of[c]];
            k_h += weights[c] * self.k_h[of[c]];
        }
        let s = (1.0 - z / bed).clamp(0.0, 1.0);
        let (k, _) = split(self.level_of(s) * (nz - 1) as f32, nz);
        let (s0, s1) = (self.levels[k], self.levels[k + 1]);
        // Rounding of the square root may name the neighbouring level; the clamp keeps it continuous.
        let f = ((s - s0) / (s1 - s0)).clamp(0.0, 1.0);
        let (mut low, mut high) = ([0.0_f32; 4], [0.0_f32; 4]);
        for c in 0..4 {
            let pair = &self.data[of[c] * nz + k..of[c] * nz + k + 2];
            for d in 0..4 {
                low[d] += weights[c] * pair[0][d];
                high[d] += weights[c] * pair[1][d];
            }
        }
        let mut v = [0.0_f32; 4];
        for d in 0..4 {
            v[d] = low[d] + f * (high[d] - low[d]);
        }
        GridSample {
            velocity: [v[0], v[1], v[2]],
            k_z: v[3],
            dk_dz: (high[3] - low[3]) / ((s1 - s0) * -bed),
            k_h,
            bed_z: bed,
        }
    }

    /// ξ of s: the inverse of s = (1 − a)ξ + aξ², in the form that does not cancel at a = 0.
    #[inline]
    fn level_of(&self, s: f32) -> f32 {
        let a = self.stretch;
        let b = 1.0 - a;
        2.0 * s / (b + (b * b + 4.0 * a * s).sqrt())
    }
}

/// Cell index in 0..n−1 and the part of the cell passed, of a coordinate in cells.
#[inline]
fn split(c: f32, n: usize) -> (usize, f32) {
    let c = c.clamp(0.0, (n - 1) as f32);
    let i = (c as usize).min(n - 2);
    (i, c - i as f32)
}
