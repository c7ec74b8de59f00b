//! `rheotaxis picture`: takes one picture of a scenario's plume.

use super::cache;
use crate::args::picture::PictureArgs;
use crate::exit::Exit;
use crate::failure::{Failure, hinted};
use crate::say;
use eyes::camera::{RenderedPicture, Scene, render};
use image::RgbImage;
use nalgebra::Vector3;
use output::charts::picture_png;
use output::files::{ReportError, beside_no_run, write_whole};
use rheotaxis::assemble::WaterLight;
use rheotaxis::ocean::Ocean;
use rheotaxis::scenario::load_with;
use rheotaxis::trial::{Trial, Unwatched};
use robots::sense::{CameraSpec, looking};
use std::path::Path;
use world::ranges::Positive;
use world::registry::Registry;
use world::seeds;
use world::units::Heading;

/// Takes the picture and prints the names of the files.
pub(crate) fn picture(registry: &Registry, args: &PictureArgs) -> Result<Exit, Failure> {
    if args.truth.as_ref() == Some(&args.out) {
        let problem = format!("--out and --truth are the same file, {}", args.out.display());
        return Err(hinted(problem, "name another file for one of them"));
    }
    for file in [Some(&args.out), args.truth.as_ref()].into_iter().flatten() {
        beside_no_run(file)?;
    }
    let mut loaded = load_with(registry, &args.file)?;
    let visibility_m = args.visibility.map(Positive::try_from);
    if let Some(Ok(metres)) = visibility_m {
        loaded.scenario.optics.clarity.visibility_m = metres;
    }
    say::warnings(&loaded)?;
    if let Some((wrong, Err(_))) = args.visibility.zip(visibility_m) {
        return Err(format!("--visibility must be > 0, got {wrong}").into());
    }
    let mut trial = Trial::assemble(&loaded, args.key.seed(args.seed))?;
    let p_W = place(trial.simulation.ocean(), args.at.0)?;
    match cache::opened(&args.cache) {
        Some(kept) => {
            trial.spin_up_with(&kept, &mut Unwatched);
            cache::tell_fault(Some(&kept));
        }
        None => {
            trial.spin_up(&mut Unwatched);
        }
    }
    let (world, ocean) = (&trial.simulation.world, trial.simulation.ocean());
    let scene = Scene {
        terrain: &ocean.terrain,
        obstacles: &ocean.obstacles,
        dye: ocean.plume(),
        optics: &world.resource::<WaterLight>().0,
    };
    let spec = (loaded.scenario.robots.iter()).find_map(|r| r.sensors.get::<CameraSpec>().cloned());
    let camera = spec.unwrap_or_default();
    let [heading, down] = args.look.0;
    let pose_WC = looking(p_W, Heading::from_deg(heading).yaw(), down.to_radians());
    let noise = seeds::key(args.key.seed(args.seed), "picture", "camera");
    let made = render(&camera, &pose_WC, &scene, noise);
    let written = write_png(&args.out, &made.image);
    let beside = args.truth.as_ref().map_or(Ok(()), |path| write_png(path, &truth(&camera, &made)));
    // If one file cannot be written, the other is.
    match ReportError::combine(written.err().into_iter().chain(beside.err()).collect()) {
        None => Ok(Exit::Success),
        Some(error) => Err(error.into()),
    }
}

/// The place of the camera (ENU, m), if it is in the water.
fn place(ocean: &Ocean, [east, north, up]: [f64; 3]) -> Result<Vector3<f64>, String> {
    let bed = ocean.terrain.bed_z(east, north);
    if up > 0.0 || up < bed {
        return Err(format!(
            "the camera must be in the water: at that place, up must be from {bed:.2} to 0 m, got {up}"
        ));
    }
    let p = Vector3::new(east, north, up);
    match ocean.obstacles.containing(&p) {
        Some(solid) => Err(format!("the camera would be inside obstacle \"{}\"", solid.id)),
        None => Ok(p),
    }
}

/// The truth as a picture. Red is how much the dye changes a pixel, blue the share of a solid's light that arrives.
fn truth(camera: &CameraSpec, made: &RenderedPicture) -> RgbImage {
    let byte = |share: f32| (255.0 * share.clamp(0.0, 1.0) + 0.5) as u8;
    let bytes = (made.seen.iter()).flat_map(|s| {
        let solid = s.obstacle.map_or(0.0, |_| s.clear);
        [byte(s.plume), 0, byte(solid)]
    });
    RgbImage::from_raw(camera.width, camera.height, bytes.collect()).expect("there is a truth for every pixel")
}

/// Writes a picture and prints the name of the file.
fn write_png(path: &Path, image: &RgbImage) -> Result<(), ReportError> {
    let png = picture_png(image).map_err(|e| ReportError::Draw { path: path.to_owned(), cause: e.to_string() })?;
    write_whole(path, &png)?;
    say::line(path.display());
    Ok(())
}
