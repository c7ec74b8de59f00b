//! Charts: canvas, panels with axes, contours, colours. Figures are drawn as SVG with our own helpers. The PNG is the
//! same SVG, rasterised with a font that the program contains, so both look the same on a machine without fonts.
//! *Written here*: plotting crates have no belief maps, sections and flumes as papers of our field show them.

pub mod canvas;
pub mod contours;
mod elements;
pub mod far;
mod glyphs;
pub mod label_box;
mod paint;
pub mod palette;
pub mod panel;
mod raster;
mod thin;

pub use canvas::escaped;
pub use raster::{mask_png, picture_png, png, small_png};
