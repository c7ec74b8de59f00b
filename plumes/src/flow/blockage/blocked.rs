//! Currents that flow round obstacles over time: solved at multiples of a period and interpolated linearly in between.
//!
//! *Source*: the projection of `solve`, on the cells of `cells`, evaluated as in `field`. If two fields are free of
//! divergence and tangent, then so is their interpolation, because both conditions are linear.
//!
//! *Parameters*: [`BlockageSpec`], `period_s` (s).
//!
//! *Deviations*: exact at multiples of the period. In between, a current that turns with angular frequency ω has a
//! relative error of at most (ω·period)²/8 (meander at 0.02 1/s, 30 s: 4.5 %). Density, diffusivities and the
//! interfaces of layers stay those of the unblocked water: interfaces do not rise over a block.

mod kept;

use nalgebra::{Matrix3, Vector3};
use std::sync::Arc;
use world::area::Area;
use world::obstacles::Obstacles;

use super::cells::{Cells, Faces, beyond};
use super::field::{self, FieldPair};
use super::solve::{Projector, SolutionReport};
use super::spec::BlockageSpec;
use crate::error::PlumeError;
use crate::flow::free_water::{Column, FreeWater};
use crate::flow::ground::Floor;

/// How long after the latest advance questions may come, s.
const AHEAD_S: f64 = 1.0;

/// Velocity (m/s), gradient (1/s) and rate of change (m/s²).
type Sample = (Vector3<f64>, Matrix3<f64>, Vector3<f64>);

/// Water that flows round obstacles.
#[derive(Clone, Debug)]
pub struct ObstacleFlow {
    cells: Arc<Cells>,
    // `None` once steady water has been solved.
    projector: Option<Arc<Projector>>,
    // The unblocked water, advanced to the last of the three moments.
    free: Box<FreeWater>,
    phi: Vec<f64>,
    // At `first`, `first + 1`, `first + 2` periods.
    fields: [Arc<Faces<f32>>; 3],
    first: u64,
    period_s: f64,
    solved: SolutionReport,
    // Stokes' drift of the waves, led round obstacles as the currents are. It carries filaments, not hulls.
    drift: Option<Arc<Faces<f32>>>,
    // Mean depth of each column, m: that of its four corners.
    depth: Arc<Vec<f64>>,
}

impl ObstacleFlow {
    pub(crate) fn new(
        spec: &BlockageSpec,
        area: &Area,
        obstacles: &Obstacles,
        free: FreeWater,
    ) -> Result<Self, PlumeError> {
        let ground = &free.ground;
        let cells = Cells::new(spec, area, ground, obstacles, free.side_walls().is_some())?;
        let projector = Projector::new(&cells, ground);
        let [nx, ny, _] = cells.n;
        let corner = |i: usize, j: usize| -ground.floor(cells.place(i as f64, j as f64)).z;
        let mean = |i, j| 0.25 * (corner(i, j) + corner(i + 1, j) + corner(i, j + 1) + corner(i + 1, j + 1));
        let depth = (0..nx * ny).map(|c| mean(c / ny, c % ny)).collect();
        let mut this = Self {
            phi: Vec::new(),
            fields: [(); 3].map(|()| Arc::new(Faces::default())),
            first: 0,
            period_s: spec.period_s.get(),
            solved: SolutionReport { open_cells: 0, cells: 0, steps: 0, divergence: 0.0 },
            projector: Some(Arc::new(projector)),
            cells: Arc::new(cells),
            drift: None,
            depth: Arc::new(depth),
            free: Box::new(free),
        };
        this.drift = this.stokes();
        let now = this.worked_out(0.0);
        if this.free.steady {
            this.fields = [now.clone(), now.clone(), now];
            (this.projector, this.phi) = (None, Vec::new());
        } else {
            let [one, two] = [1.0, 2.0].map(|k| this.worked_out(k * this.period_s));
            this.fields = [now, one, two];
        }
        Ok(this)
    }

    /// The last solution: cells, steps, divergence left.
    pub fn solved(&self) -> SolutionReport {
        self.solved
    }

    /// The field at a moment not earlier than the one solved last.
    fn worked_out(&mut self, t_s: f64) -> Arc<Faces<f32>> {
        let projector = self.projector.clone().expect("unsteady water keeps its projector");
        self.free.advance(t_s);
        let mut flux = self.incoming(t_s, |column, z| column.velocity(z));
        self.solved = projector.project(&self.cells, &mut flux, &mut self.phi);
        Arc::new(Projector::velocities(&self.cells, &flux))
    }

    pub(crate) fn advance(&mut self, t_s: f64) {
        if self.projector.is_none() {
            return;
        }
        while t_s + AHEAD_S >= (self.first + 2) as f64 * self.period_s {
            let next = self.worked_out((self.first + 3) as f64 * self.period_s);
            self.fields.rotate_left(1);
            self.fields[2] = next;
            self.first += 1;
        }
    }

    /// The waves' drift, if there is any.
    fn stokes(&self) -> Option<Arc<Faces<f32>>> {
        let waves = self.free.waves()?;
        let drift = |z: f64| waves.drift(z);
        if drift(0.0).norm() == 0.0 {
            return None;
        }
        let projector = self.projector.as_ref()?;
        let mut flux = self.incoming(0.0, |_, z| drift(z).push(0.0));
        projector.project(&self.cells, &mut flux, &mut Vec::new());
        Some(Arc::new(Projector::velocities(&self.cells, &flux)))
    }

    /// Fluxes of the unblocked water at the centre of every face, m³/s.
    fn incoming(&self, t_s: f64, velocity: impl Fn(&Column<'_>, f64) -> Vector3<f64>) -> Faces<f64> {
        let cells = &*self.cells;
        let [nx, ny, nz] = cells.n;
        let mut flux = Faces::default();
        for d in 0..2 {
            let n = [nx + usize::from(d == 0), ny + usize::from(d == 1)];
            let mut all = Vec::with_capacity(n[0] * n[1] * nz);
            for i in 0..n[0] {
                for j in 0..n[1] {
                    let half = [0.5 * f64::from(d == 1), 0.5 * f64::from(d == 0)];
                    let p = cells.place(i as f64 + half[0], j as f64 + half[1]);
                    let column = self.free.column(p, t_s);
                    let bed = column.bed_z();
                    for k in 0..nz {
                        let u = velocity(&column, bed * (1.0 - cells.middle(k))).xy();
                        let area = cells.d[1 - d] * -bed * (cells.s[k + 1] - cells.s[k]);
                        all.push(u.dot(&cells.axes[d]) * area);
                    }
                }
            }
            flux.0[d] = all;
        }
        let top = cells.d[0] * cells.d[1];
        for i in 0..nx {
            for j in 0..ny {
                let p = cells.place(i as f64 + 0.5, j as f64 + 0.5);
                let column = self.free.column(p, t_s);
                let floor = self.free.floor(p);
                flux.0[2].push(0.0);
                for s in &cells.s[1..nz] {
                    let v = velocity(&column, floor.z * (1.0 - s));
                    flux.0[2].push((v.z - v.xy().dot(&floor.slope) * (1.0 - s)) * top);
                }
                flux.0[2].push(0.0);
            }
        }
        flux
    }

    fn between(&self, t_s: f64) -> FieldPair<'_> {
        let at = t_s / self.period_s - self.first as f64;
        let n = usize::from(at >= 1.0);
        ([&*self.fields[n], &*self.fields[n + 1]], at - n as f64)
    }

    /// Velocity, m/s; `None` outside the cells.
    pub(crate) fn velocity(&self, p: &Vector3<f64>, floor: &Floor, t_s: f64) -> Option<Vector3<f64>> {
        field::velocity(&self.cells, self.between(t_s), p.xy(), p.z, floor)
    }

    /// Fills in the velocities that carry filaments through each cell, as [`Flow::rates`](world::fields::Flow::rates)
    /// requires: along, across and upwards, the speed at the lower and the upper face in cell sizes per second. Columns
    /// have one level less than nodes: cell (i, j, k) has the number (i·(ny + 1) + j)·nz + k and belongs to the flow
    /// grid's column at its lower corner.
    pub(crate) fn rates(&self, t_s: f64, out: &mut Vec<[f32; 6]>) {
        let cells = &*self.cells;
        let [nx, ny, nz] = cells.n;
        let between = self.between(t_s);
        let drift = self.drift.as_deref();
        out.resize(nx * (ny + 1) * nz, [0.0; 6]);
        for i in 0..nx {
            for j in 0..ny {
                let depth = self.depth[i * ny + j];
                let column = &mut out[(i * (ny + 1) + j) * nz..][..nz];
                for (k, rates) in column.iter_mut().enumerate() {
                    let ds = cells.s[k + 1] - cells.s[k];
                    let per = [1.0 / cells.d[0], 1.0 / cells.d[1], 1.0 / ds];
                    for d in 0..3 {
                        for (side, face) in [[i, j, k], beyond(d, [i, j, k])].into_iter().enumerate() {
                            let at = cells.face(d, face);
                            let of = |f: &Faces<f32>| f.0[d][at];
                            let v = field::mixed(of, between) + drift.map_or(0.0, |f| f64::from(of(f)));
                            rates[2 * d + side] = (v * per[d] / depth) as f32;
                        }
                    }
                }
            }
        }
    }

    /// Whether friction stops the water at the bed.
    pub(crate) fn still_bed(&self) -> bool {
        self.free.stands_at_bed()
    }

    /// Velocity, its gradient and rate of change; `None` outside the cells. The gradient is taken between the centres
    /// of cells: over half a cell to both sides, or to one side where the other is solid, bed or surface.
    pub(crate) fn sample(&self, p: &Vector3<f64>, floor: &Floor, t_s: f64) -> Option<Sample> {
        let cells = &*self.cells;
        let between = self.between(t_s);
        let here = field::velocity(cells, between, p.xy(), p.z, floor)?;
        let side = 0.5 * cells.d[0].min(cells.d[1]);
        let up = 0.5 * field::thickness(cells, p.z, floor);
        let mut gradient = Matrix3::zeros();
        for (d, step) in [side, side, up].into_iter().enumerate() {
            let at = |sign: f64| {
                let mut q = *p;
                q[d] += sign * step;
                let floor = self.free.floor(q.xy());
                let off = q.z < floor.z || q.z > 0.0 || field::solid(cells, q.xy(), q.z, &floor);
                let v = (!off).then(|| field::velocity(cells, between, q.xy(), q.z, &floor));
                v.flatten().map_or((here, 0.0), |v| (v, step))
            };
            let ((high, above), (low, below)) = (at(1.0), at(-1.0));
            if above + below > 0.0 {
                gradient.set_column(d, &((high - low) / (above + below)));
            }
        }
        let ([one, two], _) = between;
        let first = field::velocity(cells, ([one, two], 0.0), p.xy(), p.z, floor)?;
        let second = field::velocity(cells, ([one, two], 1.0), p.xy(), p.z, floor)?;
        Some((here, gradient, (second - first) / self.period_s))
    }

    /// The cells.
    pub(crate) fn cells(&self) -> &Arc<Cells> {
        &self.cells
    }

    #[cfg(test)]
    pub(super) fn field(&self, n: usize) -> &Faces<f32> {
        &self.fields[n]
    }
}
