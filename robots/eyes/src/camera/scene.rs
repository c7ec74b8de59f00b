//! The surfaces before a camera, and how bright they are.
//!
//! *Source:* Lambert's law; light on a face from `light.rs`. The surface from below: Snell's window (Horváth & Varjú
//! 1991, J. Exp. Biol. 160, 259), within which the sky appears n² times as bright as above.
//!
//! *Parameters:* `bed_albedo` share of light that a bed of sand reflects, red to blue 0.30, 0.26, 0.20 (wet quartz
//! sand); `texture` standard deviation of any surface's brightness, 0.2 of its mean.
//!
//! *Deviations:* window: an even sky that gives 0.3 of the light, and a sun that the waves smear to some degrees; its
//! rim is softened by 0.1 rad because of the waves; beyond it the surface mirrors endless water. Texture is noise of
//! three sizes, 0.05 to 0.8 m. The light focused by waves is noise of 0.3 m that vanishes within some metres (flicker
//! e^(-z/4 m)). Neither moves.

use super::bands::{N, Spectrum, each, spread};
use super::clarity::{Clarity, ClaritySpec};
use super::dye::{Dye, DyeSpec};
use super::light::{INDEX, Light, LightSpec, fresnel, phase};
use super::sensor::hash;
use nalgebra::Vector3;
use robots::error::RobotError;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::f64::consts::PI;
use world::fields::Concentration;
use world::math;
use world::obstacles::{Obstacle, Obstacles};
use world::ranges::Fraction;
use world::terrain::Terrain;

/// Parameters of light in a scenario's water.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct OpticsSpec {
    /// How clear the water is.
    pub clarity: ClaritySpec,
    /// Daylight.
    pub light: LightSpec,
    /// Optical properties of the dye.
    pub dye: DyeSpec,
    /// Share of red, green and blue light that the bed reflects.
    #[default((Fraction::new(0.30), Fraction::new(0.26), Fraction::new(0.20)))]
    pub bed_albedo: (Fraction, Fraction, Fraction),
    /// Standard deviation of the brightness of any surface, as a share of its mean.
    #[default(Fraction::new(0.2))]
    pub texture: Fraction,
}

/// Light in the water of a scenario.
#[derive(Clone, Debug, PartialEq)]
pub struct Optics {
    /// The water.
    pub clarity: Clarity,
    /// Daylight.
    pub light: Light,
    /// The dye.
    pub dye: Dye,
    /// The bed.
    pub bed_albedo: Spectrum,
    /// Unevenness of surfaces.
    pub texture: f64,
}

impl Optics {
    /// The optics of a specification.
    ///
    /// # Errors
    /// If water or sun are out of range.
    pub fn new(spec: &OpticsSpec) -> Result<Self, RobotError> {
        let clarity = Clarity::new(&spec.clarity)?;
        Ok(Self {
            light: Light::new(&spec.light, &clarity)?,
            clarity,
            dye: Dye::new(&spec.dye),
            bed_albedo: spread(spec.bed_albedo),
            texture: spec.texture.get(),
        })
    }
}

/// What a camera may see.
#[derive(Clone, Copy)]
pub struct Scene<'a> {
    /// The bed.
    pub terrain: &'a Terrain,
    /// Solids in the water.
    pub obstacles: &'a Obstacles,
    /// Dye in the water.
    pub dye: &'a dyn Concentration,
    /// Light in the water.
    pub optics: &'a Optics,
}

/// What a line of sight ends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct End {
    /// Way there, m.
    pub way_m: f64,
    /// What it is.
    pub kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    /// Water, as far as light comes from.
    Water,
    /// The bed.
    Bed,
    /// The surface from below.
    Surface,
    /// An obstacle, with its outward normal.
    Solid(usize, Vector3<f64>),
}

/// An obstacle with a bounding sphere, which most lines of sight miss.
pub(super) struct Round<'a> {
    solid: &'a Obstacle,
    to_middle: Vector3<f64>,
    r2: f64,
    number: usize,
}

impl Scene<'_> {
    /// The obstacles within reach of a camera at `from`.
    pub(super) fn near(&self, from: &Vector3<f64>, max_m: f64) -> Vec<Round<'_>> {
        let all = self.obstacles.0.iter().enumerate().map(|(number, solid)| {
            let (middle, r) = solid.ball();
            Round { solid, to_middle: middle - from, r2: r * r, number }
        });
        all.filter(|r| r.to_middle.norm() - r.r2.sqrt() < max_m).collect()
    }

    /// Where bed or surface end the line of sight from `from` along the unit vector `dir`.
    pub(super) fn shell(&self, from: &Vector3<f64>, dir: &Vector3<f64>, max_m: f64) -> End {
        if let Some(way_m) = self.terrain.ray(from, dir, max_m) {
            return End { way_m, kind: Kind::Bed };
        }
        let up = -from.z / dir.z;
        if dir.z > 0.0 && up < max_m {
            return End { way_m: up.max(0.0), kind: Kind::Surface };
        }
        End { way_m: max_m, kind: Kind::Water }
    }

    /// The end of a line of sight.
    pub(super) fn end(&self, near: &[Round<'_>], from: &Vector3<f64>, dir: &Vector3<f64>, max_m: f64) -> End {
        let mut end = self.shell(from, dir, max_m);
        for r in near {
            let along = r.to_middle.dot(dir);
            if r.to_middle.norm_squared() - along * along > r.r2 {
                continue;
            }
            if let Some((way_m, normal)) = r.solid.cast(from, dir, end.way_m) {
                end = End { way_m, kind: Kind::Solid(r.number, normal) };
            }
        }
        end
    }

    /// Radiance towards the camera of what ends a line of sight, in daylight and in the lamp's light `lamp` (lx on a
    /// face turned to it, by colour, and its direction), cd/m².
    pub(super) fn radiance(
        &self,
        end: &End,
        p: &Vector3<f64>,
        dir: &Vector3<f64>,
        lamp: Option<(Spectrum, Vector3<f64>)>,
    ) -> Spectrum {
        let o = self.optics;
        let (albedo, normal) = match end.kind {
            Kind::Water => return [0.0; N],
            Kind::Surface => return window(o, dir),
            Kind::Bed => (o.bed_albedo, self.terrain.normal(p.x, p.y)),
            Kind::Solid(n, normal) => (spread(self.obstacles.0[n].surface.albedo), normal),
        };
        let rough = (1.0 + o.texture * texture(p, end.way_m)).max(0.0);
        let waves = o.light.flicker * math::exp(0.25 * p.z.min(0.0));
        let day = o.light.on(&normal) * (1.0 + waves * grain(p, 0.3, 4)).max(0.0);
        let lit = o.light.irradiance(p.z);
        each(|i| {
            let lamp = lamp.map_or(0.0, |(lx, to)| lx[i] * normal.dot(&to).max(0.0));
            albedo[i] * rough / PI * (lit[i] * day + lamp)
        })
    }
}

/// Radiance of the surface seen from below along `dir`, cd/m².
fn window(o: &Optics, dir: &Vector3<f64>) -> Spectrum {
    const SKY: f64 = 0.3;
    const WAVES_RAD: f64 = 0.1;
    let light = &o.light;
    let mirrored = Vector3::new(dir.x, dir.y, -dir.z);
    let mirror = light.endless(&o.clarity, 0.0, &mirrored);
    let slant = math::acos(dir.z.min(1.0));
    let rim = math::asin(1.0 / INDEX);
    let sky_share = ((rim - slant) / (2.0 * WAVES_RAD) + 0.5).clamp(0.0, 1.0);
    let flat = INDEX * math::sin(slant.min(rim));
    let lost = fresnel((1.0 - flat * flat).max(0.0).sqrt(), math::cos(slant.min(rim)));
    let sky = SKY * light.above / PI * INDEX * INDEX * (1.0 - lost);
    let sun = (1.0 - SKY) * light.above * phase(0.97, dir.dot(&light.to_sun));
    each(|i| sky_share * (sky + sun) + (1.0 - sky_share) * mirror[i])
}

/// Unevenness of a surface at `p`, with mean zero and a variance of about one; details finer than a pixel at `way_m`
/// are left out.
fn texture(p: &Vector3<f64>, way_m: f64) -> f64 {
    let mut sum = 0.0;
    for (n, size) in [0.8, 0.2, 0.05].into_iter().enumerate() {
        // A pixel is some two thousandths of the distance wide.
        let fade = (size / (0.004 * way_m) - 0.5).clamp(0.0, 1.0);
        if fade > 0.0 {
            sum += fade * grain(p, size, n as u64);
        }
    }
    sum / 3.0f64.sqrt()
}

/// Noise of mean zero and variance one that varies over `size_m`: numbers at the corners of a grid, smoothly
/// interpolated.
fn grain(p: &Vector3<f64>, size_m: f64, layer: u64) -> f64 {
    let q = p / size_m;
    let cell = q.map(f64::floor);
    let part = (q - cell).map(|x| x * x * (3.0 - 2.0 * x));
    let mut sum = 0.0;
    for corner in 0..8u64 {
        let up = [corner & 1, (corner >> 1) & 1, corner >> 2];
        let mut key = layer;
        let mut weight = 1.0;
        for d in 0..3 {
            key = hash(key, (cell[d] as i64 as u64).wrapping_add(up[d]));
            weight *= if up[d] == 1 { part[d] } else { 1.0 - part[d] };
        }
        sum += weight * ((key >> 11) as f64 / 9_007_199_254_740_992.0 - 0.5);
    }
    // Uniform numbers have the variance 1/12, and the squares of the weights sum to (26/35)³ on average.
    sum * (12.0 / 0.409_935f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grain_has_mean_zero_and_variance_one() {
        let (n, mut m, mut v) = (200_000, 0.0, 0.0);
        let mut r = world::seeds::Stream::new(1, "test", "grain");
        for _ in 0..n {
            // Far apart, so that nearly every place has cells of its own.
            let p = Vector3::repeat(500.0).map(|far| far * (r.uniform() - 0.5));
            let z = grain(&p, 0.5, 3);
            m += z;
            v += z * z;
        }
        let n = f64::from(n);
        // 5 standard errors, for a kurtosis of at most 5.
        let said = (m / n, v / n);
        assert!(said.0.abs() < 5.0 / n.sqrt(), "{said:?}");
        assert!((said.1 - 1.0).abs() < 5.0 * (4.0 / n).sqrt(), "{said:?}");
    }

    #[test]
    fn the_window_is_bright_inside_and_dark_beyond_its_rim() {
        let o = Optics::new(&OpticsSpec::default()).unwrap();
        let at = |slant_deg: f64| {
            let (s, c) = math::sin_cos(slant_deg.to_radians());
            window(&o, &Vector3::new(s, 0.0, c))[3]
        };
        assert!(at(20.0) > 5.0 * at(60.0), "{} {}", at(20.0), at(60.0));
        let (s, c) = math::sin_cos(60f64.to_radians());
        let mirrored = o.light.endless(&o.clarity, 0.0, &Vector3::new(s, 0.0, -c));
        assert!((at(60.0) - mirrored[3]).abs() < 1e-9 * mirrored[3]);
    }
}
