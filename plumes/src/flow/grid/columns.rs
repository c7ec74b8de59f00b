//! Evaluates the flow in the grid's columns, in all or in some.

use super::FlowGrid;
use nalgebra::Vector3;
use rayon::prelude::*;
use world::fields::{Flow, Mixing};

/// Memory for one column.
struct ColumnWork {
    heights: Vec<f64>,
    out: Vec<(Vector3<f64>, Mixing)>,
    nodes: Vec<[f32; 4]>,
}

impl ColumnWork {
    fn new(levels: usize) -> Self {
        Self {
            heights: vec![0.0; levels],
            out: vec![(Vector3::zeros(), Mixing::default()); levels],
            nodes: vec![[0.0; 4]; levels],
        }
    }
}

impl FlowGrid {
    /// Evaluates the flow at every node for time `t_s`, to which the flow must have been advanced.
    pub fn refresh(&mut self, flow: &dyn Flow, t_s: f64) {
        self.t_s = t_s;
        let all: Vec<usize> = (0..self.bed.len()).collect();
        self.refresh_columns(flow, &all, false);
    }

    /// Evaluates the flow in some columns for the grid's time, with the threads of the present pool if wanted.
    pub(crate) fn refresh_columns(&mut self, flow: &dyn Flow, columns: &[usize], threads: bool) {
        let nz = self.dims[2];
        if !threads || columns.len() < 64 {
            let mut work = ColumnWork::new(nz);
            for &column in columns {
                self.k_h[column] = self.column(flow, column, &mut work);
                self.data[column * nz..(column + 1) * nz].copy_from_slice(&work.nodes);
            }
            return;
        }
        let of = |work: &mut ColumnWork, column: &usize| {
            let k_h = self.column(flow, *column, work);
            (k_h, work.nodes.clone())
        };
        let all: Vec<_> = columns.par_iter().map_init(|| ColumnWork::new(nz), of).collect();
        for (&column, (k_h, nodes)) in columns.iter().zip(all) {
            self.k_h[column] = k_h;
            self.data[column * nz..(column + 1) * nz].copy_from_slice(&nodes);
        }
    }

    /// Evaluates the flow at the nodes of one column. Returns the horizontal diffusivity.
    fn column(&self, flow: &dyn Flow, column: usize, work: &mut ColumnWork) -> f32 {
        let (ny, nz) = (self.dims[1], self.dims[2]);
        for (z, level) in work.heights.iter_mut().zip(&self.levels) {
            *z = f64::from(self.bed[column]) * (1.0 - f64::from(*level));
        }
        let place = self.node(column / ny, column % ny, 0).xy();
        flow.column(place, &work.heights, self.t_s, &mut work.out);
        let slope = self.ground.floor(place).slope;
        for ((node, (u, m)), level) in work.nodes.iter_mut().zip(&work.out).zip(&self.levels) {
            let through = u.z - u.xy().dot(&slope) * (1.0 - f64::from(*level));
            *node = [u.x as f32, u.y as f32, through as f32, m.k_z_m2_s as f32];
        }
        work.out[nz / 2].1.k_h_m2_s as f32
    }
}
