//! Layers as a scenario asks for them.

use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::catalogue::Entry;
use world::limits::shown;
use world::ranges::{Finite, HeadingDeg, NonNegative, Positive};
use world::registry::Listed;
use world::seeds::Stream;

use super::layers::{Face, Layered, MAX_LAYERS, Wave};
use crate::error::PlumeError;
use crate::flow::current::{CurrentParams, CurrentSlot};
use crate::flow::free_water::FreeWater;
use crate::flow::grid::{CurrentScales, InterfaceScale};

/// Fastest wave of an interface, m/s.
const FASTEST_M_S: f64 = 15.0;

/// Layers and the interfaces between them, from the surface down.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LayeredSpec {
    /// One to four layers, top first.
    pub layers: Vec<LayerSpec>,
    /// One fewer than there are layers, top first.
    #[serde(default)]
    pub interfaces: Vec<InterfaceSpec>,
}

/// One layer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "WaterLayer")]
#[serde(deny_unknown_fields)]
pub struct LayerSpec {
    /// Speed over ground, m/s.
    #[serde(with = "world::limits::stream_m_s")]
    pub speed_m_s: NonNegative,
    /// Where the layer's water goes, degrees clockwise from north.
    pub heading_deg: HeadingDeg,
    /// Density, kg/m³.
    #[serde(with = "world::limits::density_kg_m3")]
    pub density_kg_m3: Positive,
}

/// One interface.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InterfaceSpec {
    /// Mean depth, m.
    #[serde(with = "world::limits::depth_m")]
    pub depth_m: Positive,
    /// Thickness, m: the change across the interface divided by the steepest gradient in it.
    #[serde(with = "world::limits::depth_m")]
    pub thickness_m: Positive,
    /// Waves of its height, summed.
    #[serde(default)]
    pub waves: Vec<WaveSpec>,
}

/// One travelling wave of an interface's height.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "InternalWave")]
#[serde(deny_unknown_fields)]
pub struct WaveSpec {
    /// Half the height from trough to crest, m.
    #[serde(with = "world::limits::internal_m")]
    pub amplitude_m: NonNegative,
    /// Wave length, m.
    #[serde(with = "world::limits::internal_length_m")]
    pub length_m: Positive,
    /// Period at a fixed place, s.
    #[serde(with = "world::limits::internal_s")]
    pub period_s: Positive,
    /// Where the wave travels, degrees clockwise from north.
    pub heading_deg: HeadingDeg,
    /// Phase at the area's centre at time zero, degrees; drawn from the seed if absent.
    #[serde(default)]
    pub phase_deg: Option<Finite>,
}

impl Listed for LayeredSpec {
    const ENTRY: Entry = Entry {
        name: "Layered",
        what: "Layers of different density and velocity with interfaces that rise and sink",
        source: "Pang 2009, section 6 (Duck); Hazel 1972, J. Fluid Mech. 51, 39; Gill 1982, section 6.2",
    };
}

impl CurrentParams for LayeredSpec {
    fn join(&self, water: &mut FreeWater, place: &CurrentSlot) -> Result<(), PlumeError> {
        if water.layers.is_some() {
            return place.wrong(
                "only one Layered current can fix the water's layers; add the second one's layers to the first",
            );
        }
        water.layers = Some(self.build(place)?);
        Ok(())
    }

    fn is_steady(&self) -> bool {
        self.interfaces.iter().all(|f| f.waves.is_empty())
    }

    /// The slowest layer holds filaments longest.
    fn carries_m_s(&self) -> Vector2<f64> {
        (self.layers.iter()).map(LayerSpec::velocity).min_by(|a, b| a.norm().total_cmp(&b.norm())).unwrap_or_default()
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

impl LayerSpec {
    /// (east, north), m/s.
    fn velocity(&self) -> Vector2<f64> {
        self.heading_deg.heading().unit() * self.speed_m_s.get()
    }
}

impl LayeredSpec {
    /// The layers, checked; absent phases come from the seed.
    ///
    /// # Errors
    /// Names the field: no layers or too many, the wrong number of interfaces, interfaces not in order of depth, or a
    /// density that does not increase downwards.
    fn build(&self, place: &CurrentSlot) -> Result<Layered, PlumeError> {
        let field = place.field;
        let n = self.layers.len();
        if n == 0 || n > MAX_LAYERS {
            let problem = format!("needs from 1 to {MAX_LAYERS} layers, got {n}");
            return Err(PlumeError::new(format!("{field}.layers"), problem));
        }
        if self.interfaces.len() != n - 1 {
            let got = self.interfaces.len();
            let problem = format!("{n} layers need {} interfaces, got {got}", n - 1);
            return Err(PlumeError::new(format!("{field}.interfaces"), problem));
        }
        for (i, pair) in self.layers.windows(2).enumerate() {
            let (upper, lower) = (pair[0].density_kg_m3.get(), pair[1].density_kg_m3.get());
            if upper > lower {
                let problem =
                    format!("must be >= {upper}, that of the layer above (lighter water floats), got {lower}");
                return Err(PlumeError::new(format!("{field}.layers[{}].density_kg_m3", i + 1), problem));
            }
        }
        for (i, pair) in self.interfaces.windows(2).enumerate() {
            let (upper, lower) = (pair[0].depth_m.get(), pair[1].depth_m.get());
            if lower <= upper {
                let problem = format!("must be > {upper}, that of the interface above, got {lower}");
                return Err(PlumeError::new(format!("{field}.interfaces[{}].depth_m", i + 1), problem));
            }
        }
        for (i, face) in self.interfaces.iter().enumerate() {
            for (j, wave) in face.waves.iter().enumerate() {
                let at = || format!("{field}.interfaces[{i}].waves[{j}].length_m");
                wave.check().map_err(|problem| PlumeError::new(at(), problem))?;
            }
        }
        let mut rng = Stream::new(place.seed, field, "interface phases");
        let faces = self.interfaces.iter().map(|f| f.build(&mut rng, place.area.centre)).collect();
        Ok(Layered {
            u: self.layers.iter().map(LayerSpec::velocity).collect(),
            density: self.layers.iter().map(|l| l.density_kg_m3.get()).collect(),
            faces,
        })
    }
}

impl WaveSpec {
    /// Checks that the wave is no steeper than 45° and no faster than water can be; otherwise it could not keep its
    /// shape.
    fn check(&self) -> Result<(), String> {
        let (length, period) = (self.length_m.get(), self.period_s.get());
        let least = std::f64::consts::TAU * self.amplitude_m.get();
        let most = FASTEST_M_S * period;
        if length >= least && length <= most {
            return Ok(());
        }
        Err(format!(
            "must be from {} (a slope of 45 degrees) to {} m ({FASTEST_M_S} m/s), got {}",
            shown(least),
            shown(most),
            shown(length)
        ))
    }
}

impl InterfaceSpec {
    /// Phases are those at a place (east, north), and not at the datum: they must not depend on where that is.
    fn build(&self, rng: &mut Stream, place: Vector2<f64>) -> Face {
        let waves = self.waves.iter().map(|w| {
            // Drawn even if it is not used, so that giving one phase does not change another.
            let drawn = rng.uniform() * std::f64::consts::TAU;
            let travels = w.heading_deg.heading().unit();
            let (length, period) = (w.length_m.get(), w.period_s.get());
            let k = travels * (std::f64::consts::TAU / length);
            Wave {
                amplitude: w.amplitude_m.get(),
                k,
                omega: std::f64::consts::TAU / period,
                phase: w.phase_deg.map_or(drawn, |p| p.get().to_radians()) - k.dot(&place),
                travels,
                speed: length / period,
            }
        });
        Face {
            z: -self.depth_m.get(),
            thickness: self.thickness_m.get(),
            waves: waves.collect(),
            reach: self.waves.iter().map(|w| w.amplitude_m.get()).sum(),
        }
    }
}
