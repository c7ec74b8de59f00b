//! The flow prepared for the plume: velocity and diffusivity, evaluated once at the nodes of a bed-following grid, so
//! that each of thousands of filaments needs only one trilinear look-up.
//!
//! *Source*: terrain-following ("sigma") coordinate, Phillips 1957, J. Meteorol. 14, 184; interpolation by
//! the tensor product of linear ones.
//!
//! *Parameters*: [`GridShape`]: `cell_m` horizontal spacing (m), `levels` nodes from bed to surface,
//! `stretch` (0 even, towards 1 denser at the bed), `margin_m` beyond the area (m).
//!
//! *Layout*: axes along (i) and across (j, to the right of) the area's axis, k from bed to surface; node (i, j, k) is
//! `data[(i·ny + j)·nz + k] = [u_east, u_north, ω, K_z]`, f32. The height above the bed as a part of the depth, s =
//! (z − b)/(−b), is s(ξ) = (1 − a)ξ + aξ² with ξ = k/(nz − 1); its inverse is a square root, so no search is needed.
//! ω = w − u·∇b z/b is the vertical velocity through the surfaces of constant s (m/s). The bed is not that of the
//! nodes: it is the terrain's at every place, so what flows along it stays on it where its slope changes within a cell.
//! Within a cell everything is linear in s, that is in z, and K_z is piecewise linear with the gradient that the
//! well-mixed drift needs. Only the current over a rough bed is logarithmic in the lowest cell, as the law of the wall
//! has it (`log_law.rs`).
//!
//! *Deviations*: outside the grid, the value at the nearest edge applies. The values are constant between two
//! refreshes: call [`FlowGrid::refresh`] at fixed times, for the middle of the coming span.

mod columns;
mod log_law;
mod shape;

pub(crate) use log_law::LogLaw;
pub use shape::{CurrentScales, GridShape, InterfaceScale};

use crate::flow::ground::{Ground, NearGround};
use nalgebra::{Vector2, Vector3};
use world::area::Area;
use world::terrain::Terrain;

/// Flow and diffusivities at the grid's nodes at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct FlowGrid {
    /// World (east, north) of the area's centre, m. All that is single precision is relative to it, because single
    /// precision resolves only half a metre at the distance of a chart's datum.
    pub datum: Vector2<f64>,
    /// Node (0, 0) from there (east, north), m.
    pub origin: [f32; 2],
    /// Unit vector (east, north) of increasing i.
    pub along: [f32; 2],
    /// Unit vector (east, north) of increasing j.
    pub across: [f32; 2],
    /// Spacing along and across, m.
    pub spacing: [f32; 2],
    /// Nodes: nx along, ny across, nz upwards.
    pub dims: [usize; 3],
    /// The vertical map's a, see above.
    pub stretch: f32,
    /// s of each level, 0 at the bed to 1 at the surface.
    pub levels: Vec<f32>,
    /// `[east, north, ω (m/s), K_z (m²/s)]` at node (i·ny + j)·nz + k.
    pub data: Vec<[f32; 4]>,
    /// Bed height (m, negative) at column i·ny + j.
    pub bed: Vec<f32>,
    /// The bed at any place, in the world and from the datum.
    pub(crate) ground: Ground,
    pub(crate) near: NearGround,
    /// How the current falls to the bed in the lowest cell, if not linearly.
    pub(crate) law: Option<LogLaw>,
    /// Horizontal diffusivity (m²/s) at column i·ny + j, taken at mid-depth.
    pub k_h: Vec<f32>,
    /// Time for which the values hold, s.
    pub t_s: f64,
}

/// The values that a filament needs at its place.
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
    /// If the shape has fewer than two levels, no positive cell size, or a stretch outside [0, 1): mistakes in the
    /// code.
    pub fn new(area: &Area, terrain: &Terrain, shape: GridShape) -> Self {
        assert!(
            shape.levels >= 2 && shape.cell_m > 0.0 && (0.0..1.0).contains(&shape.stretch),
            "a flow grid needs levels >= 2, cell_m > 0 and stretch in [0, 1), got {shape:?}"
        );
        let extent = shape.extent_m(area);
        let n = shape.nodes(area).map(|n| n as usize);
        let spacing = [0, 1].map(|d| extent[d] / (n[d] - 1) as f64);
        let corner = Vector2::new(-extent[0] / 2.0, -extent[1] / 2.0);
        let at = |i: usize, j: usize| area.world(corner + Vector2::new(i as f64 * spacing[0], j as f64 * spacing[1]));
        let ground = Ground::new(terrain);
        let columns = (0..n[0]).flat_map(|i| (0..n[1]).map(move |j| (i, j)));
        let bed: Vec<f32> = columns.map(|(i, j)| ground.floor(at(i, j)).z as f32).collect();
        let a = area.axis.unit();
        let r = area.axis.turned(std::f64::consts::FRAC_PI_2).unit();
        let o = at(0, 0) - area.centre;
        let nz = shape.levels;
        let levels = (0..nz).map(|k| shape.level(k) as f32);
        Self {
            datum: area.centre,
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
            ground,
            near: ground.near(area.centre),
            law: None,
            t_s: 0.0,
        }
    }

    /// World position of a node, m.
    pub fn node(&self, i: usize, j: usize, k: usize) -> Vector3<f64> {
        let (di, dj) = (i as f64 * f64::from(self.spacing[0]), j as f64 * f64::from(self.spacing[1]));
        let xy = |d: usize| {
            self.datum[d] + f64::from(self.origin[d]) + di * f64::from(self.along[d]) + dj * f64::from(self.across[d])
        };
        let b = f64::from(self.bed[i * self.dims[1] + j]);
        Vector3::new(xy(0), xy(1), b * (1.0 - f64::from(self.levels[k])))
    }

    /// A world point from the datum, m.
    pub fn local(&self, p: &Vector3<f64>) -> [f32; 3] {
        let [x, y] = [0, 1].map(|d| (p[d] - self.datum[d]) as f32);
        [x, y, p.z as f32]
    }

    /// A point from the datum in the world, m.
    pub fn world(&self, [x, y, z]: [f32; 3]) -> Vector3<f64> {
        let [x, y, z] = [x, y, z].map(f64::from);
        Vector3::new(self.datum.x + x, self.datum.y + y, z)
    }

    /// Trilinear values at a point from the datum, m; the point is first moved into the grid.
    #[inline]
    pub fn sample(&self, x: f32, y: f32, z: f32) -> GridSample {
        let [nx, ny, nz] = self.dims;
        let (dx, dy) = (x - self.origin[0], y - self.origin[1]);
        let (i, fi) = split((dx * self.along[0] + dy * self.along[1]) / self.spacing[0], nx);
        let (j, fj) = split((dx * self.across[0] + dy * self.across[1]) / self.spacing[1], ny);
        let column = i * ny + j;
        let weights = [(1.0 - fi) * (1.0 - fj), (1.0 - fi) * fj, fi * (1.0 - fj), fi * fj];
        let of = [column, column + 1, column + ny, column + ny + 1];
        let k_h = (0..4).map(|c| weights[c] * self.k_h[of[c]]).sum();
        let bed = self.near.z(x, y);
        let s = (1.0 - z / bed).clamp(0.0, 1.0);
        let (k, _) = split(self.level_of(s) * (nz - 1) as f32, nz);
        let (s0, s1) = (self.levels[k], self.levels[k + 1]);
        // Rounding of the square root may give the neighbouring level; the clamp keeps the result continuous.
        let f = ((s - s0) / (s1 - s0)).clamp(0.0, 1.0);
        let (mut low, mut high) = ([0.0_f32; 4], [0.0_f32; 4]);
        for (column, w) in of.iter().zip(weights) {
            let at = column * nz + k;
            let [a, b]: [[f32; 4]; 2] = self.data[at..at + 2].try_into().expect("two nodes");
            for d in 0..4 {
                low[d] += w * a[d];
                high[d] += w * b[d];
            }
        }
        let mut v = [0.0_f32; 4];
        for d in 0..4 {
            v[d] = low[d] + f * (high[d] - low[d]);
        }
        if k == 0
            && let Some(law) = &self.law
        {
            let extra = law.extra(f, (s1 - s0) * -bed, -bed);
            v[0] += extra * (high[0] - low[0]);
            v[1] += extra * (high[1] - low[1]);
        }
        let slope = self.ground.floor(self.world([x, y, z]).xy()).slope;
        v[2] += (v[0] * slope.x as f32 + v[1] * slope.y as f32) * (1.0 - s);
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

/// Splits a coordinate in cells into the cell index in 0..n−1 and the position in the cell.
#[inline]
fn split(c: f32, n: usize) -> (usize, f32) {
    let c = c.clamp(0.0, (n - 1) as f32);
    // Through i32: this is cheaper than 64 bits, and no grid is that large.
    let i = (c as i32 as usize).min(n - 2);
    (i, c - i as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::tests::water::{duck, duck_area, duck_bed, places};
    use world::fields::{Flow, Mixing};

    struct Linear;

    impl Flow for Linear {
        fn velocity(&self, p: &Vector3<f64>, _t_s: f64) -> Vector3<f64> {
            Vector3::new(0.1 + 1e-3 * p.x, 2e-3 * p.y - 1e-3 * p.x, 0.01 * p.z)
        }
        fn mixing(&self, p: &Vector3<f64>, _t_s: f64) -> Mixing {
            Mixing { k_h_m2_s: 0.02, k_z_m2_s: 1e-3 * (p.z + 9.0) }
        }
    }

    #[test]
    fn linear_fields_come_back_whole() {
        let bed = Terrain::Level { depth_m: 6.0 };
        let mut grid = FlowGrid::new(&duck_area(), &bed, GridShape::default());
        grid.refresh(&Linear, 0.0);
        for (k, p) in places(500).enumerate() {
            let z = -6.0 * (k as f64 * 0.618_034).fract();
            let got = grid.sample(p.x as f32, p.y as f32, z as f32);
            let want = Linear.velocity(&Vector3::new(p.x, p.y, z), 0.0);
            for d in 0..3 {
                // f32: positions of 600 m to 6e-5 m, values of order 1 to 1e-7.
                assert!((f64::from(got.velocity[d]) - want[d]).abs() < 3e-6);
            }
            assert!((f64::from(got.k_z) - 1e-3 * (z + 9.0)).abs() < 1e-8);
            // Differences of f32 numbers near 9e-3 over the least spacing, 0.06 m: 1e-9/0.06.
            assert!((got.dk_dz - 1e-3).abs() < 1e-7, "{}", got.dk_dz);
            assert!((got.k_h - 0.02).abs() < 1e-8 && (got.bed_z + 6.0).abs() < 2e-6);
        }
    }

    /// Compared with the flow itself. Expected at worst, h²/8 of the second derivative: across the interface (0.34 m/s
    /// over 0.8 m, levels 0.55 m apart in 8 m) 0.03 m/s; in the foot of the log law below the second level 0.03 m/s.
    #[test]
    fn stays_near_the_flow_itself() {
        let water = duck().build(&duck_area(), &duck_bed(), 7).unwrap();
        let mut grid = FlowGrid::new(&duck_area(), &duck_bed(), GridShape::default());
        grid.refresh(&water, 0.0);
        let (mut worst, mut sum): (f64, f64) = (0.0, 0.0);
        for (k, p) in places(5000).enumerate() {
            let z = water.column(p, 0.0).bed_z() * (k as f64 * 0.618_034).fract();
            let got = grid.sample(p.x as f32, p.y as f32, z as f32);
            let want = water.velocity(&Vector3::new(p.x, p.y, z), 0.0);
            let off = (Vector3::from(got.velocity.map(f64::from)) - want).norm();
            worst = worst.max(off);
            sum += off * off / 5000.0;
            assert!(got.k_z >= 0.0);
        }
        assert!(worst < 0.04 && sum.sqrt() < 0.01, "{worst} {}", sum.sqrt());
    }

    #[test]
    fn columns_at_once_give_the_same_numbers() {
        let water = duck().build(&duck_area(), &duck_bed(), 7).unwrap();
        // Closer than the interface is thick.
        let heights = [-2.9, -2.3, -2.0, -1.5, -1.0, -0.3];
        for place in places(50) {
            let mut out = [(Vector3::zeros(), Mixing::default()); 6];
            Flow::column(&water, place, &heights, 2.0, &mut out);
            for (z, got) in heights.iter().zip(out) {
                let p = Vector3::new(place.x, place.y, *z);
                assert_eq!(got, (water.velocity(&p, 2.0), water.mixing(&p, 2.0)));
            }
        }
    }

    #[test]
    fn beyond_the_edge_the_edge_holds() {
        let mut grid = FlowGrid::new(&duck_area(), &duck_bed(), GridShape::default());
        grid.refresh(&Linear, 0.0);
        let far = duck_area().world(Vector2::new(5000.0, 0.0));
        let edge = duck_area().world(Vector2::new(597.0, 0.0));
        let (a, b) = (grid.sample(far.x as f32, far.y as f32, 5.0), grid.sample(edge.x as f32, edge.y as f32, 0.0));
        for d in 0..3 {
            assert!((a.velocity[d] - b.velocity[d]).abs() < 1e-5);
        }
        assert!(grid.sample(0.0, 0.0, -99.0).velocity[2] < 0.0);
    }
}
