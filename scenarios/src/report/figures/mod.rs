//! Figures of a run: each drawn once as SVG with helpers of our own, and the PNG is that SVG
//! rasterised with a font the program carries, so both show the same on a machine without fonts.

mod approach;
mod belief;
pub(crate) mod canvas;
mod contours;
mod convergence;
mod far;
mod flume;
mod layers_panel;
mod map;
mod map_layers;
mod map_legend;
mod map_section;
mod odour;
pub(crate) mod palette;
pub(crate) mod panel;
mod plume_load;
mod probe_records;
mod raster;
pub(crate) mod room;
mod section;
mod series;
mod series_panels;
mod sidescan;
mod solids;
#[cfg(test)]
mod tests_map;

pub(super) use approach::approach;
pub(super) use belief::belief;
pub(crate) use canvas::escaped;
pub(super) use convergence::convergence;
pub(super) use flume::flume;
pub(super) use map::map;
pub(super) use odour::odour;
pub(super) use probe_records::probe_records;
pub(crate) use raster::png;
pub(super) use series::series;
pub(super) use sidescan::sidescan;
