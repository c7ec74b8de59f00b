//! What fills the space: moving water and what is dissolved in it. These are the truth, whoever implements them.

use nalgebra::{Matrix3, Vector2, Vector3};

/// Water at a point: velocity, its gradient, its rate of change and the density.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WaterSample {
    /// Velocity over ground, ENU, m/s; points where the water goes.
    pub velocity: Vector3<f64>,
    /// Gradient ∂u_i/∂x_j, 1/s.
    pub gradient: Matrix3<f64>,
    /// Local rate of change ∂u/∂t, m/s².
    pub rate: Vector3<f64>,
    /// Density, kg/m³.
    pub density_kg_m3: f64,
}

/// Two parallel vertical walls with the water between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SideWalls {
    /// A point half-way between them (east, north), m.
    pub centre: Vector2<f64>,
    /// Unit vector (east, north) from one to the other.
    pub across: Vector2<f64>,
    /// Half of their distance, m.
    pub half_width_m: f64,
}

/// Eddy diffusivities at a point, m²/s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mixing {
    /// Horizontal.
    pub k_h_m2_s: f64,
    /// Vertical.
    pub k_z_m2_s: f64,
}

/// The water: one source of answers for the hull, the sensors, the plume and the reports.
///
/// `advance` must be called with increasing times, and before any question about the time `t`. Questions may refer to a
/// time up to about a second after the latest `advance`, because a flow with inner state interpolates.
pub trait Flow: Send + Sync {
    /// Brings inner state (meander, turbulence) up to `t_s`, s. The result must not depend on the number of calls that
    /// lead there.
    fn advance(&mut self, _t_s: f64) {}

    /// Velocity over ground at `p` (ENU, m) and time `t_s`, m/s.
    fn velocity(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64>;

    /// Whether [`Flow::column`] never changes.
    fn is_steady(&self) -> bool {
        false
    }

    /// Density at `p`, kg/m³.
    fn density(&self, _p: &Vector3<f64>, _t_s: f64) -> f64 {
        1026.0
    }

    /// Eddy diffusivity at `p`, m²/s.
    fn mixing(&self, _p: &Vector3<f64>, _t_s: f64) -> Mixing {
        Mixing::default()
    }

    /// Diffusivity by which filaments of a size (m) near `p` grow, m²/s: that of all eddies that do not carry them.
    fn stirring(&self, p: &Vector3<f64>, _size_m: f64, t_s: f64) -> f64 {
        self.mixing(p, t_s).k_h_m2_s
    }

    /// Dissipation of turbulent energy at `p`, m²/s³.
    fn dissipation(&self, _p: &Vector3<f64>, _t_s: f64) -> f64 {
        0.0
    }

    /// Velocity and diffusivity at several heights above one place (east, north), m. An implementation can compute only
    /// once what is the same in the whole column. The velocity excludes eddies that [`Flow::carry`] adds. Of waves that
    /// [`Flow::displacement`] adds, it contains only the mean drift, because it moves mean places.
    fn column(&self, place: Vector2<f64>, heights_m: &[f64], t_s: f64, out: &mut [(Vector3<f64>, Mixing)]) {
        for (z, node) in heights_m.iter().zip(out) {
            let p = Vector3::new(place.x, place.y, *z);
            *node = (self.velocity(&p, t_s), self.mixing(&p, t_s));
        }
    }

    /// Moves places with the eddies that [`Flow::column`] leaves out, up to `t_s`; the n-th place by `dt_s[n]`. Places
    /// are east and north of the `datum` (east, north) and upwards, m. The default has no eddies.
    fn carry(&self, _t_s: f64, _dt_s: &[f32], _datum: Vector2<f64>, _places: [&mut [f32]; 3]) {}

    /// Fills in the face velocities that carry mean places through the cells in which the water was computed, and
    /// returns true; returns false if there are no cells. For each cell, the six values are the velocities at its lower
    /// and upper faces along, across and upwards, in cell sizes per second. Between two faces each component varies
    /// linearly, so that volume is conserved. The order of the cells is that of their maker.
    fn rates(&self, _t_s: f64, _cells: &mut Vec<[f32; 6]>) -> bool {
        false
    }

    /// Displacement at time `t_s` of the water whose mean place is `p`, m: the orbital motion of waves, which
    /// [`Flow::column`] leaves out. `None` without waves.
    fn displacement(&self, _p: &Vector3<f64>, _t_s: f64) -> Option<Vector3<f64>> {
        None
    }

    /// Pressure head of the waves at `p`, m of water, in addition to that of still water.
    fn head(&self, _p: &Vector3<f64>, _t_s: f64) -> f64 {
        0.0
    }

    /// Roughness of the bed and the height at which the law of the wall ends, m, if the velocity falls by it.
    fn log_layer(&self) -> Option<[f64; 2]> {
        None
    }

    /// Vertical walls along both sides, if the water stands between walls.
    fn walls(&self) -> Option<SideWalls> {
        None
    }

    /// Velocity with gradient, rate of change and density; central differences unless overridden.
    fn sample(&self, p: &Vector3<f64>, t_s: f64) -> WaterSample {
        // Small compared with layer thicknesses (0.1 m), large compared with rounding at positions of 10³ m.
        const H: f64 = 1e-3;
        let mut gradient = Matrix3::zeros();
        for j in 0..3 {
            let mut e = Vector3::zeros();
            e[j] = H;
            let d = (self.velocity(&(p + e), t_s) - self.velocity(&(p - e), t_s)) / (2.0 * H);
            gradient.set_column(j, &d);
        }
        let rate = (self.velocity(p, t_s + H) - self.velocity(p, (t_s - H).max(0.0))) / (t_s + H - (t_s - H).max(0.0));
        WaterSample { velocity: self.velocity(p, t_s), gradient, rate, density_kg_m3: self.density(p, t_s) }
    }
}

/// Something dissolved in the water.
pub trait Concentration: Send + Sync {
    /// Concentration at `p` (ENU, m), kg/m³, now.
    fn concentration(&self, p: &Vector3<f64>) -> f64;

    /// What a probe is given at `p` that averages over `across_m` (m): where the model has structure that is finer than
    /// what it resolves, with that.
    fn sensed(&self, p: &Vector3<f64>, across_m: f64) -> f64 {
        let _ = across_m;
        self.concentration(p)
    }
}

/// Still water of constant density.
#[derive(Clone, Copy, Debug, Default)]
pub struct Still;

impl Flow for Still {
    fn velocity(&self, _p: &Vector3<f64>, _t_s: f64) -> Vector3<f64> {
        Vector3::zeros()
    }
}

/// Nothing dissolved.
#[derive(Clone, Copy, Debug, Default)]
pub struct Clean;

impl Concentration for Clean {
    fn concentration(&self, _p: &Vector3<f64>) -> f64 {
        0.0
    }
}
