//! Observes a scenario's water and plume for a while and computes the figures.
//!
//! *Source*: definitions in `series`, `gamma` and `expected`.
//!
//! *Parameters*: the time of observation; [`THRESHOLD`].
//!
//! *Deviations*: widths are those of the mass in slices across the stream, at all heights together. Down-stream is
//! where the water at the source goes at the end of the spin-up. Heights are parts of the water depth at the source.

use super::expected::ChannelFigures;
use super::figure::{PlumeFigure, Statistics};
use super::series::Series;
use nalgebra::{Vector2, Vector3};
use plumes::filaments::{DisplacedConcentration, Plume};
use plumes::flow::Water;
use rheotaxis::error::AssembleError;
use rheotaxis::ocean::Origin;
use rheotaxis::scenario::Loaded;
use robots::sense::TIP_M;
use world::fields::{Concentration, Flow};
use world::seeds::Seed;

/// Odour counts above this part of the time mean on the centreline at the nearest distance.
const THRESHOLD: f64 = 0.01;
/// Default time of observation of a channel, s.
const CHANNEL_S: f64 = 1200.0;
/// Heights of the probes for intermittency, as parts of the depth, beside the source's own; the lowest is 2.5 cm of 20
/// cm.
const HEIGHTS: [f64; 3] = [0.125, 0.375, 0.625];
/// Heights of the water's profile, parts of the depth.
pub(super) const PROFILE: [f64; 6] = [0.1, 0.2, 0.3, 0.5, 0.7, 0.9];
/// Number of places across and along at which the profile is evaluated in each sample.
const PLACES: usize = 8;

/// Why a scenario has no statistics.
#[derive(Debug, thiserror::Error)]
pub enum StatisticsError {
    /// It cannot be built.
    #[error(transparent)]
    Assemble(#[from] AssembleError),
    /// Stopped from outside.
    #[error("interrupted: nothing was written")]
    Interrupted,
    /// The scenario releases nothing.
    #[error("{0} has no source: there is no plume to measure; add one under `sources`")]
    NoSource(String),
    /// The water at the source stands still.
    #[error("the water at the source of {0} stands still: there is no down-stream to measure along")]
    Still(String),
    /// The plume did not reach the first distance.
    #[error(
        "no odour reached {distance_m:.2} m down-stream of the source of {name} in {watched_s} s: watch it longer (--seconds)"
    )]
    Clean {
        /// Name of the scenario.
        name: String,
        /// Nearest distance, m.
        distance_m: f64,
        /// Time of observation, s.
        watched_s: f64,
    },
}

/// Period of the readings at sea and in a channel, s.
const LOOK_S: [f64; 2] = [0.5, 0.05];

/// Data collected during the observation.
pub(super) struct Watch {
    pub(super) source: Vector3<f64>,
    pub(super) bed_z: f64,
    pub(super) along: Vector2<f64>,
    pub(super) left: Vector2<f64>,
    pub(super) distances: Vec<f64>,
    /// Count, sum, sum of squares across of the mass in each slice.
    pub(super) slices: Vec<[f64; 3]>,
    /// Concentration at [distance][height]: the source's height first.
    pub(super) odour: Vec<Vec<Series>>,
    pub(super) heights: Vec<f64>,
    /// Count, sum of the speed along, sums of squares along, across and up, at each height of the profile.
    pub(super) profile: Vec<[f64; 5]>,
    pub(super) speed: Series,
}

/// Lets a scenario's plume develop, observes it, and computes its figures.
///
/// `heard` gets the share that is done, and ends the observation by returning `false`.
///
/// # Errors
/// If the scenario cannot be built or has no plume to measure.
pub fn statistics(
    loaded: &Loaded,
    seed: impl Into<Seed>,
    seconds: Option<f64>,
    mut heard: impl FnMut(f64) -> bool,
) -> Result<Statistics, StatisticsError> {
    let scenario = &loaded.scenario;
    let seed = seed.into();
    let (mut water, mut plume) = built(loaded, seed)?;
    let Some(source) = plume.sources().first().map(|s| s.p_W) else {
        return Err(StatisticsError::NoSource(loaded.name.clone()));
    };
    let time = &scenario.time;
    let spin_up = time.spin_up_s.get();
    let watched_s = seconds.unwrap_or(if water.channel().is_some() { CHANNEL_S } else { time.limit_s.get() });
    let whole_s = spin_up + watched_s;
    if spin_up > 0.0 {
        plume.pace(0.0, spin_up, time.spin_up_period_s.get());
        let mut t_s = 0.0;
        while t_s < spin_up {
            water.advance(t_s);
            t_s = plume.next_meeting_s();
            plume.advance(&water, t_s);
            if !heard(t_s / whole_s) {
                return Err(StatisticsError::Interrupted);
            }
        }
    }
    let mut watch = Watch::new(loaded, &water, source, spin_up)?;
    let channel = water.channel().is_some();
    let dt = if channel { LOOK_S[1] } else { LOOK_S[0] };
    for record in watch.odour.iter_mut().flatten() {
        record.step_s = dt;
    }
    watch.speed.step_s = dt;
    plume.pace(spin_up, f64::INFINITY, time.drift_period_s.get());
    for n in 0..(watched_s / dt).ceil() as u64 {
        let t = spin_up + (n + 1) as f64 * dt;
        water.advance(t);
        plume.advance(&water, t);
        watch.look(&water, &plume, t);
        if !heard((t / whole_s).min(1.0)) {
            return Err(StatisticsError::Interrupted);
        }
    }
    let figures = watch.figures(loaded, &water, &plume, watched_s)?;
    Ok(Statistics { name: loaded.name.clone(), seed: seed.number(), watched_s, figures })
}

fn built(loaded: &Loaded, seed: Seed) -> Result<(Water, Plume), AssembleError> {
    let origin = Origin::from_scenario(&loaded.scenario, &loaded.base_dir, seed);
    Ok(origin.build(&loaded.base_dir)?.state())
}

impl Watch {
    fn new(loaded: &Loaded, water: &Water, source: Vector3<f64>, t_s: f64) -> Result<Self, StatisticsError> {
        let area = loaded.scenario.area.build();
        let bed_z = loaded.scenario.terrain.build(&area).bed_z(source.x, source.y);
        let mean = match water.channel() {
            Some(channel) => channel.along * channel.mean_m_s,
            None => {
                let orbit = water.waves().map(|w| w.velocity(&source, t_s));
                (water.velocity(&source, t_s) - orbit.unwrap_or_default()).xy()
            }
        };
        if mean.norm() < 1e-4 {
            return Err(StatisticsError::Still(loaded.name.clone()));
        }
        let along = mean.normalize();
        let reach = (1..=2000)
            .map(|k| 0.0005 * f64::from(k) * (area.length_m + area.width_m))
            .take_while(|d| area.contains(source.xy() + along * *d))
            .last()
            .unwrap_or(0.0);
        let depth = -bed_z;
        // In a channel, at multiples of the depth, as far as it reaches; elsewhere, at parts of the way to the edge.
        let distances: Vec<f64> = match water.channel() {
            Some(_) if reach > 2.5 * depth => {
                [2.5, 5.0, 7.5, 10.0].map(|k| k * depth).into_iter().filter(|d| *d < reach).collect()
            }
            _ => [0.125, 0.25, 0.5, 0.75].map(|k| k * reach).to_vec(),
        };
        let heights: Vec<f64> = std::iter::once(source.z - bed_z).chain(HEIGHTS.map(|s| s * depth)).collect();
        Ok(Self {
            source,
            bed_z,
            along,
            left: Vector2::new(-along.y, along.x),
            slices: vec![[0.0; 3]; distances.len()],
            odour: vec![vec![Series::default(); heights.len()]; distances.len()],
            distances,
            heights,
            profile: vec![[0.0; 5]; PROFILE.len()],
            speed: Series::default(),
        })
    }

    fn look(&mut self, water: &Water, plume: &Plume, t_s: f64) {
        let slice = 0.05 * self.distances[0];
        for f in plume.iter() {
            let d = Vector2::new(f[0], f[1]) - self.source.xy();
            let x = d.dot(&self.along);
            for (sums, at) in self.slices.iter_mut().zip(&self.distances) {
                if (x - at).abs() < slice {
                    let (y, size, mass) = (d.dot(&self.left), f[3], f[4]);
                    sums[0] += mass;
                    sums[1] += mass * y;
                    sums[2] += mass * (y * y + size * size);
                }
            }
        }
        let dye = DisplacedConcentration::new(plume, water, t_s);
        for (i, distance) in self.distances.iter().enumerate() {
            let p = self.source.xy() + self.along * *distance;
            for (k, height) in self.heights.iter().enumerate() {
                let value = dye.sensed(&Vector3::new(p.x, p.y, self.bed_z + height), TIP_M);
                self.odour[i][k].values.push(value);
            }
        }
        let Some(channel) = water.channel() else {
            return;
        };
        let p = self.source.xy() + self.along * self.distances[0];
        let q = Vector3::new(p.x, p.y, self.source.z);
        let u = water.velocity(&q, t_s).xy().dot(&channel.along);
        self.speed.values.push(u);
        // Places that move from sample to sample, so that a few at a time are many in all; the middle half of the
        // width.
        for n in 0..PLACES {
            let turn = |by: f64| ((t_s * 7.0 + n as f64) * by).fract();
            let across = 2.0 * self.half_width(water) * 0.5 * (turn(0.618_034) - 0.5);
            let p = self.source.xy() + self.along * (2.0 * turn(0.754_878)) + self.left * across;
            for (sums, part) in self.profile.iter_mut().zip(PROFILE) {
                let height = part * channel.depth_m;
                let v = water.velocity(&Vector3::new(p.x, p.y, self.bed_z + height), t_s);
                let (u, cross) = (v.xy().dot(&channel.along), v.xy().dot(&self.left));
                let off = u - channel.speed(height);
                let terms = [1.0, u, off * off, cross * cross, v.z * v.z];
                for (sum, term) in sums.iter_mut().zip(terms) {
                    *sum += term;
                }
            }
        }
    }

    fn half_width(&self, water: &Water) -> f64 {
        water.walls().map_or(0.0, |w| w.half_width_m)
    }

    fn figures(
        &self,
        loaded: &Loaded,
        water: &Water,
        plume: &Plume,
        watched_s: f64,
    ) -> Result<Vec<PlumeFigure>, StatisticsError> {
        let threshold = THRESHOLD * self.odour[0][0].mean();
        if threshold <= 0.0 {
            return Err(StatisticsError::Clean { name: loaded.name.clone(), distance_m: self.distances[0], watched_s });
        }
        let mut figures = Vec::new();
        let channel = water.channel();
        let expected = channel.map(ChannelFigures::from_channel);
        self.widths(expected.as_ref(), &mut figures);
        let nozzle = plume.sources()[0].release.nozzle.as_ref();
        self.centreline(expected.as_ref(), nozzle.map(|n| n.volume_m3_s()), plume, &mut figures);
        self.spikes(threshold, &mut figures);
        if let Some(channel) = channel {
            self.water(channel, &mut figures);
        }
        Ok(figures)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rheotaxis::scenario::load;
    use std::path::Path;

    fn of(name: &str, seconds: f64) -> Statistics {
        let loaded = load(Path::new(name)).unwrap();
        statistics(&loaded, 1, Some(seconds), |share| {
            assert!((0.0..=1.0).contains(&share));
            true
        })
        .unwrap()
    }

    /// The flume's figures have expectations. Except for the gaps, and where the record is too short, they lie within a
    /// factor of 2.
    #[test]
    fn flume_has_all_its_figures() {
        let s = of("flume_crab", 120.0);
        let named = |name: &str| {
            let mut found = s.figures.iter().filter(|f| f.name.starts_with(name));
            let first = found.next().unwrap_or_else(|| panic!("no {name}"));
            (first.clone(), 1 + found.count())
        };
        assert_eq!(named("width sigma_y").1, 4);
        assert_eq!(named("centreline C/C0").1, 4);
        assert_eq!(named("intermittency").1, 16);
        assert_eq!(named("resolved w'").1, PROFILE.len());
        for name in ["gaps below", "gamma shape", "integral time of the speed"] {
            assert!(named(name).0.expected.is_some(), "{name}");
        }
        for name in ["width sigma_y", "centreline C/C0", "mean speed", "resolved u'"] {
            let (figure, _) = named(name);
            assert!(!figure.flagged(), "{figure:?}");
        }
    }

    #[test]
    fn any_plume_has_widths_and_intermittency() {
        let s = of("uniform_channel", 20.0);
        let width = |n: usize| {
            let mut widths = s.figures.iter().filter(|f| f.name.starts_with("width"));
            widths.nth(n).unwrap().ours
        };
        assert!(width(0) > 0.0 && width(2) > width(0), "{:?}", s.figures);
        assert!(s.figures.iter().all(|f| f.expected.is_none() || f.unit.is_empty()));
        assert!(s.figures.iter().any(|f| f.name.starts_with("intermittency")));
    }

    #[test]
    fn without_a_source_there_is_nothing_to_measure() {
        let mut loaded = load(Path::new("uniform_channel")).unwrap();
        loaded.scenario.sources.clear();
        let said = statistics(&loaded, 1, Some(1.0), |_| true).unwrap_err();
        assert!(said.to_string().contains("uniform_channel has no source"), "{said}");
    }
}
