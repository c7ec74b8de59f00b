//! What runs leave behind: charts, figures, tables, reports, recordings, live state.
//!
//! Rooms, each of which knows only those before it: [`charts`] draws axes and shapes, [`record`] writes MCAP files of
//! ROS 2 messages, [`files`] writes what can fail, [`results`] gathers what a run's frames say, [`figures`] draws that,
//! [`report`] puts it into a folder. [`live`] is the only place that touches zenoh.

pub mod charts;
pub mod figures;
pub mod files;
pub mod live;
pub mod record;
pub mod report;
pub mod results;

#[cfg(test)]
mod sample;
#[cfg(test)]
mod sample_gantry;
