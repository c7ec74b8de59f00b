//! A drawn scene, built and rendered: its plume in a turbulent stream, its picture, and the true content of each pixel.

use super::draw::{Content, SceneDraw};
use eyes::camera::{ClaritySpec, LightSpec, Optics, OpticsSpec, Scene, render};
use image::{GrayImage, Luma, RgbImage};
use nalgebra::{Vector2, Vector3};
use plumes::filaments::{Plume, PlumeSettings};
use plumes::flow::channel::open_channel::OpenChannelSpec;
use plumes::flow::eddies::EddiesSpec;
use plumes::flow::{CurrentSpec, GridShape, WaterSpec};
use plumes::release::{ReleaseSpec, SourceSpec};
use robots::sense::{CameraSpec, looking};
use std::path::Path;
use world::area::Area;
use world::fields::{Clean, Concentration, Flow};
use world::math;
use world::obstacles::{Base, BoxShape, Obstacle, ObstacleSpec, Obstacles, ShapeSpec, Surface};
use world::ranges::{Finite, Fraction, HeadingDeg, NonNegative, Positive};
use world::terrain::Terrain;
use world::units::Heading;

/// Depth of the water, m.
const DEPTH_M: f64 = 6.0;
/// The source: 1.0 m by 0.5 m (Tian et al. 2013, section 4), half a metre high; dye leaves it just above its top.
const BODY_M: [f64; 3] = [1.0, 0.5, 0.5];
const NOZZLE_M: f64 = 0.55;
/// Sand roughness of the bed, m.
const BED_M: f64 = 0.01;
/// Filaments per second, and their size at release, m.
const FILAMENTS_HZ: f64 = 20.0;
const FILAMENT_M: f64 = 0.03;
/// Size below which eddies are not resolved, m: a quarter of the depth over 2π.
const EDDY_M: f64 = 0.24;
/// The plume is as old as it needs to be to reach this far down-flow at half the mean current, m.
const REACH_M: f64 = 10.0;
const STEP_S: f64 = 0.5;
/// A pixel shows dye if its light changes by at least this much; Blackwell's 2 % is the limit for an even patch.
pub(super) const DYED: f32 = 0.1;
/// A pixel shows the body if at least this share of the body's own light arrives.
pub(super) const CLEAR: f32 = 0.02;

/// A picture with known content.
#[derive(Clone, Debug)]
pub struct Shot {
    /// The picture.
    pub picture: RgbImage,
    /// Where dye changes the light: 255 or 0.
    pub dye: GrayImage,
    /// The pixels that show the source; empty if there is none.
    pub source: GrayImage,
}

/// Renders a scene as a picture of a width and height, px.
///
/// # Errors
/// If the scene cannot be built: a mistake in its ranges.
pub fn shoot(seed: u64, d: &SceneDraw, [width, height]: [u32; 2]) -> Result<Shot, String> {
    let terrain = Terrain::Level { depth_m: DEPTH_M };
    let standing = matches!(d.content, Content::Source | Content::Body);
    let obstacles = if standing {
        let body = Obstacle::build(&body(d), &terrain, Path::new(""));
        Obstacles(vec![body.map_err(|e| e.to_string())?])
    } else {
        Obstacles::default()
    };
    let dyed = matches!(d.content, Content::Source | Content::Dye);
    let plume = dyed.then(|| plume(seed, d, &terrain)).transpose()?;
    let optics = Optics::new(&optics(d)).map_err(|e| e.to_string())?;
    let scene = Scene {
        terrain: &terrain,
        obstacles: &obstacles,
        dye: plume.as_ref().map_or(&Clean as &dyn Concentration, |p| p),
        optics: &optics,
    };
    let camera = CameraSpec { width, height, ..CameraSpec::default() };
    let noise = world::seeds::key(seed, &format!("scene-{}", d.n), "camera");
    let made = render(&camera, &pose(d), &scene, noise);
    let mask = |of: &dyn Fn(usize) -> bool| {
        GrayImage::from_fn(width, height, |x, y| Luma([255 * u8::from(of((y * width + x) as usize))]))
    };
    let is_source = d.content == Content::Source;
    Ok(Shot {
        dye: mask(&|k| made.seen[k].plume >= DYED),
        source: mask(&|k| is_source && made.seen[k].obstacle.is_some() && made.seen[k].clear >= CLEAR),
        picture: made.image,
    })
}

fn body(d: &SceneDraw) -> ObstacleSpec {
    let albedo = |times: f64| Fraction::new(d.albedo * times);
    let [l, w, h] = BODY_M.map(Positive::new);
    ObstacleSpec {
        id: "body".to_string(),
        shape: ShapeSpec::Box(BoxShape { size_m: (l, w, h) }),
        east_m: Finite::new(0.0),
        north_m: Finite::new(0.0),
        base: Base::default(),
        heading_deg: HeadingDeg::new(d.body_heading_deg),
        // "Dark and close to the blue color" (section 5).
        surface: Surface { albedo: (albedo(1.0), albedo(1.0), albedo(1.3)), ..Surface::default() },
    }
}

/// The plume of a source at the origin in a stream to the east.
fn plume(seed: u64, d: &SceneDraw, terrain: &Terrain) -> Result<Plume, String> {
    let area = Area { centre: Vector2::new(8.0, 0.0), length_m: 36.0, width_m: 18.0, axis: Heading::from_deg(90.0) };
    let stream = OpenChannelSpec {
        mean_m_s: Positive::new(d.current_m_s),
        heading_deg: HeadingDeg::new(90.0),
        roughness_m: NonNegative::new(BED_M),
        viscosity_m2_s: Positive::new(1e-6),
        eddies: Some(EddiesSpec::default()),
    };
    let water = WaterSpec { currents: vec![CurrentSpec::new(stream)], ..WaterSpec::default() };
    let seed = world::seeds::key(seed, &format!("scene-{}", d.n), "plume");
    let mut water = (water.build(&area, terrain, seed)).map_err(|e| e.to_string())?;
    let source = SourceSpec {
        id: "source".to_string(),
        east_m: Finite::new(0.0),
        north_m: Finite::new(0.0),
        height_m: Some(Finite::new(NOZZLE_M)),
        depth_m: None,
        rate_g_s: Positive::new(d.dye_g_min / 60.0),
        release: ReleaseSpec {
            rate_hz: Positive::new(FILAMENTS_HZ),
            initial_size_m: Positive::new(FILAMENT_M),
            eddy_size_m: Some(Positive::new(EDDY_M)),
            ..ReleaseSpec::default()
        },
    };
    let settings = PlumeSettings { grid: GridShape::fitting(&area), refresh_s: 1e6 };
    let mut plume = Plume::new(&[source], &area, terrain, seed, settings).map_err(|e| e.to_string())?;
    let steps = (REACH_M / (0.5 * d.current_m_s) / STEP_S).ceil() as u64;
    for k in 0..steps {
        let (t0, t1) = (k as f64 * STEP_S, (k + 1) as f64 * STEP_S);
        water.advance(t1);
        plume.drift(&water, t0, t1);
    }
    Ok(plume)
}

fn optics(d: &SceneDraw) -> OpticsSpec {
    OpticsSpec {
        clarity: ClaritySpec { visibility_m: Positive::new(d.visibility_m), ..ClaritySpec::default() },
        light: LightSpec {
            sun_elevation_deg: NonNegative::new(d.sun_elevation_deg),
            sun_heading_deg: HeadingDeg::new(d.sun_heading_deg),
            illuminance_klux: Positive::new(d.illuminance_klx),
            ..LightSpec::default()
        },
        ..OpticsSpec::default()
    }
}

/// The camera's pose: at a distance from its target and looking at it, except for `off_deg`.
fn pose(d: &SceneDraw) -> world::frames::Pose {
    let at = match d.content {
        Content::Source | Content::Body | Content::Nothing => Vector3::new(0.0, 0.0, -DEPTH_M + 0.3),
        Content::Dye => Vector3::new(d.down_flow_m, 0.0, -DEPTH_M + NOZZLE_M),
    };
    let (s, c) = math::sin_cos(d.bearing_deg.to_radians());
    let from = Vector3::new(at.x + d.range_m * c, at.y + d.range_m * s, -DEPTH_M + d.height_m);
    let down = math::atan2(from.z - at.z, d.range_m);
    looking(from, math::atan2(-s, -c) + d.off_deg[0].to_radians(), down - d.off_deg[1].to_radians())
}

#[cfg(test)]
mod tests {
    use super::super::draw::draw;
    use super::*;

    fn count(mask: &GrayImage) -> usize {
        mask.pixels().filter(|m| m.0[0] > 0).count()
    }

    /// In the clearest water everything is where it should be: scenes 18 to 23 have the last range of visibility.
    #[test]
    fn pictures_show_what_was_drawn() {
        for n in 18..24 {
            let d = draw(5, n);
            let shot = shoot(5, &d, [48, 36]).unwrap();
            let (dye, source) = (count(&shot.dye), count(&shot.source));
            assert_eq!(source > 0, d.content == Content::Source, "{n}: {source}");
            match d.content {
                Content::Source => assert!(dye > 0, "{n}"),
                Content::Body | Content::Nothing => assert_eq!(dye, 0, "{n}"),
                Content::Dye => {}
            }
        }
    }

    #[test]
    fn pictures_are_repeatable_bit_by_bit() {
        let d = draw(5, 18);
        let [a, b] = [(); 2].map(|()| shoot(5, &d, [32, 24]).unwrap());
        assert_eq!(a.picture, b.picture);
    }
}
