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

use nalgebra::Vector2;

use crate::flow::ground::Floor;
use crate::flow::number::{Number, along, still, times};

/// Most layers of a water column; columns live on the stack.
pub const MAX_LAYERS: usize = 4;
const MAX_FACES: usize = MAX_LAYERS - 1;
/// Least distance of an interface from its neighbours, as a part of the depth.
const GAP: f64 = 0.02;

/// A wave of an interface's height.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wave {
    pub(super) amplitude: f64,
    pub(super) k: Vector2<f64>,
    pub(super) omega: f64,
    pub(super) phase: f64,
    pub(super) travels: Vector2<f64>,
    pub(super) speed: f64,
}

/// An interface between two layers.
#[derive(Clone, Debug)]
pub(super) struct Face {
    pub(super) z: f64,
    pub(super) thickness: f64,
    pub(super) waves: Vec<Wave>,
    pub(super) reach: f64,
}

/// The layered current, ready to use.
#[derive(Clone, Debug)]
pub struct Layered {
    pub(super) u: Vec<Vector2<f64>>,
    pub(super) density: Vec<f64>,
    pub(super) faces: Vec<Face>,
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
    pub(super) of: &'a Layered,
    pub(super) u: [Vector2<N>; MAX_LAYERS],
    pub(super) faces: [Sheet<N>; MAX_FACES],
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
