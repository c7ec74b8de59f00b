//! Tells in which water layer a depth lies, from a density profile of the depths that the vehicle has passed.
//!
//! *Source:* Pang 2009, section 7: the upward profiler sometimes "was measuring the flow in the top layer instead of
//! the bottom layer. Detecting and accommodating such events would require ... a conductivity, temperature, and depth
//! (CTD) sensor with a fast response time". The paper gives no rule; this one is ours.
//!
//! *Parameters:* two depths lie in different layers if their densities differ by more than `differs_kg_m3`, 0.5 kg/m³
//! (an eighth of the step in the scenario of Duck: the flow measured near an interface is then off by at most an
//! eighth of the difference between the layers, 4 cm/s); bin size `bin_m`, 0.25 m, a third of the thickness of an
//! interface; a bin not visited for `memory_s`, 3600 s, is forgotten, because internal waves and tide move the
//! interface.
//!
//! *Deviations:* all of it is ours. When the vehicle leaves a layer, it forgets the flow measured there. Between two
//! bins the profile is a straight line. Above the shallowest and below the deepest bin nothing is known, and an
//! unknown depth is not refused: a vehicle that was never above an interface still uses the wrong layer. A dive from
//! the surface at the start gives the profile.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::collections::BTreeMap;
use world::math;
use world::ranges::Positive;

/// Time constant with which a bin's density follows new readings, s: a compromise between noise and the time within a
/// bin.
const SMOOTH_S: f64 = 1.0;

/// Parameters of the layer test.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LayerAwareSpec {
    /// Two densities farther apart than this belong to different layers, kg/m³.
    #[default(Positive::new(0.5))]
    pub differs_kg_m3: Positive,
    /// Height of a bin of the profile, m.
    #[default(Positive::new(0.25))]
    pub bin_m: Positive,
    /// A bin not visited for this long is forgotten, s.
    #[default(Positive::new(3600.0))]
    pub memory_s: Positive,
}

#[derive(Clone, Copy, Debug)]
struct Bin {
    density_kg_m3: f64,
    visited_s: f64,
}

/// The profile, and the density where the vehicle is.
#[derive(Clone, Debug, Default)]
pub(super) struct LayerWatch {
    spec: LayerAwareSpec,
    bins: BTreeMap<i64, Bin>,
    here: Option<f64>,
    /// Density at the vehicle when the believed flow was measured.
    measured_in: Option<f64>,
}

impl LayerWatch {
    pub(super) fn new(spec: &LayerAwareSpec) -> Self {
        Self { spec: spec.clone(), ..Self::default() }
    }

    /// Takes in a reading at a depth.
    pub(super) fn take_in(&mut self, t_s: f64, depth_m: f64, density_kg_m3: f64) {
        self.here = Some(density_kg_m3);
        let k = (depth_m / self.spec.bin_m.get()).floor() as i64;
        let before = self.bins.get(&k).copied();
        let density_kg_m3 = before.map_or(density_kg_m3, |b| {
            let keep = math::exp(-(t_s - b.visited_s) / SMOOTH_S);
            density_kg_m3 + (b.density_kg_m3 - density_kg_m3) * keep
        });
        let bin = Bin { density_kg_m3, visited_s: t_s };
        self.bins.insert(k, bin);
        let oldest_s = t_s - self.spec.memory_s.get();
        self.bins.retain(|_, b| b.visited_s >= oldest_s);
    }

    /// Density at a depth from the profile, kg/m³; `None` if it is not known.
    fn density(&self, depth_m: f64) -> Option<f64> {
        let at = depth_m / self.spec.bin_m.get();
        let inside = self.bins.get(&(at.floor() as i64));
        // Between the middles of the nearest bins to either side.
        let k = (at - 0.5).floor() as i64;
        let above = self.bins.range(..=k).next_back();
        let below = self.bins.range(k + 1..).next();
        match (above, below) {
            (Some((i, a)), Some((j, b))) => {
                let share = (at - 0.5 - *i as f64) / (j - i) as f64;
                Some(a.density_kg_m3 + (b.density_kg_m3 - a.density_kg_m3) * share)
            }
            _ => inside.map(|b| b.density_kg_m3),
        }
    }

    /// Records that the flow has just been measured.
    pub(super) fn measured(&mut self) {
        self.measured_in = self.here;
    }

    /// Whether the vehicle has left the layer in which the believed flow was measured.
    pub(super) fn left_layer(&self) -> bool {
        match (self.here, self.measured_in) {
            (Some(here), Some(then)) => (here - then).abs() > self.spec.differs_kg_m3.get(),
            _ => false,
        }
    }

    /// Whether the water at a depth is known to belong to another layer than the water at the vehicle.
    pub(super) fn is_other(&self, depth_m: f64) -> bool {
        match (self.here, self.density(depth_m)) {
            (Some(here), Some(there)) => (here - there).abs() > self.spec.differs_kg_m3.get(),
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A dive at 0.3 m/s, ten readings a second, to `to_m`; 4 kg/m³ over 0.8 m round `interface_m`.
    fn dive(w: &mut LayerWatch, t_s: f64, from_m: f64, to_m: f64, interface_m: f64) -> f64 {
        let n = ((to_m - from_m).abs() / 0.03) as u32;
        for k in 0..=n {
            let depth = from_m + (to_m - from_m) * f64::from(k) / f64::from(n);
            w.take_in(t_s + 0.1 * f64::from(k), depth, density(depth, interface_m));
        }
        t_s + 0.1 * f64::from(n)
    }

    fn density(depth_m: f64, interface_m: f64) -> f64 {
        1020.0 + 4.0 * ((depth_m - interface_m) / 0.8 + 0.5).clamp(0.0, 1.0)
    }

    #[test]
    fn after_a_dive_it_knows_what_lies_above() {
        let mut w = LayerWatch::new(&LayerAwareSpec::default());
        assert!(!w.is_other(1.0));
        dive(&mut w, 0.0, 0.3, 3.0, 1.8);
        assert!(w.is_other(0.5) && w.is_other(1.4) && w.is_other(1.7));
        assert!(!w.is_other(2.5) && !w.is_other(3.0));
        for depth in [0.6, 1.0, 1.8, 2.6, 2.9] {
            let got = w.density(depth).expect("passed through");
            // 5 kg/m4 over half a bin.
            assert!((got - density(depth, 1.8)).abs() < 5.0 * 0.13, "{depth}: {got}");
        }
        // Not passed through: not known, not refused.
        assert!(!w.is_other(3.6) && !w.is_other(0.1));
        assert_eq!(w.density(3.6), None);
    }

    #[test]
    fn it_forgets_and_learns_anew() {
        let spec = LayerAwareSpec { memory_s: Positive::new(600.0), ..Default::default() };
        let mut w = LayerWatch::new(&spec);
        let t_s = dive(&mut w, 0.0, 0.3, 3.0, 1.8);
        assert!(w.is_other(1.0));
        // Ten minutes at 3 m.
        (0..6100).for_each(|k| w.take_in(t_s + 0.1 * f64::from(k), 3.0, 1024.0));
        assert!(!w.is_other(1.0));
        // Meanwhile the interface has risen.
        let t_s = dive(&mut w, t_s + 610.0, 3.0, 0.3, 0.8);
        dive(&mut w, t_s, 0.3, 3.0, 0.8);
        assert!(w.is_other(0.4) && !w.is_other(1.6));
    }

    #[test]
    fn in_water_of_one_density_nothing_is_refused() {
        let mut w = LayerWatch::new(&LayerAwareSpec::default());
        dive(&mut w, 0.0, 0.0, 6.0, 60.0);
        assert!((0..30).all(|k| !w.is_other(0.2 * f64::from(k))));
    }
}
