//! What runs leave behind: charts, figures, tables, reports, recordings, live state.
//!
//! Each module uses only the ones before it: [`charts`] draws axes and shapes, [`mcap`] writes MCAP files of ROS 2
//! messages, [`files`] writes files and reports failures, [`results`] gathers data from a run's frames, [`record`]
//! records them, [`figures`] draws them, and [`report`] puts them into a folder. [`live`] is the only place that uses
//! zenoh.
#![forbid(unsafe_code)]

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
