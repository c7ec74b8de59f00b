//! The kinds of currents: what each is called, and how it takes its part in the water.

use nalgebra::Vector2;
use world::area::Area;
use world::catalogue::Entry;
use world::cost::{Cost, Times};
use world::registry::Listed;

use crate::error::PlumeError;
use crate::flow::current::{CurrentParams, CurrentSlot};
use crate::flow::flume::Flume;
use crate::flow::grid::{CurrentScales, InterfaceScale};
use crate::flow::layered::LayeredSpec;
use crate::flow::meander::MeanderSpec;
use crate::flow::open_channel::OpenChannelSpec;
use crate::flow::tide::TideSpec;
use crate::flow::uniform::UniformSpec;
use crate::flow::water::Water;
use crate::flow::waves::WavesSpec;

impl Listed for UniformSpec {
    const ENTRY: Entry = Entry {
        name: "Uniform",
        what: "One velocity everywhere and always",
        source: "Farrell et al. 2002, Environ. Fluid Mech. 2, 143",
    };
}

impl CurrentParams for UniformSpec {
    fn join(&self, water: &mut Water, _: &CurrentSlot) -> Result<(), PlumeError> {
        water.uniform += self.velocity();
        Ok(())
    }

    fn carries_m_s(&self) -> Vector2<f64> {
        self.velocity()
    }
}

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

impl Listed for MeanderSpec {
    const ENTRY: Entry = Entry {
        name: "Meander",
        what: "Coloured noise at the area's corners carried inside, made divergence-free",
        source: "Farrell et al. 2002, Environ. Fluid Mech. 2, 143; Chorin 1968, Math. Comp. 22, 745",
    };
}

impl CurrentParams for MeanderSpec {
    fn join(&self, _: &mut Water, _: &CurrentSlot) -> Result<(), PlumeError> {
        Ok(())
    }

    fn join_carried(&self, water: &mut Water, place: &CurrentSlot, carrier: Vector2<f64>) -> Result<(), PlumeError> {
        let meander = self.build(place.field, place.area, carrier, place.seed)?;
        water.meanders.push(meander);
        Ok(())
    }

    fn is_steady(&self) -> bool {
        false
    }

    fn cost(&self, area: &Area, _: f64, ahead_s: f64, times: &Times) -> Cost {
        self.work(area, ahead_s, times)
    }
}

impl Listed for OpenChannelSpec {
    const ENTRY: Entry = Entry {
        name: "OpenChannel",
        what: "Flume or canal between walls: log law over a smooth or rough bed, and turbulence resolved by random Fourier modes",
        source: "Nezu & Nakagawa 1993, Turbulence in Open-Channel Flows; Fung et al. 1992, J. Fluid Mech. 236, 281",
    };
}

impl CurrentParams for OpenChannelSpec {
    fn join(&self, water: &mut Water, place: &CurrentSlot) -> Result<(), PlumeError> {
        let alone = water.flume.is_none() && water.bed.is_none();
        let CurrentSlot { field, area, terrain, seed } = *place;
        water.flume = Some(Flume::build(self, field, area, terrain, alone, seed)?);
        Ok(())
    }

    fn is_walled(&self) -> bool {
        true
    }

    fn carries_m_s(&self) -> Vector2<f64> {
        self.heading_deg.heading().unit() * self.mean_m_s.get()
    }

    fn cost(&self, area: &Area, depth_m: f64, _: f64, _: &Times) -> Cost {
        let eddies = self.eddies.as_ref();
        eddies.map_or_else(Cost::default, |e| e.cost(area, depth_m).under("eddies"))
    }
}

impl Listed for TideSpec {
    const ENTRY: Entry = Entry {
        name: "Tide",
        what: "Tidal current: ellipses of constituents, rotating or rectilinear",
        source: "Pugh 1987, Tides, Surges and Mean Sea-Level, section 6:4; Foreman 1978",
    };
}

impl CurrentParams for TideSpec {
    fn join(&self, water: &mut Water, place: &CurrentSlot) -> Result<(), PlumeError> {
        water.tides.push(self.build(place.field)?);
        Ok(())
    }

    fn is_steady(&self) -> bool {
        false
    }
}

impl Listed for WavesSpec {
    const ENTRY: Entry = Entry {
        name: "Waves",
        what: "Surface waves by linear theory, trains or a JONSWAP sea: orbits for hull and instruments, Stokes' drift and mixing for the plume",
        source: "Dean & Dalrymple 1991, Water Wave Mechanics; Hasselmann et al. 1973; Andrews & McIntyre 1978, J. Fluid Mech. 89, 609",
    };
}

impl CurrentParams for WavesSpec {
    fn join(&self, water: &mut Water, place: &CurrentSlot) -> Result<(), PlumeError> {
        if water.waves.is_some() {
            return place.wrong("only one Waves can move the surface; add the second one's trains to the first");
        }
        let depth_m = -water.ground.floor(place.area.centre).z;
        let waves = self.build(place.field, depth_m, place.seed)?;
        water.waves = Some(waves.with_phases_at(place.area.centre));
        Ok(())
    }

    fn waves(&self) -> f64 {
        self.count()
    }
}
