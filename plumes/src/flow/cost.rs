//! Memory and time that the water will need. `world::cost` says where the unit costs were measured.

use nalgebra::Vector2;
use world::area::Area;
use world::cost::{Cost, Part, Times};

use crate::flow::water_spec::WaterSpec;

/// Memory of a node of the plume's flow, bytes: its values, those by cell, and their check.
const NODE_BYTES: f64 = 64.0;
/// Time to evaluate the flow at a node, s: for currents alone, and for each surface wave.
const NODE_S: [f64; 2] = [60e-9, 25e-9];
/// Part of the columns that a plume is in, and in which alone the flow is evaluated, unless it flows round obstacles.
const IN_PLUME: f64 = 0.3;
/// Additional time where the water flows round obstacles, s.
const ROUND_S: f64 = 250e-9;

impl WaterSpec {
    /// Memory and time that it needs; paths begin with `water`.
    pub fn cost(&self, area: &Area, depth_m: f64, times: &Times) -> Cost {
        let mut cost = Cost::default();
        let blockage = self.blockage.as_ref();
        let ahead_s = blockage.map_or(0.0, |b| 2.0 * b.period_s.get());
        for (i, current) in self.currents.iter().enumerate() {
            let own = current.cost(area, depth_m, ahead_s, times);
            cost.add(own.under(&format!("water.currents[{i}]")));
        }
        let waves = self.waves();
        let shape = self.grid_shape(area, depth_m);
        if let Some(spec) = &self.blockage {
            cost.add(spec.cost(area, self.is_steady(), times).under("water.blockage"));
        }
        let nodes: f64 = shape.nodes(area).iter().product();
        let round_s = if self.blockage.is_some() { ROUND_S } else { 0.0 };
        let part = if self.blockage.is_some() { 1.0 } else { IN_PLUME };
        let each_s = NODE_S[0] + waves * NODE_S[1] + round_s;
        let path = if self.blockage.is_some() { "water.blockage.cell_m" } else { "area" };
        let nodes_of = Part::new(path, format!("{nodes:.1e} nodes of the plume's flow"))
            .holds(nodes * NODE_BYTES)
            .takes(nodes * part * each_s * times.sums());
        cost.add(Cost::single(match &self.blockage {
            Some(spec) => nodes_of.by(spec.cell_m.get(), -2.0),
            None => nodes_of,
        }));
        cost
    }

    /// Number of waves that are summed whenever the water is evaluated.
    pub fn waves(&self) -> f64 {
        self.currents.iter().map(|c| c.waves()).sum()
    }

    /// Approximate speed at which the water carries things away, m/s: the mean of the currents that keep their
    /// direction.
    pub fn carries_m_s(&self) -> f64 {
        let all = self.currents.iter().map(|c| c.carries_m_s());
        all.sum::<Vector2<f64>>().norm()
    }
}
