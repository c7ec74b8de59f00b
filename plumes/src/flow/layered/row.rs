//! What makes the layers known to scenarios, and what they say of themselves before they are made.

use nalgebra::Vector2;
use world::catalogue::Entry;
use world::registry::Listed;

use super::LayeredSpec;
use crate::error::PlumeError;
use crate::flow::catalogue::{CurrentParams, CurrentScales, CurrentSlot, InterfaceScale};
use crate::flow::water::Water;

impl Listed for LayeredSpec {
    const ENTRY: Entry = Entry {
        name: "Layered",
        what: "Layers of different density and velocity with interfaces that rise and sink",
        source: "Pang 2009, section 6 (Duck); Hazel 1972, J. Fluid Mech. 51, 39; Gill 1982, section 6.2",
    };
}

impl CurrentParams for LayeredSpec {
    fn join(&self, water: &mut Water, place: &CurrentSlot) -> Result<(), PlumeError> {
        if water.layered.is_some() {
            return place.wrong(
                "only one Layered current can fix the water's layers; add the second one's layers to the first",
            );
        }
        let layered = self.build(place.field, place.seed)?;
        water.layered = Some(layered.with_phases_at(place.area.centre));
        Ok(())
    }

    fn is_steady(&self) -> bool {
        self.interfaces.iter().all(|f| f.waves.is_empty())
    }

    /// The slowest layer holds filaments longest.
    fn carries_m_s(&self) -> Vector2<f64> {
        (self.layers.iter())
            .map(|l| l.heading_deg.heading().unit() * l.speed_m_s.get())
            .min_by(|a, b| a.norm().total_cmp(&b.norm()))
            .unwrap_or_default()
    }

    fn scales(&self) -> CurrentScales {
        let waves = || self.interfaces.iter().flat_map(|i| &i.waves).filter(|w| w.amplitude_m.get() > 0.0);
        CurrentScales {
            shortest_m: waves().map(|w| w.length_m.get()).fold(f64::INFINITY, f64::min),
            shortest_s: waves().map(|w| w.period_s.get()).fold(f64::INFINITY, f64::min),
            interfaces: (self.interfaces.iter())
                .map(|i| InterfaceScale { depth_m: i.depth_m.get(), thickness_m: i.thickness_m.get() })
                .collect(),
        }
    }
}
