//! `rheotaxis picture`: takes one picture of a scenario's plume.

use super::args_picture::PictureArgs;
use super::exit::Exit;
use super::{cache, say};
use image::RgbImage;
use nalgebra::Vector3;
use output::charts::picture_png;
use output::files::{ReportError, beside_no_run, write_whole};
use rheotaxis::assemble::WaterLight;
use rheotaxis::scenario::load_with;
use rheotaxis::trial::{Trial, Unwatched};
use robots::sense::camera::{CameraModel, CameraSpec, RenderedPicture, Scene, looking, render};
use std::path::{Path, PathBuf};
use world::ranges::Positive;
use world::registry::Registry;
use world::seeds;
use world::units::Heading;

/// Takes the picture and prints the names of the files.
pub(super) fn picture(registry: &Registry, args: &PictureArgs) -> Exit {
    if args.truth.as_ref() == Some(&args.out) {
        let problem = format!("--out and --truth are the same file, {}", args.out.display());
        say::error(problem, Some("name another file for one of them"));
        return Exit::Error;
    }
    let files = [Some(&args.out), args.truth.as_ref()];
    let free = |file: &PathBuf| beside_no_run(file);
    if let Err(error) = files.into_iter().flatten().try_for_each(free) {
        say::error(error, None);
        return Exit::Error;
    }
    let checked = load_with(registry, &args.file).and_then(|mut loaded| {
        if let Some(metres) = args.visibility.and_then(|v| Positive::try_from(v).ok()) {
            loaded.scenario.optics.clarity.visibility_m = metres;
        }
        loaded.check().map(|odd| (loaded, odd))
    });
    let loaded = match checked {
        Ok((loaded, odd)) => {
            say::warnings(&odd);
            loaded
        }
        Err(error) => {
            say::scenario_error(&error);
            return Exit::Error;
        }
    };
    if let Some(wrong) = args.visibility.filter(|v| Positive::try_from(*v).is_err()) {
        say::error(format!("--visibility must be > 0, got {wrong}"), None);
        return Exit::Error;
    }
    let mut trial = match Trial::assemble(&loaded, args.key.seed(args.seed)) {
        Ok(trial) => trial,
        Err(error) => {
            say::error(error, None);
            return Exit::Error;
        }
    };
    let world_of = |trial: &Trial| {
        let [east, north, up] = args.at.0;
        let bed = trial.simulation.ocean().terrain.bed_z(east, north);
        if up > 0.0 || up < bed {
            return Err(format!(
                "the camera must be in the water: at that place, up must be from {bed:.2} to 0 m, got {up}"
            ));
        }
        let p = Vector3::new(east, north, up);
        match trial.simulation.ocean().obstacles.containing(&p) {
            Some(solid) => Err(format!("the camera would be inside obstacle \"{}\"", solid.id)),
            None => Ok(p),
        }
    };
    let p_W = match world_of(&trial) {
        Ok(p_W) => p_W,
        Err(problem) => {
            say::error(problem, None);
            return Exit::Error;
        }
    };
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
    let camera = CameraModel::new(&spec.unwrap_or_default());
    let [heading, down] = args.look.0;
    let pose_WC = looking(p_W, Heading::from_deg(heading).yaw(), down.to_radians());
    let noise = seeds::key(args.key.seed(args.seed), "picture", "camera");
    let made = render(&camera, &pose_WC, &scene, noise);
    let files = [
        Some((args.out.as_path(), made.image.clone())),
        (args.truth.as_deref()).map(|path| (path, truth(&camera, &made))),
    ];
    let mut exit = Exit::Success;
    for (path, image) in files.into_iter().flatten() {
        match write_png(path, &image) {
            Ok(()) => say::line(path.display()),
            Err(error) => {
                say::error(error, None);
                exit = Exit::Error;
            }
        }
    }
    exit
}

/// The truth as a picture. Red is how much the dye changes a pixel, blue the share of a solid's light that arrives.
fn truth(camera: &CameraModel, made: &RenderedPicture) -> RgbImage {
    let byte = |share: f32| (255.0 * share.clamp(0.0, 1.0) + 0.5) as u8;
    let bytes = (made.seen.iter()).flat_map(|s| {
        let solid = s.obstacle.map_or(0.0, |_| s.clear);
        [byte(s.plume), 0, byte(solid)]
    });
    RgbImage::from_raw(camera.width, camera.height, bytes.collect()).expect("there is a truth for every pixel")
}

fn write_png(path: &Path, image: &RgbImage) -> Result<(), ReportError> {
    let png = picture_png(image).map_err(|e| ReportError::Draw { path: path.to_owned(), cause: e.to_string() })?;
    write_whole(path, &png).map(drop)
}
