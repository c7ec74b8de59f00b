//! Eddies that move with the stream, live for their turn-over time, and carry filaments.
//!
//! *Source*: kinematic simulation (file `stretch`) in a frame that moves with the mean of the stream (Taylor 1938,
//! Proc. R. Soc. A 164, 476: frozen turbulence moves with the mean); turn-over time k/ε (Pope 2000, Turbulent Flows,
//! section 6.1) from Nezu & Nakagawa's depth means.
//!
//! *Parameters*: `cells_a_depth`, nodes of the eddies' grid from bed to surface. The shortest wave is four cells long:
//! 16 gives H/4, 5 cm in 20 cm of water. All else follows from the channel.
//!
//! *Deviations*: two patches of one long stretch, taken at random places and mirrored at random, overlap with the
//! weights sin and cos. Each lives for two periods T, and the sum of the squared weights is always 1. The correlation
//! in the moving frame then has the integral time 8T/π² = k/ε. It is the same for eddies of all sizes, although small
//! ones live shorter in reality: a filament is decorrelated from them because large ones, and shear, sweep it through
//! them. For each channel, all seeds take their patches from one stretch of 32 depths, drawn once per process; the
//! water of a run follows from its seed alone. So runs of different seeds share the eddies of that stretch, and what
//! depends on single eddies, such as a tracker's rate of success, differs between stretches by more than an interval
//! over seeds says; with `own` each run draws a stretch. The patches move with the depth mean at all heights.

use super::eddy_field::{ChannelAxes, EddyField, Patch};
use super::lazy_stretch::LazyStretch;
use super::overlapping;
use super::small::{self, Small, SmallSpec};
use super::spectrum::Spectrum;
use super::stretch::{CELLS_A_WAVE, LENGTH, Shape};
use crate::error::PlumeError;
use crate::flow::channel::Channel;
use crate::simd::dispatch::InstructionSet;
use nalgebra::{Vector2, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::Arc;
use world::area::Area;
use world::cost::{Cost, Part};
use world::fields::WaterSample;
use world::seeds::{Seed, Stream};

/// How finely turbulence is resolved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct EddiesSpec {
    /// Cells of the eddies' grid from bed to surface, from 8 to 32.
    pub cells_a_depth: u32,
    /// Whether each run draws eddies of its own, in a third of a second. Otherwise all runs share one drawn stretch, and
    /// a seed chooses places in it.
    pub own: bool,
    /// Smaller eddies, which carry filaments and nothing else; without them they are diffusivity.
    pub small: Option<SmallSpec>,
}

impl Default for EddiesSpec {
    fn default() -> Self {
        Self { cells_a_depth: 16, own: false, small: None }
    }
}

/// The eddies of a channel.
#[derive(Clone, Debug)]
pub struct Eddies {
    centre: Vector2<f64>,
    along: Vector2<f64>,
    left: Vector2<f64>,
    half_width_m: f64,
    mean_m_s: f64,
    u_star_m_s: f64,
    /// T, s.
    period_s: f64,
    seed: Seed,
    path: InstructionSet,
    shape: Shape,
    stretch: Arc<LazyStretch>,
    small: Option<Arc<Small>>,
}

/// Memory of a node while it is drawn, bytes.
const NODE_BYTES: f64 = 40.0;
/// Time to draw a node, s.
const NODE_S: f64 = 400e-9;

impl EddiesSpec {
    /// The eddies of a channel in an area, checked.
    ///
    /// # Errors
    /// If the grid is too coarse or too fine, if the stream is not along the area's axis, or if the channel is narrower
    /// than deep.
    pub fn build(&self, field: &str, area: &Area, channel: &Channel, seed: Seed) -> Result<Eddies, PlumeError> {
        let field = format!("{field}.eddies");
        if !(8..=32).contains(&self.cells_a_depth) {
            let problem = format!("must be from 8 to 32, got {}", self.cells_a_depth);
            return Err(PlumeError::new(format!("{field}.cells_a_depth"), problem));
        }
        let ratio = area.width_m / channel.depth_m;
        if !(2.0..=20.0).contains(&ratio) {
            let problem = format!(
                "resolved eddies need a channel from 2 to 20 times as wide as deep; the area is {} m wide, the water {} m deep",
                area.width_m, channel.depth_m
            );
            return Err(PlumeError::new(field, problem));
        }
        let cell = channel.depth_m / f64::from(self.cells_a_depth);
        let shape = Shape {
            width_m: area.width_m,
            depth_m: channel.depth_m,
            spectrum: Spectrum::new(channel, CELLS_A_WAVE * cell),
            up: self.cells_a_depth as usize,
            across: (area.width_m / cell).round() as usize,
        };
        let small = (self.small.as_ref())
            .map(|s| s.build(&format!("{field}.small"), channel, shape.spectrum.k_c, seed))
            .transpose()?;
        let energy = channel.mean_of(|z| channel.energy(z));
        let dissipation = channel.mean_of(|z| channel.dissipation(z));
        let pi = std::f64::consts::PI;
        Ok(Eddies {
            centre: area.centre,
            along: channel.along,
            left: Vector2::new(-channel.along.y, channel.along.x),
            half_width_m: area.width_m / 2.0,
            mean_m_s: channel.mean_m_s,
            u_star_m_s: channel.u_star_m_s,
            period_s: pi * pi / 8.0 * energy / dissipation,
            seed,
            path: InstructionSet::detect(),
            stretch: Arc::new(LazyStretch::new(shape, self.own.then_some(seed))),
            small: small.map(Arc::new),
            shape,
        })
    }
}

/// Does something on a thread of its own. Without the thread it is done when its result is first asked for.
fn beside(work: impl FnOnce() + Send + 'static) {
    let begun = std::thread::Builder::new().name("eddies".to_owned());
    drop(begun.spawn(work));
}

impl EddiesSpec {
    /// What the eddies need in a channel as wide as the area.
    pub fn cost(&self, area: &Area, depth_m: f64) -> Cost {
        let up = f64::from(self.cells_a_depth);
        let across = (area.width_m / depth_m * up).round();
        let nodes = LENGTH as f64 * (across + 1.0) * (up + 1.0);
        let part = Part::new("cells_a_depth", format!("{nodes:.1e} nodes of the eddies"))
            .holds(nodes * NODE_BYTES)
            .takes(nodes * NODE_S)
            .by(up, 2.0);
        let mut cost = Cost::single(part);
        if self.small.is_some() {
            cost.add(small::cost().under("small"));
        }
        cost
    }
}

impl Eddies {
    /// The eddies below the grid, if they are resolved.
    pub fn small(&self) -> Option<&Arc<Small>> {
        self.small.as_ref()
    }

    /// Greatest wave number that carries filaments, 1/m.
    pub(crate) fn finest(&self) -> f64 {
        self.small.as_ref().map_or(self.shape.spectrum.k_c, |s| s.k_f)
    }

    /// Draws them with so many threads; the eddies are the same with any number. With more than one, it begins at once
    /// beside its caller.
    pub(crate) fn use_threads(&self, n: usize) {
        self.stretch.use_threads(n);
        if n > 1 {
            let stretch = Arc::clone(&self.stretch);
            beside(move || {
                stretch.nodes();
            });
            if self.small.is_some() {
                beside(Small::draw);
            }
        }
    }

    /// The spectrum of the eddies.
    pub fn spectrum(&self) -> &Spectrum {
        &self.shape.spectrum
    }

    /// Expected intensities (along, across, up) at a height above the bed, m/s, averaged over the width.
    pub fn intensities(&self, height_m: f64) -> [f64; 3] {
        self.shape.expected(height_m).map(|v| v * self.u_star_m_s)
    }

    /// Integral time in the frame that moves with the stream, s.
    pub fn turn_over_s(&self) -> f64 {
        self.period_s * 8.0 / (std::f64::consts::PI * std::f64::consts::PI)
    }

    /// Velocity at a place (ENU, m), m/s; beyond walls, bed or surface, the velocity at them.
    pub fn velocity(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
        let d = p.xy() - self.centre;
        let now = self.now(t_s);
        let v = now.velocity([d.dot(&self.along), d.dot(&self.left), p.z].map(|v| v as f32));
        let [u, v, w] = v.map(f64::from);
        let plane = self.along * u + self.left * v;
        Vector3::new(plane.x, plane.y, w)
    }

    /// Adds velocity, gradient and rate of change at a place to those of the rest of the water.
    pub(crate) fn add_to(&self, sample: &mut WaterSample, p: &Vector3<f64>, t_s: f64) {
        // Large compared with rounding in f32, small compared with the cells in which the eddies are linear.
        const WIDE: f64 = 2e-3;
        let at = |q: Vector3<f64>, dt: f64| self.velocity(&(p + q), t_s + dt);
        sample.velocity += at(Vector3::zeros(), 0.0);
        for d in 0..3 {
            let mut e = Vector3::zeros();
            e[d] = WIDE;
            let slope = (at(e, 0.0) - at(-e, 0.0)) / (2.0 * WIDE);
            sample.gradient.set_column(d, &(sample.gradient.column(d) + slope));
        }
        // The eddies move with the stream: in a tenth of a second, by some millimetres.
        const WHILE: f64 = 0.1;
        sample.rate += (at(Vector3::zeros(), WHILE) - at(Vector3::zeros(), 0.0)) / WHILE;
    }

    /// Carries places from `t_s - dt_s` to `t_s`, the n-th for `dt_s[n]`: see [`Flow::carry`].
    ///
    /// [`Flow::carry`]: world::fields::Flow::carry
    pub fn carry(&self, t_s: f64, dt_s: &[f32], datum: Vector2<f64>, [x, y, z]: [&mut [f32]; 3]) {
        let turned = ChannelAxes {
            centre: (self.centre - datum).map(|v| v as f32),
            along: self.along.map(|v| v as f32),
            left: self.left.map(|v| v as f32),
        };
        self.now(t_s).carry(self.path, &turned, dt_s, [x, y, z]);
    }

    #[cfg(test)]
    pub(super) fn with_seed(&self, seed: impl Into<Seed>) -> Self {
        Self { seed: seed.into(), ..self.clone() }
    }

    #[cfg(test)]
    pub(super) fn shape(&self) -> &Shape {
        &self.shape
    }

    fn now(&self, t_s: f64) -> EddyField<'_> {
        let h = self.shape.spacing();
        let of = |(life, weight): (f64, f64)| {
            let mut rng = Stream::new(self.seed, "eddies", &format!("patch {life}"));
            let begin = rng.uniform() * LENGTH as f64 + self.mean_m_s * t_s / h[0];
            Patch {
                begin: begin.rem_euclid(LENGTH as f64) as f32,
                mirrored: rng.uniform() < 0.5,
                weight: (weight * self.u_star_m_s) as f32,
            }
        };
        EddyField {
            nodes: self.stretch.nodes(),
            across: self.shape.across,
            up: self.shape.up,
            per_m: h.map(|h| (1.0 / h) as f32),
            half_width: self.half_width_m as f32,
            depth: self.shape.depth_m as f32,
            patches: overlapping(t_s / self.period_s).map(of),
        }
    }
}
