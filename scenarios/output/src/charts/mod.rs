//! Charts: canvas, panels with axes, contours, colours; drawn as SVG with helpers of our own, and the PNG is that SVG
//! rasterised with a font the program carries, so both show the same on a machine without fonts.

pub mod canvas;
pub mod contours;
pub mod far;
pub mod palette;
pub mod panel;
mod raster;
pub mod room;

pub use canvas::escaped;
pub use raster::png;
