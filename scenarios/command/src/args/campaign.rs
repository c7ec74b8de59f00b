//! Arguments of `rheotaxis campaign`.

use super::key::KeyArgs;
use super::share::ShareArgs;
use clap::Subcommand;
use std::path::PathBuf;

/// Arguments of `campaign`.
#[derive(Clone, Debug, clap::Args)]
#[command(after_help = AFTER)]
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
  rheotaxis campaign report beta --against paper
  rheotaxis campaign rerun beta --run 17 --record

Exit codes: 0 done; 75 stopped before the end (the same command continues); 1 error; 2 wrong usage.";

/// What to do with a campaign.
#[derive(Clone, Debug, Subcommand)]
pub enum CampaignCommand {
    /// Check a campaign, count its runs and estimate what they cost.
    Plan(PlanArgs),
    /// Run a campaign, or what is left of it.
    Run(CampaignRunArgs),
    /// Show how much of a campaign is done.
    Status(StatusArgs),
    /// Write all rows of a campaign to one file, and all declarations to one beside it.
    Merge(MergeArgs),
    /// Compare the arms: tables, figures and a page.
    #[command(long_about = REPORT_ABOUT)]
    Report(ReportArgs),
    /// Find the drawn arms that come nearest to the figures that a paper prints.
    #[command(long_about = IDENTIFY_ABOUT)]
    Identify(IdentifyArgs),
    /// Repeat one run, with all the files that `rheotaxis run` writes.
    #[command(long_about = RERUN_ABOUT)]
    Rerun(RerunArgs),
}

/// Arguments of `campaign plan`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct PlanArgs {
    /// Campaign file, or the name of a campaign that comes with the program.
    #[arg(value_name = "FILE")]
    pub file: PathBuf,
    /// Runs in a block [default: what one thread does in half a minute].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    pub block: Option<u64>,
    /// Do not estimate the cost. The estimate makes one run.
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
    /// Folder for the blocks. Several machines may share it.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// The key of the runs.
    #[command(flatten)]
    pub key: KeyArgs,
    /// Which runs are made, and how.
    #[command(flatten)]
    pub share: ShareArgs,
    /// Runs in a block, rounded up to a multiple of the arms [default: as the folder has it; in a new folder, what one
    /// thread does in half a minute, at most 256].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    pub block: Option<u64>,
    /// Continue in a folder that was begun with another scenario, campaign or version, and keep its blocks.
    #[arg(long)]
    pub force: bool,
}

const RUN_AFTER: &str = "\
Without --shard the share is read from a Slurm array (SLURM_ARRAY_TASK_ID, _MIN, _STEP, _COUNT), a
HyperQueue task array counted from 1 (HQ_TASK_ID) or an indexed Kubernetes Job (JOB_COMPLETION_INDEX).
HyperQueue and Kubernetes do not say how many shares there are: set RHEOTAXIS_SHARDS (for Kubernetes
JOB_COMPLETIONS works too).

After Ctrl-C, a termination signal or --max-wall, the runs under way are finished and every finished row is
written, also of blocks that are not complete. SIGKILL loses the runs under way and at most half a minute of rows.

Exit codes: 0 the share is done; 75 stopped (the same command continues); 1 error; 2 wrong usage.";

/// Arguments of `campaign status`.
#[derive(Clone, Debug, PartialEq, Eq, clap::Args)]
#[command(after_help = "Exit codes: 0 all runs are done; 75 some are left; 1 error; 2 wrong usage.")]
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
    /// Also write both as CSV files beside them.
    #[arg(long)]
    pub csv: bool,
}

/// Arguments of `campaign identify`.
#[derive(Clone, Debug, PartialEq, Eq, clap::Args)]
pub struct IdentifyArgs {
    /// Folder of the campaign that draws the arms, and of the rounds after it.
    #[arg(value_name = "DIR", required = true)]
    pub dirs: Vec<PathBuf>,
    /// Row with the paper's figures, by its name or file [default: that of the first campaign's name].
    #[arg(long, value_name = "ROW")]
    pub figures: Option<PathBuf>,
    /// Do not judge by this figure, by its name in the table; may be given several times.
    #[arg(long, value_name = "FIGURE")]
    pub leave_out: Vec<String>,
    /// Folder for the results.
    #[arg(long, short, value_name = "DIR")]
    pub out: PathBuf,
}

/// Arguments of `campaign rerun`.
#[derive(Clone, Debug, PartialEq, Eq, clap::Args)]
#[command(after_help = "Exit codes: 0 the same digest, or no row to compare with; 1 another digest, or an error; \
        130 interrupted; 2 wrong usage.")]
pub struct RerunArgs {
    /// Folder of the campaign.
    #[arg(value_name = "DIR")]
    pub dir: PathBuf,
    /// Number of the run, as in the column `run`.
    #[arg(long, value_name = "K")]
    pub run: u64,
    /// The key of the runs.
    #[command(flatten)]
    pub key: KeyArgs,
    /// Write the recording (run.mcap).
    #[arg(long)]
    pub record: bool,
    /// Folder for the results [default: DIR/run-K].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Do not show progress.
    #[arg(long, short)]
    pub quiet: bool,
}

/// What the help of this command begins with.
pub(super) const CAMPAIGN_ABOUT: &str = "A campaign runs variants of a scenario (arms) with the same seeds and compares them. A campaign file \
        (RON) names the scenario, the arms with the values that each changes, the conditions and the seeds. Start with \
        `plan`, which checks the file and estimates the cost; then `run`, `status` and `report`.\n\n\
        Seeds: `seeds: 20` means seeds 1 to 20, and `seeds: Literal(first: 101, count: 20)` means 101 to 120. Each row \
        is then the run of `rheotaxis run --seed N` of the same scenario and has the same digest. \
        `seeds: Hashed(seed: 1, count: 20)` gives every condition seeds of its own.\n\n\
        `run` writes blocks of rows, each a Parquet file. A run that has a row is done, so a campaign can be \
        interrupted and continued at any time, and any number of machines can work in the same folder. A row does not \
        depend on how the work was divided.\n\n\
        Arms that differ only in the searcher share one plume for each seed and run in it together, in lanes. Each row \
        is that of the run alone.";

/// What the help of this command begins with.
pub(super) const RERUN_ABOUT: &str = "Repeats one run of a campaign and writes the files that `rheotaxis run` writes. Its digest must be \
        the one in the row.";

/// What the help of this command begins with.
pub(super) const IDENTIFY_ABOUT: &str = "Which of a campaign's drawn arms (`drawn_arms`) come nearest to the figures that a paper prints? The distance of a \
        draw is that of its runs' figures from the paper's, each in the figure's own standard errors; the nearest \
        hundredth is accepted (approximate Bayesian computation). The figures are those of the first arm of a row of \
        `rheotaxis reproduce` that say how well they are known.\n\n\
        A first round of a few seeds leaves most draws out. `next.ron` is the campaign of the nearest tenth, on the seeds \
        that follow; run it, then name both folders:\n\n  \
        rheotaxis campaign run crab_identify --out round1\n  \
        rheotaxis campaign identify round1 --out found1\n  \
        rheotaxis campaign run found1/next.ron --out round2\n  \
        rheotaxis campaign identify round1 round2 --out found\n\n\
        It writes IDENTIFICATION.md, draws.csv, next.ron and a picture of all pairs of unknowns.";

/// What the help of this command begins with.
pub(super) const REPORT_ABOUT: &str = "Compares the arms of a campaign, even if it is not complete. The report has:\n\n\
        - success shares with Wilson's 95 % interval;\n\
        - time, path and error with bootstrap intervals;\n\
        - curves over time of the share of runs that have not yet declared, and curves of the errors;\n\
        - differences between arms on the same seeds: better, worse, or not separable at this number of runs;\n\
        - the tracks of the best, the median and the worst run of each of the first three arms; these runs are made \
        anew;\n\
        - where the computing time went.\n\n\
        It is written as report.html, with figures as SVG and PNG and a CSV file for everything drawn.";

/// Arguments of `campaign report`.
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct ReportArgs {
    /// Folder of the campaign.
    #[arg(value_name = "DIR")]
    pub dir: PathBuf,
    /// Folder for the report [default: DIR/report].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Compare each other arm with this one [default: each with each; of more than five, each with the first].
    #[arg(long, value_name = "ARM")]
    pub against: Option<String>,
    /// Do not make runs anew to show their tracks.
    #[arg(long)]
    pub no_tracks: bool,
    /// Runs at the same time; 0 means one on each core.
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub jobs: usize,
    /// Show no progress.
    #[arg(short, long)]
    pub quiet: bool,
    /// The key of the runs.
    #[command(flatten)]
    pub key: KeyArgs,
}
