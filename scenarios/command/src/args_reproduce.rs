//! What `rheotaxis reproduce` can be asked.

use std::path::PathBuf;

/// Arguments of `reproduce`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(
    long_about = "Runs the experiments of the papers over many seeds and prints each figure of ours with \
        its 95 % interval, the paper's, and whether the paper's lies inside. Shares have Wilson's interval, \
        medians and quantiles a bootstrap interval, means one on the scale of the logarithm; of fewer than 5 values there is \
        none.\n\nA row is run by its name, with all its arms or those of `--arm`; a name that no row has stands for all rows that begin with it \
        and `_` (`wp`: wp_laminar, wp_turbulent, wp_dead_end). How many trials that makes is said first.\n\nLeaves REPRODUCTION.md, figures.csv (the table), rows.csv and declarations.csv \
        (every run), renewed every 50 seeds: an interrupted row leaves what it has done. Seeds are 1 to n, or as many from `--first-seed` on; the figures do not depend on the number of jobs.",
    after_help = "Examples:\n  rheotaxis reproduce\n  rheotaxis reproduce duck_st --seeds 20\n  rheotaxis reproduce crab --arm adaptive\n  \
        rheotaxis reproduce wp --seeds 1000 --first-seed 1001\n  rheotaxis reproduce duck_st --until-width 0.05 --max 1000\n\n\
        Exit codes: 0 ran, whatever the figures say; 130 interrupted; 1 error; 2 usage."
)]
pub struct ReproduceArgs {
    /// Rows by name, or row files of your own (RON); without any, all that come with the program.
    #[arg(value_name = "ROW")]
    pub rows: Vec<PathBuf>,
    /// Only this arm of the rows; may be given several times.
    #[arg(long = "arm", value_name = "NAME")]
    pub arms: Vec<String>,
    /// Seeds for each row; every arm runs with each of them.
    #[arg(long, value_name = "N", default_value_t = 200, conflicts_with = "until_width",
        value_parser = clap::value_parser!(u64).range(1..))]
    pub seeds: u64,
    /// The first seed; the others follow it. For figures on seeds that nobody has looked at while setting something up.
    #[arg(long, value_name = "SEED", default_value_t = 1,
        value_parser = clap::value_parser!(u64).range(..=1 << 62))]
    pub first_seed: u64,
    /// 20 seeds for each row: a first look.
    #[arg(long, conflicts_with_all = ["seeds", "until_width"])]
    pub quick: bool,
    /// Run until the success share is known to this half width (0.05: plus or minus 5 %).
    #[arg(long, value_name = "W", value_parser = half_width)]
    pub until_width: Option<f64>,
    /// At most so many seeds for each row.
    #[arg(long, value_name = "N", default_value_t = 2000, requires = "until_width",
        value_parser = clap::value_parser!(u64).range(1..))]
    pub max: u64,
    /// Runs at a time; 0 for one on each core.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub jobs: usize,
    /// Folder for the results.
    #[arg(long, value_name = "DIR", default_value = "runs/reproduce")]
    pub out: PathBuf,
    /// Show no progress.
    #[arg(long, short)]
    pub quiet: bool,
}

/// Seeds of a first look.
const QUICK: u64 = 20;

impl ReproduceArgs {
    /// Seeds for each row; with a width to reach, at most.
    #[must_use]
    pub fn n(&self) -> u64 {
        match (self.quick, self.until_width) {
            (true, _) => QUICK,
            (false, Some(_)) => self.max,
            (false, None) => self.seeds,
        }
    }
}

fn half_width(s: &str) -> Result<f64, String> {
    match s.parse::<f64>() {
        Ok(w) if w > 0.0 && w < 0.5 => Ok(w),
        _ => Err("must be > 0 and < 0.5".to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_shares_below_a_half() {
        assert_eq!(half_width("0.05"), Ok(0.05));
        for bad in ["0", "0.5", "-0.1", "nan", "inf", "5%", ""] {
            assert!(half_width(bad).is_err(), "{bad}");
        }
    }
}
