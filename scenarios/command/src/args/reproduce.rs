//! Arguments of `rheotaxis reproduce`.

use super::cache::CacheArgs;
use super::key::KeyArgs;
use super::values::within;
use std::path::PathBuf;
use studies::reproduce::Row;

/// Arguments of `reproduce`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(after_help = "Examples:\n  rheotaxis reproduce\n  rheotaxis reproduce duck_st --seeds 20\n  \
        rheotaxis reproduce crab --arm adaptive\n  \
        rheotaxis reproduce wp --seeds 1000 --first-seed 1001\n  \
        rheotaxis reproduce duck_st --until-width 0.05 --max 1000\n  \
        rheotaxis reproduce --keep docs/rows/kept --no-runs --check 0\n\n\
        Exit codes: 0 done, whatever the figures say; 130 interrupted; 1 error; 2 wrong usage.")]
pub struct ReproduceArgs {
    /// Names of rows, or row files of your own (RON) [default: all that come with the program].
    #[arg(value_name = "ROW")]
    pub rows: Vec<PathBuf>,
    /// Run only this arm of the rows. You may give it several times.
    #[arg(long = "arm", value_name = "NAME")]
    pub arms: Vec<String>,
    /// Seeds for each row; every arm runs with each of them.
    #[arg(long, value_name = "N", default_value_t = 200, conflicts_with = "until_width",
        value_parser = clap::value_parser!(u64).range(1..))]
    pub seeds: u64,
    /// First seed; the others follow it. Measure on seeds that were not used to set something up.
    #[arg(long, value_name = "SEED", default_value_t = 1,
        value_parser = clap::value_parser!(u64).range(..=1 << 62))]
    pub first_seed: u64,
    /// The key of the runs.
    #[command(flatten)]
    pub key: KeyArgs,
    /// The cache of spin-ups.
    #[command(flatten)]
    pub cache: CacheArgs,
    /// Use few seeds, for a first look: as many as the row says under `quick`, 20 unless it does.
    #[arg(long, conflicts_with_all = ["seeds", "until_width"])]
    pub quick: bool,
    /// Run until the success share is known to this half width; 0.05 means plus or minus 5 %.
    #[arg(long, value_name = "W",
        value_parser = within(f64::MIN_POSITIVE..=0.5_f64.next_down(), "must be > 0 and < 0.5"))]
    pub until_width: Option<f64>,
    /// With --until-width: at most this many seeds for each row.
    #[arg(long, value_name = "N", default_value_t = 2000, requires = "until_width",
        value_parser = clap::value_parser!(u64).range(1..))]
    pub max: u64,
    /// Runs at the same time; 0 means one on each core.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub jobs: usize,
    /// Folder for the results.
    #[arg(long, value_name = "DIR", default_value = "runs/reproduce")]
    pub out: PathBuf,
    /// Keep every run in this folder as tables, and take from them the runs that they hold already.
    #[arg(long, value_name = "DIR", conflicts_with = "key")]
    pub keep: Option<PathBuf>,
    /// With --keep: run so many seeds of each kept row again first, drawn at random; a row that now gives another
    /// digest is out of date.
    #[arg(long, value_name = "N", default_value_t = 1, requires = "keep")]
    pub check: usize,
    /// With --keep: make no runs, but the checks; print the figures of the kept ones.
    #[arg(long, requires = "keep", conflicts_with = "anew")]
    pub no_runs: bool,
    /// With --keep: replace the tables of rows that are out of date.
    #[arg(long, requires = "keep")]
    pub anew: bool,
    /// Do not show progress.
    #[arg(long, short)]
    pub quiet: bool,
}

impl ReproduceArgs {
    /// Seeds for a row; with a width to reach, at most.
    pub fn n(&self, row: &Row) -> u64 {
        match (self.quick, self.until_width) {
            (true, _) => row.quick.get(),
            (false, Some(_)) => self.max,
            (false, None) => self.seeds,
        }
    }
}

/// What the help of this command begins with.
pub(super) const REPRODUCE_ABOUT: &str = "Repeats the papers' experiments over many seeds. A table shows each of our figures with its 95 % \
        interval, the paper's figure, and whether that lies in the interval. Shares have Wilson's interval, medians \
        and other quantiles a bootstrap interval, and means an interval on the logarithmic scale. Fewer than 5 values \
        have none.\n\n\
        ROW is the name of an experiment. A name without a row of its own stands for all rows that begin with it: \
        `wp` means wp_laminar, wp_turbulent and wp_dead_end. The number of trials is shown before they start.\n\n\
        The results are REPRODUCTION.md, figures.csv (the table), rows.csv (every run) and declarations.csv. They are \
        renewed every 50 seeds, so an interrupted experiment keeps what is done. The figures do not depend on the \
        number of jobs. With several rows, each first runs one seed on each core: from then on it is known how long \
        all of them take.\n\n\
        With --keep, seed, outcome, digest and all measures of every run stay in a folder as small tables (CSV). A \
        later run takes from them what they hold, adds what they lack, and prints the figures of both. Before that, \
        seeds drawn at random are run again: if they give other digests, or the scenario has changed, the row is out \
        of date, which is an error.";
