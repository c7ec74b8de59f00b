//! Statistics of many runs: shares, quantiles, waiting times and differences, each with its interval.

mod adaptive;
mod bootstrap;
mod ecdf;
mod interval;
mod mean;
mod paired;
mod quantile;
mod survival;
mod wilson;

pub use adaptive::next_n;
pub use bootstrap::{RESAMPLES, quantile_interval};
pub use ecdf::Ecdf;
pub use interval::Interval;
pub use mean::{mean_interval, positive_mean_interval};
pub use paired::{Better, Difference, LEAST_PAIRS, Separation, paired_mean, paired_median, paired_share};
pub use quantile::{finite_sorted, middle, quantile};
pub use survival::{Survival, SurvivalStep};
pub use wilson::{Z95, wilson};

/// With fewer values than this, a mean or quantile has no useful interval: "too few".
pub const LEAST_VALUES: usize = 5;
