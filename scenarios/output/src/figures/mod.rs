//! Figures of a run, each an SVG text that is drawn with [`crate::charts`].

mod approach;
mod belief;
mod convergence;
mod flume;
mod layers_panel;
mod map;
pub(super) mod marks;
mod odour;
mod plume_load;
mod probe_records;
mod section;
mod series;
mod series_panels;
mod shaded_cells;
mod sidescan;
mod solids;
mod thinned;
mod vehicles;

pub use approach::approach;
pub use belief::belief;
pub use convergence::convergence;
pub use flume::flume;
pub use map::map;
pub use odour::odour;
pub use probe_records::probe_records;
pub use series::series;
pub use sidescan::sidescan;
