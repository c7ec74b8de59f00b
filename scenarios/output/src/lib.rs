//! What runs leave behind: charts, figures, tables, reports, recordings, live state.
//!
//! Each module uses only the ones before it: [`charts`] draws axes and shapes, [`ros`] encodes ROS 2 messages, [`mcap`]
//! writes MCAP files of them, [`columns`] describes the columns of tables, [`scene`] says what is there before a run,
//! [`files`] writes files and reports failures, [`results`] gathers data from a run's frames, [`record`] records them,
//! [`figures`] draws them, [`report`] puts them into a folder, and [`follow`] does all of that for a run. [`shown`]
//! writes mistakes of a scenario for people.
//! [`live`] is the only place that uses zenoh.
#![forbid(unsafe_code)]

pub mod charts;
pub mod columns;
mod decimal;
pub mod figures;
pub mod files;
pub mod follow;
pub mod live;
pub mod mcap;
pub mod record;
pub mod report;
pub mod results;
pub mod ros;
pub mod scene;
pub mod shown;

#[cfg(test)]
mod sample;
#[cfg(test)]
mod sample_gantry;
#[cfg(test)]
mod sample_run;
