//! Source map by a particle filter: possible source positions, weighted by detections and non-detections.
//!
//! *Source*: Li, Meng, Wang & Zeng 2011 (Autonomous Robots 30(3)); roughening: Gordon, Salmond & Smith 1993, eq. 15;
//! systematic resampling: Kitagawa 1996.
//!
//! *Parameters*: particles, 1000; `roughening` K, 0.2 (Gordon's); the filter resamples when the effective number of
//! particles falls below `resample_below`, 0.5 of all; if the particles give a detection a chance of less than
//! `lost_below`, 0.01, half of them are drawn anew along its trajectory; μ, σ, h in `trajectory`; ε,
//! `false_detection`.
//!
//! *Deviations*: reconstructed (the paper's own equations were not available): the likelihood is that of `Pomdp`, 1 −
//! γ and γ by the back-trajectory, at each particle's own place instead of a cell's middle; ε on either side (γ at
//! least ε), so that the weights never all vanish. Particles start evenly over the area. A set that cannot explain a
//! detection has lost the source (no particle was near it at a resampling): half are then drawn anew from the
//! releases that could have been met, as Lenser & Veloso 2000 reset a lost robot. The belief on the grid is the
//! weight of the particles in each cell, with the share ε spread over all cells.

use super::cost::{PARTICLE_S, by_kernel};
use super::doubt::alternatives::Alternatives;
use super::doubt::evidence::{DoubtSpec, mixed};
use super::doubt::shifts::Shifts;
use super::kernel::Kernel;
use super::log_belief::LogBelief;
use super::mapper::{MapParams, Mapper};
use super::spec::{GridSpec, TrajectorySpec, must};
use super::watch::MapObservation;
use super::workings::Workings;
use crate::error::RobotError;
use crate::handoff::{Belief, BeliefGrid};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::area::Area;
use world::catalogue::Entry;
use world::cost::{Cost, Times};
use world::math;
use world::ranges::{Fraction, NonNegative, Positive};
use world::registry::Listed;
use world::seeds::Stream;

/// Legal numbers of particles.
const PARTICLES: (u32, u32) = (10, 100_000);

/// The mapper's parameters.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct ParticleFilterSpec {
    /// The cells of the belief that the particles give.
    pub grid: GridSpec,
    /// Model of how dye travels.
    pub trajectory: TrajectorySpec,
    /// Time between two updates, s.
    #[default(Positive::new(1.0))]
    pub update_period_s: Positive,
    /// Chance ε of a detection where there is no dye; must be greater than 0.
    #[default(Fraction::new(1e-6))]
    pub false_detection: Fraction,
    /// How far the map doubts its model.
    pub doubt: DoubtSpec,
    /// Number of particles.
    #[default(1000)]
    pub particles: u32,
    /// Resample when the effective number is below this share of all.
    #[default(Fraction::new(0.5))]
    pub resample_below: Fraction,
    /// The particles have lost the source if they give an actual detection a smaller chance than this.
    #[default(Fraction::new(0.01))]
    pub lost_below: Fraction,
    /// Scatter after resampling, K: share of the particles' extent, divided by the d-th root of their number in d
    /// dimensions.
    #[default(NonNegative::new(0.2))]
    pub roughening: NonNegative,
}

impl Listed for ParticleFilterSpec {
    const ENTRY: Entry = Entry {
        name: "ParticleFilter",
        what: "possible source positions as particles, weighted by detections and non-detections (reconstructed)",
        source: "Li, Meng, Wang & Zeng 2011, Autonomous Robots 30(3)",
    };
}

impl MapParams for ParticleFilterSpec {
    fn build(&self, area: &Area, rng: Stream) -> Result<Box<dyn Mapper>, RobotError> {
        Alternatives::around(&self.doubt, |doubt| {
            let spec = Self { doubt: doubt.clone(), ..self.clone() };
            let grid = self.grid.build(area)?;
            Ok(Box::new(ParticleFilter::new(&spec, grid, rng.clone())?))
        })
    }

    fn check(&self, area: &Area) -> Result<(), RobotError> {
        self.grid.build(area)?;
        self.trajectory.check()
    }

    fn cost(&self, times: &Times) -> Cost {
        let each_s = (self.doubt.maps() as f64) * f64::from(self.particles) * PARTICLE_S;
        by_kernel(&self.grid, &self.trajectory, self.update_period_s.get(), each_s, times)
    }
}

/// State of the mapper.
#[derive(Clone, Debug)]
pub struct ParticleFilter {
    with: Workings,
    kernel: Kernel,
    spec: ParticleFilterSpec,
    rng: Stream,
    /// Places in the grid's own axes, m.
    places: Vec<[f64; 3]>,
    weights: Vec<f64>,
    /// Errors of navigation in which the particles believe, and where their sources then appear to be, m.
    shifts: Option<Shifts>,
    seen_at: Vec<[f64; 3]>,
    ln_evidence: f64,
    /// Probability of each cell of the belief.
    mass: Vec<f64>,
    /// Chance of no detection from each place, for an update.
    gamma: Vec<f64>,
    extent_m: [f64; 3],
}

impl ParticleFilter {
    /// A mapper whose particles are spread over the grid.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if the number of particles or a chance is out of range.
    pub fn new(spec: &ParticleFilterSpec, grid: BeliefGrid, mut rng: Stream) -> Result<Self, RobotError> {
        let periods = [spec.trajectory.release_period_s, spec.update_period_s].map(Positive::get);
        let mut with =
            Workings::new(grid, &spec.trajectory, periods, spec.false_detection, &spec.doubt, spec.grid.places)?;
        must(
            (PARTICLES.0..=PARTICLES.1).contains(&spec.particles),
            "particles",
            format!("must be from {} to {}, got {}", PARTICLES.0, PARTICLES.1, spec.particles),
        )?;
        // The belief is that of the particles, whatever they believe of navigation.
        let cells = with.belief.belief().grid.clone();
        with.belief = LogBelief::uniform(&cells);
        let grid = &with.grid;
        let extent_m = [0, 1, 2].map(|a| grid.cell_m[a] * grid.n[a] as f64);
        let count = spec.particles as usize;
        let places = (0..count).map(|_| extent_m.map(|e| e * rng.uniform())).collect();
        Ok(Self {
            kernel: Kernel::within(grid, with.places, &spec.trajectory),
            shifts: Shifts::from_doubt(&spec.doubt, count, &mut rng),
            seen_at: Vec::new(),
            ln_evidence: 0.0,
            spec: spec.clone(),
            rng,
            places,
            mass: vec![0.0; cells.len()],
            weights: vec![1.0 / count as f64; count],
            gamma: Vec::with_capacity(count),
            extent_m,
            with,
        })
    }

    /// Bayes' rule for each particle.
    fn weigh(&mut self, t_s: f64, detected: bool) {
        let same = self.with.evidence.repeated(t_s, detected);
        let evidence = self.with.evidence;
        let mut places = &self.places;
        if let Some(shifts) = &mut self.shifts {
            self.seen_at.clear();
            let shifted =
                (self.places.iter().zip(shifts.displacements(t_s))).map(|(p, by)| [p[0] + by[0], p[1] + by[1], p[2]]);
            self.seen_at.extend(shifted);
            places = &self.seen_at;
        }
        (self.kernel.anywhere()).not_detecting(places, &mut self.gamma);
        for (gamma, w) in self.gamma.iter().zip(&mut self.weights) {
            let likelihood = if detected { evidence.some(*gamma) } else { evidence.none(*gamma).max(evidence.epsilon) };
            let likelihood = mixed(same, likelihood);
            *w *= if evidence.share < 1.0 { math::powf(likelihood, evidence.share) } else { likelihood };
        }
        let total: f64 = self.weights.iter().sum();
        self.ln_evidence += math::ln(total.max(1e-300));
        if detected && total < self.spec.lost_below.get() {
            self.send_back(t_s);
        } else {
            for w in &mut self.weights {
                *w /= total;
            }
        }
    }

    /// Draws every other particle anew from the releases that may have been met; then all have the same weight.
    fn send_back(&mut self, t_s: f64) {
        let shifts: Option<Vec<_>> = self.shifts.as_mut().map(|s| s.displacements(t_s).collect());
        let releases: Vec<_> = self.with.watch.history.releases().collect();
        let (at, plane) = (self.kernel.place(), self.with.belief.belief().grid.n[2] == 1);
        for (i, place) in self.places.iter_mut().enumerate().step_by(2) {
            let by = shifts.as_ref().map_or([0.0; 2], |s| s[i]);
            // Releases outside the area are impossible: draw another one, a few times.
            for _ in 0..20 {
                let pick = (self.rng.uniform() * releases.len() as f64) as usize;
                let (age, s) = releases[pick.min(releases.len() - 1)];
                let spread = self.spec.trajectory.spread_m(age);
                let mut drawn = [0, 1, 2].map(|a| {
                    let drift = s.get(a).copied().unwrap_or(0.0);
                    let shift = by.get(a).copied().unwrap_or(0.0);
                    at[a] - drift + spread[a] * self.rng.normal() - shift
                });
                drawn[2] = if plane { place[2] } else { within(drawn[2], self.extent_m[2]) };
                if (0..2).all(|a| (0.0..self.extent_m[a]).contains(&drawn[a])) {
                    *place = drawn;
                    break;
                }
            }
        }
        let even = 1.0 / self.weights.len() as f64;
        self.weights.fill(even);
    }

    fn resample_if_worn(&mut self) {
        let count = self.weights.len() as f64;
        let effective = 1.0 / self.weights.iter().map(|w| w * w).sum::<f64>();
        if effective >= self.spec.resample_below.get() * count {
            return;
        }
        let scatter = self.scatter();
        let start = self.rng.uniform();
        let mut kept = Vec::with_capacity(self.places.len());
        let mut of = Vec::with_capacity(self.places.len());
        let (mut i, mut upto) = (0, self.weights[0]);
        for m in 0..self.weights.len() {
            let mark = (m as f64 + start) / count;
            while upto < mark && i + 1 < self.weights.len() {
                i += 1;
                upto += self.weights[i];
            }
            of.push(i);
            let mut place = self.places[i];
            for (axis, x) in place.iter_mut().enumerate() {
                *x = within(*x + scatter[axis] * self.rng.normal(), self.extent_m[axis]);
            }
            kept.push(place);
        }
        self.places = kept;
        if let Some(shifts) = &mut self.shifts {
            shifts.keep(&of);
        }
        self.weights.fill(1.0 / count);
    }

    /// Standard deviation of the roughening along each axis, m: K·E·N^(−1/d).
    fn scatter(&self) -> [f64; 3] {
        let axes = if self.with.belief.belief().grid.n[2] == 1 { 2 } else { 3 };
        let root = math::powf(self.places.len() as f64, -1.0 / f64::from(axes));
        [0, 1, 2].map(|axis| {
            if axis >= axes as usize {
                return 0.0;
            }
            let alive = self.places.iter().zip(&self.weights);
            // Particles without weight are not resampled and do not widen the extent.
            let xs = alive.filter(|(_, w)| **w > 1e-12).map(|(p, _)| p[axis]);
            let (lo, hi) = xs.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
            self.spec.roughening.get() * (hi - lo).max(0.0) * root
        })
    }

    fn onto_grid(&mut self, t_s: f64, detected: bool) {
        let grid = self.with.belief.belief().grid.clone();
        let grid = grid.as_ref();
        let e = self.with.evidence.epsilon;
        let mass = &mut self.mass;
        mass.fill(e / grid.len() as f64);
        for (place, w) in self.places.iter().zip(&self.weights) {
            let cell = [0, 1, 2].map(|a| ((place[a] / grid.cell_m[a]) as usize).min(grid.n[a] - 1));
            mass[grid.index(cell)] += (1.0 - e) * w;
        }
        (self.with.belief).replace(t_s, detected, &self.mass);
    }
}

/// A coordinate reflected back into [0, extent].
fn within(x: f64, extent: f64) -> f64 {
    if (0.0..=extent).contains(&x) {
        return x;
    }
    let folded = x.rem_euclid(2.0 * extent);
    folded.min(2.0 * extent - folded)
}

impl Mapper for ParticleFilter {
    fn step(&mut self, seen: &MapObservation) {
        let Some(sighting) = self.with.watch.step(seen) else {
            return;
        };
        self.kernel.gather(&self.with.watch.history, sighting.cell);
        if let (Some(fix_s), Some(shifts)) = (self.with.watch.fix(), &mut self.shifts) {
            shifts.fixed(fix_s, &mut self.rng);
        }
        self.weigh(sighting.t_s, sighting.detected);
        self.onto_grid(sighting.t_s, sighting.detected);
        self.resample_if_worn();
    }

    fn belief(&self) -> &Belief {
        self.with.belief.belief()
    }

    fn ln_evidence(&self) -> f64 {
        self.ln_evidence
    }
}

#[cfg(test)]
mod tests;
