//! Memory and time that the water will need. `world::cost` says where the unit costs were measured.

use nalgebra::Vector2;
use world::area::Area;
use world::cost::{Cost, Part, Times};

use crate::flow::catalogue::CurrentSpec;
use crate::flow::water::WaterSpec;

/// Memory of a node of the plume's flow, bytes: its values, those by cell, and their check.
const NODE_BYTES: f64 = 64.0;
/// Time to evaluate the flow at a node, s: for currents alone, and for each surface wave.
const NODE_S: [f64; 2] = [60e-9, 25e-9];
/// Additional time where the water flows round obstacles, s.
const ROUND_S: f64 = 250e-9;

impl WaterSpec {
    /// Memory and time that it needs; paths begin with `water`.
    #[must_use]
    pub fn cost(&self, area: &Area, depth_m: f64, times: &Times) -> Cost {
        let mut cost = Cost::default();
        let mut waves = 0.0;
        let mut steady = true;
        for (i, current) in self.currents.iter().enumerate() {
            let path = format!("water.currents[{i}]");
            cost.add(match current {
                CurrentSpec::Meander(spec) => {
                    steady = false;
                    let ahead_s = self
                        .blockage
                        .as_ref()
                        .map_or(0.0, |b| 2.0 * b.period_s.get());
                    spec.cost(area, ahead_s, times).under(&path)
                }
                CurrentSpec::OpenChannel(spec) => match &spec.eddies {
                    Some(eddies) => eddies.cost(area, depth_m).under(&format!("{path}.eddies")),
                    None => Cost::default(),
                },
                CurrentSpec::Waves(spec) => {
                    waves += spec.count();
                    Cost::default()
                }
                CurrentSpec::Tide(_) => {
                    steady = false;
                    Cost::default()
                }
                CurrentSpec::Layered(spec) => {
                    steady &= spec.interfaces.iter().all(|f| f.waves.is_empty());
                    Cost::default()
                }
                CurrentSpec::Uniform(_) => Cost::default(),
            });
        }
        let shape = self.grid_shape(area);
        if let Some(spec) = &self.blockage {
            cost.add(spec.cost(area, steady, times).under("water.blockage"));
        }
        let nodes: f64 = shape.nodes(area).iter().product();
        let round_s = if self.blockage.is_some() {
            ROUND_S
        } else {
            0.0
        };
        let each_s = NODE_S[0] + waves * NODE_S[1] + round_s;
        let path = if self.blockage.is_some() {
            "water.blockage.cell_m"
        } else {
            "area"
        };
        let part = Part::new(path, format!("{nodes:.1e} nodes of the plume's flow"))
            .holds(nodes * NODE_BYTES)
            .takes(nodes * each_s * times.sums());
        cost.add(Cost::of(match &self.blockage {
            Some(spec) => part.by(spec.cell_m.get(), -2.0),
            None => part,
        }));
        cost
    }

    /// Number of waves that are summed whenever the water is evaluated.
    #[must_use]
    pub fn waves(&self) -> f64 {
        let of = |c: &CurrentSpec| match c {
            CurrentSpec::Waves(spec) => spec.count(),
            _ => 0.0,
        };
        self.currents.iter().map(of).sum()
    }

    /// Approximate speed at which the water carries things away, m/s: the mean of the currents that keep their
    /// direction.
    #[must_use]
    pub fn carries_m_s(&self) -> f64 {
        let along = |deg: f64, speed: f64| world::units::Heading::from_deg(deg).unit() * speed;
        let of = |c: &CurrentSpec| match c {
            CurrentSpec::Uniform(spec) => spec.velocity(),
            CurrentSpec::OpenChannel(spec) => along(spec.heading_deg.get(), spec.mean_m_s.get()),
            // The slowest layer holds filaments longest.
            CurrentSpec::Layered(spec) => (spec.layers.iter())
                .map(|l| along(l.heading_deg.get(), l.speed_m_s.get()))
                .min_by(|a, b| a.norm().total_cmp(&b.norm()))
                .unwrap_or_default(),
            _ => Vector2::zeros(),
        };
        self.currents.iter().map(of).sum::<Vector2<f64>>().norm()
    }
}
