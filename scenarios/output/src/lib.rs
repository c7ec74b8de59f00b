//! What runs leave behind: charts, figures, tables, reports, recordings, live state.
//!
//! Rooms, each of which knows only those before it: [`charts`] draws axes and shapes, [`mcap`] writes MCAP files of
//! ROS 2 messages, [`files`] says what could not be written, [`results`] gathers what a run's frames say, [`record`]
//! records them, [`figures`] draws them, [`report`] puts them into a folder. [`live`] is the only place that touches zenoh.

pub mod charts;
pub mod figures;
pub mod files;
pub mod live;
pub mod mcap;
pub mod record;
pub mod report;
pub mod results;

#[cfg(test)]
mod sample;
#[cfg(test)]
mod sample_gantry;
