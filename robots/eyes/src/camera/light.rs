//! Daylight in the water: how bright it is, where it comes from, and how much the water scatters towards a camera.
//!
//! *Source:* single scattering of a light field that has the shape of Henyey & Greenstein 1941 (Astrophys. J. 93, 70)
//! about the refracted sun. Two such shapes one after the other make a third with the product of their mean cosines,
//! so the light scattered into a line of sight has it too. Mean cosine of scattering 0.924 (Mobley 1994, Light and
//! Water, table 3.10, Petzold's particles, from memory; its share of backscattering, 0.017, lies within the 0.013 to
//! 0.020 that Petzold 1972, SIO Ref. 72-78, measured off California and in San Diego harbour, read from jerlov 0.22.0
//! (PyPI), `petzold1972_stations.csv`). Light on a tilted face from such a field: Ramamoorthi & Hanrahan 2001, J.
//! Opt. Soc. Am. A 18, 2448, eq. 12, to the fourth order. With depth: `clarity.rs`.
//!
//! *Parameters:* `sun_elevation_deg` 45°; `sun_heading_deg` direction of the sun, 180°; `illuminance_klux` on the
//! surface, 60 klx; `mean_cosine` of the light field in the water, 0.75 (Kirk 1994, Light and Photosynthesis in
//! Aquatic Ecosystems, ch. 6: 0.7 to 0.85 in the upper layer of coastal waters); `flicker` 0.1, see `scene.rs`.
//!
//! *Deviations:* the field keeps its shape with depth; the bed reflects no light up into the water; only dye casts a
//! shadow. Daylight is white, from sun and sky alike.

use super::bands::{Spectrum, each};
use super::clarity::Clarity;
use nalgebra::Vector3;
use robots::error::{RobotError, require};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::f64::consts::PI;
use world::math;
use world::ranges::{Fraction, HeadingDeg, NonNegative, Positive};

/// Index of refraction of sea water.
pub(super) const INDEX: f64 = 1.34;
/// Mean cosine of one scattering.
pub(super) const SCATTER_COSINE: f64 = 0.924;

/// Parameters of daylight.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct LightSpec {
    /// Elevation of the sun above the horizon, °, at most 90.
    #[default(NonNegative::new(45.0))]
    pub sun_elevation_deg: NonNegative,
    /// Direction of the sun.
    #[default(HeadingDeg::new(180.0))]
    pub sun_heading_deg: HeadingDeg,
    /// Illuminance of the surface, klx.
    #[default(Positive::new(60.0))]
    pub illuminance_klux: Positive,
    /// Mean cosine of the light field in the water, about the refracted sun.
    #[default(Fraction::new(0.75))]
    pub mean_cosine: Fraction,
    /// Standard deviation of the light focused by waves just below the surface, as a share of its mean.
    #[default(Fraction::new(0.1))]
    pub flicker: Fraction,
}

/// Daylight in the water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Unit vector in the water towards the direction from which most light comes.
    pub to_sun: Vector3<f64>,
    /// Attenuation with depth, 1/m.
    pub down: Spectrum,
    /// Scalar irradiance just below the surface, lx.
    pub scalar: f64,
    /// Illuminance above the surface, lx.
    pub above: f64,
    /// Mean cosine of the field.
    pub mean_cosine: f64,
    /// Flicker just below the surface.
    pub flicker: f64,
}

impl Light {
    /// The light of a specification in a water.
    ///
    /// # Errors
    /// If the sun is higher than the zenith.
    pub fn new(spec: &LightSpec, clarity: &Clarity) -> Result<Self, RobotError> {
        let elevation = spec.sun_elevation_deg.get();
        require(elevation <= 90.0, "optics.light.sun_elevation_deg", format!("must be from 0 to 90, got {elevation}"))?;
        let (up, flat) = math::sin_cos(elevation.to_radians());
        let flat_in = flat / INDEX;
        let mu = (1.0 - flat_in * flat_in).sqrt();
        let there = spec.sun_heading_deg.heading().unit() * flat_in;
        let above = 1e3 * spec.illuminance_klux.get();
        let mean_cosine = spec.mean_cosine.get();
        let enters = above * (1.0 - fresnel(up, mu));
        Ok(Self {
            to_sun: Vector3::new(there.x, there.y, mu),
            down: clarity.down(mu),
            scalar: enters / on_face(mean_cosine, mu),
            above,
            mean_cosine,
            flicker: spec.flicker.get(),
        })
    }

    /// Scalar irradiance at height `z` (m, negative below the surface), lx.
    pub fn irradiance(&self, z: f64) -> Spectrum {
        each(|i| self.scalar * math::exp(self.down[i] * z.min(0.0)))
    }

    /// Irradiance on a face with the outward unit normal `normal`, as a share of the scalar irradiance.
    pub fn on(&self, normal: &Vector3<f64>) -> f64 {
        on_face(self.mean_cosine, normal.dot(&self.to_sun))
    }

    /// Light that one scattering sends into the line of sight `dir` (unit vector away from the camera), 1/sr.
    pub fn scattered(&self, dir: &Vector3<f64>) -> f64 {
        phase(SCATTER_COSINE * self.mean_cosine, dir.dot(&self.to_sun))
    }

    /// Share of the field's light that comes from the camera's side of a place on the line of sight `dir`.
    pub fn from_front(&self, dir: &Vector3<f64>) -> f64 {
        (0.5 - 0.75 * self.mean_cosine * dir.dot(&self.to_sun)).clamp(0.0, 1.0)
    }

    /// Radiance of endless water along `dir` from height `z`, where there is nothing else to see, cd/m².
    pub fn endless(&self, clarity: &Clarity, z: f64, dir: &Vector3<f64>) -> Spectrum {
        let (e, p) = (self.irradiance(z), self.scattered(dir));
        each(|i| clarity.scattering[i] * p * e[i] / (clarity.attenuation[i] - self.down[i] * dir.z))
    }
}

/// Phase function of Henyey & Greenstein, 1/sr.
pub(super) fn phase(g: f64, cosine: f64) -> f64 {
    let d = 1.0 + g * g - 2.0 * g * cosine;
    (1.0 - g * g) / (4.0 * PI * d * d.sqrt())
}

/// Irradiance on a face as a share of the scalar irradiance, in a field of mean cosine `g` about an axis at cosine
/// `x` from the face's normal.
fn on_face(g: f64, x: f64) -> f64 {
    let (x2, g2) = (x * x, g * g);
    let p2 = 0.5 * (3.0 * x2 - 1.0);
    let p4 = 0.125 * (35.0 * x2 * x2 - 30.0 * x2 + 3.0);
    (0.25 + 0.5 * g * x + 0.3125 * g2 * p2 - 0.09375 * g2 * g2 * p4).max(0.0)
}

/// Share of unpolarised light that the surface reflects; cosines of the slants above and below it.
pub(super) fn fresnel(cos_air: f64, cos_water: f64) -> f64 {
    let s = (cos_air - INDEX * cos_water) / (cos_air + INDEX * cos_water);
    let p = (cos_water - INDEX * cos_air) / (cos_water + INDEX * cos_air);
    0.5 * (s * s + p * p)
}

#[cfg(test)]
mod tests {
    use super::super::clarity::ClaritySpec;
    use super::*;

    #[test]
    fn the_phase_function_has_its_mean_cosine_and_integrates_to_one() {
        for g in [0.0, 0.5, 0.75, 0.924] {
            let n = 200_000;
            let (mut whole, mut mean, mut back) = (0.0, 0.0, 0.0);
            for k in 0..n {
                let x = -1.0 + (f64::from(k) + 0.5) * 2.0 / f64::from(n);
                let p = 2.0 * PI * phase(g, x) * 2.0 / f64::from(n);
                whole += p;
                mean += p * x;
                back += if x < 0.0 { p } else { 0.0 };
            }
            assert!((whole - 1.0).abs() < 1e-5 && (mean - g).abs() < 1e-5);
            if g == SCATTER_COSINE {
                assert!((back - 0.017).abs() < 3e-4, "{back}");
            }
        }
    }

    #[test]
    fn a_face_gets_the_integral_of_the_field() {
        let g = 0.75;
        for tilt_deg in [0.0, 30.0, 60.0, 90.0, 130.0, 180.0f64] {
            let (s, c) = math::sin_cos(tilt_deg.to_radians());
            let axis = Vector3::new(s, 0.0, c);
            let (n, mut sum) = (400, 0.0);
            for k in 0..n {
                let up = (f64::from(k) + 0.5) / f64::from(n);
                for turn in 0..n {
                    let (y, x) = math::sin_cos(2.0 * PI * f64::from(turn) / f64::from(n));
                    let flat = (1.0 - up * up).sqrt();
                    let from = Vector3::new(flat * x, flat * y, up);
                    sum += up * phase(g, from.dot(&axis));
                }
            }
            sum *= 2.0 * PI / f64::from(n * n);
            // The series ends at the fourth order; the next term is 13/(4π) · π/64 · 2 · g⁶ < 0.018.
            assert!((on_face(g, c) - sum).abs() < 0.018, "{tilt_deg}: {sum}");
        }
    }

    #[test]
    fn level_irradiance_below_the_surface_is_what_comes_through() {
        let clarity = Clarity::new(&ClaritySpec::default()).unwrap();
        let light = Light::new(&LightSpec::default(), &clarity).unwrap();
        let level = light.scalar * light.on(&Vector3::z());
        assert!((0.95 * 60e3..0.99 * 60e3).contains(&level), "{level}");
        assert!((light.to_sun.norm() - 1.0).abs() < 1e-12);
        // The sun is in the south: the light comes from there.
        assert!(light.to_sun.y < -0.5);
        let deep = light.irradiance(-2.0);
        for (i, got) in deep.into_iter().enumerate() {
            let want = light.scalar * math::exp(-2.0 * light.down[i]);
            assert!((got - want).abs() < 1e-9 * want);
        }
    }
}
