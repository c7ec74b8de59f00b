//! The plume's statistics, compared with published ones: `rheotaxis statistics`.

mod expected;
mod figure;
mod gamma;
mod measure;
mod results;
mod series;
mod write;

pub use figure::{PlumeFigure, Statistics};
pub use measure::{StatisticsError, statistics};
pub use write::{table, write};
