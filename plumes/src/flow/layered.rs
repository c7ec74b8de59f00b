//! Currents in layers of different density, with thin interfaces that rise and sink as internal waves pass.
//!
//! *Source*: the two-layer flow off Duck, Pang 2009, section 6; tanh profiles across an interface, Hazel 1972,
//! J. Fluid Mech. 51, 39; volume kept in each layer, Gill 1982, Atmosphere-Ocean Dynamics, section 6.2.
//!
//! *Parameters*: `layers` from the surface down: `speed_m_s`, `heading_deg`, `density_kg_m3`; `interfaces` between
//! them, from the top: mean `depth_m`, `thickness_m` (change divided by steepest gradient), `waves` of the height:
//! `amplitude_m`, `length_m`, `period_s`, `heading_deg` (where it travels), `phase_deg` (absent: drawn from the seed).
//!
//! *Deviations*: the paper says only that the interface's depth varies in place and time; the sum of travelling waves
//! is our choice. A wave of speed c towards e that thickens a layer by h′ sets the layer's water in motion by (c − U·e)
//! e h′/h, as continuity requires to first order in h′/h; so the layer's volume is conserved to second order. An
//! interface stays at least 2 % of the depth from bed, surface and the next interface, and follows the bed there.

mod column;

use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::limits::shown;
use world::ranges::{Finite, HeadingDeg, NonNegative, Positive};
use world::seeds::{Seed, Stream};

use crate::error::PlumeError;
use crate::flow::ground::Floor;
use crate::flow::number::{Number, along, still, times};

/// Fastest wave of an interface, m/s.
const FASTEST_M_S: f64 = 15.0;
/// Most layers of a water column; columns live on the stack.
pub const MAX_LAYERS: usize = 4;
const MAX_FACES: usize = MAX_LAYERS - 1;
/// Least distance of an interface from its neighbours, as a part of the depth.
const GAP: f64 = 0.02;

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

#[derive(Clone, Copy, Debug)]
struct Wave {
    amplitude: f64,
    k: Vector2<f64>,
    omega: f64,
    phase: f64,
    travels: Vector2<f64>,
    speed: f64,
}

#[derive(Clone, Debug)]
struct Face {
    z: f64,
    thickness: f64,
    waves: Vec<Wave>,
    reach: f64,
}

/// The layered current, ready to use.
#[derive(Clone, Debug)]
pub struct Layered {
    u: Vec<Vector2<f64>>,
    density: Vec<f64>,
    faces: Vec<Face>,
}

impl Layered {
    /// Whether no wave moves its interfaces.
    pub(crate) fn is_steady(&self) -> bool {
        self.faces.iter().all(|f| f.waves.is_empty())
    }

    /// With phases that are those at a place (east, north), and not at the datum: they must not depend on where that is.
    pub(crate) fn with_phases_at(mut self, place: Vector2<f64>) -> Self {
        for wave in self.faces.iter_mut().flat_map(|f| &mut f.waves) {
            wave.phase -= wave.k.dot(&place);
        }
        self
    }
}

impl LayeredSpec {
    /// The current, checked; absent phases come from the seed.
    ///
    /// # Errors
    /// Names the field: no layers or too many, the wrong number of interfaces, interfaces not in order of depth, or a
    /// density that does not increase downwards.
    pub fn build(&self, field: &str, seed: impl Into<Seed>) -> Result<Layered, PlumeError> {
        let bad = |sub: String, problem: String| PlumeError::Invalid { field: format!("{field}.{sub}"), problem };
        let n = self.layers.len();
        if n == 0 || n > MAX_LAYERS {
            let problem = format!("needs from 1 to {MAX_LAYERS} layers, got {n}");
            return Err(bad("layers".into(), problem));
        }
        if self.interfaces.len() != n - 1 {
            let got = self.interfaces.len();
            let problem = format!("{n} layers need {} interfaces, got {got}", n - 1);
            return Err(bad("interfaces".into(), problem));
        }
        for (i, pair) in self.layers.windows(2).enumerate() {
            let (upper, lower) = (pair[0].density_kg_m3.get(), pair[1].density_kg_m3.get());
            if upper > lower {
                return Err(bad(
                    format!("layers[{}].density_kg_m3", i + 1),
                    format!("must be >= {upper}, that of the layer above (lighter water floats), got {lower}"),
                ));
            }
        }
        for (i, pair) in self.interfaces.windows(2).enumerate() {
            let (upper, lower) = (pair[0].depth_m.get(), pair[1].depth_m.get());
            if lower <= upper {
                return Err(bad(
                    format!("interfaces[{}].depth_m", i + 1),
                    format!("must be > {upper}, that of the interface above, got {lower}"),
                ));
            }
        }
        for (i, face) in self.interfaces.iter().enumerate() {
            for (j, wave) in face.waves.iter().enumerate() {
                let field = format!("interfaces[{i}].waves[{j}].length_m");
                wave.check().map_err(|problem| bad(field, problem))?;
            }
        }
        let mut rng = Stream::new(seed, field, "interface phases");
        let faces = self.interfaces.iter().map(|f| f.build(&mut rng)).collect();
        Ok(Layered {
            u: (self.layers.iter()).map(|l| l.heading_deg.heading().unit() * l.speed_m_s.get()).collect(),
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
    fn build(&self, rng: &mut Stream) -> Face {
        let waves = self.waves.iter().map(|w| {
            // Drawn even if it is not used, so that giving one phase does not change another.
            let drawn = rng.uniform() * std::f64::consts::TAU;
            let travels = w.heading_deg.heading().unit();
            let (length, period) = (w.length_m.get(), w.period_s.get());
            Wave {
                amplitude: w.amplitude_m.get(),
                k: travels * (std::f64::consts::TAU / length),
                omega: std::f64::consts::TAU / period,
                phase: w.phase_deg.map_or(drawn, |p| p.get().to_radians()),
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

/// Height of a surface that the water follows: level, slope and rate of rise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheet<N = f64> {
    /// Height, m.
    pub z: N,
    /// Slope (east, north).
    pub slope: Vector2<N>,
    /// Rate of rise at a fixed place, m/s.
    pub rate: N,
}

impl<N: Number> Sheet<N> {
    /// A level surface at rest.
    pub(super) fn level(z: f64) -> Self {
        Self { z: z.into(), slope: still(Vector2::zeros()), rate: 0.0.into() }
    }
}

/// Velocity and density at one height, with their vertical gradients.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Profile {
    /// Horizontal velocity, m/s.
    pub u: Vector2<f64>,
    /// Its vertical gradient, 1/s.
    pub du_dz: Vector2<f64>,
    /// Density, kg/m³.
    pub density: f64,
    /// Its vertical gradient, kg/m⁴ (never positive).
    pub drho_dz: f64,
}

/// The layers at one place and time.
#[derive(Clone, Copy, Debug)]
pub struct LayeredColumn<'a, N = f64> {
    of: &'a Layered,
    u: [Vector2<N>; MAX_LAYERS],
    faces: [Sheet<N>; MAX_FACES],
}

impl Layered {
    /// The layers over the floor at (east, north) `p` and time `t_s`.
    pub fn column<N: Number>(&self, p: Vector2<N>, floor: &Floor<N>, t_s: N) -> LayeredColumn<'_, N> {
        let mut column =
            LayeredColumn { of: self, u: [still(Vector2::zeros()); MAX_LAYERS], faces: [Sheet::level(0.0); MAX_FACES] };
        for (u, mean) in column.u.iter_mut().zip(&self.u) {
            *u = still(*mean);
        }
        let mut ceiling = N::from(0.0);
        for (i, face) in self.faces.iter().enumerate() {
            // Mean thicknesses, at least twice the reach of the waves, so that a thin layer does not get too fast.
            let below = (self.faces.get(i + 1)).map_or(floor.z, |f| N::from(f.z));
            let above = if i == 0 { 0.0 } else { self.faces[i - 1].z };
            let least = N::from(2.0 * face.reach).greatest(-floor.z * GAP);
            let h_up = N::from(above - face.z).greatest(least);
            let h_low = (N::from(face.z) - below).greatest(least);
            let mut sheet = Sheet::level(face.z);
            for w in &face.waves {
                let (s, c) = (along(w.k, p) - t_s * w.omega + w.phase).sin_cos();
                let rise = s * w.amplitude;
                sheet.z += rise;
                sheet.slope += times(w.k, c * w.amplitude);
                sheet.rate -= c * (w.omega * w.amplitude);
                let (up, low) = (self.u[i].dot(&w.travels), self.u[i + 1].dot(&w.travels));
                column.u[i] -= times(w.travels, rise * (w.speed - up) / h_up);
                column.u[i + 1] += times(w.travels, rise * (w.speed - low) / h_low);
            }
            // Room for this interface and those below it.
            let lowest = 1.0 - GAP * (self.faces.len() - i) as f64;
            let highest = ceiling + GAP;
            let part = if sheet.z.value() < lowest * floor.z.value() {
                Some(N::from(lowest))
            } else if sheet.z.value() > (highest * floor.z).value() {
                Some(highest)
            } else {
                None
            };
            if let Some(part) = part {
                sheet = Sheet { z: part * floor.z, slope: floor.slope * part, rate: 0.0.into() };
            }
            ceiling = sheet.z / floor.z;
            column.faces[i] = sheet;
        }
        column
    }
}
