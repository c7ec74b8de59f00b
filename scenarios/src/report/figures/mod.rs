//! Figures of a run: each drawn once as SVG with helpers of our own, and the PNG is that SVG
//! rasterised with a font the program carries, so both show the same on a machine without fonts.

mod belief;
pub(crate) mod canvas;
mod contours;
mod convergence;
mod map;
mod map_layers;
mod map_legend;
pub(crate) mod palette;
pub(crate) mod panel;
mod plume_load;
mod raster;
mod series;
mod series_panels;

pub(super) use belief::belief;
pub(crate) use canvas::escaped;
pub(super) use convergence::convergence;
pub(super) use map::map;
pub(crate) use raster::png;
pub(super) use series::series;
