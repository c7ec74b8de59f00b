//! The pictures of a source added up: a line over it in murky water, the ground that its pictures make together, and
//! what they say after the first picture and after the last.
//!
//! `cargo run --release -p rheotaxis-studies --example studies mosaic mosaic.png`

use eyes::camera::{Optics, Scene, render};
use eyes::vision::place::{Mosaic, PlaceEvidence, PlacePictures, Stand};
use image::imageops::{FilterType, resize};
use image::{Rgb, RgbImage};
use nalgebra::{UnitQuaternion, Vector2, Vector3};
use rheotaxis::ocean::Origin;
use rheotaxis::scenario::load;
use robots::handoff::Picture;
use robots::sense::{CameraSpec, looking, turned};
use robots::strategy::AddUpSpec;
use std::error::Error;
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;
use world::ranges::Positive;
use world::terrain::Terrain;
use world::units::Heading;

/// The scenario whose water, bed and source these are, and its visibility, here 6 m.
const SCENARIO: &str = "inspect_places";
const VISIBILITY_M: &str = "6";
const ALTITUDE_M: f64 = 2.0;
/// How far the told place is from the source, east and north, m.
const TOLD_M: [f64; 2] = [0.4, -0.3];
/// Sides of a cell in the drawing, px.
const CELL_PX: u32 = 4;

#[allow(clippy::print_stdout, reason = "an example shows its result")]
pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let to = std::env::args().nth(2).unwrap_or("mosaic.png".to_string());
    let loaded = load(SCENARIO.as_ref())?.set("optics.visibility_m", VISIBILITY_M)?;
    let mut ocean = Origin::from_scenario(&loaded.scenario, &loaded.base_dir, 900_003).build(&loaded.base_dir)?;
    ocean.spin_up(|_| true);
    let Terrain::Level { depth_m } = ocean.terrain else {
        return Err("a level bed is needed: all pictures are from one height".into());
    };
    let source = ocean.sources()[0].xy();
    let optics = Optics::new(&loaded.scenario.optics)?;
    let scene = Scene { terrain: &ocean.terrain, obstacles: &ocean.obstacles, dye: ocean.plume(), optics: &optics };
    let camera = CameraSpec { width: 96, height: 72, view_deg: Positive::new(90.0), ..CameraSpec::default() };
    let mut place = PlacePictures::new(&AddUpSpec::default(), source + Vector2::from(TOLD_M), Heading::from_deg(90.0));
    let mut strip = Vec::new();
    for (n, north) in [0.0, 0.9, -0.9].into_iter().enumerate() {
        for k in 0..9 {
            let east = 1.5 * f64::from(k) - 6.0;
            let at = Vector3::new(source.x + east, source.y + north, ALTITUDE_M - depth_m);
            let noise = 100 * n as u64 + k as u64;
            let made = render(&camera, &looking(at, 0.0, FRAC_PI_2), &scene, noise);
            if n == 0 && (3..7).contains(&k) {
                strip.push(made.image.clone());
            }
            let picture = Picture {
                image: Arc::new(made.image),
                p_BC: Vector3::zeros(),
                R_BC: turned(0.0, FRAC_PI_2),
                view_rad: camera.view_rad(),
            };
            let stand = Stand { position: at.xy(), altitude_m: ALTITUDE_M, R_WB: UnitQuaternion::identity() };
            place.add(&picture, &stand).map_err(|why| format!("{why:?}"))?;
            if n == 0 && k == 4 || n == 2 && k == 8 {
                let said = place.weigh();
                println!(
                    "{} pictures: {:?}, logarithm of the Bayes factor {:+.1}, visibility {:.1} m",
                    place.pictures()[0],
                    said.answer,
                    said.log_factor,
                    place.clarity().map_or(f64::NAN, |c| c.visibility_m())
                );
            }
        }
    }
    let mosaic = place.mosaic().ok_or("no pictures")?;
    draw(&strip, &mosaic, &place.weigh()).save(to)?;
    Ok(())
}

/// A strip of single pictures; below it brightness, redness and the likelihood of a source on the ground.
fn draw(strip: &[RgbImage], mosaic: &Mosaic, said: &PlaceEvidence) -> RgbImage {
    let [w, h] = mosaic.size.map(|n| n as u32);
    let side = w * CELL_PX;
    let mut out = RgbImage::from_pixel(3 * side + 20, h * CELL_PX + 260, Rgb([255; 3]));
    for (n, picture) in strip.iter().enumerate() {
        let larger = resize(picture, 333, 250, FilterType::Nearest);
        image::imageops::replace(&mut out, &larger, n as i64 * 343, 0);
    }
    let grey = |v: f64| Rgb([(128.0 + 110.0 * v).clamp(0.0, 255.0) as u8; 3]);
    let unseen = Rgb([40, 50, 90]);
    let cell = |x: u32, y: u32| mosaic.contrast(x as usize, (h - 1 - y) as usize);
    let panels = [0, 1].map(|k| RgbImage::from_fn(w, h, |x, y| cell(x, y).map_or(unseen, |c| grey(c[k]))));
    let mut likely = panels[0].clone();
    for (p, log) in &said.places {
        let at = [0, 1].map(|k| (p[k] / mosaic.cell_m).floor() as i32 - mosaic.low[k]);
        // From red, against a source, over white to green, for it.
        let v = (log / 12.0).clamp(-1.0, 1.0);
        let [more, less] = [255.0, 255.0 * (1.0 - v.abs())].map(|v| v as u8);
        let colour = if v > 0.0 { [less, more, less] } else { [more, less, less] };
        for (dx, dy) in (0..3).flat_map(|x| (0..3).map(move |y| (x, y))) {
            let (x, y) = (at[0] + dx, h as i32 - 1 - at[1] - dy);
            if (0..w as i32).contains(&x) && (0..h as i32).contains(&y) {
                likely.put_pixel(x as u32, y as u32, Rgb(colour));
            }
        }
    }
    for (n, panel) in [&panels[0], &panels[1], &likely].into_iter().enumerate() {
        let larger = resize(panel, side, h * CELL_PX, FilterType::Nearest);
        image::imageops::replace(&mut out, &larger, i64::from(n as u32 * (side + 10)), 260);
    }
    out
}
