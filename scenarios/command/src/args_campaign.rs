//! What `rheotaxis campaign` can be asked.

use clap::Subcommand;
use std::path::PathBuf;
use std::time::Duration;
use studies::campaign::Shard;

/// Arguments of `campaign`.
#[derive(Clone, Debug, clap::Args)]
#[command(
    long_about = "A campaign file (RON) says which scenario, which arms (values changed by their path in it), \
        under which conditions and with which seeds. Every arm runs with the same seeds.\n\n\
        `seeds: 20` is seeds 1 to 20, `seeds: Literal(first: 101, count: 20)` 101 to 120: a row is that of `rheotaxis run \
        --seed N` of the same scenario, digest and all. `seeds: Hashed(seed: 1, count: 20)` are others under each condition. \
        (A file of version 1 means hashed seeds by a number; it is read so, and says so.)\n\n\
        `run` writes blocks of rows, each a Parquet file: what has a row is \
        done, so a campaign goes on after any interruption, and any number of machines share a folder. \
        A run's row does not depend on how the work was dealt out.",
    after_help = AFTER
)]
pub struct CampaignArgs {
    /// What to do.
    #[command(subcommand)]
    pub command: CampaignCommand,
}

const AFTER: &str = "\
Examples:
  rheotaxis campaign plan duck_beta
  rheotaxis campaign run duck_beta --out beta
  rheotaxis campaign status beta
  rheotaxis campaign merge beta -o beta.parquet --csv
  rheotaxis campaign report beta
  rheotaxis campaign rerun beta --run 17 --record

Exit codes: 0 done; 75 stopped before the end, the same command goes on; 1 error; 2 usage.";

/// What to do with a campaign.
#[derive(Clone, Debug, Subcommand)]
pub enum CampaignCommand {
    /// Check a campaign, count its runs and estimate what they cost.
    Plan(PlanArgs),
    /// Run it, or what is left of it.
    Run(CampaignRunArgs),
    /// Say how far it has come.
    Status(StatusArgs),
    /// Put all its rows into one file, and their declarations into one beside it.
    Merge(MergeArgs),
    /// Compare its arms: tables, figures and a page.
    Report(ReportArgs),
    /// Make one of its runs again, with all that `rheotaxis run` leaves.
    Rerun(RerunArgs),
}

/// Arguments of `campaign plan`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct PlanArgs {
    /// Campaign file, or the name of a campaign that comes with the program.
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Runs in a block; without it what one thread does in half a minute.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    pub block: Option<u64>,
    /// Estimate no cost: that takes one run.
    #[arg(long)]
    pub no_probe: bool,
}

/// Arguments of `campaign run`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(after_help = RUN_AFTER)]
pub struct CampaignRunArgs {
    /// Campaign file, or the name of a campaign that comes with the program.
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Folder for the blocks; may be shared by many machines.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Do the I-th of N shares, counted from 1; without it, as the cluster's scheduler says.
    #[arg(long, value_name = "I/N")]
    pub shard: Option<Shard>,
    /// Runs at a time; 0 for one a core.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub jobs: usize,
    /// Runs in a block, made a multiple of the arms; without it the folder's or, in a new one, what a thread does in half
    /// a minute by the cost of the first run (at most 256).
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    pub block: Option<u64>,
    /// Stop in time for this limit: 90s, 55m, 1h30m.
    #[arg(long, value_name = "TIME", value_parser = wall_time)]
    pub max_wall: Option<Duration>,
    /// Go on in a folder made with another scenario, campaign or version, keeping the blocks it has.
    #[arg(long)]
    pub force: bool,
    /// Show no progress.
    #[arg(long, short)]
    pub quiet: bool,
}

const RUN_AFTER: &str = "\
Without --shard the share is read from a Slurm array (SLURM_ARRAY_TASK_ID, _MIN, _STEP, _COUNT), a
HyperQueue task array counted from 1 (HQ_TASK_ID) or an indexed Kubernetes Job (JOB_COMPLETION_INDEX).
The latter two do not say how many there are: set RHEOTAXIS_SHARDS (for Kubernetes also JOB_COMPLETIONS).

Ctrl-C, a termination signal and --max-wall let the runs in hand end and write every row that is done, of blocks
that are not whole, too. A kill costs the runs in hand and at most half a minute of rows.

Exit codes: 0 the share is done; 75 stopped, the same command goes on; 1 error; 2 usage.";

/// Arguments of `campaign status`.
#[derive(Clone, Debug, PartialEq, Eq, clap::Args)]
#[command(after_help = "Exit codes: 0 all is done; 75 something is left to do; 1 error; 2 usage.")]
pub struct StatusArgs {
    /// Folder of the campaign.
    #[arg(value_name = "DIR")]
    pub dir: PathBuf,
}

/// Arguments of `campaign merge`.
#[derive(Clone, Debug, PartialEq, Eq, clap::Args)]
pub struct MergeArgs {
    /// Folder of the campaign.
    #[arg(value_name = "DIR")]
    pub dir: PathBuf,
    /// Parquet file to write; the declarations go beside it (all.parquet: all-declarations.parquet).
    #[arg(long, short, value_name = "FILE")]
    pub out: PathBuf,
    /// Write both as CSV files too, beside them.
    #[arg(long)]
    pub csv: bool,
}

/// Arguments of `campaign rerun`.
#[derive(Clone, Debug, PartialEq, Eq, clap::Args)]
#[command(
    long_about = "Makes one run of a campaign again and leaves what `rheotaxis run` leaves. Its digest must \
        be the row's.",
    after_help = "Exit codes: 0 the same digest, or no row to compare with; 1 another digest, or error; \
        130 interrupted; 2 usage."
)]
pub struct RerunArgs {
    /// Folder of the campaign.
    #[arg(value_name = "DIR")]
    pub dir: PathBuf,
    /// Which run, as in the column `run`.
    #[arg(long, value_name = "K")]
    pub run: u64,
    /// Record it (run.mcap).
    #[arg(long)]
    pub record: bool,
    /// Folder for the results; without it DIR/run-K.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Show no progress.
    #[arg(long, short)]
    pub quiet: bool,
}

/// Hours, minutes and seconds, in this order.
fn wall_time(text: &str) -> Result<Duration, String> {
    let wrong = || "must be like 90s, 55m or 1h30m".to_string();
    let (mut rest, mut seconds) = (text, 0_u64);
    for (unit, length) in [('h', 3600), ('m', 60), ('s', 1)] {
        if let Some((n, after)) = rest.split_once(unit) {
            let n: u64 = n.parse().map_err(|_| wrong())?;
            let part = n.checked_mul(length).ok_or_else(wrong)?;
            seconds = seconds.checked_add(part).ok_or_else(wrong)?;
            rest = after;
        }
    }
    if !rest.is_empty() || seconds == 0 {
        return Err(wrong());
    }
    Ok(Duration::from_secs(seconds))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wall_times_read_as_hours_minutes_and_seconds() {
        let seconds = |text: &str| wall_time(text).map(|d| d.as_secs()).ok();
        assert_eq!(seconds("55m"), Some(3300));
        assert_eq!(seconds("1h30m"), Some(5400));
        assert_eq!(seconds("1h2m3s"), Some(3723));
        for bad in ["", "5", "m", "30m1h", "0s", "-5s", "1.5h", "5 m"] {
            assert_eq!(seconds(bad), None, "{bad}");
        }
    }
}

/// Arguments of `campaign report`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
#[command(
    long_about = "Compares the arms of a campaign, whole or in part: success with Wilson's 95 % interval; time, path \
        and error with bootstrap intervals; curves of runs that have not yet declared and of errors; differences between \
        arms on the same seeds, each with its interval and whether it is better, worse or not separable at this \
        number of runs; and where the wall time went.\n\nLeaves CSV of everything drawn, figures as SVG and PNG, and \
        report.html."
)]
pub struct ReportArgs {
    /// Folder of the campaign.
    #[arg(value_name = "DIR")]
    pub dir: PathBuf,
    /// Folder for the report; without it DIR/report.
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}
