//! The trait [`Flow`] for the whole water.

use super::Water;
use crate::flow::number::Jet;
use nalgebra::{Matrix3, Vector2, Vector3};
use world::fields::{Flow, Mixing, SideWalls, WaterSample};

impl Flow for Water {
    fn advance(&mut self, t_s: f64) {
        for m in &mut self.meanders {
            m.advance(t_s);
        }
        if let Some(blocked) = &mut self.blocked {
            blocked.advance(t_s);
        }
    }

    fn is_steady(&self) -> bool {
        Water::is_steady(self)
    }

    fn velocity(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
        let mean = self.velocity_without_eddies(p, t_s);
        if self.flume.is_none() {
            return mean;
        }
        mean + self.eddying(p, t_s)
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
        self.flume.as_ref().map(|f| f.walls)
    }

    fn density(&self, p: &Vector3<f64>, t_s: f64) -> f64 {
        match &self.layered {
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
            && let Some((velocity, gradient, rate)) = blocked.sample(p, &self.ground.floor(p.xy()), t_s)
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
