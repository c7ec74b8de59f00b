//! The whole water: free, or led round obstacles. Hulls and instruments feel eddies and orbits in addition, the plume's
//! column the drift of the waves.

use nalgebra::{Matrix3, Vector2, Vector3};
use std::ops::Deref;
use world::bits::{Reader, Unreadable, Writer};
use world::fields::{Flow, Mixing, SideWalls, WaterSample};

use crate::flow::blockage::ObstacleFlow;
use crate::flow::free_water::{Column, FreeWater};
use crate::flow::number::{Jet, Number};

/// The water, ready to be evaluated. What obstacles do not change it tells as the free water that it is made of.
#[derive(Clone, Debug)]
pub struct Water {
    pub(super) free: FreeWater,
    pub(super) blocked: Option<ObstacleFlow>,
}

impl Deref for Water {
    type Target = FreeWater;

    fn deref(&self) -> &FreeWater {
        &self.free
    }
}

impl Water {
    /// Velocity at a place and a time without the eddies of a channel, m/s: a check need not draw them.
    pub fn velocity_without_eddies(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
        let turned = (self.blocked.as_ref()).and_then(|blocked| blocked.velocity(p, &self.floor(p.xy()), t_s));
        let mean = turned.unwrap_or_else(|| self.column(p.xy(), t_s).velocity(p.z));
        match &self.waves {
            Some(waves) => mean + waves.velocity(p, t_s),
            None => mean,
        }
    }

    /// The solution for the obstacles, if they divert the currents.
    pub fn blocked(&self) -> Option<&ObstacleFlow> {
        self.blocked.as_ref()
    }

    /// The water over (east, north) `p` at time `t_s`, its velocity as it would be without obstacles.
    pub fn column<N: Number>(&self, p: Vector2<N>, t_s: N) -> Column<'_, N> {
        self.free.column(p, t_s)
    }

    /// Writes what [`Flow::advance`] alone would not give again. Currents are the same at a time however they came to
    /// it; the solution round obstacles also depends, in its last bits, on the solutions before it.
    pub fn keep(&self, to: &mut Writer) {
        let Self { free: _, blocked } = self;
        if let Some(blocked) = blocked {
            blocked.keep(to);
        }
    }

    /// Becomes what other water of the same parameters, place and seed was when it had been advanced to `t_s` and was
    /// kept.
    ///
    /// # Errors
    /// If the bytes are not those of such water. This one is then of no more use.
    pub fn recall(&mut self, t_s: f64, from: &mut Reader<'_>) -> Result<(), Unreadable> {
        if let Some(blocked) = &mut self.blocked {
            blocked.recall(from)?;
        }
        self.advance(t_s);
        Ok(())
    }
}

impl Flow for Water {
    fn advance(&mut self, t_s: f64) {
        self.free.advance(t_s);
        if let Some(blocked) = &mut self.blocked {
            blocked.advance(t_s);
        }
    }

    fn is_steady(&self) -> bool {
        self.free.steady
    }

    fn velocity(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
        let mean = self.velocity_without_eddies(p, t_s);
        match self.eddies() {
            Some(eddies) => mean + eddies.velocity(p, t_s),
            None => mean,
        }
    }

    fn displacement(&self, p: &Vector3<f64>, t_s: f64) -> Option<Vector3<f64>> {
        self.waves().map(|waves| waves.displacement(p, t_s))
    }

    fn head(&self, p: &Vector3<f64>, t_s: f64) -> f64 {
        self.waves().map_or(0.0, |waves| waves.head(p, t_s))
    }

    fn carry(&self, t_s: f64, dt_s: &[f32], datum: Vector2<f64>, places: [&mut [f32]; 3]) {
        if let Some(eddies) = self.eddies() {
            eddies.carry(t_s, dt_s, datum, places);
        }
    }

    fn rates(&self, t_s: f64, cells: &mut Vec<[f32; 6]>) -> bool {
        let blocked = self.blocked.as_ref();
        blocked.inspect(|b| b.rates(t_s, cells)).is_some()
    }

    fn log_layer(&self) -> Option<[f64; 2]> {
        self.bed.map(|bed| bed.scales_m())
    }

    fn walls(&self) -> Option<SideWalls> {
        self.free.side_walls()
    }

    fn density(&self, p: &Vector3<f64>, t_s: f64) -> f64 {
        match &self.layers {
            Some(_) => self.column(p.xy(), t_s).density(p.z),
            None => self.density,
        }
    }

    fn mixing(&self, p: &Vector3<f64>, t_s: f64) -> Mixing {
        let column = self.column(p.xy(), t_s);
        column.mixing(p.z, column.friction_velocity())
    }

    fn stirring(&self, p: &Vector3<f64>, size_m: f64, t_s: f64) -> f64 {
        match &self.flume {
            Some(flume) if self.small().is_some() => flume.stirring(size_m),
            _ => self.mixing(p, t_s).k_h_m2_s,
        }
    }

    fn dissipation(&self, p: &Vector3<f64>, t_s: f64) -> f64 {
        let column = self.column(p.xy(), t_s);
        column.dissipation(p.z, column.friction_velocity())
    }

    fn column(&self, place: Vector2<f64>, heights_m: &[f64], t_s: f64, out: &mut [(Vector3<f64>, Mixing)]) {
        let column = Water::column(self, place, t_s);
        let u_star = column.friction_velocity();
        for (z, node) in heights_m.iter().zip(&mut *out) {
            *node = column.both(*z, u_star);
            if let Some(blocked) = &self.blocked {
                let p = Vector3::new(place.x, place.y, *z);
                node.0 = blocked.velocity(&p, &column.floor, t_s).unwrap_or(node.0);
            }
            if let Some(waves) = &self.waves {
                let drift = waves.drift(*z);
                node.0 += Vector3::new(drift.x, drift.y, 0.0);
            }
        }
        column.keep_apart(u_star, heights_m, out);
    }

    fn sample(&self, p: &Vector3<f64>, t_s: f64) -> WaterSample {
        if let Some(blocked) = &self.blocked
            && let Some((velocity, gradient, rate)) = blocked.sample(p, &self.floor(p.xy()), t_s)
        {
            let mut sample = WaterSample { velocity, gradient, rate, density_kg_m3: self.density(p, t_s) };
            if let Some(waves) = &self.waves {
                waves.add_to(&mut sample, p, t_s);
            }
            return sample;
        }
        let [x, y, z, t] = Jet::coordinates(p, t_s);
        let column = self.column(Vector2::new(x, y), t);
        let velocity = column.velocity(z);
        let slopes = |k: usize| velocity.map(|u| u.slopes[k]);
        let mut sample = WaterSample {
            velocity: velocity.map(|u| u.value),
            gradient: Matrix3::from_columns(&[slopes(0), slopes(1), slopes(2)]),
            rate: slopes(3),
            density_kg_m3: column.density(z),
        };
        if let Some(eddies) = self.eddies() {
            eddies.add_to(&mut sample, p, t_s);
        }
        if let Some(waves) = &self.waves {
            waves.add_to(&mut sample, p, t_s);
        }
        sample
    }
}
