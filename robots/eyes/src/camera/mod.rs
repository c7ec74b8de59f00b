//! A camera under water: pictures of bed, solids and dye as light makes them, with the truth about each pixel.
//!
//! To render without a simulation:
//!
//! ```
//! use nalgebra::Vector3;
//! use eyes::camera::{Optics, OpticsSpec, Scene, render};
//! use robots::sense::{CameraSpec, looking};
//! use world::{fields::Clean, obstacles::Obstacles, terrain::Terrain};
//!
//! // Clarity, light, dye and bed: every field has a default; murkiness is `clarity.visibility_m`.
//! let optics = Optics::new(&OpticsSpec::default())?;
//! let scene = Scene {
//!     terrain: &Terrain::Level { depth_m: 6.0 },
//!     obstacles: &Obstacles::default(), // `Obstacle::surface.albedo` is their colour
//!     dye: &Clean,                      // anything that is a `Concentration`, kg/m³
//!     optics: &optics,
//! };
//! let camera = CameraSpec { width: 64, height: 48, ..CameraSpec::default() };
//! // At (0, 0, -4) m, looking east and 20° down; the last number is the noise's seed.
//! let pose_WC = looking(Vector3::new(0.0, 0.0, -4.0), 0.0, 20f64.to_radians());
//! let made = render(&camera, &pose_WC, &scene, 1);
//! assert_eq!(made.image.dimensions(), (64, 48));
//! // The truth, row by row: `seen[n].plume`, 0–1, is how much dye changes the pixel, `.obstacle` which solid is there,
//! // `.clear` how much of that solid's own light arrives.
//! assert!(made.seen.iter().all(|s| s.plume == 0.0 && s.obstacle.is_none()));
//! # Ok::<(), robots::error::RobotError>(())
//! ```

mod bands;
mod clarity;
mod dye;
mod dye_grid;
mod light;
mod render;
mod scene;
mod sensor;
#[cfg(test)]
mod tests;
mod volume;
mod waters;

pub use clarity::{Clarity, ClaritySpec};
pub use dye::{Dye, DyeSpec};
pub use light::{Light, LightSpec};
pub use render::{PixelTruth, RenderedPicture, render};
pub use scene::{Optics, OpticsSpec, Scene};
