//! Renders a picture of a scene, with the truth about each of its pixels.
//!
//! *Source:* image formation under water: light from a surface, attenuated, plus the veil before it (McGlamery 1980,
//! Proc. SPIE 208, 221; Jaffe 1990, IEEE J. Oceanic Eng. 15, 101); the parts are in the files beside this one.
//!
//! *Parameters:* those of the camera ([`CameraSpec`]) and of the scene ([`Optics`]).
//!
//! *Deviations:* Jaffe's blur by forward scattering is left out.

use super::bands::{GREEN, Rgb, each, see};
use super::scene::{End, Kind, Optics, Scene};
use super::sensor::ExposedSensor;
use super::volume::{Lamp, Volume};
use image::RgbImage;
use robots::sense::{CameraSpec, Imaging, Surroundings};
use world::frames::Pose;
use world::math;

/// The truth about a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PixelTruth {
    /// How much the dye changes the pixel's light: the greatest change of a colour, as a share of the greater of its
    /// values with and without dye, 0–1. Above some 0.1 a person could see it.
    pub plume: f32,
    /// Share of green light that the dye absorbs on the way to what is behind it, 0–1: how opaque it is, near or far.
    pub opacity: f32,
    /// The obstacle whose surface is seen there, by its place in the scenario's order.
    pub obstacle: Option<u16>,
    /// Distance to what is seen there, m; where there is only water, the distance that light comes from.
    pub way_m: f32,
    /// Share of that surface's green light that reaches the camera.
    pub clear: f32,
}

/// A picture with the truth about it.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderedPicture {
    /// The picture.
    pub image: RgbImage,
    /// The truth, row by row from the top left.
    pub seen: Vec<PixelTruth>,
    /// Radiance before the sensor, cd/m², in the same order.
    pub radiance: Vec<[f32; 3]>,
}

/// Takes a picture of `scene` with a camera of the pose `pose_WC`; the sensor's noise depends only on `noise`.
pub fn render(camera: &CameraSpec, pose_WC: &Pose, scene: &Scene<'_>, noise: u64) -> RenderedPicture {
    let lamp = camera.lamp.as_ref().map(|l| Lamp::new(l, pose_WC));
    let (o, from) = (scene.optics, pose_WC.p_WB);
    let range = Volume::range_m(o);
    let near = scene.near(&from, range);
    let n = camera.width as usize * camera.height as usize;
    let middles =
        || (0..camera.height).flat_map(|y| (0..camera.width).map(move |x| [x, y].map(|v| f64::from(v) + 0.5)));
    let ends: Vec<End> =
        middles().map(|[x, y]| scene.end(&near, &from, &(pose_WC.R_WB * camera.ray(x, y)), range)).collect();
    let volume = Volume::new(camera, pose_WC, scene, lamp.as_ref(), ends.iter().map(|end| end.way_m));
    let (mut seen, mut radiance) = (Vec::with_capacity(n), Vec::with_capacity(n));
    let mut sum = [0.0; 3];
    for ([x, y], end) in middles().zip(ends) {
        let dir_C = camera.ray(x, y);
        let dir = pose_WC.R_WB * dir_C;
        let p = from + dir * end.way_m;
        let lit = lamp.as_ref().map(|l| l.on(&p, o));
        let surface = scene.radiance(&end, &p, &dir, lit);
        let veil = volume.before(x, y, end.way_m);
        let left = each(|i| math::exp(-o.clarity.attenuation[i] * end.way_m));
        let bare = see(&each(|i| left[i] * surface[i]));
        let shaded = see(&each(|i| left[i] * veil.passes[i] * surface[i]));
        let water = [0, 1, 2].map(|k| veil.water[k] + bare[k]);
        let dyed = [0, 1, 2].map(|k| veil.dyed[k] + shaded[k]);
        // The lens: light decreases as cos⁴ from the middle.
        let cos2 = dir_C.z * dir_C.z;
        let got = dyed.map(|l| l * cos2 * cos2);
        for i in 0..3 {
            sum[i] += got[i];
        }
        radiance.push(got.map(|v| v as f32));
        seen.push(PixelTruth {
            plume: change(&water, &dyed),
            opacity: (1.0 - veil.passes[GREEN]) as f32,
            obstacle: obstacle(&end),
            way_m: end.way_m as f32,
            clear: (left[GREEN] * veil.passes[GREEN]) as f32,
        });
    }
    let exposed = ExposedSensor::new(&camera.sensor, sum.map(|s| s / n as f64), noise);
    let bytes = (radiance.iter().enumerate()).flat_map(|(k, l)| exposed.pixel(k as u64, l.map(f64::from))).collect();
    let image = RgbImage::from_raw(camera.width, camera.height, bytes).expect("three bytes were made for each pixel");
    RenderedPicture { image, seen, radiance }
}

impl Imaging for Optics {
    fn picture(&self, camera: &CameraSpec, pose_WC: &Pose, around: &Surroundings, noise: u64) -> RgbImage {
        let scene = Scene { terrain: around.terrain, obstacles: around.obstacles, dye: around.dye, optics: self };
        render(camera, pose_WC, &scene, noise).image
    }
}

fn change(water: &Rgb, dyed: &Rgb) -> f32 {
    (0..3).map(|i| (water[i] - dyed[i]).abs() / water[i].max(dyed[i]).max(f64::MIN_POSITIVE)).fold(0.0, f64::max) as f32
}

fn obstacle(end: &End) -> Option<u16> {
    match end.kind {
        Kind::Solid(n, _) => Some(n as u16),
        _ => None,
    }
}
