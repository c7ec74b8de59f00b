//! The ocean of a run: place, water and plume. It does not depend on who searches in it.
//!
//! Only `system::drift` and the spin-up write to it; sensors read it. So two runs with the same [`Origin`] have the
//! same ocean, bit for bit.

mod origin;
mod spun_up;
pub(crate) mod system;
#[cfg(test)]
mod tests;

pub use origin::Origin;
pub use spun_up::{Mismatch, SpunUp};

use bevy_ecs::prelude::Resource;
use nalgebra::{Vector2, Vector3};
use plumes::filaments::{Displaced, Plume};
use plumes::flow::Water;
use world::area::Area;
use world::clock::Every;
use world::fields::{Flow, Mixing, SideWalls, WaterSample};
use world::obstacles::Obstacles;
use world::terrain::Terrain;

/// Place, water and plume. It holds the truth. As a [`Flow`] it takes times of the mission, s.
#[derive(Resource)]
pub struct Ocean {
    /// The operating area.
    pub area: Area,
    /// The bed.
    pub terrain: Terrain,
    /// All solid things, including those that the water passes through.
    pub obstacles: Obstacles,
    water: Water,
    plume: Plume,
    /// Age of the water when the mission starts, s.
    spin_up_s: f64,
    spin_up_steps: (u64, f64),
}

impl Ocean {
    /// Before the spin-up; nothing is released yet.
    fn new(
        area: Area,
        terrain: Terrain,
        obstacles: Obstacles,
        water: Water,
        plume: Plume,
        origin: &Origin,
    ) -> Self {
        Self {
            area,
            terrain,
            obstacles,
            water,
            plume,
            spin_up_s: origin.spin_up_s(),
            spin_up_steps: origin.spin_up_steps(),
        }
    }

    /// The water. Its own time begins with the spin-up.
    #[must_use]
    pub fn water(&self) -> &Water {
        &self.water
    }

    /// Age of the water when the mission starts, s.
    #[must_use]
    pub fn spin_up_s(&self) -> f64 {
        self.spin_up_s
    }

    /// The plume: filaments of all sources.
    #[must_use]
    pub fn plume(&self) -> &Plume {
        &self.plume
    }

    /// The dye that a sensor measures at a time of the mission, s: the plume, displaced by the orbital motion of the
    /// waves.
    #[must_use]
    pub fn dye(&self, t_s: f64) -> Displaced<'_> {
        Displaced::new(&self.plume, self, t_s)
    }

    /// The time to which the spin-up advances the water, s.
    fn spun_up_s(&self) -> f64 {
        let (steps, dt_s) = self.spin_up_steps;
        if steps == 0 || self.plume.sources().is_empty() {
            return self.spin_up_s;
        }
        steps as f64 * dt_s
    }

    /// Lets water and plume develop before the mission. `heard` gets the completed share after every step; if it
    /// returns `false`, the spin-up ends early.
    pub fn spin_up(&mut self, mut heard: impl FnMut(f64) -> bool) {
        if self.plume.sources().is_empty() {
            self.water.advance(self.spin_up_s);
            return;
        }
        let (steps, dt_s) = self.spin_up_steps;
        for n in 0..steps {
            let (t0, t1) = (n as f64 * dt_s, (n + 1) as f64 * dt_s);
            self.water.advance(t1);
            self.plume.drift(&self.water, t0, t1);
            if !heard((n + 1) as f64 / steps as f64) {
                return;
            }
        }
    }

    /// Advances the water to a time of the mission, s.
    pub fn advance_water(&mut self, t_s: f64) {
        self.water.advance(t_s + self.spin_up_s);
    }

    /// Lets the plume drift between two times of the mission, s; the water must be at the later one.
    pub fn drift_plume(&mut self, from_s: f64, to_s: f64) {
        let t0_s = self.spin_up_s;
        self.plume.drift(&self.water, from_s + t0_s, to_s + t0_s);
    }

    /// Copies of the present water and plume.
    #[must_use]
    pub fn state(&self) -> (Water, Plume) {
        (self.water.clone(), self.plume.clone())
    }

    /// Takes over the state of another ocean with the same origin.
    pub(crate) fn put_state(&mut self, (water, plume): (Water, Plume)) {
        self.water = water;
        self.plume = plume;
    }
}

/// How often the plume drifts during the mission.
#[derive(Resource, Clone, Copy, Debug)]
pub struct DriftEvery(pub Every);

impl Flow for Ocean {
    fn advance(&mut self, t_s: f64) {
        self.advance_water(t_s);
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
    fn column(
        &self,
        place: Vector2<f64>,
        heights_m: &[f64],
        t_s: f64,
        out: &mut [(Vector3<f64>, Mixing)],
    ) {
        let t_s = t_s + self.spin_up_s;
        Flow::column(&self.water, place, heights_m, t_s, out);
    }
    fn carry(&self, t_s: f64, dt_s: &[f32], places: [&mut [f32]; 3]) {
        Flow::carry(&self.water, t_s + self.spin_up_s, dt_s, places);
    }
    fn rates(&self, t_s: f64, cells: &mut Vec<[f32; 6]>) -> bool {
        self.water.rates(t_s + self.spin_up_s, cells)
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
