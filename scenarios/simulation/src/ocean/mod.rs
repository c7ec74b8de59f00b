//! The ocean of a run: place, water and plume. It does not depend on who searches in it.
//!
//! Only `system::drift` and the spin-up write to it; sensors read it. So two runs with the same [`Origin`] have the
//! same ocean, bit for bit, and can share it (see [`lanes`](crate::lanes)).

mod origin;
mod spun_up;
pub(crate) mod system;
#[cfg(test)]
mod tests;

pub use origin::Origin;
pub use spun_up::{Mismatch, SpunUp};

use bevy_ecs::prelude::Resource;
use nalgebra::{Vector2, Vector3};
use plumes::filaments::{DisplacedConcentration, Plume};
use plumes::flow::Water;
use std::ops::{Deref, DerefMut};
use world::area::{Area, Sides};
use world::clock::Clock;
use world::digest::Digest;
use world::fields::{Flow, Mixing, SideWalls, WaterSample};
use world::obstacles::Obstacles;
use world::physics::Bed;
use world::terrain::Terrain;

/// Place, water and plume. It holds the truth. As a [`Flow`] it takes times of the mission, s.
///
/// It is one pointer, because an ocean that many searchers share goes from world to world in every tick; between its
/// turns a world has none.
#[derive(Resource)]
pub struct Ocean(Option<Box<Contents>>);

/// What an [`Ocean`] holds.
pub struct Contents {
    /// The operating area.
    pub area: Area,
    pub(crate) sides: Sides,
    pub(crate) bed: Bed,
    /// The bed.
    pub terrain: Terrain,
    /// All solid things, including those that the water passes through.
    pub obstacles: Obstacles,
    water: Water,
    plume: Plume,
    /// Age of the water when the mission starts, s.
    spin_up_s: f64,
    /// Longest steps of the plume during the spin-up and during the mission, s.
    longest_s: [f64; 2],
    /// Time (with the spin-up, s) and digest of the plume at the checkpoint that the latest advance reached.
    checkpoint: Option<(f64, String)>,
}

impl Deref for Ocean {
    type Target = Contents;

    fn deref(&self) -> &Contents {
        self.0.as_deref().expect(AWAY)
    }
}

impl DerefMut for Ocean {
    fn deref_mut(&mut self) -> &mut Contents {
        self.0.as_deref_mut().expect(AWAY)
    }
}

/// The water is asked at most so long after it was advanced, s. All currents know half a second more than that.
const QUIET_S: f64 = 0.5;

const AWAY: &str = "another run has its turn in the ocean";

impl Ocean {
    /// Before the spin-up; nothing is released yet.
    fn new(area: Area, terrain: Terrain, obstacles: Obstacles, water: Water, plume: Plume, origin: &Origin) -> Self {
        Self(Some(Box::new(Contents {
            sides: area.sides(),
            bed: Bed::new(&terrain, &area),
            area,
            terrain,
            obstacles,
            water,
            plume,
            spin_up_s: origin.spin_up_s(),
            longest_s: [origin.spin_up_period_s(); 2],
            checkpoint: None,
        })))
    }

    /// The place of an ocean that is in the world of another run.
    pub(crate) fn away() -> Self {
        Self(None)
    }

    /// Whether it is here.
    pub(crate) fn is_here(&self) -> bool {
        self.0.is_some()
    }

    /// The water. Its own time begins with the spin-up.
    pub fn water(&self) -> &Water {
        &self.water
    }

    /// Age of the water when the mission starts, s.
    pub fn spin_up_s(&self) -> f64 {
        self.spin_up_s
    }

    /// The plume: filaments of all sources.
    pub fn plume(&self) -> &Plume {
        &self.plume
    }

    /// Places of the sources (ENU), m.
    pub fn sources(&self) -> Vec<Vector3<f64>> {
        self.plume.sources().iter().map(|s| s.p_W).collect()
    }

    /// The dye that a sensor measures at a time of the mission, s: the plume, displaced by the orbital motion of the
    /// waves.
    pub fn dye(&self, t_s: f64) -> DisplacedConcentration<'_> {
        DisplacedConcentration::new(&self.plume, self, t_s)
    }

    /// Lets water and plume develop before the mission. `heard` gets the completed share after every step; if it
    /// returns `false`, the spin-up ends early.
    pub fn spin_up(&mut self, mut heard: impl FnMut(f64) -> bool) {
        let here = &mut **self;
        let (mut t_s, end_s) = (0.0, here.spin_up_s);
        if !here.plume.sources().is_empty() && end_s > 0.0 {
            here.plume.pace(0.0, end_s, here.longest_s[0]);
            while t_s < end_s {
                here.water.advance(t_s);
                t_s = here.plume.next_meeting_s();
                here.plume.advance(&here.water, t_s);
                if !heard(t_s / end_s) {
                    return;
                }
            }
        }
        here.water.advance(end_s);
        self.set_out();
    }

    /// Starts the mission, in which the plume takes steps of at most `longest_s`.
    pub(crate) fn set_out(&mut self) {
        let here = &mut **self;
        let [_, longest_s] = here.longest_s;
        here.plume.pace(here.spin_up_s, f64::INFINITY, longest_s);
    }

    /// Limits the plume's steps during the mission, s.
    pub(crate) fn step_at_most(&mut self, longest_s: f64) {
        self.longest_s[1] = longest_s;
    }

    /// Brings water and plume to a time of the mission, s.
    pub fn advance(&mut self, t_s: f64) {
        let here = &mut **self;
        let t_s = t_s + here.spin_up_s;
        here.water.advance(t_s);
        let meets = here.plume.advance(&here.water, t_s);
        here.checkpoint = meets.then(|| {
            let mut digest = Digest::default();
            here.plume.digest_into(&mut digest);
            (t_s, digest.hex())
        });
    }

    /// Further steps of this length in which nothing in the ocean begins to move otherwise: in them it can be looked
    /// at, in any order.
    pub(crate) fn quiet_steps(&self, clock: &Clock) -> u64 {
        let (mut steps, mut later) = (0, *clock);
        later.advance();
        while later.t_s() <= clock.t_s() + QUIET_S && self.plume.rests_until(later.t_s() + self.spin_up_s) {
            steps += 1;
            later.advance();
        }
        steps
    }

    /// The ocean at a time of the mission, s, that is within such steps. It is what [`Self::advance`] would make it.
    pub(crate) fn look_at(&mut self, t_s: f64) {
        let here = &mut **self;
        here.plume.look_at(t_s + here.spin_up_s);
    }

    /// Digest of the plume, if the latest advance reached a checkpoint: the first tick after all filaments have met at
    /// the end of a longest step.
    pub fn checkpoint(&self) -> Option<&str> {
        let (t_s, digest) = self.checkpoint.as_ref()?;
        (*t_s == self.plume.now_s()).then_some(digest)
    }

    /// Copies of the present water and plume.
    pub fn state(&self) -> (Water, Plume) {
        let mut plume = Plume::clone(&self.plume);
        plume.use_threads(None);
        (Water::clone(&self.water), plume)
    }

    /// Takes over the state of another ocean with the same origin.
    pub(crate) fn put_state(&mut self, (water, plume): (Water, Plume)) {
        let here = &mut **self;
        let threads = here.plume.threads();
        here.water = water;
        here.plume = plume;
        here.plume.use_threads(threads);
    }

    /// Steps the plume, and draws the eddies of a channel, with this many threads; 0 means one for each core. The result
    /// is the same with any number. If the threads cannot be started, the ocean goes on with the one it has.
    pub fn use_threads(&mut self, n: usize) {
        let wanted = match n {
            0 => std::thread::available_parallelism().map_or(1, usize::from),
            n => n,
        };
        self.water.use_threads(wanted);
        self.plume.use_threads(plumes::filaments::threads(wanted));
    }
}

impl Flow for Ocean {
    fn advance(&mut self, t_s: f64) {
        Ocean::advance(self, t_s);
    }
    fn is_steady(&self) -> bool {
        Flow::is_steady(&self.water)
    }
    fn velocity(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
        self.water.velocity(p, t_s + self.spin_up_s)
    }
    fn density(&self, p: &Vector3<f64>, t_s: f64) -> f64 {
        self.water.density(p, t_s + self.spin_up_s)
    }
    fn mixing(&self, p: &Vector3<f64>, t_s: f64) -> Mixing {
        self.water.mixing(p, t_s + self.spin_up_s)
    }
    fn column(&self, place: Vector2<f64>, heights_m: &[f64], t_s: f64, out: &mut [(Vector3<f64>, Mixing)]) {
        let t_s = t_s + self.spin_up_s;
        Flow::column(&self.water, place, heights_m, t_s, out);
    }
    fn carry(&self, t_s: f64, dt_s: &[f32], datum: Vector2<f64>, places: [&mut [f32]; 3]) {
        Flow::carry(&self.water, t_s + self.spin_up_s, dt_s, datum, places);
    }
    fn rates(&self, t_s: f64, cells: &mut Vec<[f32; 6]>) -> bool {
        self.water.rates(t_s + self.spin_up_s, cells)
    }
    fn log_layer(&self) -> Option<[f64; 2]> {
        self.water.log_layer()
    }
    fn displacement(&self, p: &Vector3<f64>, t_s: f64) -> Option<Vector3<f64>> {
        self.water.displacement(p, t_s + self.spin_up_s)
    }
    fn head(&self, p: &Vector3<f64>, t_s: f64) -> f64 {
        self.water.head(p, t_s + self.spin_up_s)
    }
    fn walls(&self) -> Option<SideWalls> {
        self.water.walls()
    }
    fn sample(&self, p: &Vector3<f64>, t_s: f64) -> WaterSample {
        self.water.sample(p, t_s + self.spin_up_s)
    }
}
