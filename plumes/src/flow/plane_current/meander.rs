//! Slow fluctuation of the whole current: coloured noise at the area's corners, transported inside, free of divergence.
//!
//! *Source*: Farrell et al. 2002, Environ. Fluid Mech. 2, 143: noise at the four corners, linear along the
//! edges; inside ∂u/∂t = −(U + u)·∇u + ½K∇²u for both components.
//!
//! *Parameters*: σ `std_m_s` (m/s, of a component at a corner; Farrell's G = 2 gives 1.4), ω `omega_rad_s`
//! (Farrell 0.2), ζ `damping` (Farrell 0.1), `cell_m` (Farrell 5 of 100), K `diffusivity_m2_s`.
//!
//! *Deviations*: (1) Farrell's field converges and diverges, so an even tracer would not stay even. Here the nearest
//! divergence-free field is used (file `solenoidal`). On a square, the rms over the area falls from 0.67 σ, which
//! linear edges leave of σ, to 0.63 σ. (2) If K is absent, it is 2ω(W/2)², W the shorter side, so that noise reaches
//! the middle within its period; carried at centimetres per second it would die out near the edge. (3) Steps of 0.1/ω,
//! implicit along one axis and then the other (stable at any step). K is raised to |u|h where advection would make the
//! grid oscillate (Spalding 1972). Velocities are linear in time between levels. (4) U is the depth mean of the other
//! currents at the area's centre. (5) Outside the area, the value at the nearest edge applies.

use std::collections::VecDeque;
use std::sync::Arc;

use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::area::Area;
use world::catalogue::Entry;
use world::cost::{Cost, Part, Times};
use world::ranges::{NonNegative, Positive};
use world::registry::Listed;
use world::seeds::{Seed, Stream};

use crate::error::PlumeError;
use crate::flow::coloured_noise::{ColouredNoise, NoiseStep};
use crate::flow::current::{CurrentParams, CurrentSlot};
use crate::flow::free_water::FreeWater;
use crate::flow::number::{Jet, Number, along, times};
use crate::flow::plane_current::PlaneCurrent;
use crate::flow::solenoidal::Solenoidal;

/// Farrell's wind grid as a meander of the water.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeanderSpec {
    /// Standard deviation of each velocity component at the corners, m/s.
    #[serde(with = "world::limits::std_m_s")]
    pub std_m_s: NonNegative,
    /// Natural frequency of the noise, rad/s.
    #[serde(default = "farrell_omega", with = "world::limits::wander_rad_s")]
    pub omega_rad_s: Positive,
    /// Damping ratio of the noise, in (0, 1).
    #[serde(default = "farrell_damping", with = "world::limits::damping")]
    pub damping: Positive,
    /// Wanted spacing of the grid, m.
    pub cell_m: Positive,
    /// Diffusivity K of the velocity, m²/s; if absent, 2ω(W/2)², W the area's shorter side.
    #[serde(default, with = "world::limits::diffusivity_m2_s::<Option<NonNegative>>")]
    pub diffusivity_m2_s: Option<NonNegative>,
}

const fn farrell_omega() -> Positive {
    Positive::new(0.2)
}

const fn farrell_damping() -> Positive {
    Positive::new(0.1)
}

/// Most cells along a side; the cost of the projection grows with their cube.
const MOST_CELLS: f64 = 100.0;
/// Steps per radian of the noise.
const STEPS_PER_RADIAN: f64 = 10.0;
/// Steps before time zero, during which the inside forgets that it began as the mean of the corners.
const PRE_ROLL: usize = 200;
/// Farther than this from the latest `advance`, the value is held constant, s.
const AHEAD_S: f64 = 5.0;
const BEHIND_S: f64 = 1.0;
/// Time of a multiplication in the projection, s.
const MULTIPLY_S: f64 = 0.5e-9;
/// Time of a step of a node, s.
const STEP_S: f64 = 100e-9;

/// The meander, ready to use.
#[derive(Clone, Debug)]
pub struct Meander {
    centre: Vector2<f64>,
    // Unit vectors (east, north) along and across, and half the extents, so that questions need no trigonometry.
    axes: [Vector2<f64>; 2],
    half: Vector2<f64>,
    /// Copies of the water share it.
    grid: Arc<Solenoidal>,
    carried: FarrellField,
    dt_s: f64,
    // Stream functions at times (first + k)·dt.
    levels: VecDeque<Vec<f64>>,
    first: u64,
}

/// Farrell's field itself, before projection, in the area's axes.
#[derive(Clone, Debug)]
struct FarrellField {
    cells: [usize; 2],
    h: [f64; 2],
    dt: f64,
    half_k: f64,
    mean: Vector2<f64>,
    step: NoiseStep,
    // Components along and across at each corner: (0, 0), (0, 1), (1, 0), (1, 1).
    corners: [[ColouredNoise; 2]; 4],
    u: Vec<Vector2<f64>>,
}

impl MeanderSpec {
    /// The meander over the area, transported by a mean current (east, north).
    ///
    /// # Errors
    /// Names the field: damping not below 1, or a grid too fine.
    pub fn build(&self, field: &str, area: &Area, carrier: Vector2<f64>, seed: Seed) -> Result<Meander, PlumeError> {
        let (omega, damping) = (self.omega_rad_s.get(), self.damping.get());
        if damping >= 1.0 {
            let problem = format!("must be > 0 and < 1 (an oscillation), got {damping}");
            return Err(PlumeError::new(format!("{field}.damping"), problem));
        }
        let extent = [area.length_m, area.width_m];
        let least = extent[0].max(extent[1]) / MOST_CELLS;
        if self.cell_m.get() < least {
            let problem = format!(
                "must be >= {least} ({MOST_CELLS} cells along the area's longer side), got {}",
                self.cell_m.get()
            );
            return Err(PlumeError::new(format!("{field}.cell_m"), problem));
        }
        // At least two cells, so that there is an inside.
        let cells = extent.map(|e| ((e / self.cell_m.get()).ceil() as usize).max(2));
        let h = [0, 1].map(|d| extent[d] / cells[d] as f64);
        let half_k = self.diffusivity_m2_s.map_or_else(
            || {
                let reach = extent[0].min(extent[1]) / 2.0;
                omega * reach * reach
            },
            |k| k.get() / 2.0,
        );
        let dt = 1.0 / (STEPS_PER_RADIAN * omega);
        let step = NoiseStep::new(self.std_m_s.get(), omega, damping, dt);
        let corners = std::array::from_fn(|c| {
            ["along", "across"].map(|axis| {
                let rng = Stream::new(seed, field, &format!("corner {c} {axis}"));
                ColouredNoise::stationary(&step, rng)
            })
        });
        let turned = area.local(area.centre + carrier);
        let mut carried = FarrellField {
            cells,
            h,
            dt,
            half_k,
            mean: turned,
            step,
            corners,
            u: vec![Vector2::zeros(); (cells[0] + 1) * (cells[1] + 1)],
        };
        for k in 0..carried.u.len() {
            carried.u[k] = carried.edge(k / (cells[1] + 1), k % (cells[1] + 1));
        }
        for _ in 0..PRE_ROLL {
            carried.advance();
        }
        let grid = Arc::new(Solenoidal::new(cells, h));
        let now = grid.project(&carried.u);
        let mut meander = Meander {
            centre: area.centre,
            axes: [Vector2::x(), Vector2::y()].map(|e| area.world(e) - area.centre),
            half: Vector2::from(extent) / 2.0,
            grid,
            carried,
            dt_s: dt,
            levels: VecDeque::from([now]),
            first: 0,
        };
        meander.advance(0.0);
        Ok(meander)
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
    fn join(&self, water: &mut FreeWater, place: &CurrentSlot) -> Result<(), PlumeError> {
        water.add(self.build(place.field, place.area, place.carrier, place.seed)?);
        Ok(())
    }

    fn is_carried(&self) -> bool {
        true
    }

    fn cost(&self, area: &Area, _: f64, ahead_s: f64, times: &Times) -> Cost {
        let extent = [area.length_m, area.width_m];
        let cells = extent.map(|e| (e / self.cell_m.get()).ceil().max(2.0));
        let splines = (cells[0] + 2.0) * (cells[1] + 2.0);
        let band = 2.0 * (cells[1] + 2.0) + 2.0;
        let (omega, ahead_s) = (self.omega_rad_s.get(), ahead_s + AHEAD_S + BEHIND_S);
        let a_second = STEPS_PER_RADIAN * omega;
        let levels = ahead_s * a_second + 3.0;
        let matrix = Part::new("cell_m", format!("{splines:.0} splines"))
            .holds(splines * (band + 1.0) * 8.0)
            .takes(splines * band * band * MULTIPLY_S)
            .by(self.cell_m.get(), -3.0);
        let steps = times.whole_s() * a_second + PRE_ROLL as f64;
        let kept = Part::new("omega_rad_s", format!("{a_second:.3} levels a second"))
            .holds(levels * splines * 8.0)
            .takes(steps * splines * (4.0 * band * MULTIPLY_S + STEP_S))
            .by(omega, 1.0);
        Cost { parts: vec![matrix, kept] }
    }
}

impl PlaneCurrent for Meander {
    fn velocity(&self, p: Vector2<f64>, t_s: f64) -> Vector2<f64> {
        self.at(p, t_s)
    }

    fn with_slopes(&self, p: Vector2<Jet>, t_s: Jet) -> Vector2<Jet> {
        self.at(p, t_s)
    }

    /// Makes the levels that questions about times near `t_s` need.
    fn advance(&mut self, t_s: f64) {
        let last = ((t_s + AHEAD_S) / self.dt_s).ceil() as u64;
        let needed = ((t_s - BEHIND_S) / self.dt_s).floor().max(0.0) as u64;
        while self.first + (self.levels.len() as u64) <= last {
            self.carried.advance();
            // A level that nobody will ask about is not worked out, so a long way ahead needs no more time or memory for
            // levels than a short one.
            let new = self.first + self.levels.len() as u64;
            if new < needed {
                self.levels.clear();
                self.first = new + 1;
            } else {
                self.levels.push_back(self.grid.project(&self.carried.u));
            }
        }
        while self.first < needed && self.levels.len() > 2 {
            self.levels.pop_front();
            self.first += 1;
        }
    }
}

impl Meander {
    /// Velocity at (east, north), m/s.
    pub fn at<N: Number>(&self, p: Vector2<N>, t_s: N) -> Vector2<N> {
        let last = N::from((self.levels.len() - 1) as f64);
        let at = (t_s / self.dt_s - self.first as f64).within(N::from(0.0), last);
        let k = (at.value() as usize).min(self.levels.len() - 2);
        let d = Vector2::new(p.x - self.centre.x, p.y - self.centre.y);
        let local = |n: usize| along(self.axes[n], d) + self.half[n];
        let u =
            self.grid.velocity(Vector2::new(local(0), local(1)), [&self.levels[k], &self.levels[k + 1]], at - k as f64);
        times(self.axes[0], u.x) + times(self.axes[1], u.y)
    }
}

impl FarrellField {
    /// Value at an edge node, linear between the corners (at the start, at an inner node too).
    fn edge(&self, i: usize, j: usize) -> Vector2<f64> {
        let f = i as f64 / self.cells[0] as f64;
        let g = j as f64 / self.cells[1] as f64;
        let c = |k: usize| Vector2::new(self.corners[k][0].value(), self.corners[k][1].value());
        (c(0) * (1.0 - g) + c(1) * g) * (1.0 - f) + (c(2) * (1.0 - g) + c(3) * g) * f
    }

    fn advance(&mut self) {
        for c in self.corners.iter_mut().flatten() {
            c.advance(&self.step);
        }
        let [mx, my] = self.cells;
        let inner = my + 1;
        let carrier: Vec<_> = self.u.iter().map(|u| u + self.mean).collect();
        for i in 0..=mx {
            for j in 0..=my {
                if i == 0 || i == mx || j == 0 || j == my {
                    self.u[i * inner + j] = self.edge(i, j);
                }
            }
        }
        self.sweep(&carrier, 0, [1, my - 1], [inner, 1]);
        self.sweep(&carrier, 1, [inner, mx - 1], [1, inner]);
    }

    /// Implicit step along so many neighbouring grid lines (Thomas's algorithm) with given ends. The first begins at
    /// node `start`; the strides are from node to node in a line, and from line to line. No line waits for another, so
    /// the processor works on several at once.
    fn sweep(&mut self, carrier: &[Vector2<f64>], axis: usize, [start, lines]: [usize; 2], [stride, next]: [usize; 2]) {
        let (n, h) = (self.cells[axis], self.h[axis]);
        let mut upper = vec![0.0; n * lines];
        for k in 1..n {
            let (before, now) = upper[(k - 1) * lines..].split_at_mut(lines);
            for (line, (before, now)) in before.iter().zip(now).enumerate() {
                let at = start + k * stride + line * next;
                let a = carrier[at][axis];
                let d = self.half_k.max(0.5 * a.abs() * h) * self.dt / (h * h);
                let c = 0.5 * a * self.dt / h;
                // −(d + c) u_{k−1} + (1 + 2d) u_k − (d − c) u_{k+1} = old u_k; the two ends are known.
                let pivot = 1.0 + 2.0 * d - (d + c) * before;
                *now = (d - c) / pivot;
                self.u[at] = (self.u[at] + self.u[at - stride] * (d + c)) / pivot;
            }
        }
        for k in (1..n).rev() {
            for (line, upper) in upper[k * lines..(k + 1) * lines].iter().enumerate() {
                let at = start + k * stride + line * next;
                self.u[at] = self.u[at] + self.u[at + stride] * *upper;
            }
        }
    }
}

#[cfg(test)]
mod tests;
