//! The longest step of the plume that leaves mixed water even, for given water.
//!
//! *Source*: see `evenness`, which computes what a step does to one column.
//!
//! *Parameters*: [`EVEN`], the deviation that still counts as even.
//!
//! *Deviations*: the water is examined at [`PLACES`] by [`PLACES`] places over the area at [`TIMES`] times. For each
//! time, the column whose K_z bends most sharply counts. A meander is taken as it is at its latest advance. A filament
//! is assumed to stay in the area as long as the slowest of these columns takes to cross the diagonal, if that is
//! shorter than the time for which the step is used.

use super::evenness::MixingProfile;
use crate::flow::grid::GridShape;
use nalgebra::{Vector2, Vector3};
use world::area::Area;
use world::fields::{Flow, Mixing};
use world::terrain::Terrain;

/// Mixed water counts as even if no 24th of its depth deviates by more than this part.
pub const EVEN: f64 = 0.05;
/// The deviation is no more than this times dt·max|K''|: twice what any of the waters of `evenness` came to.
const AT_MOST: f64 = 8.0;
/// Places along and across the area.
const PLACES: usize = 5;
/// Times from the beginning to the end.
const TIMES: usize = 9;
/// Shortest step that is considered, s.
const SHORTEST_S: f64 = 1e-3;

/// The columns of a water in which K_z bends most sharply, that is, those that suffer most from a long step.
#[derive(Clone, Debug)]
pub struct SharpestMixing {
    columns: Vec<Column>,
    /// Time after which a filament has left the area, s; infinite if the water stands still anywhere.
    stay_s: f64,
}

#[derive(Clone, Debug)]
struct Column {
    place: Vector2<f64>,
    t_s: f64,
    profile: MixingProfile,
    /// Speed of the water's mean velocity over the depth, m/s.
    speed_m_s: f64,
}

/// How far from even a step leaves mixed water, at the worst place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Uneven {
    /// Greatest deviation of any 24th of the depth, as a part of even.
    pub part: f64,
    /// Place (east, north), m.
    pub place: Vector2<f64>,
    /// Time of the water, s.
    pub t_s: f64,
}

/// The places (east, north), m, and times, s, at which water is examined from time 0 to `until_s`.
pub fn examined(area: &Area, until_s: f64) -> impl Iterator<Item = (Vector2<f64>, f64)> {
    times(until_s).flat_map(move |t_s| places(area).map(move |place| (place, t_s)))
}

fn times(until_s: f64) -> impl Iterator<Item = f64> {
    (0..TIMES).map(move |n| until_s * n as f64 / (TIMES - 1) as f64)
}

impl SharpestMixing {
    /// The sharpest columns of an area from time 0 to `until_s`, as a plume on a grid of this shape sees them.
    pub fn sharpest(flow: &dyn Flow, area: &Area, terrain: &Terrain, shape: &GridShape, until_s: f64) -> Self {
        let mut columns: Vec<Column> = Vec::new();
        let mut slowest_m_s = f64::INFINITY;
        for t_s in times(until_s) {
            let all: Vec<Column> = places(area).map(|place| column(flow, place, terrain, shape, t_s)).collect();
            slowest_m_s = all.iter().map(|c| c.speed_m_s).fold(slowest_m_s, f64::min);
            let sharpest = all
                .into_iter()
                .filter(|c| c.profile.is_finite())
                .max_by(|a, b| a.profile.sharpest().total_cmp(&b.profile.sharpest()));
            // Steady water is the same at all times.
            columns.extend(sharpest.filter(|s| columns.iter().all(|c| c.profile != s.profile)));
        }
        let across_m = Vector2::new(area.length_m, area.width_m).norm();
        Self { columns, stay_s: across_m / slowest_m_s }
    }

    /// How steps of `dt_s` disturb mixed water within `lasts_s`, or for as long as it stays in the area. `None` if K_z
    /// is finite nowhere.
    pub fn uneven(&self, dt_s: f64, lasts_s: f64) -> Option<Uneven> {
        let all = self.columns.iter().map(|c| Uneven {
            part: c.profile.unevenness(dt_s, lasts_s.min(self.stay_s)),
            place: c.place,
            t_s: c.t_s,
        });
        all.max_by(|a, b| a.part.total_cmp(&b.part))
    }

    /// Whether steps of `dt_s` are so short that nothing has to be worked out.
    pub fn surely_even(&self, dt_s: f64) -> bool {
        let bends = self.columns.iter().map(|c| c.profile.sharpest());
        AT_MOST * dt_s * bends.fold(0.0, f64::max) <= EVEN
    }

    /// The longest step up to `most_s` that keeps mixed water within [`EVEN`] for `lasts_s`, s; it may be a twentieth
    /// too short. `None` if it would be shorter than a millisecond.
    pub fn longest_step_s(&self, most_s: f64, lasts_s: f64) -> Option<f64> {
        let even = |dt_s: f64| self.uneven(dt_s, lasts_s).is_none_or(|u| u.part <= EVEN);
        let (mut long, mut short) = (most_s, most_s);
        while !even(short) {
            long = short;
            short *= 0.5;
            if short < SHORTEST_S {
                return None;
            }
        }
        while long > 1.05 * short {
            let middle = (long * short).sqrt();
            if even(middle) {
                short = middle;
            } else {
                long = middle;
            }
        }
        Some(short)
    }
}

/// Places over the whole area, including its edges.
fn places(area: &Area) -> impl Iterator<Item = Vector2<f64>> {
    let part = |n: usize| n as f64 / (PLACES - 1) as f64 - 0.5;
    let along = move |i: usize| part(i) * area.length_m;
    let across = move |j: usize| part(j) * area.width_m;
    (0..PLACES * PLACES).map(move |n| area.world(Vector2::new(along(n / PLACES), across(n % PLACES))))
}

fn column(flow: &dyn Flow, place: Vector2<f64>, terrain: &Terrain, shape: &GridShape, t_s: f64) -> Column {
    let depth = -terrain.bed_z(place.x, place.y);
    let heights: Vec<f64> = (0..shape.levels).map(|k| depth * shape.level(k)).collect();
    let z: Vec<f64> = heights.iter().map(|h| h - depth).collect();
    let mut out = vec![(Vector3::zeros(), Mixing::default()); z.len()];
    flow.column(place, &z, t_s, &mut out);
    let k = out.iter().map(|(_, mixing)| mixing.k_z_m2_s).collect();
    let sum: Vector3<f64> = out.iter().map(|(velocity, _)| velocity).sum();
    Column { place, t_s, profile: MixingProfile::new(heights, k), speed_m_s: sum.xy().norm() / out.len() as f64 }
}
